//! The number type of the maps: f32 on the ECU, f64 for research, or anything with `+ − × ÷ √`.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::sqrt::{sqrt_f32, sqrt_f64};

/// What the maps need of a number: `+ − × ÷ √` and comparison. No trigonometry, no fused multiply-add.
///
/// ```
/// use kinematics_core::Real;
/// fn hypotenuse<T: Real>(a: T, b: T) -> T {
///     (a * a + b * b).sqrt()
/// }
/// assert_eq!((hypotenuse(3.0_f32, 4.0), hypotenuse(5.0_f64, 12.0)), (5.0, 13.0));
/// // To the ECU's precision and back: 0.1 is not the same number in f32.
/// assert_eq!(f32::from_f64(0.1).to_f64(), f64::from(0.1_f32));
/// assert_eq!(f64::from_i32(-3) + f64::ONE + f64::ZERO, -2.0);
/// assert_eq!([2.4_f32, 2.5, -2.5, 1e12, f32::NAN].map(Real::nearest_i32), [2, 3, -3, i32::MAX, 0]);
/// assert_eq!([2.9_f32, -2.9, 1e12, f32::NAN].map(Real::truncated_i32), [2, -2, i32::MAX, 0]);
/// assert_eq!((-4.0_f32).sqrt_of_magnitude(), 2.0);
/// assert_eq!(<f64 as Real>::atan2(1.0, 0.0), core::f64::consts::FRAC_PI_2);
/// ```
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;

    /// The nearest value to `x`.
    fn from_f64(x: f64) -> Self;

    /// The value `n`, exactly where the type can hold it.
    fn from_i32(n: i32) -> Self;

    /// Whether steps of 2⁻³⁰ are finer than this type's next to one: sums that cancel are then formed in fixed point
    /// ([`crate::Machine::cylinders_to_tip_with_fine_jacobian`]).
    const COARSER_THAN_FIXED: bool;

    /// The integer next to it towards zero, saturating; 0 for NaN.
    fn truncated_i32(self) -> i32;

    /// The nearest integer, halves away from zero, saturating; 0 for NaN.
    fn nearest_i32(self) -> i32;

    /// `x` as f64, for messages and edges.
    fn to_f64(self) -> f64;

    /// The correctly rounded square root.
    fn sqrt(self) -> Self;

    /// √|x|: for what is known not to be negative. On the ECU it spares the test for a negative argument that
    /// [`Real::sqrt`] carries; below zero it hides the error that a NaN would show.
    #[inline(always)]
    fn sqrt_of_magnitude(self) -> Self {
        if self < Self::ZERO { (-self).sqrt() } else { self.sqrt() }
    }

    /// Angle of the vector (x, y) in radians. For the edges only: the loop never calls it.
    fn atan2(y: Self, x: Self) -> Self;

    /// Splits a constant into a high and a low part whose sum is `x` to twice this type's precision.
    #[inline]
    fn split(x: f64) -> Split<Self> {
        let hi = Self::from_f64(x);
        Split { hi, lo: Self::from_f64(x - hi.to_f64()) }
    }
}

/// A constant as the unevaluated sum hi + lo, so that adding a measured length to it rounds once, not twice.
///
/// ```
/// use kinematics_core::Real;
/// let constant = f32::split(2.163);
/// let length = 2.163_f32;
/// // Of the small difference f32 alone keeps nothing.
/// assert_eq!(constant.hi - length, 0.0);
/// let difference = 2.163 - f64::from(length);
/// assert!(difference.abs() > 1e-9);
/// assert!((constant.minus(length).to_f64() - difference).abs() < 1e-14);
/// assert!((constant.plus(-length).to_f64() - difference).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split<T> {
    /// The constant rounded to T.
    pub hi: T,
    /// What rounding left over.
    pub lo: T,
}

impl<T: Real> Split<T> {
    /// constant + x
    #[inline(always)]
    pub fn plus(self, x: T) -> T {
        (self.hi + x) + self.lo
    }

    /// constant − x
    #[inline(always)]
    pub fn minus(self, x: T) -> T {
        (self.hi - x) + self.lo
    }
}

impl Real for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const COARSER_THAN_FIXED: bool = true;

    #[inline(always)]
    fn truncated_i32(self) -> i32 {
        self as i32
    }

    #[inline(always)]
    fn from_i32(n: i32) -> Self {
        n as f32
    }
    #[inline(always)]
    fn nearest_i32(self) -> i32 {
        let away = if self < 0.0 { self - 0.5 } else { self + 0.5 };
        away as i32
    }

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as f32
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        sqrt_f32(self)
    }
    #[inline(always)]
    fn sqrt_of_magnitude(self) -> Self {
        sqrt_f32(self.abs())
    }
    fn atan2(y: Self, x: Self) -> Self {
        libm::atan2f(y, x)
    }
}

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const COARSER_THAN_FIXED: bool = false;

    #[inline(always)]
    fn truncated_i32(self) -> i32 {
        self as i32
    }

    #[inline(always)]
    fn from_i32(n: i32) -> Self {
        n as f64
    }
    #[inline(always)]
    fn nearest_i32(self) -> i32 {
        let away = if self < 0.0 { self - 0.5 } else { self + 0.5 };
        away as i32
    }

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        sqrt_f64(self)
    }
    fn atan2(y: Self, x: Self) -> Self {
        libm::atan2(y, x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_of_the_magnitude_is_the_root_bit_for_bit_wherever_there_is_one() {
        for x in [0.0_f32, 1e-45, 1e-38, 0.2, 2.0, 3e38, f32::INFINITY] {
            assert_eq!(x.sqrt_of_magnitude().to_bits(), Real::sqrt(x).to_bits(), "{x}");
            assert_eq!((-x).sqrt_of_magnitude().to_bits(), Real::sqrt(x).to_bits(), "-{x}");
        }
        assert!(f32::NAN.sqrt_of_magnitude().is_nan());
    }
}
