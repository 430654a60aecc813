//! Weight: the torques that hold the links, and the payload that boom and arm cylinder forces tell in a static pose.
//!
//! The cylinders' and the four-bar's own masses belong to the links they hang on. Gravity is a vector in the boom's plane, so
//! a tilted chassis needs no other formula.
//!
//! ```
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Vec2};
//! use kinematics_core::payload::{level_gravity, LinkMass, Masses};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
//! let masses = Masses {
//!     boom: LinkMass { mass_kg: 227.343, centre: Vec2::new(1.025, 0.384) },
//!     arm: LinkMass { mass_kg: 130.123, centre: Vec2::new(0.225, 0.227) },
//!     bucket: LinkMass { mass_kg: 53.0, centre: Vec2::new(0.289, 0.166) },
//! };
//! let cylinders = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
//! let joints = machine.cylinders_to_joints(&cylinders)?;
//! let chain = machine.chain();
//! let gravity = level_gravity();
//!
//! // What the cylinders would push with 100 kg in the bucket …
//! let loaded = masses.with_payload(&LinkMass { mass_kg: 100.0, centre: Vec2::new(0.3, 0.2) });
//! let torques = chain.holding_torques(&joints, &loaded, gravity);
//! let arms = machine.moment_arms(&cylinders)?;
//! let measured = arms.cylinder_forces(&torques)?;
//!
//! // … tells the 100 kg, and where on the bucket is not even asked.
//! let torques = arms.joint_torques(&measured);
//! let load = chain.payload(&joints, &masses, &torques, gravity)?;
//! assert!((load.mass_kg - 100.0).abs() < 1e-9);
//! // Given the place, boom and arm each tell it; the best of both, and what is left unexplained.
//! let load = chain.payload_at(&joints, &masses, &torques, gravity, Vec2::new(0.3, 0.2))?;
//! assert!((load.mass_kg - 100.0).abs() < 1e-9 && load.residual_nm < 1e-9);
//! # Ok(())
//! # }
//! ```

use crate::chain::{Chain, Joints};
use crate::forces::JointTorques;
use crate::{Real, Singular, Vec2};

/// Standard gravity, m/s².
pub const STANDARD_GRAVITY_M_S2: f64 = 9.80665;

/// Gravity in the boom's plane on level ground, (reach, height), m/s².
#[inline]
pub fn level_gravity<T: Real>() -> Vec2<T> {
    Vec2::new(T::ZERO, T::from_f64(-STANDARD_GRAVITY_M_S2))
}

/// A link's mass and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkMass<T> {
    /// kg
    pub mass_kg: T,
    /// Centre of mass in the link's own frame (at its pin, x along the link), m.
    pub centre: Vec2<T>,
}

/// The masses of boom, arm and bucket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Masses<T> {
    /// Boom, in the frame at the boom pin.
    pub boom: LinkMass<T>,
    /// Arm, in the frame at the arm pin.
    pub arm: LinkMass<T>,
    /// Bucket, in the frame at the bucket pin.
    pub bucket: LinkMass<T>,
}

impl<T: Real> Masses<T> {
    /// With a load in the bucket, given in the bucket's frame. Masses must be positive.
    pub fn with_payload(&self, load: &LinkMass<T>) -> Self {
        let mass_kg = self.bucket.mass_kg + load.mass_kg;
        let moment = self.bucket.centre.scale(self.bucket.mass_kg) + load.centre.scale(load.mass_kg);
        Self { bucket: LinkMass { mass_kg, centre: moment.scale(T::ONE / mass_kg) }, ..*self }
    }
}

/// A payload told by torques, wherever it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Payload<T> {
    /// kg
    pub mass_kg: T,
    /// Its weight's moment about the arm pin, N·m, positive counter-clockwise.
    pub moment_about_arm_nm: T,
}

/// A payload at a known place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedPayload<T> {
    /// kg, the best in the sense of least squares of both torques.
    pub mass_kg: T,
    /// The torque no mass at that place explains, N·m: a check on masses, friction, motion and contact with the ground.
    pub residual_nm: T,
}

