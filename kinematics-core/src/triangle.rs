//! The triangle of two fixed sides and a cylinder: boom, arm, swing cylinder, and the bucket's rocker.
//!
//! With sides a, b and cylinder length L, the angle α between a and b has
//! `cos α = (u − v)/4ab` and `sin α = 2√(uv)/4ab`, where `u = (a+b)² − L²`, `v = L² − (a−b)²`, `u + v = 4ab`:
//! Koivo 1994 (10)–(13), Frankel 2003 (7), (9) without an angle. u and v are products of sums, so the relative accuracy
//! survives near the dead points (α = 0, π), where `√(1 − cos²)` loses it; the constant sums are stored as
//! hi + lo, for the same reason.
//!
//! ```
//! use kinematics_core::triangle::{Side, Triangle};
//! use kinematics_core::Vec2;
//! // Two sides of 1 m, the cylinder across the right angle between them.
//! let triangle = Triangle::<f64>::new(Vec2::new(1.0, 0.0), Vec2::new(1.0, 0.0), Side::CounterClockwise, 1.0);
//! let length = 2.0f64.sqrt();
//! let joint = triangle.rotor(length).unwrap();
//! assert!(joint.cos.abs() < 1e-15 && (joint.sin - 1.0).abs() < 1e-15);
//! assert!((triangle.length(joint).unwrap() - length).abs() < 1e-15);
//! // It pulls at 0.71 m from the pin, of the length as of the joint; d²L/dθ² = −(dL/dθ)²/L here.
//! let arm = triangle.moment_arm(length).unwrap();
//! assert!((arm - 0.5f64.sqrt()).abs() < 1e-15);
//! assert!((triangle.moment_arm_at(joint).unwrap() - arm).abs() < 1e-15);
//! assert!((triangle.moment(length).unwrap().slope + arm * arm / length).abs() < 1e-15);
//! // Beyond 2 m the sides miss each other, below 0° there is no length; unchecked, nobody says so.
//! assert_eq!(triangle.vector(length).map(|v| (v.x, v.z)), Ok((joint.cos, joint.sin)));
//! assert_eq!(triangle.vector(2.5), Err(0.5));
//! assert_eq!(triangle.vector_unchecked(length), joint.to_vec());
//! assert!(triangle.vector_unchecked(2.5).x.is_nan());
//! assert!((triangle.length(joint.inverse()).unwrap_err() - 0.5f64.sqrt()).abs() < 1e-15);
//! assert!((triangle.length_unchecked(joint.inverse()) - length).abs() < 1e-15);
//! ```

use crate::{Real, Rotor, Split, Vec2};

/// On which side of the fixed pin's direction the moving pin lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The joint turns counter-clockwise as the cylinder extends.
    CounterClockwise,
    /// The joint turns clockwise as the cylinder extends.
    Clockwise,
}

/// A joint moved by a cylinder between a fixed and a moving pin.
#[derive(Clone, Copy, Debug)]
pub struct Triangle<T> {
    /// a + b
    sum: Split<T>,
    /// |a − b|
    difference: Split<T>,
    /// The joint's vector is (u − v)·straight + √(uv)·across, times the length given to [`Triangle::new`].
    straight: Vec2<T>,
    across: Vec2<T>,
    /// 2σ, σ = +1 where the joint turns counter-clockwise as the cylinder extends, else −1.
    turn: T,
    /// a² + b², and −2ab times the constant rotor's parts: L² = squares + cos θ·back.x + sin θ·back.z
    squares: T,
    back: Vec2<T>,
}

/// A triangle that closes away from its dead points: the joint's vector, and √(uv) = 2ab·sin α > 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closed<T> {
    pub(crate) vector: Vec2<T>,
    pub(crate) root: T,
}

impl<T: Real> Closed<T> {
    /// The vector as a rotor, for a scale of one.
    #[inline(always)]
    pub(crate) fn rotor(&self) -> Rotor<T> {
        Rotor { cos: self.vector.x, sin: self.vector.z }
    }
}

