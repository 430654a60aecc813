//! Unit complex numbers for rotations, and plane vectors.

use core::ops::{Add, Mul, Sub};

use crate::Real;

/// A vector in a plane frame: x along the frame's first axis, z along its second. Metres.
///
/// ```
/// use kinematics_core::Vec2;
/// let v = Vec2::new(3.0, 4.0);
/// assert_eq!((v.norm_squared(), v.norm()), (25.0, 5.0));
/// // Turned left by 90°: at right angles, counter-clockwise.
/// let left = v.complex_mul(Vec2::new(0.0, 1.0));
/// assert_eq!(left, Vec2::new(-4.0, 3.0));
/// assert_eq!((v.dot(left), v.cross(left), left.cross(v)), (0.0, 25.0, -25.0));
/// assert_eq!(v.conjugate().scale(2.0), Vec2::new(6.0, -8.0));
/// let direction = v.direction().expect("not zero");
/// assert_eq!((direction.cos, direction.sin), (0.6, 0.8));
/// assert_eq!((v - v).direction(), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vec2<T> {
    /// First component.
    pub x: T,
    /// Second component.
    pub z: T,
}

impl<T: Real> Vec2<T> {
    /// The vector (x, z).
    #[inline(always)]
    pub const fn new(x: T, z: T) -> Self {
        Self { x, z }
    }

    /// x² + z².
    #[inline(always)]
    pub fn norm_squared(self) -> T {
        self.x * self.x + self.z * self.z
    }

    /// √(x² + z²).
    #[inline]
    pub fn norm(self) -> T {
        self.norm_squared().sqrt()
    }

    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.x * other.x + self.z * other.z
    }

    /// The vector product's out-of-plane component, positive when `other` lies counter-clockwise.
    #[inline(always)]
    pub fn cross(self, other: Self) -> T {
        self.x * other.z - self.z * other.x
    }

    /// This vector scaled.
    #[inline(always)]
    pub fn scale(self, by: T) -> Self {
        Self::new(self.x * by, self.z * by)
    }

    /// The complex product: this vector rotated by `other`'s angle and scaled by its length.
    #[inline(always)]
    pub fn complex_mul(self, other: Self) -> Self {
        Self::new(self.x * other.x - self.z * other.z, self.x * other.z + self.z * other.x)
    }

    /// The mirror image in the first axis.
    #[inline(always)]
    pub fn conjugate(self) -> Self {
        Self::new(self.x, -self.z)
    }

    /// The direction of this vector; `None` for the zero vector or one that is not finite.
    pub fn direction(self) -> Option<Rotor<T>> {
        let norm = self.norm();
        if norm > T::ZERO && norm * T::ZERO == T::ZERO {
            Some(Rotor { cos: self.x / norm, sin: self.z / norm })
        } else {
            None
        }
    }
}

impl<T: Real> Add for Vec2<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.z + other.z)
    }
}

impl<T: Real> Sub for Vec2<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.z - other.z)
    }
}

/// A rotation as the unit complex number (cos θ, sin θ).
///
/// ```
/// use core::f64::consts::FRAC_PI_6;
/// use kinematics_core::{Rotor, Vec2};
/// let near = |a: Vec2<f64>, b: Vec2<f64>| (a - b).norm() < 1e-15;
/// // A quarter turn is exact; 30° come to one rounding.
/// let quarter = Rotor::from_turns(0.25);
/// assert_eq!(quarter.rotate(Vec2::new(2.0, 1.0)), Vec2::new(-1.0, 2.0));
/// let thirty = Rotor::from_angle(FRAC_PI_6);
/// assert!(near(thirty.to_vec(), Vec2::new(0.75f64.sqrt(), 0.5)));
/// assert!(((quarter * thirty.inverse()).angle() - 2.0 * FRAC_PI_6).abs() < 1e-15);
/// // A rotor 1e-4 too long is 1.5e-8 off afterwards.
/// let long = Rotor { cos: 1.0001 * thirty.cos, sin: 1.0001 * thirty.sin };
/// assert!((long.renormalised().to_vec().norm() - 1.0).abs() < 2e-8);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotor<T> {
    /// cos θ
    pub cos: T,
    /// sin θ
    pub sin: T,
}

impl<T: Real> Rotor<T> {
    /// No rotation.
    pub const IDENTITY: Self = Self { cos: T::ONE, sin: T::ZERO };

