//! What a run to a target past obstacles showed.

use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::reach::Target;

use super::Log;
use crate::scenario::Scenario;
use crate::scenes::{Kit, Sample};

/// The machine's true way, beside target and obstacles.
#[derive(Clone, Debug)]
pub struct ReachSeen {
    /// A sample every 10 ms.
    pub samples: Vec<Sample>,
    /// What to keep away from.
    pub obstacles: Vec<Sphere<f64>>,
    /// Where the tip should go.
    pub target: Target<f64>,
    /// Tip from target at the end, m.
    pub target_error_m: f64,
    /// m
    pub smallest_clearance_m: f64,
}

impl ReachSeen {
    /// Of a run; `None` where no target is to be reached or nothing was logged.
    pub fn of(scenario: &Scenario, log: &Log) -> Option<Self> {
        let reach = scenario.parameters.reach?;
        let kit = Kit::new(&scenario.machine.geometry).ok()?;
        let obstacles: Vec<_> = reach.obstacles.into_iter().flatten().collect();
        let posed = log.rows.iter().filter_map(|row| {
            let (swing, joints) = (row.swing?, row.joints?);
            Some((row.time_s, [swing, joints.boom, joints.arm, joints.bucket]))
        });
        let every: Vec<Sample> = posed
            .map(|(time_s, joints)| Sample { time_s, joints, clearance_m: kit.clearance(&joints, &obstacles) })
            .collect();
        let target = reach.target;
        let [x, y, z] = kit.tip(&every.last()?.joints);
        let apart = [x - target.x, y - target.y, z - target.z];
        Some(Self {
            target_error_m: libm::sqrt(apart.iter().map(|d| d * d).sum()),
            smallest_clearance_m: every.iter().map(|s| s.clearance_m).fold(f64::INFINITY, f64::min),
            samples: every.into_iter().step_by(10).collect(),
            obstacles,
            target,
        })
    }
}
