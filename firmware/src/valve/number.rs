//! Counts of the converter and of the timer as fixed point; amperes, volts and duties between them are f32.

/// A share of full scale, a step for each code of 16 bits; it may be below zero.
pub type Share = fixed::types::I16F16;

/// The share that `code` is beyond `zero`.
#[inline(always)]
pub fn share(code: u16, zero: u16) -> Share {
    Share::from_bits(i32::from(code) - i32::from(zero))
}

/// A share as a float; exact.
#[inline(always)]
pub fn fraction(share: Share) -> f32 {
    share.to_bits() as f32 / 65536.0
}

/// The compare value of a 16-bit PWM timer for a duty 0…1; below is off, and 65535 is always on. A duty is never NaN.
#[inline(always)]
pub fn duty_code(duty: f32) -> u16 {
    // From 1 to 2 a float's bits count in steps of 2⁻²³, below and above they still rise: fewer instructions than the
    // saturating cast.
    let steps = (1.0 + duty).to_bits().cast_signed().saturating_sub(1.0_f32.to_bits().cast_signed());
    (steps >> 7).clamp(0, 65535) as u16
}
