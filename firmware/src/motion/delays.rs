//! The delay lines of the dig, of a planned move and of the coordinated modes, in one memory: only one of them runs at a time, and whichever begins starts
//! over.

use super::delay::DelayLine;
use crate::TICKS_PER_S;
use crate::parameters::MotionParameters;

/// Numbers that the lines keep: 128 times eight or 256 times three.
const KEPT: usize = 128 * 8;

/// Values of a preview. Filled in place, in memory of its own.
#[derive(Clone, Debug)]
pub(super) struct Delays {
    /// Cylinder lengths that a dig saw ahead, until their time comes. What was computed once is not computed again.
    dig: DelayLine<3, 256>,
    /// Places ahead relative to the start, and corrections given, of cylinders and swing: one line, so that when is told once for all.
    modes: DelayLine<8, 128>,
    /// How far a planned move is.
    planned: DelayLine<1, 256>,
    kept: [f32; KEPT],
}

/// The preview, ticks.
pub(super) fn preview_ticks(motion: &MotionParameters) -> u32 {
    (motion.preview_s * TICKS_PER_S as f32 + 0.5) as u32
}

impl Delays {
    /// Of nothing.
    pub(super) const fn new() -> Self {
        Self { dig: DelayLine::new(), modes: DelayLine::new(), planned: DelayLine::new(), kept: [0.0; KEPT] }
    }

    /// For a dig that begins at `start`.
    pub(super) fn set_dig(&mut self, preview_ticks: u32, start: [f32; 3]) {
        self.dig.set_delay(preview_ticks + 1);
        self.dig.set_origin(start);
    }

    /// For a planned move.
    pub(super) fn set_move(&mut self, preview_ticks: u32) {
        self.planned.set_delay(preview_ticks);
    }

    /// For the coordinated modes.
    pub(super) fn set_modes(&mut self, preview_ticks: u32) {
        self.modes.set_delay(preview_ticks);
    }

    /// As [`DelayLine::pass`], of a dig.
    pub(super) fn dig(&mut self, tick: u32, values: [f32; 3]) -> [f32; 3] {
        self.dig.pass(self.kept.as_chunks_mut().0, tick, values)
    }

    /// As [`DelayLine::pass`], of a planned move.
    pub(super) fn planned(&mut self, tick: u32, values: [f32; 1]) -> [f32; 1] {
        self.planned.pass(self.kept.as_chunks_mut().0, tick, values)
    }

    /// As [`DelayLine::pass`], of a coordinated mode.
    #[inline(always)]
    pub(super) fn modes(&mut self, tick: u32, values: [f32; 8]) -> [f32; 8] {
        self.modes.pass(self.kept.as_chunks_mut().0, tick, values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_move_and_dig_one_after_the_other_see_nothing_of_each_other() {
        let mut delays = Delays::new();
        delays.set_modes(150);
        delays.set_dig(150, [1.0; 3]);
        delays.set_move(150);
        for _ in 0..2 {
            for tick in 1..=700 {
                let then = if tick > 150 { (tick - 150) as f32 } else { 0.0 };
                assert_eq!(delays.modes(tick, [tick as f32; 8]), [then; 8], "{tick}");
            }
            for tick in 1..=700 {
                let then = if tick > 150 { (tick - 150) as f32 } else { 0.0 };
                assert_eq!(delays.planned(tick, [tick as f32]), [then], "{tick}");
            }
            for tick in 1..=700 {
                let then = if tick > 151 { -((tick - 151) as f32) } else { 1.0 };
                assert_eq!(delays.dig(tick, [-(tick as f32); 3]), [then; 3], "{tick}");
            }
        }
    }
}