/// A lever of gravity's moment below this part of the boom's length tells nothing.
const SHORTEST_LEVER: f64 = 1e-3;

impl<T: Real> Chain<T> {
    /// The joints' torques that hold the links' weight still, N·m: minus gravity's own moment about each pin.
    pub fn holding_torques(&self, joints: &Joints<T>, masses: &Masses<T>, gravity: Vec2<T>) -> JointTorques<T> {
        let [_, a2, a3, _] = self.lengths();
        let forearm = joints.boom * joints.arm;
        let pitch = forearm * joints.bucket;
        let hold = |lever: Vec2<T>, mass: T| -(lever.cross(gravity) * mass);
        let bucket = hold(pitch.rotate(masses.bucket.centre), masses.bucket.mass_kg);
        let arm = hold(forearm.rotate(masses.arm.centre), masses.arm.mass_kg)
            + hold(forearm.to_vec().scale(a3), masses.bucket.mass_kg)
            + bucket;
        let boom = hold(joints.boom.rotate(masses.boom.centre), masses.boom.mass_kg)
            + hold(joints.boom.to_vec().scale(a2), masses.arm.mass_kg + masses.bucket.mass_kg)
            + arm;
        JointTorques { boom, arm, bucket }
    }

    /// Boom and arm torques in a static pose → the payload's mass, wherever it lies in the bucket: τ2 − τ3 holds its weight at the
    /// arm pin. Uses the torques of boom and arm only.
    ///
    /// # Errors
    /// [`Singular::NoLever`] where the boom points along gravity.
    pub fn payload(
        &self,
        joints: &Joints<T>,
        masses: &Masses<T>,
        torques: &JointTorques<T>,
        gravity: Vec2<T>,
    ) -> Result<Payload<T>, Singular> {
        let [_, a2, ..] = self.lengths();
        let empty = self.holding_torques(joints, masses, gravity);
        let boom_direction = -joints.boom.to_vec().cross(gravity);
        check(boom_direction, gravity)?;
        let arm = torques.arm - empty.arm;
        let mass_kg = (torques.boom - empty.boom - arm) / (a2 * boom_direction);
        Ok(Payload { mass_kg, moment_about_arm_nm: -arm })
    }

    /// Boom and arm torques in a static pose → the mass of a payload at `place` in the bucket's frame: least squares of both
    /// moments, so that either joint may stand where it tells nothing.
    ///
    /// # Errors
    /// [`Singular::NoLever`] where the payload hangs along gravity from boom pin and arm pin both.
    pub fn payload_at(
        &self,
        joints: &Joints<T>,
        masses: &Masses<T>,
        torques: &JointTorques<T>,
        gravity: Vec2<T>,
        place: Vec2<T>,
    ) -> Result<PlacedPayload<T>, Singular> {
        let empty = self.holding_torques(joints, masses, gravity);
        let [from_boom, from_arm, _] = self.jacobian_at(joints, place).levers();
        // N·m per kg
        let levers = Vec2::new(-from_boom.cross(gravity), -from_arm.cross(gravity));
        let [_, a2, ..] = self.lengths();
        let length = levers.norm();
        check(length / a2, gravity)?;
        let loads = Vec2::new(torques.boom - empty.boom, torques.arm - empty.arm);
        let across = levers.cross(loads) / length;
        Ok(PlacedPayload {
            mass_kg: levers.dot(loads) / (length * length),
            residual_nm: if across < T::ZERO { -across } else { across },
        })
    }
}

/// Whether a lever, as a part of the boom's length times gravity, is long enough.
fn check<T: Real>(lever: T, gravity: Vec2<T>) -> Result<(), Singular> {
    let shortest = gravity.norm() * T::from_f64(SHORTEST_LEVER);
    if lever > shortest || lever < -shortest { Ok(()) } else { Err(Singular::NoLever) }
}
