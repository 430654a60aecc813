//! Sees what is wrong with a coil, from its measured current and the voltage given to it.
//!
//! A healthy coil's current lies between two envelopes of its mean voltage u, whatever its temperature: `low` rises with the longest L/R
//! towards u/R_hottest and falls at once, `high` rises at once to u/R_coldest and falls with the longest L/R. Far outside them for a
//! while, it is a fault. The board is assumed to measure in the coil's return, and its high-side switch to pull the sense line to full scale
//! in overload, as smart switches do.

use super::coil_fault::{CoilFault, WatchParameters};
use super::current_loop::LoopParameters;
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
    /// The duty was as large as it can be.
    pub at_limit: bool,
}

impl Given {
    /// Nothing.
    pub const NOTHING: Self = Self { volts: 0.0, wanted_a: 0.0, at_limit: false };
}

/// What all the watches compare with.
#[derive(Clone, Copy, Debug)]
pub struct WatchLimits {
    per_hottest_ohm: f32,
    per_coldest_ohm: f32,
    /// Share of the way that an envelope goes in a tick.
    step: f32,
    /// What the sense line at its end reads as, A.
    full_scale_a: f32,
    floor_a: f32,
    over_a: f32,
    /// An upper envelope below this is none, A: a 64th of the floor beside which it is added.
    forgotten_a: f32,
    open_ticks: u16,
    short_ticks: u16,
    saturated_ticks: u16,
}

impl WatchLimits {
    /// From valid parameters; a measured current of `full_scale_a` or more is a switch in overload.
    pub fn new(parameters: &WatchParameters, coil: &LoopParameters, full_scale_a: f32) -> Self {
        let p = parameters;
        let [coldest, hottest] = p.winding_c;
        let per_ohm = |winding_c: f32| 1.0 / (coil.resistance_ohm * (1.0 + COPPER_PER_K * (winding_c - 20.0)));
        Self {
            per_hottest_ohm: per_ohm(hottest),
            per_coldest_ohm: per_ohm(coldest),
            step: TICK_S / p.slowest_s,
            full_scale_a,
            floor_a: p.floor_a,
            over_a: p.over_current_a,
            forgotten_a: p.floor_a / 64.0,
            open_ticks: p.open_ticks,
            short_ticks: p.short_ticks,
            saturated_ticks: p.saturated_ticks,
        }
    }
}

/// What the measured current of a tick looks like.
struct Signs {
    driven: bool,
    excess: bool,
    over: bool,
    missing: bool,
    too_little: bool,
}

/// Watches one coil.
#[derive(Clone, Copy, Debug)]
pub struct CoilWatch {
    low_a: f32,
    high_a: f32,
    open: Suspicion,
    /// Excess in ticks with a duty, and in ticks without; each waits while the other kind of tick goes by.
    driven_excess: Suspicion,
    idle_excess: Suspicion,
    over_current: Suspicion,
    saturated: Suspicion,
    /// One of the suspicions is not zero.
    suspicious: bool,
    /// Envelopes and suspicions are all at zero.
    quiet: bool,
}

impl Default for CoilWatch {
    fn default() -> Self {
        Self {
            low_a: 0.0,
            high_a: 0.0,
            open: Suspicion::default(),
            driven_excess: Suspicion::default(),
            idle_excess: Suspicion::default(),
            over_current: Suspicion::default(),
            saturated: Suspicion::default(),
            suspicious: false,
            quiet: true,
        }
    }
}

impl CoilWatch {
    /// Without voltage and with no more than the floor's current, nothing would change.
    #[inline(always)]
    pub(super) fn quiet(&self) -> bool {
        self.quiet
    }

    /// One tick: what the coil was given since the last one, and its current now, A.
    #[inline(always)]
    pub fn judge(&mut self, limits: &WatchLimits, given: &Given, measured_a: f32) -> Option<CoilFault> {
        // Most coils are off most of the time.
        if self.quiet && given.volts <= 0.0 && measured_a <= limits.floor_a {
            return None;
        }
        self.follow(limits, given.volts);
        // Half as much again as the coldest coil could carry: ripple and a supply read at the wrong moment are far less.
        let excess = measured_a > 1.5 * self.high_a + limits.floor_a || measured_a >= limits.full_scale_a;
        let signs = Signs {
            driven: given.volts > 0.0,
            excess,
            over: measured_a > limits.over_a && !excess,
            // A third of what the hottest coil would carry: the freewheel's drop takes less.
            missing: self.low_a > limits.floor_a && 3.0 * measured_a < self.low_a,
            too_little: given.at_limit && measured_a < 0.875 * given.wanted_a,
        };
        if signs.excess || signs.over || signs.missing || signs.too_little || self.suspicious {
            return self.count(limits, &signs);
        }
        self.quiet = self.high_a <= 0.0 && self.low_a <= 0.0;
        None
    }

    /// [`Self::judge`] for a coil that was given nothing.
    #[inline(always)]
    pub(super) fn judge_idle(&mut self, limits: &WatchLimits, measured_a: f32) -> Option<CoilFault> {
        if self.quiet && measured_a <= limits.floor_a { None } else { self.judge_dying(limits, measured_a) }
    }

    /// Not inlined: a coil is seldom off and not yet quiet.
    #[inline(never)]
    fn judge_dying(&mut self, limits: &WatchLimits, measured_a: f32) -> Option<CoilFault> {
        self.judge(limits, &Given::NOTHING, measured_a)
    }

    /// How long each sign has been there. Not inlined: a healthy coil shows none.
    #[inline(never)]
    fn count(&mut self, limits: &WatchLimits, signs: &Signs) -> Option<CoilFault> {
        let (this, other) = if signs.driven {
            (&mut self.driven_excess, CoilFault::ShortToGround)
        } else {
            (&mut self.idle_excess, CoilFault::ShortToSupply)
        };
        let short = this.lasts(signs.excess, limits.short_ticks).then_some(other);
        let over = self.over_current.lasts(signs.over, limits.short_ticks);
        let open = self.open.lasts(signs.missing, limits.open_ticks);
        let saturated = self.saturated.lasts(signs.too_little, limits.saturated_ticks);

        let all = [self.open, self.driven_excess, self.idle_excess, self.over_current, self.saturated];
        self.suspicious = !all.into_iter().all(Suspicion::none);
        self.quiet = !self.suspicious && self.high_a <= 0.0 && self.low_a <= 0.0;
        short
            .or(over.then_some(CoilFault::OverCurrent))
            .or(open.then_some(CoilFault::Open))
            .or(saturated.then_some(CoilFault::Saturated))
    }

    /// Both envelopes, one tick on.
    #[inline(always)]
    fn follow(&mut self, limits: &WatchLimits, volts: f32) {
        let hot = volts * limits.per_hottest_ohm;
        let cold = volts * limits.per_coldest_ohm;
        self.low_a = if hot > self.low_a { self.low_a + (hot - self.low_a) * limits.step } else { hot };
        let high = if cold < self.high_a { self.high_a + (cold - self.high_a) * limits.step } else { cold };
        self.high_a = if high < limits.forgotten_a { 0.0 } else { high };
    }
}
