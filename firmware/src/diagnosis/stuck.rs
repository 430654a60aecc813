//! A sensor that does not follow: told from a stall by its lost noise, or by the pressure of the driven side where no other actuator
//! takes its oil.

use super::{OUTSIDE_ROUNDS, QUIET_ROUNDS, ROUND_S};

/// One actuator's limits.
#[derive(Clone, Copy, Debug)]
pub(super) struct StuckLimits {
    /// Predicted travel after which the sensor must have followed.
    pub(super) travel: f32,
    /// The sensor's noise is known and wide enough for its loss to be seen.
    pub(super) noisy: bool,
    /// A slower motion may hide in the dead band.
    pub(super) creep: f32,
    /// Beyond these codes a stop or its cushion may hold it.
    pub(super) stops: [u16; 2],
}

impl StuckLimits {
    /// At this code a stop or its cushion may hold it.
    #[inline(always)]
    pub(super) fn near_stop(&self, code: u16) -> bool {
        let [first, last] = self.stops;
        code < first || code > last
    }
}

/// Pressures of a driven side that move an actuator without stalling it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Free {
    pub(super) supplied_pa: f32,
    pub(super) stalled_pa: f32,
}

/// Head and rod side, as far as they are known, Pa.
pub(super) type Sides<'a> = Option<&'a [Option<f32>; 2]>;

/// What is followed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stuck {
    /// Rounds without a change of the code.
    quiet: u8,
    /// Predicted travel in them.
    quiet_travel: f32,
    /// Code from which travel is counted.
    from: u16,
    /// Predicted travel since.
    travel: f32,
    /// Rounds in which the pressure said that nothing holds it back.
    free: u8,
}

#[inline]
fn far(x: f32, limit: f32) -> bool {
    x >= limit || x <= -limit
}

impl Stuck {
    /// One round: the model's `sure` speed, the sensor's code, its change, and a code's worth of travel. Whether it is stuck.
    #[inline(always)]
    pub(super) fn follow(
        &mut self,
        limits: &StuckLimits,
        sure: f32,
        codes: [u16; 2],
        unit: f32,
        (free, sides): (Free, Sides<'_>),
    ) -> bool {
        let [before, code] = codes;
        let ahead = sure * ROUND_S;
        if before == code {
            self.quiet = self.quiet.saturating_add(1);
            self.quiet_travel += if ahead > 0.0 { ahead } else { -ahead };
        } else {
            (self.quiet, self.quiet_travel) = (0, 0.0);
        }
        let silent = limits.noisy && self.quiet >= QUIET_ROUNDS && self.quiet_travel >= limits.travel;
        let moved = f32::from(code.wrapping_sub(self.from).cast_signed()) * unit;
        // A fifth of the travel is movement, well above noise.
        if !far(sure, limits.creep) || far(5.0 * moved, limits.travel) {
            (self.from, self.travel, self.free) = (code, 0.0, 0);
            return silent;
        }
        self.travel += ahead;
        silent || (!limits.near_stop(code) && far(self.travel, limits.travel) && self.stands_free(sure, free, sides))
    }

    /// Standing though nothing holds it back, long enough. Not inlined: it is for faults and stalls.
    #[inline(never)]
    fn stands_free(&mut self, sure: f32, free: Free, sides: Sides<'_>) -> bool {
        let driven = sides.and_then(|[head, rod]| if sure > 0.0 { *head } else { *rod });
        let moves = driven.is_some_and(|pressure| pressure >= free.supplied_pa && pressure < free.stalled_pa);
        self.free = if moves { self.free.saturating_add(1) } else { 0 };
        self.free >= OUTSIDE_ROUNDS
    }
}
