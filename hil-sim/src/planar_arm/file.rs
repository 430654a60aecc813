//! The scenario's TOML: every field required, nothing unknown, every number within its range by name.

use kinematics_core::chain_n::PlanarChain;
use kinematics_core::planning::obstacle::{Obstacle, nearest};
use kinematics_core::planning::park::Direction;
use kinematics_core::planning::planner::PlannerParameters;
use kinematics_core::{Rotor, Vec2};
use serde::Deserialize;

use crate::toml_text::{Tag, strictly};

const TAGS: [Tag; 1] = [("gains.direction", "`\"add\"` or `\"hold\"`")];

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    name: String,
    description: String,
    iterations: u32,
    arm: Arm,
    target: Target,
    obstacle: Point,
    gains: Gains,
    limits: Limits,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Arm {
    link_m: [f64; 4],
    start_deg: [f64; 4],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Target {
    x_m: f64,
    z_m: f64,
    tolerance_m: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Point {
    x_m: f64,
    z_m: f64,
    keep_m: f64,
    acts_m: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Gains {
    end_effector: f64,
    obstacle: f64,
    links: [f64; 4],
    direction: Sense,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Sense {
    Add,
    Hold,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Limits {
    trusted_m: f64,
    turn_rad: f64,
}

/// A planar arm, its way and its obstacle, checked.
#[derive(Clone, Debug)]
pub struct PlanarArm {
    /// Its name, which becomes the report's folder.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Iterations of every run.
    pub iterations: u32,
    /// The links.
    pub chain: PlanarChain<f64, 4>,
    /// Every joint at the beginning, rad.
    pub start_rad: [f64; 4],
    /// Where the tip should go, m.
    pub target: Vec2<f64>,
    /// What it should go round.
    pub obstacle: Obstacle<f64>,
    /// Gains and limits, with the scheme.
    pub parameters: PlannerParameters<f64, 4>,
}

impl PlanarArm {
    /// The pose at the beginning.
    pub fn start(&self) -> [Rotor<f64>; 4] {
        self.start_rad.map(Rotor::from_angle)
    }

    /// A scenario from the text of a file.
    ///
    /// # Errors
    /// The field, and its allowed range.
    pub fn from_toml(text: &str) -> Result<Self, String> {
        let file: File = strictly(text, &TAGS).map_err(|fault| fault.to_string())?;
        name(&file.name)?;
        ranges(&file)?;
        let File { name, description, iterations, arm, target, obstacle, gains, limits, .. } = file;
        let direction = match gains.direction {
            Sense::Add => Direction::Add,
            Sense::Hold => Direction::Hold,
        };
        let scenario = Self {
            name,
            description,
            iterations,
            chain: PlanarChain::new(arm.link_m),
            start_rad: arm.start_deg.map(f64::to_radians),
            target: Vec2::new(target.x_m, target.z_m),
            obstacle: Obstacle {
                position: Vec2::new(obstacle.x_m, obstacle.z_m),
                keep_m: obstacle.keep_m,
                acts_m: obstacle.acts_m,
            },
            parameters: PlannerParameters {
                end_effector: gains.end_effector,
                obstacle: gains.obstacle,
                links: gains.links,
                directions: [direction; 4],
                trusted_m: limits.trusted_m,
                turn_rad: limits.turn_rad,
                tolerance_m: target.tolerance_m,
            },
        };
        scenario.places()?;
        Ok(scenario)
    }

    /// Arm and target outside the circle the tip goes round.
    fn places(&self) -> Result<(), String> {
        let Obstacle { position, keep_m, .. } = self.obstacle;
        let arm = nearest(&self.chain.ends(&self.start()), position).distance_m;
        if arm < keep_m {
            return Err(format!(
                "`arm.start_deg` puts the arm {arm:.3} m from the obstacle but it must be at least `obstacle.keep_m`, {keep_m} m, away"
            ));
        }
        let target = (self.target - position).norm();
        if target < keep_m {
            return Err(format!(
                "`target.x_m` and `target.z_m` are {target:.3} m from the obstacle but must be at least `obstacle.keep_m`, {keep_m} m, away"
            ));
        }
        Ok(())
    }
}

/// The name becomes the report's folder.
fn name(name: &str) -> Result<(), String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if !name.is_empty() && name.len() <= 64 && !name.starts_with('.') && name.chars().all(plain) {
        Ok(())
    } else {
        Err(format!("`name` is {name:?} but must be 1 to 64 of A–Z, a–z, 0–9, `-`, `_`, `.`, the first not `.`"))
    }
}

fn ranges(file: &File) -> Result<(), String> {
    let File { arm, target, obstacle, gains, limits, .. } = file;
    let far = [-50.0, 50.0];
    let gain = [0.0, 1.0];
    let mut checks = vec![("iterations", f64::from(file.iterations), [1.0, 10_000.0])];
    checks.extend(arm.link_m.map(|m| ("arm.link_m", m, [0.01, 20.0])));
    checks.extend(arm.start_deg.map(|deg| ("arm.start_deg", deg, [-360.0, 360.0])));
    checks.extend([
        ("target.x_m", target.x_m, far),
        ("target.z_m", target.z_m, far),
        ("target.tolerance_m", target.tolerance_m, [1e-6, 1.0]),
        ("obstacle.x_m", obstacle.x_m, far),
        ("obstacle.z_m", obstacle.z_m, far),
        ("obstacle.keep_m", obstacle.keep_m, [0.001, 20.0]),
        ("obstacle.acts_m", obstacle.acts_m, [obstacle.keep_m, 50.0]),
        ("gains.end_effector", gains.end_effector, [0.001, 1.0]),
        ("gains.obstacle", gains.obstacle, gain),
    ]);
    checks.extend(gains.links.map(|s| ("gains.links", s, gain)));
    checks.extend([
        ("limits.trusted_m", limits.trusted_m, [1e-6, 10.0]),
        ("limits.turn_rad", limits.turn_rad, [0.001, 1.0]),
    ]);
    for (field, value, [low, high]) in checks {
        // Written so that NaN fails.
        if !(value >= low && value <= high) {
            return Err(format!("`{field}` is {value} but must be within {low}…{high}"));
        }
    }
    Ok(())
}
