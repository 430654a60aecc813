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

/// The saturating product, rounded down: the bits of `fixed`'s own in a third fewer instructions on the Cortex-M4F.
pub(crate) trait Times {
    fn times(self, other: Self) -> Self;
}

impl Times for Q {
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        let wide = (i64::from(self.to_bits()) * i64::from(other.to_bits())) >> Self::FRAC_NBITS;
        match i32::try_from(wide) {
            Ok(bits) => Self::from_bits(bits),
            Err(_) if wide < 0 => Self::MIN,
            Err(_) => Self::MAX,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Q, Times};

    #[test]
    fn the_product_has_the_bits_of_fixeds_own() {
        let mut bits = 1_i32;
        for _ in 0..100_000 {
            let a = Q::from_bits(bits >> (bits & 31));
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let b = Q::from_bits(bits >> (bits & 15));
            assert_eq!(a.times(b), a.saturating_mul(b));
        }
        assert_eq!([Q::MAX.times(Q::MAX), Q::MIN.times(Q::MAX), Q::MIN.times(Q::MIN)], [Q::MAX, Q::MIN, Q::MAX]);
    }
}
