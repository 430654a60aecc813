//! Cylinder rates ↔ joint rates by moment arms dL/dθ, and their accelerations: Koivo 1994 (32)–(37), closed form, without ε3.
//!
//! A cylinder of length L moves its joint θ; `L̇ = (dL/dθ)·θ̇`, and by virtual work a push of f newtons turns the joint with
//! `τ = (dL/dθ)·f`. The moment arm is positive where the joint turns counter-clockwise as the cylinder extends, zero at
//! a dead point: there joints move cylinders, but cylinders do not move joints.
//!
//! ```
//! use kinematics_core::{Cylinders, Machine, PinGeometry};
//! use kinematics_core::rates::{CylinderRates, JointRates};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI)?;
//! let arms = machine.moment_arms(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
//! // Extending raises the boom, and curls arm and bucket.
//! assert!(arms.boom > 0.0 && arms.arm < 0.0 && arms.bucket < 0.0);
//! let joints = arms.joint_rates(&CylinderRates { boom: 0.1, arm: 0.0, bucket: -0.2 })?;
//! let back = arms.cylinder_rates(&joints);
//! assert!((back.boom - 0.1).abs() < 1e-7 && (back.bucket + 0.2).abs() < 1e-7);
//! // Transmissions dθ/dL are their reciprocals.
//! let [boom, ..] = arms.transmissions()?;
//! assert!((boom * arms.boom - 1.0).abs() < 1e-6);
//! # Ok(())
//! # }
//! ```

use crate::machine::{bucket_open, open};
use crate::triangle::Moment;
use crate::{Cylinder, Cylinders, Joints, Machine, PoseError, Real, Singular};

/// Rates of the joints in the plane: θ̇2, θ̇3, θ̇4, rad/s; or their accelerations, rad/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRates<T> {
    /// Boom.
    pub boom: T,
    /// Arm relative to the boom.
    pub arm: T,
    /// Bucket relative to the arm.
    pub bucket: T,
}

/// Rates of the cylinders' lengths, m/s, positive extending; or their accelerations, m/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderRates<T> {
    /// Boom cylinder.
    pub boom: T,
    /// Arm cylinder.
    pub arm: T,
    /// Bucket cylinder.
    pub bucket: T,
}

/// Moment arms dL/dθ of the three cylinders at their joints, m/rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentArms<T> {
    /// dL/dθ2 of the boom cylinder.
    pub boom: T,
    /// dL/dθ3 of the arm cylinder.
    pub arm: T,
    /// dL/dθ4 of the bucket cylinder, through the four-bar.
    pub bucket: T,
}

/// A moment arm smaller than this is a dead point's, m: in f32 what is left is rounding.
pub const SMALLEST_MOMENT_ARM_M: f64 = 1e-6;

impl<T: Real> MomentArms<T> {
    /// L̇ = (dL/dθ)·θ̇, m/s.
    #[inline(always)]
    pub fn cylinder_rates(&self, joints: &JointRates<T>) -> CylinderRates<T> {
        CylinderRates { boom: self.boom * joints.boom, arm: self.arm * joints.arm, bucket: self.bucket * joints.bucket }
    }

    /// θ̇ = L̇/(dL/dθ), rad/s.
    ///
    /// # Errors
    /// [`Singular::DeadPoint`] of the first cylinder that does not move its joint.
    #[inline(always)]
    pub fn joint_rates(&self, cylinders: &CylinderRates<T>) -> Result<JointRates<T>, Singular> {
        self.check()?;
        Ok(JointRates {
            boom: cylinders.boom / self.boom,
            arm: cylinders.arm / self.arm,
            bucket: cylinders.bucket / self.bucket,
        })
    }

    /// dθ/dL of boom, arm, bucket, rad/m.
    ///
    /// # Errors
    /// As [`MomentArms::joint_rates`].
    #[inline(always)]
    pub fn transmissions(&self) -> Result<[T; 3], Singular> {
        let one = CylinderRates { boom: T::ONE, arm: T::ONE, bucket: T::ONE };
        self.joint_rates(&one).map(|r| [r.boom, r.arm, r.bucket])
    }

