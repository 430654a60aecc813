//! Follows the dig: feed-forward seen ahead by the known dead time, plus proportional correction of each cylinder.

use kinematics_core::{Cylinders, Machine};

use super::Wanted;
use super::creep::Creep;
use crate::TICKS_PER_S;
use crate::dig::Dig;
use crate::fault::Fault;
use crate::io::Speeds;
use crate::parameters::MotionParameters;

#[derive(Clone, Copy, Debug)]
enum Mode {
    Hold,
    /// Ticks since the request, and the reference seen ahead in the last one.
    Dig {
        elapsed: u32,
        ahead: Cylinders<f32>,
    },
    /// The dig is over: hold until the levers were in neutral.
    Done,
}

/// The dig's follower.
#[derive(Clone, Copy, Debug)]
pub(super) struct DigFollower {
    dig: Dig<f32>,
    dig_ticks: u32,
    preview_ticks: u32,
    gain_per_s: f32,
    smallest_speed_mps: f32,
    start_tolerance_m: f32,
    following_error_m: f32,
    mode: Mode,
    creep: [Creep; 3],
}

fn for_each(a: Cylinders<f32>, b: Cylinders<f32>, f: impl Fn(f32, f32) -> f32) -> Cylinders<f32> {
    Cylinders { boom: f(a.boom, b.boom), arm: f(a.arm, b.arm), bucket: f(a.bucket, b.bucket) }
}

fn all_within(c: Cylinders<f32>, limit: f32) -> bool {
    [c.boom, c.arm, c.bucket].into_iter().all(|x| x >= -limit && x <= limit)
}

impl DigFollower {
    pub(super) fn new(p: &MotionParameters, dig: Dig<f32>) -> Self {
        Self {
            dig,
            dig_ticks: dig.ticks(),
            preview_ticks: (p.preview_s * TICKS_PER_S as f32 + 0.5) as u32,
            gain_per_s: p.gain_per_s,
            smallest_speed_mps: p.smallest_speed_mps,
            start_tolerance_m: p.start_tolerance_m,
            following_error_m: p.following_error_m,
            mode: Mode::Hold,
            creep: [Creep::default(); 3],
        }
    }

    /// Back to holding: the next dig starts over.
    pub(super) fn reset(&mut self) {
        self.mode = Mode::Hold;
        self.creep = [Creep::default(); 3];
    }

    /// Speeds for this tick of the dig.
    pub(super) fn follow(&mut self, machine: &Machine<f32>, lengths: &Cylinders<f32>) -> Result<Wanted, Fault> {
        let hold = Wanted::hold(lengths);
        match self.mode {
            Mode::Done => Ok(hold),
            Mode::Hold => {
                let start = self.reference(machine, 0)?;
                if !all_within(for_each(start, *lengths, |a, b| a - b), self.start_tolerance_m) {
                    return Err(Fault::NotAtStart);
                }
                self.step(machine, 0, start, lengths)
            }
            Mode::Dig { elapsed, .. } if elapsed >= self.dig_ticks + self.preview_ticks => {
                self.mode = Mode::Done;
                Ok(hold)
            }
            Mode::Dig { elapsed, ahead } => self.step(machine, elapsed, ahead, lengths),
        }
    }

    /// One tick of the dig. The dig's own time starts when the dead time is over: until then only the feed-forward sees it.
    fn step(
        &mut self,
        machine: &Machine<f32>,
        elapsed: u32,
        ahead: Cylinders<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        let dig_tick = elapsed.saturating_sub(self.preview_ticks);
        let reference = self.reference(machine, dig_tick)?;
        let next_ahead = self.reference(machine, elapsed + 1)?;
        self.mode = Mode::Dig { elapsed: elapsed + 1, ahead: next_ahead };

        let error = for_each(reference, *lengths, |wanted, is| wanted - is);
        if !all_within(error, self.following_error_m) {
            return Err(Fault::FollowingError);
        }
        let feed_forward = for_each(next_ahead, ahead, |next, now| (next - now) * TICKS_PER_S as f32);
        let asked = for_each(feed_forward, error, |speed, error| speed + self.gain_per_s * error);
        let [boom, arm, bucket] = &mut self.creep;
        let smallest = self.smallest_speed_mps;
        let speeds = Speeds {
            swing: 0.0,
            boom: boom.pass(asked.boom, smallest),
            arm: arm.pass(asked.arm, smallest),
            bucket: bucket.pass(asked.bucket, smallest),
        };
        Ok(Wanted { speeds, reference, dig_tick: dig_tick + 1 })
    }

    fn reference(&self, machine: &Machine<f32>, tick: u32) -> Result<Cylinders<f32>, Fault> {
        machine.tip_to_cylinders(&self.dig.at_tick(tick)).map_err(|_| Fault::Trajectory)
    }
}
