//! The paper's three runs of one scenario: the end effector's task alone, with the obstacle's, and with the links' too.

use kinematics_core::planning::obstacle::nearest;
use kinematics_core::planning::planner::{Outcome, Planner, PlannerError, PlannerParameters};
use kinematics_core::{Rotor, Vec2};
use serde::Serialize;

use super::{KIND, PlanarArm};

/// The arm after an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Every joint's angle, rad, counted on from the start.
    pub joints_rad: [f64; 4],
    /// The ends of the links, m, the tip last.
    pub ends: [Vec2<f64>; 4],
    /// The arm's distance from the obstacle, m.
    pub obstacle_m: f64,
    /// The tip's distance from the target, m.
    pub target_m: f64,
}

/// One of the runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// What it is.
    pub name: &'static str,
    /// With which gains.
    pub parameters: PlannerParameters<f64, 4>,
    /// The start and the pose after every iteration.
    pub poses: Vec<Pose>,
    /// How it ended.
    pub outcome: Outcome<f64>,
}

/// The runs, in the paper's order: obstacle ignored (s_o = s_k = 0), Figure 5 (s_k = 0), Figure 6.
///
/// # Errors
/// A parameter outside its range; a loaded scenario has none.
pub fn cases(scenario: &PlanarArm) -> Result<[Case; 3], PlannerError> {
    let scheme = scenario.parameters;
    let without = PlannerParameters { links: [0.0; 4], ..scheme };
    let ignored = PlannerParameters { obstacle: 0.0, ..without };
    Ok([
        case(scenario, "obstacle ignored", ignored)?,
        case(scenario, "without the scheme", without)?,
        case(scenario, "with the scheme", scheme)?,
    ])
}

fn case(scenario: &PlanarArm, name: &'static str, parameters: PlannerParameters<f64, 4>) -> Result<Case, PlannerError> {
    let planner = Planner::new(scenario.chain, parameters)?;
    let start = scenario.start();
    let pose = |joints: &[Rotor<f64>; 4], joints_rad| {
        let ends = scenario.chain.ends(joints);
        let obstacle_m = nearest(&ends, scenario.obstacle.position).distance_m;
        Pose { joints_rad, ends, obstacle_m, target_m: (scenario.target - ends[3]).norm() }
    };
    let mut angles = scenario.start_rad;
    let mut poses = vec![pose(&start, angles)];
    let outcome = planner.run(&start, scenario.target, Some(&scenario.obstacle), scenario.iterations, |_, step| {
        for (angle, change) in angles.iter_mut().zip(step.change) {
            *angle += change;
        }
        poses.push(pose(&step.joints, angles));
    });
    Ok(Case { name, parameters, poses, outcome })
}

/// A run in a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaseSummary {
    /// What it is.
    pub case: &'static str,
    /// s_e.
    pub end_effector_gain: f64,
    /// s_o.
    pub obstacle_gain: f64,
    /// s_k.
    pub link_gains: [f64; 4],
    /// Whether the tip ended within the tolerance of the target.
    pub reached: bool,
    /// From which iteration on it stayed there.
    pub settled_at_iteration: Option<u32>,
    /// The tip's last distance from the target, m.
    pub final_distance_m: f64,
    /// The arm's smallest distance from the obstacle, m.
    pub smallest_obstacle_distance_m: f64,
}

/// The scenario's runs in a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The scenario's name.
    pub scenario: String,
    /// `planar_arm`.
    pub kind: &'static str,
    /// Iterations of every run.
    pub iterations: u32,
    /// The radius round the obstacle that is kept free, m.
    pub keep_m: f64,
    /// The runs.
    pub cases: Vec<CaseSummary>,
}

impl Summary {
    /// Of all runs.
    pub fn of(scenario: &PlanarArm, cases: &[Case]) -> Self {
        let cases = cases.iter().map(|case| {
            let settled = match case.outcome {
                Outcome::Reached { iterations } => Some(iterations),
                Outcome::NotReached { .. } => None,
            };
            let smallest = case.poses.iter().map(|pose| pose.obstacle_m).min_by(f64::total_cmp);
            CaseSummary {
                case: case.name,
                end_effector_gain: case.parameters.end_effector,
                obstacle_gain: case.parameters.obstacle,
                link_gains: case.parameters.links,
                reached: settled.is_some(),
                settled_at_iteration: settled,
                final_distance_m: case.poses.last().map_or(f64::NAN, |pose| pose.target_m),
                smallest_obstacle_distance_m: smallest.unwrap_or(f64::NAN),
            }
        });
        Self {
            scenario: scenario.name.clone(),
            kind: KIND,
            iterations: scenario.iterations,
            keep_m: scenario.obstacle.keep_m,
            cases: cases.collect(),
        }
    }
}
