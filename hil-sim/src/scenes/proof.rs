//! What an independent search says of a target that was not reached.

use kinematics_core::{PlaneTip, Rotor};
use serde::Serialize;

use super::generate::{Kit, Scene};

/// Pitches tried: three times as dense as the planner's finest.
const PITCHES: u32 = 1440;

/// The search's word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Proof {
    /// None of the pitches gives a pose within the stroke that is clear by what the planner asks for, 1.02 of the stop distance.
    NoClearPose,
    /// There is a clear pose: the planner owes an answer.
    ClearPose,
}

impl Kit {
    /// Looks for a clear pose at the target.
    pub(super) fn prove(&self, scene: &Scene) -> Proof {
        let t = scene.target;
        let reach = t.x.hypot(t.y);
        let ahead = Rotor { cos: t.x / reach, sin: t.y / reach };
        let behind = Rotor { cos: -ahead.cos, sin: -ahead.sin };
        let clear = (0..PITCHES).flat_map(|i| [(i, ahead, reach), (i, behind, -reach)]).any(|(i, swing, reach)| {
            let pitch = Rotor::from_turns(f64::from(i) / f64::from(PITCHES));
            self.machine.tip_to_joints(&PlaneTip { reach, height: t.z, pitch }).is_ok_and(|joints| {
                let within = self.machine.joints_to_cylinders(&joints).is_ok()
                    && self.machine.swing_cylinder().is_none_or(|cylinder| cylinder.length(swing).is_ok());
                let joints = [swing, joints.boom, joints.arm, joints.bucket];
                within && self.clearance(&joints, &scene.obstacles) > 1.02 * self.stop_m()
            })
        });
        if clear { Proof::ClearPose } else { Proof::NoClearPose }
    }
}
