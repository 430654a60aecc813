//! Reach: the tip goes to a target past obstacles. Joint rates by `kinematics_core::planning`, actuator speeds by moment arms.

use kinematics_core::planning::avoid::{Avoid, AvoidParameters};
use kinematics_core::planning::hull::{Flesh, Hull, Sphere};
use kinematics_core::planning::reach::{Progress, Reach, Target};
use kinematics_core::{Cylinders, Machine, PinGeometry, Pose};

use super::Wanted;
use super::creep::Creep;
use crate::TICK_S;
use crate::fault::Fault;
use crate::io::Speeds;
use crate::parameters::{MotionParameters, ParameterError, ReachParameters, ValveDirection};

/// Stands for an obstacle that is not there: a point farther off than any machine reaches.
const NOWHERE: Sphere<f32> = Sphere { x: 0.0, y: 0.0, z: 1000.0, radius: 0.0 };

/// The follower of one target.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReachFollower {
    /// As it was before the first tick: every request starts over.
    fresh: Reach<f32, 2>,
    reach: Reach<f32, 2>,
    /// Full speed of swing, boom, arm, bucket: \[extend, retract\].
    full_speeds: [[f32; 2]; 4],
    smallest_speed: f32,
    creep: [Creep; 4],
}

fn sphere(sphere: Option<Sphere<f64>>) -> Sphere<f32> {
    sphere.map_or(NOWHERE, |s| Sphere { x: s.x as f32, y: s.y as f32, z: s.z as f32, radius: s.radius as f32 })
}

impl ReachFollower {
    pub(super) fn new(
        p: &ReachParameters,
        geometry: &PinGeometry,
        machine: &Machine<f32>,
        valves: &[[ValveDirection; 2]; 4],
        motion: &MotionParameters,
    ) -> Result<Self, ParameterError> {
        let reach_m = geometry.reach_m();
        let hull = Hull::new(geometry, Flesh::of_reach(reach_m))?;
        // What the feed-forward of a dig looks ahead by is what the actuators lag behind by.
        let limits = AvoidParameters::of_reach(reach_m, p.speeds_rad_s).with_delay(motion.preview_s.into());
        let avoid = Avoid::new(geometry, hull, &limits).map_err(ParameterError::Avoid)?;
        let target = Target { x: p.target.x as f32, y: p.target.y as f32, z: p.target.z as f32 };
        let reach = Reach::new(avoid, *machine.chain(), target, p.obstacles.map(sphere), p.tolerance_m as f32);
        Ok(Self {
            fresh: reach,
            reach,
            full_speeds: valves.map(|spool| spool.map(|direction| direction.full_speed)),
            smallest_speed: motion.smallest_speed_mps,
            creep: [Creep::default(); 4],
        })
    }

    pub(super) fn reset(&mut self) {
        self.reach = self.fresh;
        self.creep = [Creep::default(); 4];
    }

    /// One tick: planning at first, then towards the target, then rest.
    pub(super) fn follow(
        &mut self,
        machine: &Machine<f32>,
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let joints = [pose.swing, pose.joints.boom, pose.joints.arm, pose.joints.bucket];
        let told = self.reach.tick(&joints, TICK_S);
        match told.progress {
            Progress::Planning | Progress::Moving | Progress::Reached => {}
            Progress::Blocked | Progress::NoRoute | Progress::NotConverged => return Err(Fault::Trajectory),
        }
        let arms = machine.moment_arms(lengths).map_err(|_| Fault::Geometry)?;
        let [swing, boom, arm, bucket] = told.rates;
        let swing = match machine.swing_cylinder() {
            Some(cylinder) => {
                let length = cylinder.length(pose.swing).map_err(|_| Fault::Geometry)?;
                swing * cylinder.moment_arm(length).map_err(|_| Fault::Geometry)?
            }
            None => swing,
        };
        let speeds = self.within_full([swing, boom * arms.boom, arm * arms.arm, bucket * arms.bucket]);
        let mut passed = [0.0; 4];
        for ((passed, speed), creep) in passed.iter_mut().zip(speeds).zip(&mut self.creep) {
            *passed = creep.pass(speed, self.smallest_speed);
        }
        Ok(Wanted { speeds: Speeds::from_array(passed), ..Wanted::hold(lengths) })
    }

    /// One factor for all, so that the way stays the same and no distance shrinks faster than planned.
    fn within_full(&self, speeds: [f32; 4]) -> [f32; 4] {
        let mut share = 1.0_f32;
        for (speed, [extend, retract]) in speeds.into_iter().zip(self.full_speeds) {
            let wanted = if speed > 0.0 { speed / extend } else { -speed / retract };
            if wanted > share {
                share = wanted;
            }
        }
        speeds.map(|speed| speed / share)
    }
}