    /// Whether every cylinder moves its joint.
    ///
    /// # Errors
    /// As [`MomentArms::joint_rates`].
    #[inline(always)]
    pub(crate) fn check(&self) -> Result<(), Singular> {
        let smallest = T::from_f64(SMALLEST_MOMENT_ARM_M);
        let moves = |arm: T| arm > smallest || arm < -smallest;
        if !moves(self.boom) {
            return Err(Singular::DeadPoint { cylinder: Cylinder::Boom });
        }
        if !moves(self.arm) {
            return Err(Singular::DeadPoint { cylinder: Cylinder::Arm });
        }
        if !moves(self.bucket) {
            return Err(Singular::DeadPoint { cylinder: Cylinder::Bucket });
        }
        Ok(())
    }
}

/// Moment arms with their slopes d²L/dθ², for accelerations.
///
/// ```
/// use kinematics_core::{Cylinders, Machine, PinGeometry};
/// use kinematics_core::rates::JointRates;
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
/// let moments = machine.moments(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
/// let rates = JointRates { boom: 0.3, arm: -0.5, bucket: 1.0 };
/// // Joints at constant speed still need their cylinders accelerated…
/// let at_rest = JointRates { boom: 0.0, arm: 0.0, bucket: 0.0 };
/// let cylinders = moments.cylinder_accelerations(&rates, &at_rest);
/// // … and with those the joints keep their speed.
/// let joints = moments.joint_accelerations(&rates, &cylinders)?;
/// assert!(joints.boom.abs() < 1e-15 && joints.arm.abs() < 1e-15 && joints.bucket.abs() < 1e-15);
/// // The moment arms themselves change.
/// assert_eq!(moments.arms().boom, moments.boom.arm);
/// assert_eq!(moments.rates(&rates).boom, moments.boom.slope * 0.3);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments<T> {
    /// Boom cylinder and θ2.
    pub boom: Moment<T>,
    /// Arm cylinder and θ3.
    pub arm: Moment<T>,
    /// Bucket cylinder and θ4.
    pub bucket: Moment<T>,
}

impl<T: Real> Moments<T> {
    /// The moment arms alone.
    #[inline(always)]
    pub fn arms(&self) -> MomentArms<T> {
        MomentArms { boom: self.boom.arm, arm: self.arm.arm, bucket: self.bucket.arm }
    }

    /// d/dt of the moment arms, (d²L/dθ²)·θ̇, m/rad/s.
    #[inline(always)]
    pub fn rates(&self, joints: &JointRates<T>) -> MomentArms<T> {
        MomentArms {
            boom: self.boom.slope * joints.boom,
            arm: self.arm.slope * joints.arm,
            bucket: self.bucket.slope * joints.bucket,
        }
    }

    /// L̈ = (dL/dθ)·θ̈ + (d²L/dθ²)·θ̇², m/s².
    #[inline]
    pub fn cylinder_accelerations(&self, rates: &JointRates<T>, accelerations: &JointRates<T>) -> CylinderRates<T> {
        let of = |moment: Moment<T>, rate: T, acceleration: T| moment.arm * acceleration + moment.slope * rate * rate;
        CylinderRates {
            boom: of(self.boom, rates.boom, accelerations.boom),
            arm: of(self.arm, rates.arm, accelerations.arm),
            bucket: of(self.bucket, rates.bucket, accelerations.bucket),
        }
    }

    /// θ̈ = (L̈ − (d²L/dθ²)·θ̇²)/(dL/dθ), rad/s².
    ///
    /// # Errors
    /// [`Singular::DeadPoint`].
    #[inline]
    pub fn joint_accelerations(
        &self,
        rates: &JointRates<T>,
        accelerations: &CylinderRates<T>,
    ) -> Result<JointRates<T>, Singular> {
        let rest = |moment: Moment<T>, rate: T, acceleration: T| acceleration - moment.slope * rate * rate;
        self.arms().joint_rates(&CylinderRates {
            boom: rest(self.boom, rates.boom, accelerations.boom),
            arm: rest(self.arm, rates.arm, accelerations.arm),
            bucket: rest(self.bucket, rates.bucket, accelerations.bucket),
        })
    }
}

