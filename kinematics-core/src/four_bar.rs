//! The bucket's linkage: a cylinder turns a rocker, a coupler joins it to the bucket. Closed form both ways.
//!
//! Koivo 1994 (14)–(18), (29) need ε3 from a sensor and Frankel 2003 (15) searches; two intersections of circles, one square
//! root and one division each, need neither. E cylinder base, I rocker pivot, P = (a3, 0) bucket pin (arm frame),
//! H coupler pin (bucket frame), J common pin of rod, rocker and coupler, K the coupler pin in the arm frame.
//!
//! ```
//! use kinematics_core::four_bar::FourBar;
//! use kinematics_core::{PinGeometry, Vec2};
//! let PinGeometry { arm_m, bucket: pins, .. } = PinGeometry::EXACT_MINI;
//! let pin = Vec2::new(arm_m, 0.0);
//! let linkage =
//!     FourBar::<f64>::new(pins.base, pins.rocker_pivot, pin, pins.coupler_pin, pins.rocker_m, pins.coupler_m);
//! let bucket = linkage.rotor(1.0).unwrap();
//! assert!((linkage.length(bucket).unwrap() - 1.0).abs() < 1e-15);
//! // The moment arm of the length and of the joint, and its slope by a difference.
//! let moment = linkage.moment(1.0).unwrap();
//! assert!((linkage.moment_arm(1.0).unwrap() - moment.arm).abs() < 1e-15);
//! assert!((linkage.moment_arm_at(bucket).unwrap() - moment.arm).abs() < 1e-14);
//! let change = linkage.moment_arm(1.0 + 1e-6).unwrap() - linkage.moment_arm(1.0 - 1e-6).unwrap();
//! assert!((change / 2e-6 * moment.arm - moment.slope).abs() < 1e-9);
//! // A rod of 1.6 m is longer than the rocker lets it be: an error, or unchecked not a number.
//! let eye_m = (pins.rocker_pivot - pins.base).norm() + pins.rocker_m;
//! assert!(linkage.rotor(1.6).is_err_and(|gap| (gap.0 - (1.6 - eye_m)).abs() < 1e-15));
//! assert!(linkage.rotor_unchecked(1.6).cos.is_nan());
//! assert_eq!(linkage.rotor_unchecked(1.0), bucket);
//! assert_eq!(Ok(linkage.length_unchecked(bucket)), linkage.length(bucket));
//! ```

use crate::triangle::{Closed, Moment, Side, Triangle};
use crate::{Real, Rotor, Vec2};

/// Which part of the linkage does not close, and by how much (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap<T>(pub T);

/// The bucket's four-bar with its cylinder.
#[derive(Clone, Copy, Debug)]
pub struct FourBar<T> {
    /// Cylinder, rocker and E–I; gives J − I in the arm frame.
    rocker: Triangle<T>,
    /// I − P
    pivot_from_pin: Vec2<T>,
    /// |H|² − c² and 4|H|²
    pin_balance: T,
    four_pin: T,
    /// conj(H)/2|H|²
    unwind: Vec2<T>,
    /// H
    coupler_pin: Vec2<T>,
    /// r² − c² and 4r²
    rocker_balance: T,
    four_rocker: T,
    /// I − E and r² + |I − E|²
    pivot_from_base: Vec2<T>,
    squares: T,
    /// |H|, c and r, for messages.
    sides: [T; 3],
}

/// The common pin J seen from the bucket pin, in the arm frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CommonPin<T> {
    /// J − P, m.
    pub(crate) from_bucket_pin: Vec2<T>,
    /// Its derivative by θ4, m/rad.
    pub(crate) per_bucket: Vec2<T>,
}

/// The linkage at one cylinder length, away from the forward map's dead points: what rotor and rates share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<T> {
    rocker: Closed<T>,
    /// J − P, |J − P|² and its reciprocal
    j: Vec2<T>,
    square: T,
    reciprocal: T,
    /// 2|J − P|²·(K − P)
    k: Vec2<T>,
    /// −2·(J − P) × (K − P) > 0
    root: T,
    pub(crate) rotor: Rotor<T>,
}

