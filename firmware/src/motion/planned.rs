//! Follows a planned move: the time scaling says where on its path, ahead by the known dead time, for the feed-forward; the
//! reference is where that was a dead time ago.

use kinematics_core::planning::time_scaling::Pace;
use kinematics_core::{Cylinders, Machine};

use super::Wanted;
use super::delays::{Delays, preview_ticks};
use super::tracker::Tracker;
use crate::TICK;
use crate::fault::Fault;
use crate::moves::{Move, MoveError, MoveParameters};
use crate::parameters::MotionParameters;

/// The move's follower: about 7 KiB that are filled in place.
#[derive(Clone, Debug)]
pub(super) struct MoveFollower {
    planned: Move,
    ahead: Pace<f32>,
    preview_ticks: u32,
    /// Ticks since the request; 0 before.
    elapsed: u32,
    /// Ticks since `ahead` came to rest on the end; 0 before.
    rested: u32,
    tracker: Tracker,
}

impl MoveFollower {
    /// Without a move.
    pub(super) const fn new() -> Self {
        Self {
            planned: Move::unplanned(),
            ahead: Pace::start(),
            preview_ticks: 0,
            elapsed: 0,
            rested: 0,
            tracker: Tracker::IDLE,
        }
    }

    /// Plans the move.
    pub(super) fn plan(
        &mut self,
        p: &MotionParameters,
        machine: &Machine<f32>,
        planned: &MoveParameters,
        delays: &mut Delays,
    ) -> Result<(), MoveError> {
        self.planned.plan(machine, planned, TICK)?;
        self.preview_ticks = preview_ticks(p);
        delays.set_move(self.preview_ticks);
        self.tracker = Tracker::new(p);
        Ok(())
    }

    /// Back to holding: the next move starts over.
    #[inline(never)]
    pub(super) fn reset(&mut self) {
        if self.elapsed > 0 {
            self.ahead = Pace::start();
        }
        (self.elapsed, self.rested) = (0, 0);
        self.tracker.reset();
    }

    /// Speeds for this tick of the move; at its end it holds.
    #[inline]
    pub(super) fn follow(&mut self, lengths: &Cylinders<f32>, delays: &mut Delays) -> Result<Wanted, Fault> {
        let path = self.planned.path.as_ref().ok_or(Fault::NotConfigured)?;
        if self.elapsed == 0 {
            self.tracker.check_start(path.at(0.0).lengths, lengths)?;
        }
        if self.rested > self.preview_ticks {
            return Ok(Wanted::hold(lengths));
        }
        let ahead = self.planned.scaling.advance(&mut self.ahead, 1.0);
        if ahead.done {
            self.rested += 1;
        }
        self.elapsed = self.elapsed.saturating_add(1);
        let [then] = delays.planned(self.elapsed, [ahead.s]);
        let reference = path.at(then).lengths;
        let [boom, arm, bucket] = path.at(ahead.s).slope.map(|slope| slope * ahead.rate);
        let speeds = self.tracker.speeds(Cylinders { boom, arm, bucket }, reference, lengths)?;
        Ok(Wanted { speeds, reference, dig_tick: self.elapsed.saturating_sub(self.preview_ticks) })
    }
}