impl<T: Real> Machine<T> {
    /// Moment arms from measured cylinder lengths, inside the stroke or not; relative accuracy holds up to the dead points.
    ///
    /// # Errors
    /// [`PoseError::NoAssembly`] where a linkage does not close.
    #[inline(always)]
    pub fn moment_arms(&self, cylinders: &Cylinders<T>) -> Result<MomentArms<T>, PoseError<T>> {
        Ok(MomentArms {
            boom: self.boom.moment_arm(cylinders.boom).map_err(open(Cylinder::Boom))?,
            arm: self.arm.moment_arm(cylinders.arm).map_err(open(Cylinder::Arm))?,
            bucket: self.bucket.moment_arm(cylinders.bucket).map_err(bucket_open)?,
        })
    }

    /// Moment arms of joints that are given, inside the stroke or not; next to a dead point more accurate than by way of
    /// rounded lengths.
    ///
    /// ```
    /// # use kinematics_core::{Cylinders, Machine, PinGeometry};
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
    /// let cylinders = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
    /// let joints = machine.cylinders_to_joints(&cylinders)?;
    /// let (one, other) = (machine.moment_arms(&cylinders)?, machine.moment_arms_at(&joints)?);
    /// assert!((one.bucket - other.bucket).abs() < 1e-14);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`Machine::joints_to_cylinders_any_stroke`].
    #[inline]
    pub fn moment_arms_at(&self, joints: &Joints<T>) -> Result<MomentArms<T>, PoseError<T>> {
        Ok(MomentArms {
            boom: self.boom.moment_arm_at(joints.boom).map_err(open(Cylinder::Boom))?,
            arm: self.arm.moment_arm_at(joints.arm).map_err(open(Cylinder::Arm))?,
            bucket: self.bucket.moment_arm_at(joints.bucket).map_err(bucket_open)?,
        })
    }

    /// [`Machine::joints_to_cylinders`] and [`Machine::moment_arms_at`] of the same joints, their work shared.
    ///
    /// ```
    /// # use kinematics_core::{Cylinders, Machine, PinGeometry};
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
    /// let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
    /// let (lengths, arms) = machine.joints_to_cylinders_with_arms(&joints)?;
    /// assert_eq!(lengths, machine.joints_to_cylinders(&joints)?);
    /// assert_eq!(arms, machine.moment_arms_at(&joints)?);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As both.
    #[inline(always)]
    pub fn joints_to_cylinders_with_arms(
        &self,
        joints: &Joints<T>,
    ) -> Result<(Cylinders<T>, MomentArms<T>), PoseError<T>> {
        if self.within_sectors(joints) {
            let boom = self.boom.length_unchecked(joints.boom);
            let arm = self.arm.length_unchecked(joints.arm);
            let (bucket, bucket_arm) = self.bucket.length_and_arm_unchecked(joints.bucket);
            // As there; and a moment arm that is not finite leaves not zero but no number.
            if boom + arm + bucket > T::ZERO && bucket_arm - bucket_arm == T::ZERO {
                let arms = MomentArms {
                    boom: self.boom.arm_of(joints.boom, boom),
                    arm: self.arm.arm_of(joints.arm, arm),
                    bucket: bucket_arm,
                };
                return Ok((Cylinders { boom, arm, bucket }, arms));
            }
        }
        self.judge_with_arms(joints)
    }

    /// The last word where one of them is in doubt.
    #[cold]
    #[inline(never)]
    fn judge_with_arms(&self, joints: &Joints<T>) -> Result<(Cylinders<T>, MomentArms<T>), PoseError<T>> {
        Ok((self.joints_to_cylinders(joints)?, self.moment_arms_at(joints)?))
    }

    /// Moment arms and their slopes from cylinder lengths, inside the stroke or not.
    ///
    /// # Errors
    /// [`PoseError::NoAssembly`] where a linkage does not close.
    #[inline]
    pub fn moments(&self, cylinders: &Cylinders<T>) -> Result<Moments<T>, PoseError<T>> {
        Ok(Moments {
            boom: self.boom.moment(cylinders.boom).map_err(open(Cylinder::Boom))?,
            arm: self.arm.moment(cylinders.arm).map_err(open(Cylinder::Arm))?,
            bucket: self.bucket.moment(cylinders.bucket).map_err(bucket_open)?,
        })
    }
}
