//! What the operator does in a scenario, and where the machine stands when it begins.

use firmware::Request;
use serde::Deserialize;

/// What the operator does.
#[derive(Clone, Debug, PartialEq)]
pub enum Task {
    /// Asks for the dig of the parameters; the machine stands at its start.
    Dig,
    /// Asks for the planned move of the parameters; the machine stands at its start.
    Move,
    /// Moves the levers.
    Levers {
        /// Where the machine stands at first.
        start: Start,
        /// The moves; where several are under way their deflections add up.
        moves: Vec<LeverMove>,
    },
    /// Asks for the target of the parameters.
    Reach {
        /// Where the machine stands at first.
        start: Start,
    },
}

/// Where the machine stands at first.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// Swing θ1, degrees.
    pub swing_deg: f64,
    /// Boom cylinder, m.
    pub boom_m: f64,
    /// Arm cylinder, m.
    pub arm_m: f64,
    /// Bucket cylinder, m.
    pub bucket_m: f64,
}

/// Levers held from `at_s` until `until_s`; −1…1 of full deflection each, extending (swing: counter-clockwise) positive.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeverMove {
    /// Start, s.
    pub at_s: f64,
    /// End, s.
    pub until_s: f64,
    /// Swing lever.
    pub swing: f64,
    /// Boom lever.
    pub boom: f64,
    /// Arm lever.
    pub arm: f64,
    /// Bucket lever.
    pub bucket: f64,
}

impl LeverMove {
    pub(super) fn check(&self, duration_s: f64) -> Result<(), String> {
        let checks = [
            ("at_s", self.at_s, [0.0, duration_s]),
            ("until_s", self.until_s, [self.at_s, duration_s]),
            ("swing", self.swing, [-1.0, 1.0]),
            ("boom", self.boom, [-1.0, 1.0]),
            ("arm", self.arm, [-1.0, 1.0]),
            ("bucket", self.bucket, [-1.0, 1.0]),
        ];
        super::check::within(&checks)
    }
}

impl Task {
    /// What the levers' messages ask for once the task has begun.
    pub fn request(&self) -> Request {
        match self {
            Self::Dig => Request::Dig,
            Self::Move => Request::Move,
            Self::Levers { .. } => Request::Levers,
            Self::Reach { .. } => Request::Reach,
        }
    }

    /// The levers at `time_s`: swing, boom, arm, bucket.
    pub fn levers(&self, time_s: f64) -> [i16; 4] {
        let Self::Levers { moves, .. } = self else { return [0; 4] };
        let under_way = moves.iter().filter(|m| time_s >= m.at_s && time_s < m.until_s);
        let sum = under_way.fold([0.0; 4], |sum: [f64; 4], m| {
            let deflections = [m.swing, m.boom, m.arm, m.bucket];
            std::array::from_fn(|i| sum[i] + deflections[i])
        });
        // The cast saturates.
        sum.map(|deflection| libm::round(deflection.clamp(-1.0, 1.0) * 32767.0) as i16)
    }
}