impl<T: Real> FourBar<T> {
    /// The linkage with the cylinder's base E, the rocker pivot I and the bucket pin P in the arm frame, the coupler
    /// pin H in the bucket frame, rocker and coupler lengths; metres. `PinGeometry::validate` sees to it that none
    /// is zero.
    pub fn new(
        base: Vec2<f64>,
        pivot: Vec2<f64>,
        pin: Vec2<f64>,
        coupler_pin: Vec2<f64>,
        rocker: f64,
        coupler: f64,
    ) -> Self {
        let round = |v: Vec2<f64>| Vec2::new(T::from_f64(v.x), T::from_f64(v.z));
        let pin_square = coupler_pin.norm_squared();
        let arm = pivot - base;
        Self {
            // Clockwise: the rocker's J lies at R(−α) from E, seen from I.
            rocker: Triangle::new(base - pivot, Vec2::new(rocker, 0.0), Side::Clockwise, rocker),
            pivot_from_pin: round(pivot - pin),
            pin_balance: T::from_f64(pin_square - coupler * coupler),
            four_pin: T::from_f64(4.0 * pin_square),
            unwind: round(coupler_pin.conjugate().scale(0.5 / pin_square)),
            coupler_pin: round(coupler_pin),
            rocker_balance: T::from_f64(rocker * rocker - coupler * coupler),
            four_rocker: T::from_f64(4.0 * rocker * rocker),
            pivot_from_base: round(arm),
            squares: T::from_f64(rocker * rocker + arm.norm_squared()),
            sides: [coupler_pin.norm(), coupler, rocker].map(T::from_f64),
        }
    }

    /// Cylinder length (m) → rotor of θ4.
    #[inline(always)]
    pub fn rotor(&self, length: T) -> Result<Rotor<T>, Gap<T>> {
        let j = self.pivot_from_pin + self.rocker.vector(length).map_err(Gap)?;
        let (square, balance, discriminant) = self.pin_circle(j);
        if discriminant >= T::ZERO {
            Ok(self.assemble(j, square, balance, discriminant.sqrt_of_magnitude()))
        } else {
            Err(self.gap(square, self.sides[0]))
        }
    }

    /// [`FourBar::rotor`] without the checks: not a number where the linkage does not close.
    #[inline(always)]
    pub fn rotor_unchecked(&self, length: T) -> Rotor<T> {
        let j = self.pivot_from_pin + self.rocker.vector_unchecked(length);
        let (square, balance, discriminant) = self.pin_circle(j);
        self.assemble(j, square, balance, discriminant.sqrt())
    }

    /// Rotor of θ4 → cylinder length (m): K from θ4, J from the circles (I, r) and (K, c) on the + side,
    /// `J = I + (r/|d|)·R(+a)·d` with d = K − I. An angle beyond a dead point has none.
    #[inline(always)]
    pub fn length(&self, rotor: Rotor<T>) -> Result<T, Gap<T>> {
        let d = rotor.rotate(self.coupler_pin) - self.pivot_from_pin;
        let square = d.norm_squared();
        let balance = square + self.rocker_balance;
        let discriminant = self.four_rocker * square - balance * balance;
        if !(discriminant >= T::ZERO && square > T::ZERO) {
            return Err(self.gap(square, self.sides[2]));
        }
        // J − I = (balance + i·√discriminant)·d / 2|d|²; |J − E|² by its product with I − E.
        let along = d.dot(self.pivot_from_base);
        let across = d.cross(self.pivot_from_base);
        let root = discriminant.sqrt();
        let length_squared = self.squares + (balance * along + root * across) / square;
        // 2|d|² times (I − E) × (J − I) and (K − P) × (J − P): beyond a dead point of rocker or coupler the same
        // cylinder length belongs to another bucket angle.
        let rocker_side = root * along - balance * across;
        let coupler_side = root * (square + d.dot(self.pivot_from_pin))
            + (square - self.rocker_balance) * d.cross(self.pivot_from_pin);
        if rocker_side > T::ZERO && coupler_side > T::ZERO && length_squared > T::ZERO {
            Ok(length_squared.sqrt())
        } else {
            Err(self.beyond(rocker_side, coupler_side, square, length_squared))
        }
    }

    /// [`FourBar::length`] without the checks: beyond a dead point the length of another angle, or not a number.
    #[inline(always)]
    pub fn length_unchecked(&self, rotor: Rotor<T>) -> T {
        let d = rotor.rotate(self.coupler_pin) - self.pivot_from_pin;
        let square = d.norm_squared();
        let balance = square + self.rocker_balance;
        let discriminant = self.four_rocker * square - balance * balance;
        let along = d.dot(self.pivot_from_base);
        let across = d.cross(self.pivot_from_base);
        (self.squares + (balance * along + discriminant.sqrt() * across) / square).sqrt()
    }

