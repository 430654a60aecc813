//! Tip force ↔ joint torques ↔ cylinder forces in a static pose, by virtual work: Hareesha 2015 (21), τ = Jᵀ·F.
//!
//! F is what the tip exerts on the soil, τ what the joints and f what the cylinders push: F·v = τ·θ̇ = f·L̇. The machine's own
//! weight is apart, in [`crate::payload`]. So measured cylinder pressures give the force at the tip:
//!
//! ```
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
//! use kinematics_core::forces::{CylinderForces, Wrench};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
//! let cylinders = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
//! let (pose, jacobian) = machine.cylinders_to_tip_with_jacobian(&cylinders, Rotor::IDENTITY)?;
//! let measured = CylinderForces { boom: 4000.0, arm: -2000.0, bucket: 9000.0 };
//! let tip = jacobian.wrench(&measured)?;
//! let back = jacobian.cylinder_forces(&tip);
//! assert!((back.arm + 2000.0).abs() < 1e-8);
//!
//! // The same by way of the joints' torques.
//! let arms = machine.moment_arms(&cylinders)?;
//! let torques = arms.joint_torques(&measured);
//! let joint_space = machine.chain().jacobian(&pose.joints);
//! let again: Wrench<f64> = joint_space.wrench(&torques)?;
//! assert!((again.height - tip.height).abs() < 1e-8);
//! let torques = joint_space.joint_torques(&again);
//! assert!((arms.cylinder_forces(&torques)?.bucket - 9000.0).abs() < 1e-8);
//! # Ok(())
//! # }
//! ```

use crate::jacobian::PlanarJacobian;
use crate::rates::MomentArms;
use crate::{Real, Singular, Vec2};

/// A force and a moment in the boom's plane, exerted by a point of the bucket: N and N·m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<T> {
    /// Along the reach, away from the swing axis.
    pub reach: T,
    /// Upwards.
    pub height: T,
    /// Counter-clockwise, as φ.
    pub moment: T,
}

/// Torques about boom pin, arm pin and bucket pin, counter-clockwise on the outer link, N·m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointTorques<T> {
    /// τ2
    pub boom: T,
    /// τ3
    pub arm: T,
    /// τ4
    pub bucket: T,
}

/// What the cylinders push, N; negative where they pull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderForces<T> {
    /// Boom cylinder (all of them together, where there are two).
    pub boom: T,
    /// Arm cylinder.
    pub arm: T,
    /// Bucket cylinder.
    pub bucket: T,
}

impl<T: Real> MomentArms<T> {
    /// τ = (dL/dθ)·f.
    #[inline(always)]
    pub fn joint_torques(&self, cylinders: &CylinderForces<T>) -> JointTorques<T> {
        JointTorques {
            boom: self.boom * cylinders.boom,
            arm: self.arm * cylinders.arm,
            bucket: self.bucket * cylinders.bucket,
        }
    }

    /// f = τ/(dL/dθ).
    ///
    /// # Errors
    /// [`Singular::DeadPoint`].
    #[inline(always)]
    pub fn cylinder_forces(&self, joints: &JointTorques<T>) -> Result<CylinderForces<T>, Singular> {
        self.check()?;
        Ok(CylinderForces {
            boom: joints.boom / self.boom,
            arm: joints.arm / self.arm,
            bucket: joints.bucket / self.bucket,
        })
    }
}

impl<T: Real> PlanarJacobian<T> {
    /// The force the point exerts → the joints' torques that hold it: Hareesha 2015 (21).
    #[inline(always)]
    pub fn joint_torques(&self, tip: &Wrench<T>) -> JointTorques<T> {
        let force = Vec2::new(tip.reach, tip.height);
        let [boom, arm, bucket] = self.links();
        let bucket = bucket.cross(force) + tip.moment;
        let arm = arm.cross(force) + bucket;
        JointTorques { boom: boom.cross(force) + arm, arm, bucket }
    }

    /// The joints' torques → the force and moment the point exerts.
    ///
    /// # Errors
    /// [`Singular::ArmStretched`]: along the line of boom and arm any force is held without torque.
    #[inline(always)]
    pub fn wrench(&self, joints: &JointTorques<T>) -> Result<Wrench<T>, Singular> {
        self.check()?;
        let [boom, arm, bucket] = self.links();
        // boom × F and arm × F, each alone.
        let (of_boom, of_arm) = (joints.boom - joints.arm, joints.arm - joints.bucket);
        let reciprocal = T::ONE / self.determinant();
        let force = (arm.scale(of_boom) - boom.scale(of_arm)).scale(reciprocal);
        Ok(Wrench { reach: force.x, height: force.z, moment: joints.bucket - bucket.cross(force) })
    }
}
