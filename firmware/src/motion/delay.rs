//! Values as they were some ticks ago, in fixed memory.

use core::num::NonZeroU32;

/// A delay of up to 1000 ticks of `N` values. Of a delay longer than what is kept every second, third, … is kept and a line drawn
/// between. `KEPT` is a power of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct DelayLine<const N: usize, const KEPT: usize> {
    /// The first at tick 0; a ring.
    kept: [[f32; N]; KEPT],
    ticks: u32,
    /// Ticks left out from one kept value to the next.
    between: u32,
}

impl<const N: usize, const KEPT: usize> DelayLine<N, KEPT> {
    /// Without delay.
    pub(super) const fn new() -> Self {
        Self { kept: [[0.0; N]; KEPT], ticks: 0, between: 0 }
    }

    pub(super) fn set_delay(&mut self, ticks: u32) {
        self.ticks = ticks;
        self.between = ticks / (KEPT as u32 - 1);
    }

    /// Takes the values of `tick`, counted from 1, one after the other, and tells the delayed ones; before the first they are 0.
    pub(super) fn pass(&mut self, tick: u32, values: [f32; N]) -> [f32; N] {
        let every = NonZeroU32::MIN.saturating_add(self.between);
        if tick % every == 0
            && let Some(kept) = self.kept.get_mut((tick / every) as usize % KEPT)
        {
            *kept = values;
        }
        let Some(then) = tick.checked_sub(self.ticks).filter(|then| *then > 0) else { return [0.0; N] };
        let (number, beyond) = (then / every, then % every);
        let kept = |number: u32| self.kept.get(number as usize % KEPT).copied().unwrap_or([0.0; N]);
        // The first place may hold a later round's values: those of tick 0 are 0.
        let mut delayed = if number == 0 { [0.0; N] } else { kept(number) };
        if beyond > 0 {
            let share = beyond as f32 / every.get() as f32;
            for (value, next) in delayed.iter_mut().zip(kept(number + 1)) {
                *value += (next - *value) * share;
            }
        }
        delayed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_delay_up_to_a_thousand_ticks_gives_back_the_value_of_then() {
        for delay in 0..=1000_u32 {
            let mut line = DelayLine::<1, 256>::new();
            line.set_delay(delay);
            for tick in 1..=2100_u32 {
                let then = tick.saturating_sub(delay) as f32;
                let [found] = line.pass(tick, [tick as f32]);
                assert!((found - then).abs() <= 1e-3, "{delay} {tick}: {found}");
            }
        }
    }

    #[test]
    fn a_line_used_before_starts_over_at_zero() {
        let mut line = DelayLine::<1, 256>::new();
        line.set_delay(300);
        for tick in 1..=1500 {
            line.pass(tick, [7.0]);
        }
        for tick in 1..=301 {
            assert!(line.pass(tick, [0.5]) <= [0.5], "{tick}");
        }
        assert_eq!(line.pass(302, [0.5]), [0.5]);
    }
}
