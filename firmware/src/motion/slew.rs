//! No speed jumps: whatever a mode asks for, and whichever mode follows it, speeds change by the acceleration limits.

use crate::io::{Speeds, limited};
use crate::{TICK_S, law::LawParameters};

/// The last speeds, and how much each may change in a tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slew {
    steps: [f32; 4],
    speeds: [f32; 4],
}

impl Slew {
    pub(super) fn new(p: &LawParameters) -> Self {
        Self { steps: p.acceleration.map(|acceleration| acceleration * TICK_S), speeds: [0.0; 4] }
    }

    /// Everything stands still.
    pub(super) fn reset(&mut self) {
        self.speeds = [0.0; 4];
    }

    /// The speeds given last: swing, boom, arm, bucket.
    #[inline]
    pub(super) fn speeds(&self) -> [f32; 4] {
        self.speeds
    }

    #[inline]
    pub(super) fn pass(&mut self, wanted: Speeds) -> Speeds {
        for ((speed, wanted), step) in self.speeds.iter_mut().zip(wanted.to_array()).zip(self.steps) {
            *speed = limited(wanted, *speed - step, *speed + step);
        }
        Speeds::from_array(self.speeds)
    }
}
