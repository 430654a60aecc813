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
    reach: Reach<f32, 2>,
    /// Full speed of swing, boom, arm, bucket: \[extend, retract\].
    full_speeds: [[f32; 2]; 4],
    smallest_speed: f32,
    creep: [Creep; 4],
    /// The actuators' speeds for the rates chosen last.
    speeds: [f32; 4],
    /// Rates were chosen in the tick before.
    chosen: bool,
}

fn sphere(sphere: Option<Sphere<f64>>) -> Sphere<f32> {
    sphere.map_or(NOWHERE, |s| Sphere { x: s.x as f32, y: s.y as f32, z: s.z as f32, radius: s.radius as f32 })
}

impl ReachFollower {
    #[inline(never)]
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
            reach,
            full_speeds: valves.map(|spool| spool.map(|direction| direction.full_speed)),
            smallest_speed: motion.smallest_speed_mps,
            creep: [Creep::REST; 4],
            speeds: [0.0; 4],
            chosen: false,
        })
    }

    #[inline(never)]
    pub(super) fn reset(&mut self) {
        self.reach.restart();
        self.rest();
    }

    #[inline]
    fn rest(&mut self) {
        (self.creep, self.speeds, self.chosen) = ([Creep::REST; 4], [0.0; 4], false);
    }

    /// One tick: planning at first, then towards the target, then rest.
    #[inline]
    pub(super) fn follow(
        &mut self,
        machine: &Machine<f32>,
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let joints = [pose.swing, pose.joints.boom, pose.joints.arm, pose.joints.bucket];
        let told = self.reach.tick(&joints, TICK_S);
        match told.progress {
            Progress::Planning | Progress::Reached => {
                self.rest();
                return Ok(Wanted::hold(lengths));
            }
            Progress::Moving => {}
            Progress::Blocked | Progress::NoRoute | Progress::NotConverged => return Err(Fault::Trajectory),
        }
        // Rates and speeds hold until new ones are chosen: those become speeds in the next tick, which has more room.
        if core::mem::replace(&mut self.chosen, told.clearance.is_some()) {
            self.speeds = self.speeds_of(told.rates, machine, pose, lengths)?;
        }
        let mut passed = [0.0; 4];
        for ((passed, speed), creep) in passed.iter_mut().zip(self.speeds).zip(&mut self.creep) {
            *passed = creep.pass(speed, self.smallest_speed);
        }
        Ok(Wanted { speeds: Speeds::from_array(passed), ..Wanted::hold(lengths) })
    }

    /// The actuators' speeds for these joint rates, within their full speeds.
    #[inline]
    fn speeds_of(
        &self,
        rates: [f32; 4],
        machine: &Machine<f32>,
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<[f32; 4], Fault> {
        let arms = machine.moment_arms(lengths).map_err(|_| Fault::Geometry)?;
        let [swing, boom, arm, bucket] = rates;
        let swing = match machine.swing_cylinder() {
            Some(cylinder) => {
                let length = cylinder.length(pose.swing).map_err(|_| Fault::Geometry)?;
                swing * cylinder.moment_arm(length).map_err(|_| Fault::Geometry)?
            }
            None => swing,
        };
        Ok(self.within_full([swing, boom * arms.boom, arm * arms.arm, bucket * arms.bucket]))
    }

    /// One factor for all, so that the way stays the same and no distance shrinks faster than planned.
    #[inline]
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
