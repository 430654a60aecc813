//! Following a reference: feed-forward plus proportional correction of each cylinder, within the following error.

use kinematics_core::Cylinders;

use super::creep::Creep;
use crate::fault::Fault;
use crate::io::Speeds;
use crate::parameters::MotionParameters;

/// What followers share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tracker {
    gain_per_s: f32,
    smallest_speed_mps: f32,
    start_tolerance_m: f32,
    following_error_m: f32,
    creep: [Creep; 3],
}

#[inline]
pub(super) fn for_each(a: Cylinders<f32>, b: Cylinders<f32>, f: impl Fn(f32, f32) -> f32) -> Cylinders<f32> {
    Cylinders { boom: f(a.boom, b.boom), arm: f(a.arm, b.arm), bucket: f(a.bucket, b.bucket) }
}

#[inline]
fn all_within(c: Cylinders<f32>, limit: f32) -> bool {
    [c.boom, c.arm, c.bucket].into_iter().all(|x| x >= -limit && x <= limit)
}

impl Tracker {
    /// Nothing to follow.
    pub(super) const IDLE: Self = Self {
        gain_per_s: 0.0,
        smallest_speed_mps: 0.0,
        start_tolerance_m: 0.0,
        following_error_m: 0.0,
        creep: [Creep::REST; 3],
    };

    pub(super) fn new(p: &MotionParameters) -> Self {
        Self {
            gain_per_s: p.gain_per_s,
            smallest_speed_mps: p.smallest_speed_mps,
            start_tolerance_m: p.start_tolerance_m,
            following_error_m: p.following_error_m,
            creep: [Creep::REST; 3],
        }
    }

    pub(super) fn reset(&mut self) {
        self.creep = [Creep::REST; 3];
    }

    /// Whether the cylinders stand near enough to the start.
    pub(super) fn check_start(&self, start: Cylinders<f32>, lengths: &Cylinders<f32>) -> Result<(), Fault> {
        let near = all_within(for_each(start, *lengths, |a, b| a - b), self.start_tolerance_m);
        if near { Ok(()) } else { Err(Fault::NotAtStart) }
    }

    /// Speeds towards the reference.
    #[inline]
    pub(super) fn speeds(
        &mut self,
        feed_forward: Cylinders<f32>,
        reference: Cylinders<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Speeds, Fault> {
        let error = for_each(reference, *lengths, |wanted, is| wanted - is);
        if !all_within(error, self.following_error_m) {
            return Err(Fault::FollowingError);
        }
        let asked = for_each(feed_forward, error, |speed, error| speed + self.gain_per_s * error);
        let [boom, arm, bucket] = &mut self.creep;
        let smallest = self.smallest_speed_mps;
        Ok(Speeds {
            swing: 0.0,
            boom: boom.pass(asked.boom, smallest),
            arm: arm.pass(asked.arm, smallest),
            bucket: bucket.pass(asked.bucket, smallest),
        })
    }
}
