//! Fixed-point numbers with 30 bits after the point: 64 times finer than f32 next to one, and as cheap on the ECU.
//!
//! Sums of rotors and levers cancel, and f32 keeps 6e-8 of each term. A Cortex-M4F multiplies two 32-bit integers into 64 bits in
//! one instruction. Whoever makes the constants keeps every number below two; sums wrap, so that nothing can panic.

use crate::{Real, Rotor};

/// Steps in one.
const STEPS: f64 = (1u32 << 30) as f64;

/// A number in (−2, 2), in steps of 2⁻³⁰.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fixed(pub(crate) i32);

/// A product of two [`Fixed`], in steps of 2⁻⁶⁰.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide(pub(crate) i64);

impl Fixed {
    /// The nearest to a constant; `None` where it does not fit.
    pub(crate) fn new(x: f64) -> Option<Self> {
        (x > -2.0 && x < 2.0).then(|| Self((x * STEPS).nearest_i32()))
    }

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }

    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }

    #[inline(always)]
    pub(crate) fn negated(self) -> Self {
        Self(self.0.wrapping_neg())
    }

    #[inline(always)]
    pub(crate) fn half(self) -> Self {
        Self(self.0 >> 1)
    }

    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Wide {
        Wide(i64::from(self.0).wrapping_mul(i64::from(other.0)))
    }

    /// A number within (−2, 2) to the step below its magnitude; exact where T's own steps are no finer.
    #[inline(always)]
    pub(crate) fn of<T: Real>(x: T) -> Self {
        Self((x * T::from_f64(STEPS)).truncated_i32())
    }

    #[inline(always)]
    pub(crate) fn to_real<T: Real>(self) -> T {
        T::from_i32(self.0) * T::from_f64(1.0 / STEPS)
    }
}

impl Wide {
    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }

    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }

    #[inline(always)]
    pub(crate) fn narrow(self) -> Fixed {
        Fixed((self.0 >> 30) as i32)
    }

    /// The root to a step or two: T's own, and one step of Newton's for what its rounding left. `None` below 2⁻²⁹.
    #[inline(always)]
    pub(crate) fn root<T: Real>(self) -> Option<Fixed> {
        if self.0 < 1 << 31 {
            return None;
        }
        let near = T::from_i32((self.0 >> 30) as i32).sqrt_of_magnitude() * T::from_f64(32768.0);
        let first = Fixed(near.truncated_i32());
        let rest = self.minus(first.times(first)).0 >> 20;
        let correction = T::from_i32(rest as i32) * T::from_f64(524288.0) / near;
        Some(first.plus(Fixed(correction.truncated_i32())))
    }
}

/// A plane vector of such numbers; a rotor where its length is one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedVec {
    pub(crate) x: Fixed,
    pub(crate) z: Fixed,
}

impl FixedVec {
    pub(crate) fn new(x: f64, z: f64) -> Option<Self> {
        Some(Self { x: Fixed::new(x)?, z: Fixed::new(z)? })
    }

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self { x: self.x.plus(other.x), z: self.z.plus(other.z) }
    }

    #[inline(always)]
    pub(crate) fn scale(self, by: Fixed) -> Self {
        Self { x: self.x.times(by).narrow(), z: self.z.times(by).narrow() }
    }

    #[inline(always)]
    pub(crate) fn norm_squared(self) -> Fixed {
        self.x.times(self.x).plus(self.z.times(self.z)).narrow()
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Fixed {
        self.x.times(other.x).plus(self.z.times(other.z)).narrow()
    }

    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        Self { x: self.x.minus(other.x), z: self.z.minus(other.z) }
    }

    /// A rotor's direction, its length brought to one to first order: rounded to T it is up to T's step too long or short.
    #[inline(always)]
    pub(crate) fn direction<T: Real>(rotor: Rotor<T>) -> Self {
        let (x, z) = (Fixed::of(rotor.cos), Fixed::of(rotor.sin));
        let excess = x.times(x).plus(z.times(z)).minus(Wide(1 << 60));
        let half = Fixed((excess.0 >> 31) as i32);
        Self { x: x.minus(x.times(half).narrow()), z: z.minus(z.times(half).narrow()) }
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Fixed {
        self.x.times(other.z).minus(self.z.times(other.x)).narrow()
    }

    #[inline(always)]
    pub(crate) fn complex_mul(self, other: Self) -> Self {
        Self {
            x: self.x.times(other.x).minus(self.z.times(other.z)).narrow(),
            z: self.x.times(other.z).plus(self.z.times(other.x)).narrow(),
        }
    }
}
