//! Values as they were some ticks ago, in memory that is lent.

use core::num::NonZeroU32;

/// A delay of up to 1001 ticks of `N` values at once. Of a delay longer than what is kept every second, third, … is kept and a line
/// drawn between. `KEPT`, places to keep them in, is a power of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct DelayLine<const N: usize, const KEPT: usize> {
    /// At tick 0 and before.
    origin: [f32; N],
    ticks: u32,
    /// Ticks left out from one kept value to the next.
    between: u32,
}

impl<const N: usize, const KEPT: usize> DelayLine<N, KEPT> {
    /// Without delay.
    pub(super) const fn new() -> Self {
        Self { origin: [0.0; N], ticks: 0, between: 0 }
    }

    pub(super) fn set_delay(&mut self, ticks: u32) {
        self.ticks = ticks;
        self.between = ticks / (KEPT as u32 - 1);
    }

    /// What the values are at tick 0 and before; 0 unless set.
    pub(super) fn set_origin(&mut self, origin: [f32; N]) {
        self.origin = origin;
    }

    /// Takes the values of `tick`, counted from 1, one after the other, and tells the delayed ones. `memory` is a ring, tick 0 first, and
    /// nobody else's as long as ticks are counted on.
    #[inline]
    pub(super) fn pass(&self, memory: &mut [[f32; N]], tick: u32, values: [f32; N]) -> [f32; N] {
        let every = NonZeroU32::MIN.saturating_add(self.between);
        if tick % every == 0
            && let Some(kept) = memory.get_mut((tick / every) as usize % KEPT)
        {
            *kept = values;
        }
        let Some(then) = tick.checked_sub(self.ticks).filter(|then| *then > 0) else { return self.origin };
        let (number, beyond) = (then / every, then % every);
        let kept = |number: u32| memory.get(number as usize % KEPT).unwrap_or(&self.origin);
        // The first place may hold a later round's values.
        let mut told = if number == 0 { self.origin } else { *kept(number) };
        if beyond > 0 {
            let part = beyond as f32 / every.get() as f32;
            for (told, after) in told.iter_mut().zip(kept(number + 1)) {
                *told += (*after - *told) * part;
            }
        }
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_delay_up_to_a_thousand_ticks_gives_back_the_value_of_then() {
        for delay in 0..=1001_u32 {
            let (mut line, mut memory) = (DelayLine::<_, 256>::new(), [[0.0; 2]; 256]);
            line.set_delay(delay);
            for tick in 1..=2100_u32 {
                let then = tick.saturating_sub(delay) as f32;
                let [found, back] = line.pass(&mut memory, tick, [tick as f32, -(tick as f32)]);
                assert_eq!(found, -back);
                assert!((found - then).abs() <= 1e-3, "{delay} {tick}: {found}");
            }
        }
    }

    #[test]
    fn a_line_used_before_starts_over_at_its_origin() {
        let (mut line, mut memory) = (DelayLine::<_, 256>::new(), [[0.0]; 256]);
        line.set_delay(300);
        for tick in 1..=1500 {
            line.pass(&mut memory, tick, [7.0]);
        }
        line.set_origin([0.25]);
        for tick in 1..=301 {
            let [found] = line.pass(&mut memory, tick, [0.5]);
            assert!((0.25..=0.5).contains(&found), "{tick}");
        }
        assert_eq!(line.pass(&mut memory, 302, [0.5]), [0.5]);
    }
}
