//! The fence's part of the parameter record.

use kinematics_core::Real;
use kinematics_core::planning::clearance::{HalfSpace, Sphere};
use kinematics_core::planning::fence::{Fence, Stopping};
use kinematics_core::planning::limits::{HALF_SPACES, Limits, SPHERES, SwingRange};
use kinematics_core::planning::outline::OutlineShape;
use serde::{Deserialize, Serialize};

use crate::apart::apart;
use crate::parameters::{ParameterError, ordered, within};

/// What the fence checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Guards {
    /// Every part of the linkage.
    Linkage,
    /// The bucket's teeth alone: for comparison.
    Tip,
}

/// A plane: points p with normal·p ≤ offset are allowed. World frame: x forward at zero swing, y left, z up, from the swing axis on
/// the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaneParameters {
    /// Towards what is forbidden; of length one to a thousandth.
    pub normal: [f64; 3],
    /// m
    pub offset_m: f64,
}

/// A ball to keep clear of, in the same frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BallParameters {
    /// m
    pub centre_m: [f64; 3],
    /// m
    pub radius_m: f64,
}

/// Ends of the swing's range, degrees from straight ahead, counter-clockwise positive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SwingRangeParameters {
    /// To the right.
    pub right_deg: f64,
    /// To the left.
    pub left_deg: f64,
}

/// A fence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FenceParameters {
    /// Ceiling, floor, walls.
    #[serde(deserialize_with = "apart")]
    pub planes: [Option<PlaneParameters>; HALF_SPACES],
    /// Points and balls.
    #[serde(deserialize_with = "apart")]
    pub balls: [Option<BallParameters>; SPHERES],
    /// The swing's range.
    #[serde(deserialize_with = "apart")]
    pub swing: Option<SwingRangeParameters>,
    /// Height of the boom pin above the ground, m.
    pub boom_pin_height_m: f64,
    /// Sizes of the linkage's outline.
    #[serde(deserialize_with = "apart")]
    pub outline: OutlineShape,
    /// What it checks.
    pub guards: Guards,
    /// Kept of every distance, m.
    pub margin_m: f32,
    /// Deceleration of any point of the linkage, m/s².
    pub deceleration_mps2: f32,
    /// Time until a command may act, beyond what is known to be under way, s.
    pub reaction_s: f32,
    /// Kept of the swing's range at either end, rad.
    pub swing_margin_rad: f32,
    /// Deceleration of the swing, rad/s².
    pub swing_deceleration_rad_s2: f32,
    /// The valves' dead time, s.
    pub dead_time_s: f32,
    /// The spools' time constant, s.
    pub lag_s: f32,
}

impl FenceParameters {
    pub(crate) fn validate(&self) -> Result<(), ParameterError> {
        let far = [-1000.0, 1000.0];
        for plane in self.planes.iter().flatten() {
            let [x, y, z] = plane.normal;
            within("fence.planes.normal", Real::sqrt(x * x + y * y + z * z), [0.999, 1.001])?;
            within("fence.planes.offset_m", plane.offset_m, far)?;
        }
        for ball in self.balls.iter().flatten() {
            for x in ball.centre_m {
                within("fence.balls.centre_m", x, far)?;
            }
            within("fence.balls.radius_m", ball.radius_m, [0.0, 100.0])?;
        }
        if let Some(SwingRangeParameters { right_deg, left_deg }) = self.swing {
            within("fence.swing.right_deg", right_deg, [-179.0, 179.0])?;
            within("fence.swing.left_deg", left_deg, [-179.0, 179.0])?;
            ordered(("fence.swing.right_deg", right_deg), ("fence.swing.left_deg", left_deg))?;
        }
        within("fence.boom_pin_height_m", self.boom_pin_height_m, far)?;
        within("fence.margin_m", self.margin_m, [0.0, 5.0])?;
        within("fence.deceleration_mps2", self.deceleration_mps2, [0.01, 20.0])?;
        within("fence.reaction_s", self.reaction_s, [0.002, 2.0])?;
        within("fence.swing_margin_rad", self.swing_margin_rad, [0.0, 1.0])?;
        within("fence.swing_deceleration_rad_s2", self.swing_deceleration_rad_s2, [0.01, 20.0])?;
        within("fence.dead_time_s", self.dead_time_s, [0.0, 0.5])?;
        within("fence.lag_s", self.lag_s, [0.0, 1.0])
    }

    /// What it keeps clear of.
    pub fn limits<T: Real>(&self) -> Limits<T> {
        let plane = |plane: PlaneParameters| {
            let [x, y, z] = plane.normal;
            let length = Real::sqrt(x * x + y * y + z * z);
            HalfSpace { normal: [x, y, z].map(|part| T::from_f64(part / length)), offset: T::from_f64(plane.offset_m) }
        };
        let ball = |ball: BallParameters| Sphere {
            centre: ball.centre_m.map(T::from_f64),
            radius: T::from_f64(ball.radius_m),
        };
        Limits {
            half_spaces: self.planes.map(|found| found.map(plane)),
            spheres: self.balls.map(|found| found.map(ball)),
            swing: self.swing.map(|range| SwingRange::new(T::from_f64(range.right_deg), T::from_f64(range.left_deg))),
        }
    }

    /// As the loop takes it.
    pub(super) fn fence(&self) -> Fence<f32> {
        Fence {
            limits: self.limits(),
            stopping: Stopping {
                deceleration: self.deceleration_mps2,
                reaction_s: self.reaction_s,
                margin: self.margin_m,
            },
            turning: Stopping {
                deceleration: self.swing_deceleration_rad_s2,
                reaction_s: self.reaction_s,
                margin: self.swing_margin_rad,
            },
        }
    }
}