    /// [`FourBar::length_unchecked`] and the moment arm of [`FourBar::moment_arm_at`] there, their work shared; at a dead point of the
    /// inverse map, where the moment arm has no bound, it is not finite.
    #[inline(always)]
    pub(crate) fn length_and_arm_unchecked(&self, rotor: Rotor<T>) -> (T, T) {
        let d = rotor.rotate(self.coupler_pin) - self.pivot_from_pin;
        let square = d.norm_squared();
        let balance = square + self.rocker_balance;
        let root = (self.four_rocker * square - balance * balance).sqrt();
        let along = d.dot(self.pivot_from_base);
        let across = d.cross(self.pivot_from_base);
        let length = (self.squares + (balance * along + root * across) / square).sqrt();
        let rocker_side = root * along - balance * across;
        let coupler_side = root * (square + d.dot(self.pivot_from_pin))
            + (square - self.rocker_balance) * d.cross(self.pivot_from_pin);
        (length, -(rocker_side * coupler_side) / ((square + square) * square * (length * root)))
    }

    /// Rotor of θ4 → J as [`FourBar::length`] finds it, with its velocity by θ4: dψ/dθ4 = (j × p)/(s × k) of [`FourBar::moment`].
    pub(crate) fn common_pin(&self, rotor: Rotor<T>) -> Result<CommonPin<T>, Gap<T>> {
        let p = rotor.rotate(self.coupler_pin);
        let k = p - self.pivot_from_pin;
        let square = k.norm_squared();
        let balance = square + self.rocker_balance;
        let discriminant = self.four_rocker * square - balance * balance;
        if !(discriminant > T::ZERO && square > T::ZERO) {
            return Err(self.gap(square, self.sides[2]));
        }
        let s = Vec2::new(balance, discriminant.sqrt_of_magnitude()).complex_mul(k).scale(T::from_f64(0.5) / square);
        let per_bucket = (self.pivot_from_pin + s).cross(p) / s.cross(k);
        Ok(CommonPin { from_bucket_pin: self.pivot_from_pin + s, per_bucket: Vec2::new(-s.z, s.x).scale(per_bucket) })
    }

    /// Cylinder length (m) → moment arm dL/dθ4 (m/rad), by velocities along the coupler:
    /// `[(K − P) × (K − J)]·[(J − I) × (J − E)] / [(J − I) × (K − J)]·L`, which is Koivo 1994 (34), (37) without ε3.
    #[inline(always)]
    pub fn moment_arm(&self, length: T) -> Result<T, Gap<T>> {
        let placed = self.place(length)?;
        let sweep = self.sweep_checked(&placed)?;
        if length > T::ZERO {
            Ok(placed.root * placed.rocker.root * placed.square / (self.rocker.turned(length) * sweep))
        } else {
            Err(Gap(-length))
        }
    }

    /// Rotor of θ4 → moment arm dL/dθ4 (m/rad); [`FourBar::moment_arm`] for a joint that is given, not measured.
    #[inline(always)]
    pub fn moment_arm_at(&self, rotor: Rotor<T>) -> Result<T, Gap<T>> {
        let length = self.length(rotor)?;
        let d = rotor.rotate(self.coupler_pin) - self.pivot_from_pin;
        let square = d.norm_squared();
        let balance = square + self.rocker_balance;
        let root = (self.four_rocker * square - balance * balance).sqrt();
        // The sides of `length`: 2|d|² times −L·dL/dψ (ψ the rocker's angle) and times (K − P) × (J − P); √ = 2·d × (J − I).
        let rocker_side = root * d.dot(self.pivot_from_base) - balance * d.cross(self.pivot_from_base);
        let coupler_side = root * (square + d.dot(self.pivot_from_pin))
            + (square - self.rocker_balance) * d.cross(self.pivot_from_pin);
        if root > T::ZERO {
            Ok(-(rocker_side * coupler_side) / ((square + square) * square * (length * root)))
        } else {
            Err(Gap(T::ZERO))
        }
    }

    /// Cylinder length (m) → moment arm and its slope d²L/dθ4².
    ///
    /// With ψ the rocker's angle, p = K − P, j = J − P, s = J − I, k = K − I and g = dψ/dθ4 = (j × p)/(s × k):
    /// `dg/dθ4 = (p·j − 2g·p·s + g²·s·k)/(s × k)` and `d²L/dθ4² = L″(ψ)·g² + L′(ψ)·dg/dθ4`.
    #[inline]
    pub fn moment(&self, length: T) -> Result<Moment<T>, Gap<T>> {
        let placed = self.place(length)?;
        self.sweep_checked(&placed)?;
        let rocker = self.rocker.moment(length).map_err(Gap)?;
        let half = T::from_f64(0.5);
        let (j, s) = (placed.j, placed.rocker.vector);
        let p = placed.k.scale(half * placed.reciprocal);
        let k = p - self.pivot_from_pin;
        let turning = s.cross(k);
        let g = -(half * placed.root) / turning;
        let g_slope = (p.dot(j) - (g + g) * p.dot(s) + g * g * s.dot(k)) / turning;
        Ok(Moment { arm: rocker.arm * g, slope: rocker.slope * (g * g) + rocker.arm * g_slope })
    }