    /// The opposite rotation.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        Self { cos: self.cos, sin: -self.sin }
    }

    /// `v` rotated by this rotor.
    #[inline(always)]
    pub fn rotate(self, v: Vec2<T>) -> Vec2<T> {
        v.complex_mul(self.to_vec())
    }

    /// The unit vector at this angle.
    #[inline(always)]
    pub fn to_vec(self) -> Vec2<T> {
        Vec2::new(self.cos, self.sin)
    }

    /// The same rotation with its length brought back to one to first order, for rotors built up by many products.
    #[inline(always)]
    pub fn renormalised(self) -> Self {
        let half = T::from_f64(0.5);
        let correction = T::from_f64(1.5) - half * self.to_vec().norm_squared();
        Self { cos: self.cos * correction, sin: self.sin * correction }
    }

    /// The angle in (−π, π] radians. For the edges (display, configuration), never for the loop.
    pub fn angle(self) -> T {
        let angle = T::atan2(self.sin, self.cos);
        // atan2(−0, −1) is −π; the half-open range has one name for half a turn.
        if angle <= -T::atan2(T::ZERO, -T::ONE) { -angle } else { angle }
    }

    /// The rotor of `turns` of a full circle, by polynomial: `+ − ×` only, the same bits on host and ECU.
    ///
    /// Meant for angle sensors, the bucket angle of a trajectory and configuration. The error is the rounding of
    /// `turns` and about one of the result, up to 2²⁹ turns; beyond, what comes out is no rotor. Not finite in, not finite out.
    #[inline]
    pub fn from_turns(turns: T) -> Self {
        let quarters = (turns * T::from_i32(4)).nearest_i32();
        let rest = turns - T::from_i32(quarters) * T::from_f64(0.25);
        let base = Self::within_eighth(rest * T::from_f64(core::f64::consts::TAU));
        match quarters & 3 {
            0 => base,
            1 => Self { cos: -base.sin, sin: base.cos },
            2 => Self { cos: -base.cos, sin: -base.sin },
            _ => Self { cos: base.sin, sin: -base.cos },
        }
    }

    /// The rotor of an angle in radians; see [`Rotor::from_turns`].
    #[inline]
    pub fn from_angle(radians: T) -> Self {
        Self::from_turns(radians * T::from_f64(0.5 * core::f64::consts::FRAC_1_PI))
    }

    /// The rotor of an angle in degrees; see [`Rotor::from_turns`].
    ///
    /// ```
    /// # use kinematics_core::Rotor;
    /// let sixty = Rotor::<f64>::from_degrees(60.0);
    /// assert!((sixty.cos - 0.5).abs() < 1e-15);
    /// // Rotations compose by multiplication.
    /// let half_a_turn = sixty * sixty * sixty;
    /// assert!((half_a_turn.angle().abs() - core::f64::consts::PI).abs() < 1e-15);
    /// ```
    #[inline]
    pub fn from_degrees(degrees: T) -> Self {
        Self::from_turns(degrees / T::from_f64(360.0))
    }

    /// Taylor series for |x| ≤ π/4 rad: terms to x¹⁷ leave 1e-17 there, those to x¹¹ 2e-10, so that f64 and f32 end at their rounding.
    #[inline]
    fn within_eighth(x: T) -> Self {
        let square = x * x;
        // 1/(n(n−1)) from the innermost term outwards.
        let (cos, sin) = if T::COARSER_THAN_FIXED {
            (T::ONE, T::ONE)
        } else {
            (inner(square, [240.0, 182.0, 132.0]), inner(square, [272.0, 210.0, 156.0]))
        };
        let cos = outer(square, [90.0, 56.0, 30.0, 12.0, 2.0], cos);
        let sin = x * outer(square, [110.0, 72.0, 42.0, 20.0, 6.0], sin);
        Self { cos, sin }
    }
}

/// Written out, so that a build for size too divides while it compiles and not in the loop.
#[inline(always)]
fn inner<T: Real>(square: T, [a, b, c]: [f64; 3]) -> T {
    term(square, c, term(square, b, term(square, a, T::ONE)))
}

#[inline(always)]
fn outer<T: Real>(square: T, [d, e, f, g, h]: [f64; 5], sum: T) -> T {
    term(square, h, term(square, g, term(square, f, term(square, e, term(square, d, sum)))))
}

#[inline(always)]
fn term<T: Real>(square: T, denominator: f64, sum: T) -> T {
    T::ONE - square * T::from_f64(1.0 / denominator) * sum
}

impl<T: Real> Mul for Rotor<T> {
    type Output = Self;
    /// The rotation by the sum of both angles.
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let v = self.to_vec().complex_mul(other.to_vec());
        Self { cos: v.x, sin: v.z }
    }
}
