//! Sees what is wrong with a coil, from its measured current and the voltage given to it.
//!
//! A healthy coil's current lies between two envelopes of its mean voltage u, whatever its temperature: the lower rises with the longest L/R
//! towards u/R_hottest and falls at once, the upper rises at once to u/R_coldest and falls with the longest L/R. Far outside them for a
//! while, it is a fault. The board is assumed to measure in the coil's return, and its high-side switch to pull the sense line to full scale
//! in overload, as smart switches do.

use super::coil_fault::{CoilFault, WatchParameters};
use super::current_loop::LoopParameters;
use super::number::duty_code;
use crate::TICK_S;

/// Copper's resistance against that at 20 °C, 1/K.
const COPPER_PER_K: f32 = 0.003_93;

/// Ticks a suspicion has lasted; at its limit it stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Suspicion(u16);

impl Suspicion {
    /// One more tick with or without it; whether it has lasted `ticks`.
    #[inline(always)]
    pub(crate) fn lasts(&mut self, suspicious: bool, ticks: u16) -> bool {
        self.0 = if suspicious { self.0.saturating_add(1) } else { 0 };
        self.0 >= ticks
    }

    /// Nothing is suspected.
    #[inline(always)]
    pub(crate) fn none(self) -> bool {
        self.0 == 0
    }
}

/// What a coil was given from one tick to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// Duty times supply, V.
    pub volts: f32,
    /// Current asked for, A.
    pub wanted_a: f32,
    /// The timer's compare value.
    pub duty: u16,
}

impl Given {
    /// Nothing.
    pub const NOTHING: Self = Self { volts: 0.0, wanted_a: 0.0, duty: 0 };
}

/// What all the watches compare with.
#[derive(Clone, Copy, Debug)]
pub struct WatchLimits {
    /// Share of the way that an envelope goes in a tick.
    step: f32,
    /// Half as much again as the coldest coil carries: ripple and a supply read at the wrong moment are far less. A/V.
    allowed_per_volt: f32,
    floor_a: f32,
    /// At or above this a current is too large, or the line at its end, A.
    alert_a: f32,
    /// A third of what the hottest coil carries: the freewheel's drop takes less. V/A.
    missing_ohm: f32,
    /// The largest duty, less a hair that rounding may take.
    limit_duty: u16,
    open_ticks: u16,
    short_ticks: u16,
    saturated_ticks: u16,
    over_a: f32,
    /// What the sense line at its end reads as, A.
    full_scale_a: f32,
    /// The hottest coil's voltage at the floor.
    floor_v: f32,
    /// An upper envelope below this is none, V: a 64th of the floor beside which it stands.
    forgotten_v: f32,
}

impl WatchLimits {
    /// From valid parameters; a measured current of `full_scale_a` or more is a switch in overload.
    pub fn new(parameters: &WatchParameters, coil: &LoopParameters, full_scale_a: f32) -> Self {
        let p = parameters;
        let ohm = p.winding_c.map(|winding_c| coil.resistance_ohm * (1.0 + COPPER_PER_K * (winding_c - 20.0)));
        let [coldest_ohm, hottest_ohm] = ohm;
        Self {
            step: TICK_S / p.slowest_s,
            allowed_per_volt: 1.5 / coldest_ohm,
            floor_a: p.floor_a,
            alert_a: if p.over_current_a < full_scale_a { p.over_current_a } else { full_scale_a },
            missing_ohm: 3.0 * hottest_ohm,
            limit_duty: duty_code(coil.max_duty - 0.001),
            open_ticks: p.open_ticks,
            short_ticks: p.short_ticks,
            saturated_ticks: p.saturated_ticks,
            over_a: p.over_current_a,
            full_scale_a,
            floor_v: p.floor_a * hottest_ohm,
            forgotten_v: p.floor_a * coldest_ohm / 64.0,
        }
    }
}

/// Watches one coil. Its envelopes are those of the current, times the resistance they belong to.
#[derive(Clone, Copy, Debug)]
pub struct CoilWatch {
    low_v: f32,
    high_v: f32,
    /// One of the suspicions is not zero.
    suspicious: bool,
    /// Envelopes and suspicions are all at zero.
    quiet: bool,
    open: Suspicion,
    /// Excess in ticks with a duty, and in ticks without; each waits while the other kind of tick goes by.
    driven_excess: Suspicion,
    idle_excess: Suspicion,
    over_current: Suspicion,
    saturated: Suspicion,
}

impl Default for CoilWatch {
    fn default() -> Self {
        Self {
            low_v: 0.0,
            high_v: 0.0,
            suspicious: false,
            quiet: true,
            open: Suspicion::default(),
            driven_excess: Suspicion::default(),
            idle_excess: Suspicion::default(),
            over_current: Suspicion::default(),
            saturated: Suspicion::default(),
        }
    }
}

impl CoilWatch {
    /// Without voltage and with no more than the floor's current, nothing would change.
    #[inline(always)]
    pub(super) fn quiet(&self) -> bool {
        self.quiet
    }

    /// The coil will be given something.
    #[inline]
    pub(super) fn wake(&mut self) {
        self.quiet = false;
    }

