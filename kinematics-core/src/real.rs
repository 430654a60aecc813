//! The number type of the maps: f32 on the ECU, f64 for research, or anything with `+ − × ÷ √`.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::sqrt::{sqrt_f32, sqrt_f64};

/// What the maps need of a number: `+ − × ÷ √` and comparison. No trigonometry, no fused multiply-add.
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
