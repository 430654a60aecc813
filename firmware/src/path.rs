//! A path of straight segments for the tip: level, slope, trench wall, square, or a cycle that swings.

use kinematics_core::PoseError;
use serde::{Deserialize, Serialize};

use crate::parameters::Checks;

/// Knots of a path at most; one less segments.
pub const KNOTS: usize = 9;

/// Where a segment begins and the one before ends, at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Knot {
    /// Tip, reach in the boom's plane, m.
    pub x_m: f64,
    /// Tip, height over the boom pin, m.
    pub z_m: f64,
    /// Bucket pitch, degrees; continuous, not wrapped.
    pub pitch_deg: f64,
    /// Swing, degrees; continuous, not wrapped.
    pub swing_deg: f64,
}

impl Knot {
    /// Reach and height, m; pitch and swing, turns.
    pub(crate) fn place(&self) -> [f64; 4] {
        [self.x_m, self.z_m, self.pitch_deg / 360.0, self.swing_deg / 360.0]
    }
}

/// A path. On each segment tip, pitch and swing keep step, as fast as the slowest of them may.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathParameters {
    /// Two or more, and none after an empty place.
    pub knots: [Option<Knot>; KNOTS],
    /// Speed of the tip, m/s.
    pub speed_mps: f64,
    /// Its acceleration, m/s².
    pub acceleration_mps2: f64,
    /// Turning of the bucket, degrees/s.
    pub pitch_speed_deg_s: f64,
    /// Its acceleration, degrees/s².
    pub pitch_acceleration_deg_s2: f64,
    /// Turning of the swing, degrees/s.
    pub swing_speed_deg_s: f64,
    /// Its acceleration, degrees/s².
    pub swing_acceleration_deg_s2: f64,
}

/// A place of a path that the machine cannot take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathViolation {
    /// The segment, from 0.
    pub segment: usize,
    /// What: cylinder and amount.
    pub error: PoseError<f32>,
}

impl PathParameters {
    /// Checks every value; where the path leads is checked when the controller is built.
    #[inline(never)]
    pub(crate) fn check(&self, checks: &mut Checks) {
        let count = self.knots.iter().take_while(|knot| knot.is_some()).count();
        checks.within("path.knots", count as f64, &[2.0, KNOTS as f64]);
        let all = self.knots.iter().flatten().count() as f64;
        checks.within("path.knots", count as f64, &[all, all]);
        for knot in self.knots.iter().flatten() {
            checks.within("path.knot.x_m", knot.x_m, &[-50.0, 50.0]);
            checks.within("path.knot.z_m", knot.z_m, &[-50.0, 50.0]);
            checks.within("path.knot.pitch_deg", knot.pitch_deg, &[-720.0, 720.0]);
            checks.within("path.knot.swing_deg", knot.swing_deg, &[-720.0, 720.0]);
        }
        checks.within("path.speed_mps", self.speed_mps, &[0.001, 3.0]);
        checks.within("path.acceleration_mps2", self.acceleration_mps2, &[0.01, 20.0]);
        checks.within("path.pitch_speed_deg_s", self.pitch_speed_deg_s, &[0.1, 180.0]);
        checks.within("path.pitch_acceleration_deg_s2", self.pitch_acceleration_deg_s2, &[0.1, 1000.0]);
        checks.within("path.swing_speed_deg_s", self.swing_speed_deg_s, &[0.1, 180.0]);
        checks.within("path.swing_acceleration_deg_s2", self.swing_acceleration_deg_s2, &[0.1, 1000.0]);
    }
}