    /// Rotor and what the rates share with it; an error at the dead points of the forward map too.
    #[inline(always)]
    pub(crate) fn place(&self, length: T) -> Result<Placed<T>, Gap<T>> {
        let rocker = self.rocker.closed(length).map_err(Gap)?;
        let j = self.pivot_from_pin + rocker.vector;
        let (square, balance, discriminant) = self.pin_circle(j);
        if discriminant > T::ZERO {
            let root = discriminant.sqrt();
            let k = Vec2::new(balance, -root).complex_mul(j);
            let v = k.complex_mul(self.unwind);
            let reciprocal = T::ONE / square;
            let rotor = Rotor { cos: v.x * reciprocal, sin: v.z * reciprocal };
            Ok(Placed { rocker, j, square, reciprocal, k, root, rotor })
        } else {
            Err(self.gap(square, self.sides[0]))
        }
    }

    /// dθ4/dL, rad/m.
    #[inline(always)]
    pub(crate) fn transmission(&self, placed: &Placed<T>, length: T) -> T {
        self.rocker.turned(length) * self.sweep(placed) * placed.reciprocal / (placed.root * placed.rocker.root)
    }

    /// 2|J − P|²·(K − I) × (J − I): zero where rocker and coupler are in line.
    #[inline(always)]
    fn sweep(&self, placed: &Placed<T>) -> T {
        (placed.k - self.pivot_from_pin.scale(placed.square + placed.square)).cross(placed.rocker.vector)
    }

    /// [`FourBar::sweep`], or an error where rocker and coupler are in line and the moment arm has no bound.
    #[inline(always)]
    fn sweep_checked(&self, placed: &Placed<T>) -> Result<T, Gap<T>> {
        let sweep = self.sweep(placed);
        if sweep != T::ZERO { Ok(sweep) } else { Err(Gap(T::ZERO)) }
    }

    /// |J − P|², |J − P|² + |H|² − c², and what is under the root.
    #[inline(always)]
    fn pin_circle(&self, j: Vec2<T>) -> (T, T, T) {
        let square = j.norm_squared();
        let balance = square + self.pin_balance;
        (square, balance, self.four_pin * square - balance * balance)
    }

    /// K − P = (balance − i·√discriminant)·(J − P) / 2|J − P|² on the − side; θ4's rotor from K − P = H·rotor.
    #[inline(always)]
    fn assemble(&self, j: Vec2<T>, square: T, balance: T, root: T) -> Rotor<T> {
        let turn = Vec2::new(balance, -root);
        let v = turn.complex_mul(j).complex_mul(self.unwind);
        let reciprocal = T::ONE / square;
        Rotor { cos: v.x * reciprocal, sin: v.z * reciprocal }
    }

    /// How far the rocker pivot lies beyond the cylinder's line, or the bucket pin beyond the coupler's.
    #[cold]
    fn beyond(&self, rocker_side: T, coupler_side: T, square: T, length_squared: T) -> Gap<T> {
        let twice = square + square;
        if rocker_side > T::ZERO {
            Gap(-coupler_side / (twice * self.sides[1]))
        } else {
            Gap(-rocker_side / (twice * length_squared.sqrt()))
        }
    }

    /// By how much a triangle of `side`, the coupler and √square misses closing.
    #[cold]
    fn gap(&self, square: T, side: T) -> Gap<T> {
        let distance = square.sqrt();
        let coupler = self.sides[1];
        let difference = if side > coupler { side - coupler } else { coupler - side };
        // Half-way between both limits' squares; next to a limit rounding may leave nothing of the gap.
        let by =
            if square > side * side + coupler * coupler { distance - (side + coupler) } else { difference - distance };
        Gap(if by < T::ZERO { T::ZERO } else { by })
    }
}

/// Signs that tell the linkage's assembly in f64, for validation: both positive while neither map folds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Assembly {
    /// (K − P) × (J − P): zero at the forward map's dead point (coupler and bucket pin in line).
    pub(crate) forward: f64,
    /// (K − I) × (J − I): zero at the inverse map's dead point (rocker and coupler in line).
    pub(crate) inverse: f64,
}

impl FourBar<f64> {
    pub(crate) fn assembly(&self, length: f64) -> Result<Assembly, Gap<f64>> {
        let rocker = self.rocker.vector(length).map_err(Gap)?;
        let j = self.pivot_from_pin + rocker;
        let k = self.rotor(length)?.rotate(self.coupler_pin);
        Ok(Assembly { forward: k.cross(j), inverse: (k - self.pivot_from_pin).cross(rocker) })
    }
}
