//! A move of the tip along a straight line with the least cylinder travel, planned before anything moves.

use core::fmt;

use kinematics_core::planning::cylinder_path::CylinderPath;
use kinematics_core::planning::effort::{Effort, EffortError};
use kinematics_core::planning::move_limits::{LimitError, Limits, MoveLimits};
use kinematics_core::planning::pitch_plan::{PathMove, PitchPlan, PlanError, plan_path};
use kinematics_core::planning::pitch_rule::PitchRule;
use kinematics_core::planning::time_scaling::{NoProfile, TimeScaling};
use kinematics_core::planning::tip_path::TipPath;
use kinematics_core::{Machine, PoseError, Vec2};
use serde::{Deserialize, Serialize};

/// Knots of a move's path.
pub const KNOTS: usize = 17;

/// Configurations between two knots at which the smooth path is tried against the strokes.
const BETWEEN_KNOTS: i32 = 4;

/// What the bucket may do, degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Pitch {
    /// Anything.
    Free,
    /// Keep the pitch of the start.
    Fixed,
    /// Stay between these, degrees.
    Bounded {
        /// Lowest.
        lower_deg: f64,
        /// Highest.
        upper_deg: f64,
    },
}

/// A straight move. Positions in the boom's plane of the base frame, m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MoveParameters {
    /// Tip at the start, reach and height, m.
    pub start_m: [f64; 2],
    /// Pitch at the start, degrees.
    pub start_pitch_deg: f64,
    /// Tip at the end, reach and height, m.
    pub target_m: [f64; 2],
    /// What the bucket may do.
    pub pitch: Pitch,
    /// The most the bucket turns from knot to knot, degrees; the path has [`KNOTS`] of them.
    pub turn_per_knot_deg: f64,
    /// What a metre of boom, arm and bucket cylinder counts.
    pub weights: [f64; 3],
    /// Largest speeds of boom, arm, bucket: \[extend, retract\], m/s.
    pub speed_mps: [[f64; 2]; 3],
    /// Largest accelerations, m/s².
    pub acceleration_mps2: [f64; 3],
    /// Largest jerks, m/s³.
    pub jerk_mps3: [f64; 3],
    /// Areas the pump fills: \[extend, retract\], m².
    pub areas_m2: [[f64; 2]; 3],
    /// What the pump gives to all cylinders together, m³/s.
    pub flow_m3ps: f64,
}

/// Why a move is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MoveError {
    /// A limit out of its range.
    Limits(LimitError),
    /// The weights.
    Weights(EffortError),
    /// No pitches lead to the target.
    Plan(PlanError),
    /// The target is the start.
    NoMovement,
    /// Between the knots the smooth path leaves a stroke.
    Stroke(PoseError<f32>),
    /// No speeds.
    Profile(NoProfile),
}

impl fmt::Display for MoveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Limits(error) => error.fmt(f),
            Self::Weights(error) => write!(f, "`weights`: {error}"),
            Self::Plan(error) => error.fmt(f),
            Self::NoMovement => f.write_str("the target is the start"),
            Self::Stroke(error) => error.fmt(f),
            Self::Profile(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for MoveError {}

/// A planned move.
#[derive(Clone, Debug)]
pub struct Move {
    /// Pitches and cylinder lengths at the knots.
    pub plan: PitchPlan<f32, KNOTS>,
    /// The smooth path through them.
    pub path: CylinderPath<f32, KNOTS>,
    /// How fast along it, at its start.
    pub scaling: TimeScaling<f32>,
}

impl Move {
    /// Plans it, in bounded work.
    ///
    /// # Errors
    /// [`MoveError`]: nothing has moved.
    // Not inlined: what planning needs of the stack, an application without a move does not.
    #[inline(never)]
    pub fn new(machine: &Machine<f32>, p: &MoveParameters, tick_s: f64) -> Result<Self, MoveError> {
        let limits = Limits::new(&MoveLimits {
            speed_mps: p.speed_mps,
            acceleration_mps2: p.acceleration_mps2,
            jerk_mps3: p.jerk_mps3,
            areas_m2: p.areas_m2,
            flow_m3ps: p.flow_m3ps,
        })
        .map_err(MoveError::Limits)?;
        let effort = Effort::travel(p.weights).map_err(MoveError::Weights)?;
        let turns = |degrees: f64| (degrees / 360.0) as f32;
        let start = turns(p.start_pitch_deg);
        let point = |[reach, height]: [f64; 2]| Vec2::new(reach as f32, height as f32);
        let request = PathMove {
            path: TipPath::line(point(p.start_m), point(p.target_m)),
            start_pitch_turns: start,
            rule: match p.pitch {
                Pitch::Free => PitchRule::Free,
                Pitch::Fixed => PitchRule::Fixed(start),
                Pitch::Bounded { lower_deg, upper_deg } => {
                    PitchRule::Bounded { lower: turns(lower_deg), upper: turns(upper_deg) }
                }
            },
            turn_per_knot: turns(p.turn_per_knot_deg),
        };
        let plan = plan_path(machine, &request, &effort, |_| true).map_err(MoveError::Plan)?;
        let path = CylinderPath::new(&plan.cylinders, &limits).ok_or(MoveError::NoMovement)?;
        let places = BETWEEN_KNOTS * (KNOTS as i32 - 1);
        for i in 0..=places {
            let lengths = path.at(i as f32 / places as f32).lengths;
            machine.check_strokes(&lengths).map_err(MoveError::Stroke)?;
        }
        let scaling = TimeScaling::new(&path, &limits, tick_s).map_err(MoveError::Profile)?;
        Ok(Self { plan, path, scaling })
    }
}
