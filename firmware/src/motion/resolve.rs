//! Resolved rates: where the cylinders are for a tip, and how fast they go for its velocity.

use kinematics_core::jacobian::Twist;
use kinematics_core::{Cylinders, Machine, PlaneTip};

use crate::fault::Fault;

/// Lengths of a tip and their rates, m/s, for its twist. Angles stay out of it: joints, moment arms and the Jacobian's inverse.
// Once for all modes: it is two kilobytes.
#[inline]
pub(super) fn resolve(
    machine: &Machine<f32>,
    tip: &PlaneTip<f32>,
    twist: &Twist<f32>,
) -> Result<(Cylinders<f32>, [f32; 3]), Fault> {
    let joints = machine.tip_to_joints(tip).map_err(|_| Fault::Trajectory)?;
    let lengths = machine.joints_to_cylinders(&joints).map_err(|_| Fault::Trajectory)?;
    let arms = machine.moment_arms(&lengths).map_err(|_| Fault::Trajectory)?;
    let joint_rates = machine.chain().jacobian(&joints).joint_rates(twist).map_err(|_| Fault::Trajectory)?;
    let rates = arms.cylinder_rates(&joint_rates);
    Ok((lengths, [rates.boom, rates.arm, rates.bucket]))
}
