//! What the operator does in a scenario, and where the machine stands when it begins.

use firmware::Request;
use firmware::can::command::TipVelocity;
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
    /// Asks for the path of the parameters; the machine stands at its first knot.
    Path,
    /// Moves the arm's lever; boom and bucket hold the plane of the parameters.
    Grade {
        /// Where the machine stands at first.
        start: Start,
        /// The moves.
        moves: Vec<LeverMove>,
    },
    /// Says how fast the tip shall go.
    TipVelocity {
        /// Where the machine stands at first.
        start: Start,
        /// The moves; where several are under way their velocities add up.
        moves: Vec<TipMove>,
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

/// A velocity of the tip asked for from `at_s` until `until_s`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TipMove {
    /// Start, s.
    pub at_s: f64,
    /// End, s.
    pub until_s: f64,
    /// Outward, m/s.
    pub x_mps: f64,
    /// Up, m/s.
    pub z_mps: f64,
    /// Turning of the bucket, degrees/s.
    pub pitch_deg_s: f64,
}

impl TipMove {
    pub(super) fn check(&self, duration_s: f64) -> Result<(), String> {
        super::check::within(&[
            ("at_s", self.at_s, [0.0, duration_s]),
            ("until_s", self.until_s, [self.at_s, duration_s]),
            ("x_mps", self.x_mps, [-3.0, 3.0]),
            ("z_mps", self.z_mps, [-3.0, 3.0]),
            ("pitch_deg_s", self.pitch_deg_s, [-114.0, 114.0]),
        ])
    }
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
            Self::Path => Request::Path,
            Self::Grade { .. } => Request::Grade,
            Self::TipVelocity { .. } => Request::TipVelocity,
        }
    }

    /// The levers at `time_s`: swing, boom, arm, bucket.
    pub fn levers(&self, time_s: f64) -> [i16; 4] {
        let (Self::Levers { moves, .. } | Self::Grade { moves, .. }) = self else { return [0; 4] };
        let under_way = moves.iter().filter(|m| time_s >= m.at_s && time_s < m.until_s);
        let sum = under_way.fold([0.0; 4], |sum: [f64; 4], m| {
            let deflections = [m.swing, m.boom, m.arm, m.bucket];
            std::array::from_fn(|i| sum[i] + deflections[i])
        });
        // The cast saturates.
        sum.map(|deflection| libm::round(deflection.clamp(-1.0, 1.0) * 32767.0) as i16)
    }

    /// The velocity asked of the tip at `time_s`.
    pub fn tip(&self, time_s: f64) -> TipVelocity {
        let Self::TipVelocity { moves, .. } = self else { return TipVelocity::ZERO };
        let under_way = moves.iter().filter(|m| time_s >= m.at_s && time_s < m.until_s);
        under_way.fold(TipVelocity::ZERO, |sum, m| TipVelocity {
            x_mps: sum.x_mps + m.x_mps as f32,
            z_mps: sum.z_mps + m.z_mps as f32,
            pitch_radps: sum.pitch_radps + m.pitch_deg_s.to_radians() as f32,
        })
    }
}
