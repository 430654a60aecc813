//! Follows a planned move: the time scaling says where on its path, once ahead by the known dead time for the feed-forward
//! and once for the reference.

use kinematics_core::Cylinders;
use kinematics_core::planning::cylinder_path::CylinderPath;
use kinematics_core::planning::time_scaling::{Pace, TimeScaling};

use super::Wanted;
use super::tracker::Tracker;
use crate::TICKS_PER_S;
use crate::fault::Fault;
use crate::moves::{KNOTS, Move};
use crate::parameters::MotionParameters;

/// The move's follower.
#[derive(Clone, Debug)]
pub(super) struct MoveFollower {
    path: CylinderPath<f32, KNOTS>,
    scaling: TimeScaling<f32>,
    ahead: Pace<f32>,
    now: Pace<f32>,
    preview_ticks: u32,
    /// Ticks since the request; 0 before.
    elapsed: u32,
    tracker: Tracker,
}

impl MoveFollower {
    pub(super) fn new(p: &MotionParameters, planned: &Move) -> Self {
        Self {
            path: planned.path,
            scaling: planned.scaling,
            ahead: Pace::start(),
            now: Pace::start(),
            preview_ticks: (p.preview_s * TICKS_PER_S as f32 + 0.5) as u32,
            elapsed: 0,
            tracker: Tracker::new(p),
        }
    }

    /// Back to holding: the next move starts over.
    pub(super) fn reset(&mut self) {
        if self.elapsed > 0 {
            self.ahead = Pace::start();
            self.now = Pace::start();
        }
        self.elapsed = 0;
        self.tracker.reset();
    }

    /// Speeds for this tick of the move; at its end it holds.
    pub(super) fn follow(&mut self, lengths: &Cylinders<f32>) -> Result<Wanted, Fault> {
        if self.elapsed == 0 {
            self.tracker.check_start(self.path.at(0.0).lengths, lengths)?;
        }
        if self.now.progress().done {
            return Ok(Wanted::hold(lengths));
        }
        let ahead = self.scaling.advance(&mut self.ahead, 1.0);
        if self.elapsed >= self.preview_ticks {
            self.scaling.advance(&mut self.now, 1.0);
        }
        self.elapsed = self.elapsed.saturating_add(1);
        let reference = self.path.at(self.now.progress().s).lengths;
        let [boom, arm, bucket] = self.path.at(ahead.s).slope.map(|slope| slope * ahead.rate);
        let speeds = self.tracker.speeds(Cylinders { boom, arm, bucket }, reference, lengths)?;
        Ok(Wanted { speeds, reference, dig_tick: self.elapsed.saturating_sub(self.preview_ticks) })
    }
}