/// dL/dθ and d²L/dθ² of one cylinder and its joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment<T> {
    /// dL/dθ, m/rad: positive where the joint turns counter-clockwise as the cylinder extends.
    pub arm: T,
    /// d²L/dθ², m/rad².
    pub slope: T,
}

/// Forward and inverse constants of one triangle in f64, before they are rounded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sides {
    pub(crate) a: f64,
    pub(crate) b: f64,
}

impl Sides {
    pub(crate) fn closed_by(self, length: f64) -> bool {
        let difference = if self.a > self.b { self.a - self.b } else { self.b - self.a };
        length > difference && length < self.a + self.b
    }
}

impl<T: Real> Triangle<T> {
    /// The triangle with `fixed` (from the joint's pin to the cylinder's base, in the fixed link's frame) and
    /// `moving` (to the rod eye, in the moving link's frame); metres. The joint's rotor comes out multiplied by
    /// `scale` in the forward map. Both vectors must be non-zero: `PinGeometry::validate` sees to it.
    pub fn new(fixed: Vec2<f64>, moving: Vec2<f64>, side: Side, scale: f64) -> Self {
        let (a, b) = (fixed.norm(), moving.norm());
        let four_ab = 4.0 * a * b;
        let sigma = match side {
            Side::CounterClockwise => 1.0,
            Side::Clockwise => -1.0,
        };
        // moving·rotor(θ) = |moving|/|fixed| · fixed · rotor(σα), hence rotor(θ) = rotor(σα) · fixed·conj(moving)/ab.
        let offset = fixed.complex_mul(moving.conjugate()).scale(1.0 / (a * b));
        let straight = offset.scale(scale / four_ab);
        let across = Vec2::new(-offset.z, offset.x).scale(sigma * 2.0 * scale / four_ab);
        let back = offset.scale(-2.0 * a * b);
        let round = |v: Vec2<f64>| Vec2::new(T::from_f64(v.x), T::from_f64(v.z));
        Self {
            sum: T::split(a + b),
            difference: T::split(if a > b { a - b } else { b - a }),
            straight: round(straight),
            across: round(across),
            turn: T::from_f64(2.0 * sigma),
            squares: T::from_f64(a * a + b * b),
            back: round(back),
        }
    }

    /// Cylinder length (m) → the joint's rotor times the scale, or by how much the triangle fails to close (m).
    #[inline(always)]
    pub fn vector(&self, length: T) -> Result<Vec2<T>, T> {
        let (u, v) = self.products(length);
        let product = u * v;
        if product >= T::ZERO { Ok(self.assemble(u, v, product.sqrt_of_magnitude())) } else { Err(self.gap(length)) }
    }

    /// [`Triangle::vector`] without the check: not a number where the triangle does not close.
    #[inline(always)]
    pub fn vector_unchecked(&self, length: T) -> Vec2<T> {
        let (u, v) = self.products(length);
        self.assemble(u, v, (u * v).sqrt())
    }

    /// [`Triangle::vector`] as a rotor, for a scale of one.
    #[inline(always)]
    pub fn rotor(&self, length: T) -> Result<Rotor<T>, T> {
        self.vector(length).map(|v| Rotor { cos: v.x, sin: v.z })
    }

    /// Rotor → cylinder length (m), for a scale of one.
    ///
    /// On the far side of a dead point the same length belongs to another rotor, so there is none: the error is how far the
    /// joint's pin lies beyond the cylinder's line (m).
    #[inline(always)]
    pub fn length(&self, rotor: Rotor<T>) -> Result<T, T> {
        let square = self.squares + (rotor.cos * self.back.x + rotor.sin * self.back.z);
        // sin α/2ab
        let side = rotor.to_vec().dot(self.across);
        if side > T::ZERO && square > T::ZERO { Ok(square.sqrt()) } else { Err(self.beyond(side, square)) }
    }

