//! The delay lines of the dig, of a planned move and of the coordinated modes, in one memory: only one of them runs at a time, and whichever begins starts
//! over.

use super::delay::DelayLine;
use crate::TICKS_PER_S;
use crate::parameters::MotionParameters;

/// Numbers that the cylinders' lines keep: 256 times three or 128 times six.
const OF_CYLINDERS: usize = 768;

/// Numbers that all of a mode's lines keep.
const KEPT: usize = OF_CYLINDERS + 128 * 2;

/// Values of a preview. Filled in place, in memory of its own.
#[derive(Clone, Debug)]
pub(super) struct Delays {
    /// Cylinder lengths that a dig saw ahead, until their time comes. What was computed once is not computed again.
    dig: DelayLine<3, 256>,
    /// Places ahead relative to the start, and corrections given.
    cylinders: DelayLine<6, 128>,
    swing: DelayLine<2, 128>,
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
        Self {
            dig: DelayLine::new(),
            cylinders: DelayLine::new(),
            swing: DelayLine::new(),
            planned: DelayLine::new(),
            kept: [0.0; KEPT],
        }
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
        self.cylinders.set_delay(preview_ticks);
        self.swing.set_delay(preview_ticks);
    }

    /// As [`DelayLine::pass`], of a dig.
    #[inline]
    pub(super) fn dig(&mut self, tick: u32, values: [f32; 3]) -> [f32; 3] {
        let (cylinders, _) = self.kept.split_at_mut(OF_CYLINDERS);
        self.dig.pass(cylinders.as_chunks_mut().0, tick, values)
    }

    /// As [`DelayLine::pass`], of a planned move.
    #[inline]
    pub(super) fn planned(&mut self, tick: u32, values: [f32; 1]) -> [f32; 1] {
        self.planned.pass(self.kept.as_chunks_mut().0, tick, values)
    }

    /// As [`DelayLine::pass`], of the cylinders in a coordinated mode.
    #[inline(always)]
    pub(super) fn cylinders(&mut self, tick: u32, values: [f32; 6]) -> [f32; 6] {
        let (cylinders, _) = self.kept.split_at_mut(OF_CYLINDERS);
        self.cylinders.pass(cylinders.as_chunks_mut().0, tick, values)
    }

    /// As [`DelayLine::pass`], of the swing in a coordinated mode.
    #[inline(always)]
    pub(super) fn swing(&mut self, tick: u32, values: [f32; 2]) -> [f32; 2] {
        let (_, swing) = self.kept.split_at_mut(OF_CYLINDERS);
        self.swing.pass(swing.as_chunks_mut().0, tick, values)
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
                let [cylinder, .., last] = delays.cylinders(tick, [tick as f32; 6]);
                let [swing, _] = delays.swing(tick, [tick as f32; 2]);
                assert_eq!([cylinder, last, swing], [then; 3], "{tick}");
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