    /// One tick: what the coil was given since the last one, and its current now, A.
    #[inline(always)]
    pub fn judge(&mut self, limits: &WatchLimits, given: &Given, measured_a: f32) -> Option<CoilFault> {
        let (rise, fall) = (given.volts - self.low_v, given.volts - self.high_v);
        self.low_v = if rise > 0.0 { self.low_v + rise * limits.step } else { given.volts };
        self.high_v = if fall < 0.0 { self.high_v + fall * limits.step } else { given.volts };
        // Every sign of a fault is behind one of these.
        if measured_a > limits.allowed_per_volt * self.high_v + limits.floor_a
            || measured_a >= limits.alert_a
            || (limits.missing_ohm * measured_a < self.low_v && self.low_v > limits.floor_v)
            || given.duty >= limits.limit_duty
            || self.suspicious
        {
            return self.count(limits, given, measured_a);
        }
        None
    }

    /// [`Self::judge`] for a coil that was given nothing.
    #[inline(always)]
    pub(super) fn judge_idle(&mut self, limits: &WatchLimits, measured_a: f32) -> Option<CoilFault> {
        if self.quiet && measured_a <= limits.floor_a {
            return None;
        }
        // What is left of `judge` without voltage and duty: the lower envelope, never below zero, falls to it at once.
        self.low_v = 0.0;
        self.high_v = if self.high_v > 0.0 { self.high_v - self.high_v * limits.step } else { 0.0 };
        let fault = if measured_a > limits.allowed_per_volt * self.high_v + limits.floor_a
            || measured_a >= limits.alert_a
            || self.suspicious
        {
            self.count(limits, &Given::NOTHING, measured_a)
        } else {
            None
        };
        if self.high_v < limits.forgotten_v {
            self.high_v = 0.0;
        }
        self.quiet = !self.suspicious && self.high_v <= 0.0;
        fault
    }

    /// How long each sign has been there.
    #[inline]
    fn count(&mut self, limits: &WatchLimits, given: &Given, measured_a: f32) -> Option<CoilFault> {
        let excess =
            measured_a > limits.allowed_per_volt * self.high_v + limits.floor_a || measured_a >= limits.full_scale_a;
        let (this, other) = if given.volts > 0.0 {
            (&mut self.driven_excess, CoilFault::ShortToGround)
        } else {
            (&mut self.idle_excess, CoilFault::ShortToSupply)
        };
        let short = this.lasts(excess, limits.short_ticks).then_some(other);
        let over = self.over_current.lasts(measured_a > limits.over_a && !excess, limits.short_ticks);
        let missing = self.low_v > limits.floor_v && limits.missing_ohm * measured_a < self.low_v;
        let open = self.open.lasts(missing, limits.open_ticks);
        let too_little = given.duty >= limits.limit_duty && measured_a < 0.875 * given.wanted_a;
        let saturated = self.saturated.lasts(too_little, limits.saturated_ticks);

        let all = [self.open, self.driven_excess, self.idle_excess, self.over_current, self.saturated];
        self.suspicious = !all.into_iter().all(Suspicion::none);
        short
            .or(over.then_some(CoilFault::OverCurrent))
            .or(open.then_some(CoilFault::Open))
            .or(saturated.then_some(CoilFault::Saturated))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bits(watch: &CoilWatch) -> ([u32; 2], [bool; 2], [Suspicion; 5]) {
        let CoilWatch { low_v, high_v, suspicious, quiet, open, driven_excess, idle_excess, over_current, saturated } =
            *watch;
        let counts = [open, driven_excess, idle_excess, over_current, saturated];
        ([low_v, high_v].map(f32::to_bits), [suspicious, quiet], counts)
    }

    #[test]
    fn a_coil_given_nothing_is_judged_as_by_the_whole_of_it() {
        let coil = LoopParameters::tuned(5.0, 0.1, 0.005);
        let limits = WatchLimits::new(&WatchParameters::for_coil(1.5, 0.03), &coil, 3.0);
        let (mut short, mut random) = (CoilWatch::default(), 1_u32);
        let mut share = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 8) as f32 / 16_777_216.0
        };
        let mut named = 0;
        for round in 0..4000 {
            if round % 40 == 0 {
                short.wake();
                for _ in 0..20 {
                    let given = Given { volts: 24.0 * share(), wanted_a: 1.0, duty: 30_000 };
                    short.judge(&limits, &given, 1.5 * share());
                }
            }
            // Mostly dying away, now and then a current that must not be.
            let measured_a = if round / 200 % 3 == 0 { 2.0 + share() } else { 0.05 * share() - 0.01 };
            let mut whole = short;
            let expected = if whole.quiet && measured_a <= limits.floor_a {
                None
            } else {
                let fault = whole.judge(&limits, &Given::NOTHING, measured_a);
                if whole.high_v < limits.forgotten_v {
                    whole.high_v = 0.0;
                }
                whole.quiet = !whole.suspicious && whole.high_v <= 0.0 && whole.low_v <= 0.0;
                fault
            };
            assert_eq!(short.judge_idle(&limits, measured_a), expected, "{round}");
            assert_eq!(bits(&short), bits(&whole), "{round}");
            named += u32::from(expected.is_some());
        }
        assert!(named > 100, "{named}");
    }
}
