//! Double-double numbers, about 100 bits, for the oracle.
//!
//! `twofloat`'s sums, products and square root keep them; its quotient does not (53 bits: the residual in its
//! algorithm is formed without a fused multiply-add), so the quotient here is long division. `tests/oracle.rs` counts the bits.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use twofloat::TwoFloat;

/// A number of about 100 bits.
#[derive(Clone, Copy, Debug)]
pub struct Wide(TwoFloat);

impl Wide {
    /// The value of `x`, exactly.
    pub const fn from_f64(x: f64) -> Self {
        Self(TwoFloat::from_f64(x))
    }

    /// The nearest f64.
    pub fn to_f64(self) -> f64 {
        self.0.hi()
    }

    /// The square root; zero for what rounding left below zero by less than 1e-25.
    ///
    /// # Panics
    /// For anything further below zero, or not a number: the oracle was asked for a pose that does not exist.
    pub fn sqrt(self) -> Self {
        assert!(self.to_f64() > -1e-25, "square root of {}", self.to_f64());
        if self.to_f64() > 0.0 { Self(self.0.sqrt()) } else { Self::from_f64(0.0) }
    }
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Wide {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Div for Wide {
    type Output = Self;
    /// Long division with three f64 digits.
    fn div(self, other: Self) -> Self {
        let digit = |rest: TwoFloat| rest.hi() / other.0.hi();
        let first = digit(self.0);
        let rest = self.0 - other.0 * first;
        let second = digit(rest);
        let rest = rest - other.0 * second;
        Self(TwoFloat::new_add(first, second) + digit(rest))
    }
}

impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl PartialEq for Wide {
    fn eq(&self, other: &Self) -> bool {
        (*self - *other).to_f64() == 0.0
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        (*self - *other).to_f64().partial_cmp(&0.0)
    }
}

/// A point or direction in the plane.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Forward.
    pub x: Wide,
    /// Up.
    pub z: Wide,
}

impl Point {
    /// The point (x, z), exactly.
    pub const fn new(x: f64, z: f64) -> Self {
        Self { x: Wide::from_f64(x), z: Wide::from_f64(z) }
    }

    /// Scalar product.
    pub fn dot(self, other: Self) -> Wide {
        self.x * other.x + self.z * other.z
    }

    /// Vector product: positive when `other` lies counter-clockwise.
    pub fn cross(self, other: Self) -> Wide {
        self.x * other.z - self.z * other.x
    }

    /// Length.
    pub fn norm(self) -> Wide {
        self.dot(self).sqrt()
    }

    /// Scaled.
    pub fn scale(self, by: Wide) -> Self {
        Self { x: self.x * by, z: self.z * by }
    }

    /// Scaled to length one.
    pub fn unit(self) -> Self {
        self.scale(Wide::from_f64(1.0) / self.norm())
    }

    /// This direction turned by the angle of the unit vector `by`.
    pub fn turned(self, by: Self) -> Self {
        Self { x: self.x * by.x - self.z * by.z, z: self.x * by.z + self.z * by.x }
    }

    /// This direction turned back by the angle of the unit vector `by`.
    pub fn turned_back(self, by: Self) -> Self {
        Self { x: self.dot(by), z: by.cross(self) }
    }
}

impl Add for Point {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, z: self.z + other.z }
    }
}

impl Sub for Point {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, z: self.z - other.z }
    }
}
