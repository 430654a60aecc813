//! One factor for all: when a cylinder, the swing or the pump cannot keep up, everything slows alike and the tip stays on its path.

use kinematics_core::{Cylinders, PinGeometry, Real};

use crate::io::Speeds;
use crate::law::LawParameters;
use crate::parameters::ValveDirection;

/// What the machine can do. Pairs are \[extend, retract\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    full_speeds: [[f32; 2]; 4],
    areas_m2: [[f32; 2]; 3],
    flow_m3ps: f32,
    /// Twice the deceleration before the end of a stroke, m/s².
    cushion: f32,
    /// Longest and shortest, m.
    ends_m: [[f32; 2]; 3],
}

/// Lowers `factor` to what keeps `value` within `limit`.
#[inline]
fn keep(factor: &mut f32, value: f32, limit: f32) {
    if value * *factor > limit {
        *factor = limit / value;
    }
}

impl Limits {
    pub(super) fn new(p: &LawParameters, valves: &[[ValveDirection; 2]; 4], g: &PinGeometry) -> Self {
        Self {
            full_speeds: valves.map(|spool| spool.map(|direction| direction.full_speed)),
            areas_m2: p.areas_m2,
            flow_m3ps: p.flow_m3ps,
            cushion: 2.0 * p.cushion_mps2,
            ends_m: [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| [s.max_m as f32, s.min_m as f32]),
        }
    }

    /// Ends of the strokes: \[longest, shortest\], m.
    #[inline]
    pub(super) fn ends_m(&self) -> [[f32; 2]; 3] {
        self.ends_m
    }

    /// The factor for these speeds, at most 1; `share` of full speeds and flow may be used.
    #[inline(always)]
    pub(super) fn factor(&self, speeds: &[f32; 4], share: f32) -> f32 {
        let mut factor = 1.0;
        for (speed, [extend, retract]) in speeds.iter().zip(self.full_speeds) {
            if *speed > 0.0 {
                keep(&mut factor, *speed, extend * share);
            } else {
                keep(&mut factor, -*speed, retract * share);
            }
        }
        let [_, cylinders @ ..] = speeds;
        let mut flow = 0.0;
        for (speed, [head, rod]) in cylinders.iter().zip(self.areas_m2) {
            flow += if *speed > 0.0 { *speed * head } else { -*speed * rod };
        }
        keep(&mut factor, flow, self.flow_m3ps * share);
        factor
    }

    /// The factor that lets every cylinder still stop before the end of its stroke: speed ≤ √(2·a·d).
    #[inline(always)]
    pub(super) fn before_ends(&self, lengths: &Cylinders<f32>, speeds: &[f32; 4]) -> f32 {
        let [_, cylinders @ ..] = speeds;
        let mut factor = 1.0;
        let lengths = [lengths.boom, lengths.arm, lengths.bucket];
        for ((length, speed), ends) in lengths.into_iter().zip(cylinders).zip(self.ends_m) {
            if let Some(limit) = self.cushioned(length, *speed, ends) {
                keep(&mut factor, if *speed < 0.0 { -*speed } else { *speed }, limit);
            }
        }
        factor
    }

    /// Each speed for itself, slow enough to stop before the end of its stroke.
    #[inline]
    pub(super) fn cushion(&self, lengths: &Cylinders<f32>, mut speeds: Speeds) -> Speeds {
        let [boom_ends, arm_ends, bucket_ends] = self.ends_m;
        for (length, speed, ends) in [
            (lengths.boom, &mut speeds.boom, boom_ends),
            (lengths.arm, &mut speeds.arm, arm_ends),
            (lengths.bucket, &mut speeds.bucket, bucket_ends),
        ] {
            if let Some(limit) = self.cushioned(length, *speed, ends) {
                *speed = if *speed > 0.0 { limit } else { -limit };
            }
        }
        speeds
    }

    /// The speed allowed this far before the end, m/s, where `speed` is more than that.
    #[inline]
    fn cushioned(&self, length: f32, speed: f32, [longest, shortest]: [f32; 2]) -> Option<f32> {
        let left = if speed > 0.0 { longest - length } else { length - shortest };
        let square = if left > 0.0 { self.cushion * left } else { 0.0 };
        (speed * speed > square).then(|| Real::sqrt(square))
    }
}