    /// [`Triangle::length`] without the check: beyond a dead point the length of another rotor.
    #[inline(always)]
    pub fn length_unchecked(&self, rotor: Rotor<T>) -> T {
        (self.squares + (rotor.cos * self.back.x + rotor.sin * self.back.z)).sqrt()
    }

    /// Cylinder length (m) → moment arm dL/dθ = σ·ab·sin α/L = √(uv)/2σL (m/rad), to a few roundings of its own size up
    /// to the dead points, where it is zero: Koivo 1994 (32), (33). Or by how much the triangle fails to close (m).
    #[inline(always)]
    pub fn moment_arm(&self, length: T) -> Result<T, T> {
        let (u, v) = self.products(length);
        let product = u * v;
        if product >= T::ZERO && length > T::ZERO {
            Ok(product.sqrt() / (self.turn * length))
        } else {
            Err(self.gap(length))
        }
    }

    /// Rotor → moment arm dL/dθ = (cos θ·back.z − sin θ·back.x)/2L (m/rad), for a scale of one: Koivo 1994 (32), (33).
    ///
    /// For a joint that is given, not measured: near a dead point it keeps the rotor's accuracy, which a rounded length
    /// would lose. Its error is absolute, a rounding of ab/L. The error value is that of [`Triangle::length`].
    #[inline(always)]
    pub fn moment_arm_at(&self, rotor: Rotor<T>) -> Result<T, T> {
        let length = self.length(rotor)?;
        Ok(self.arm_of(rotor, length))
    }

    /// [`Triangle::moment_arm_at`] where the length for this rotor is known.
    #[inline(always)]
    pub(crate) fn arm_of(&self, rotor: Rotor<T>, length: T) -> T {
        rotor.to_vec().cross(self.back) / (length + length)
    }

    /// Cylinder length (m) → moment arm and its slope d²L/dθ² = ((u − v)/4 − (dL/dθ)²)/L.
    #[inline(always)]
    pub fn moment(&self, length: T) -> Result<Moment<T>, T> {
        let arm = self.moment_arm(length)?;
        let (u, v) = self.products(length);
        Ok(Moment { arm, slope: ((u - v) * T::from_f64(0.25) - arm * arm) / length })
    }

    /// [`Triangle::vector`] with what its transmission needs; an error at the dead points themselves too.
    #[inline(always)]
    pub(crate) fn closed(&self, length: T) -> Result<Closed<T>, T> {
        let (u, v) = self.products(length);
        let product = u * v;
        if product > T::ZERO {
            let root = product.sqrt();
            Ok(Closed { vector: self.straight.scale(u - v) + self.across.scale(root), root })
        } else {
            Err(self.gap(length))
        }
    }

    /// 2σL: the moment arm is √(uv) over this, the transmission dθ/dL this over √(uv).
    #[inline(always)]
    pub(crate) fn turned(&self, length: T) -> T {
        self.turn * length
    }

    /// ab·|sin α|/L
    #[cold]
    fn beyond(&self, side: T, square: T) -> T {
        let twice_ab = (self.sum.hi * self.sum.hi - self.difference.hi * self.difference.hi) * T::from_f64(0.5);
        -(side * twice_ab * twice_ab) * T::from_f64(0.5) / square.sqrt()
    }

    #[inline(always)]
    fn products(&self, length: T) -> (T, T) {
        let u = self.sum.minus(length) * self.sum.plus(length);
        // (L − d)(L + d) = −(d − L)(d + L)
        let v = -(self.difference.minus(length) * self.difference.plus(length));
        (u, v)
    }

    #[inline(always)]
    fn assemble(&self, u: T, v: T, root: T) -> Vec2<T> {
        self.straight.scale(u - v) + self.across.scale(root)
    }

    #[cold]
    fn gap(&self, length: T) -> T {
        let over = -self.sum.minus(length);
        if over > T::ZERO { over } else { self.difference.minus(length) }
    }
}
