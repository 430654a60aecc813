//! Follows the dig: feed-forward seen ahead by the known dead time, plus proportional correction of each cylinder.

use kinematics_core::{Cylinders, Machine};

use super::Wanted;
use super::delays::{Delays, preview_ticks};
use super::tracker::{Tracker, for_each};
use crate::TICKS_PER_S;
use crate::dig::Dig;
use crate::fault::Fault;
use crate::parameters::MotionParameters;
use crate::pose::cylinders_once;

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
    /// Its reference at the beginning.
    start: Cylinders<f32>,
    dig_ticks: u32,
    preview_ticks: u32,
    mode: Mode,
    tracker: Tracker,
}

impl DigFollower {
    /// `None` where the dig does not begin within reach and stroke. References seen ahead are kept in `delays`.
    pub(super) fn new(
        p: &MotionParameters,
        machine: &Machine<f32>,
        dig: Dig<f32>,
        delays: &mut Delays,
    ) -> Option<Self> {
        let start = cylinders_once(machine, &dig.at_tick(0)).ok()?;
        let preview_ticks = preview_ticks(p);
        delays.set_dig(preview_ticks, [start.boom, start.arm, start.bucket]);
        let dig_ticks = dig.ticks();
        Some(Self { dig, start, dig_ticks, preview_ticks, mode: Mode::Hold, tracker: Tracker::new(p) })
    }

    /// Back to holding: the next dig starts over.
    pub(super) fn reset(&mut self) {
        self.mode = Mode::Hold;
        self.tracker.reset();
    }

    /// Speeds for this tick of the dig.
    #[inline]
    pub(super) fn follow(
        &mut self,
        machine: &Machine<f32>,
        lengths: &Cylinders<f32>,
        delays: &mut Delays,
    ) -> Result<Wanted, Fault> {
        let hold = Wanted::hold(lengths);
        match self.mode {
            Mode::Done => Ok(hold),
            Mode::Hold => {
                self.tracker.check_start(self.start, lengths)?;
                self.step(machine, (0, self.start), lengths, delays)
            }
            Mode::Dig { elapsed, .. } if elapsed >= self.dig_ticks + self.preview_ticks => {
                self.mode = Mode::Done;
                Ok(hold)
            }
            Mode::Dig { elapsed, ahead } => self.step(machine, (elapsed, ahead), lengths, delays),
        }
    }

    /// One tick of the dig. The dig's own time starts when the dead time is over: until then only the feed-forward sees it.
    #[inline]
    fn step(
        &mut self,
        machine: &Machine<f32>,
        (elapsed, ahead): (u32, Cylinders<f32>),
        lengths: &Cylinders<f32>,
        delays: &mut Delays,
    ) -> Result<Wanted, Fault> {
        let dig_tick = elapsed.saturating_sub(self.preview_ticks);
        let next_ahead = machine.tip_to_cylinders(&self.dig.at_tick(elapsed + 1)).map_err(|_| Fault::Trajectory)?;
        let [boom, arm, bucket] = delays.dig(elapsed + 1, [next_ahead.boom, next_ahead.arm, next_ahead.bucket]);
        let reference = Cylinders { boom, arm, bucket };
        self.mode = Mode::Dig { elapsed: elapsed + 1, ahead: next_ahead };

        let feed_forward = for_each(next_ahead, ahead, |next, now| (next - now) * TICKS_PER_S as f32);
        let speeds = self.tracker.speeds(feed_forward, reference, lengths)?;
        Ok(Wanted { speeds, reference, dig_tick: dig_tick + 1 })
    }
}
