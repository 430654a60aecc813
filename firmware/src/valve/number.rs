//! Currents, voltages and duties as fixed point.
//!
//! Only the saturating operations of `fixed` are used: its plain operators wrap in release.

/// Amperes, volts, ohms, and duties as fractions: within ±2048 in steps of 2⁻²⁰.
pub type Q = fixed::types::I12F20;

/// Nearest below; saturates at the ends, and NaN is zero.
pub fn q(x: f32) -> Q {
    // A power of two scales exactly; the cast saturates.
    Q::from_bits((x * 1_048_576.0) as i32)
}

/// As a float, SI; exact up to ±16.
pub fn si(x: Q) -> f32 {
    x.to_bits() as f32 / 1_048_576.0
}

/// A fraction 0…1 as the compare value of a 16-bit PWM timer; 65535 is always on.
pub fn duty_code(fraction: Q) -> u16 {
    core::cmp::min(core::cmp::max(fraction.to_bits(), 0) >> 4, 65535) as u16
}

/// `x` between `low` and `high`.
pub(crate) fn bounded(x: Q, low: Q, high: Q) -> Q {
    core::cmp::max(low, core::cmp::min(x, high))
}
