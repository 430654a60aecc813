//! What can be wrong with a coil, seen from its measured current and the voltage given to it.
//!
//! A healthy coil's current lies between two envelopes of its mean voltage u, whatever its temperature: `low` rises with the longest L/R
//! towards u/R_hottest and falls at once, `high` rises at once to u/R_coldest and falls with the longest L/R. Far outside them for a
//! while, it is a fault. The board is assumed to measure in the coil's return, and its high-side switch to pull the sense line to full scale
//! in overload, as smart switches do.

use core::fmt;

use serde::{Deserialize, Serialize};

use super::current_loop::LoopParameters;
use super::interlock::Side;
use super::number::{Q, Times as _, q};
use crate::TICK_S;
use crate::io::SPOOLS;
use crate::parameters::{ParameterError, ordered, within};

/// Copper's resistance against that at 20 °C, 1/K.
const COPPER_PER_K: f32 = 0.003_93;

/// What is wrong with a coil, most urgent first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CoilFault {
    /// Far more current than the voltage can drive through a whole winding.
    ShortToGround,
    /// Current, but no duty.
    ShortToSupply,
    /// Both solenoids of a spool are on, and neither is at fault alone.
    Cross,
    /// More current than allowed.
    OverCurrent,
    /// Voltage, but no current.
    Open,
    /// Full duty, and still too little current: the supply is too low or the resistance too high.
    Saturated,
}

impl CoilFault {
    /// Every fault, most urgent first.
    pub const ALL: [Self; 6] =
        [Self::ShortToGround, Self::ShortToSupply, Self::Cross, Self::OverCurrent, Self::Open, Self::Saturated];

    /// A name for logs and JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::ShortToSupply => "short_to_supply",
            Self::ShortToGround => "short_to_ground",
            Self::OverCurrent => "over_current",
            Self::Saturated => "saturated",
            Self::Cross => "cross",
        }
    }
}

/// A fault and its coil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaultyCoil {
    /// Index into [`SPOOLS`].
    pub spool: usize,
    /// Its solenoid.
    pub side: Side,
    /// What is wrong.
    pub fault: CoilFault,
}

impl FaultyCoil {
    /// As a byte, 64…111.
    pub const fn code(&self) -> u8 {
        64 + self.fault as u8 * 8 + (self.spool as u8 & 3) * 2 + self.side as u8
    }

    /// From a byte.
    pub fn from_code(code: u8) -> Option<Self> {
        let code = code.checked_sub(64)?;
        let fault = CoilFault::ALL.into_iter().find(|fault| *fault as u8 == code >> 3)?;
        let side = if code & 1 == 0 { Side::Extend } else { Side::Retract };
        Some(Self { spool: usize::from(code >> 1 & 3), side, fault })
    }
}

impl fmt::Display for FaultyCoil {
    /// Such as `boom_extend_coil_open`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let spool = SPOOLS.get(self.spool).copied().unwrap_or("unknown");
        write!(f, "{spool}_{}_coil_{}", self.side.name(), self.fault.name())
    }
}

/// When a coil counts as faulty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WatchParameters {
    /// Coldest and hottest winding, °C.
    pub winding_c: [f32; 2],
    /// Longest time constant L/R of a healthy coil, s.
    pub slowest_s: f32,
    /// Currents below this are never judged, A.
    pub floor_a: f32,
    /// Largest current allowed, A.
    pub over_current_a: f32,
    /// Ticks until an open coil is named.
    pub open_ticks: u16,
    /// Ticks until a short, an excess of current, or a cross is named.
    pub short_ticks: u16,
    /// Ticks until saturation is named.
    pub saturated_ticks: u16,
}

impl WatchParameters {
    /// For a coil with this largest current and longest L/R.
    pub fn for_coil(max_current_a: f32, slowest_s: f32) -> Self {
        Self {
            winding_c: [-40.0, 120.0],
            slowest_s,
            floor_a: 0.05 * max_current_a,
            over_current_a: 1.3 * max_current_a,
            open_ticks: 30,
            short_ticks: 6,
            saturated_ticks: 500,
        }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        let [coldest, hottest] = self.winding_c;
        within("coil_watch.winding_c", coldest.into(), [-60.0, 180.0])?;
        within("coil_watch.winding_c", hottest.into(), [-60.0, 180.0])?;
        ordered(("coil_watch.winding_c[0]", coldest.into()), ("coil_watch.winding_c[1]", hottest.into()))?;
        within("coil_watch.slowest_s", self.slowest_s.into(), [0.003, 0.5])?;
        within("coil_watch.floor_a", self.floor_a.into(), [0.005, 1.0])?;
        within("coil_watch.over_current_a", self.over_current_a.into(), [self.floor_a.into(), 10.0])?;
        // Fewer than three ticks would trip on two bad samples.
        within("coil_watch.open_ticks", self.open_ticks.into(), [3.0, 1000.0])?;
        within("coil_watch.short_ticks", self.short_ticks.into(), [3.0, 1000.0])?;
        within("coil_watch.saturated_ticks", self.saturated_ticks.into(), [3.0, 10_000.0])
    }
}

/// Ticks a suspicion has lasted; at its limit it stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Suspicion(u16);

impl Suspicion {
    /// One more tick with or without it; whether it has lasted `ticks`.
    pub(crate) fn lasts(&mut self, suspicious: bool, ticks: u16) -> bool {
        self.0 = if suspicious { self.0.saturating_add(1) } else { 0 };
        self.0 >= ticks
    }
}

/// What a coil was given from one tick to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// Duty times supply, V.
    pub volts: Q,
    /// Current asked for, A.
    pub wanted: Q,
    /// The duty was as large as it can be.
    pub at_limit: bool,
}

impl Given {
    /// Nothing.
    pub const NOTHING: Self = Self { volts: Q::ZERO, wanted: Q::ZERO, at_limit: false };
}

/// Watches one coil.
#[derive(Clone, Copy, Debug)]
pub struct CoilWatch {
    per_hottest: Q,
    per_coldest: Q,
    step: Q,
    /// What the sense line at its end reads as, A.
    full_scale: Q,
    floor: Q,
    over: Q,
    ticks: [u16; 3],
    low: Q,
    high: Q,
    open: Suspicion,
    /// Excess in ticks with a duty, and in ticks without; each waits while the other kind of tick goes by.
    driven_excess: Suspicion,
    idle_excess: Suspicion,
    over_current: Suspicion,
    saturated: Suspicion,
    /// Envelopes and suspicions are all at zero.
    quiet: bool,
}

impl CoilWatch {
    /// From valid parameters; a measured current of `full_scale_a` or more is a switch in overload.
    pub fn new(parameters: &WatchParameters, coil: &LoopParameters, full_scale_a: f32) -> Self {
        let p = parameters;
        let [coldest, hottest] = p.winding_c;
        let conductance = |winding_c: f32| q(1.0 / (coil.resistance_ohm * (1.0 + COPPER_PER_K * (winding_c - 20.0))));
        Self {
            per_hottest: conductance(hottest),
            per_coldest: conductance(coldest),
            step: q(TICK_S / p.slowest_s),
            full_scale: q(full_scale_a),
            floor: q(p.floor_a),
            over: q(p.over_current_a),
            ticks: [p.open_ticks, p.short_ticks, p.saturated_ticks],
            low: Q::ZERO,
            high: Q::ZERO,
            open: Suspicion::default(),
            driven_excess: Suspicion::default(),
            idle_excess: Suspicion::default(),
            over_current: Suspicion::default(),
            saturated: Suspicion::default(),
            quiet: true,
        }
    }

    /// One tick: what the coil was given since the last one, and its current now.
    pub fn judge(&mut self, given: &Given, measured: Q) -> Option<CoilFault> {
        // Most coils are off most of the time: nothing below would change.
        if self.quiet && *given == Given::NOTHING && measured <= self.floor {
            return None;
        }
        self.follow(given.volts);
        let [open_ticks, short_ticks, saturated_ticks] = self.ticks;
        let driven = given.volts > Q::ZERO;

        // Half as much again as the coldest coil could carry: ripple and a supply read at the wrong moment are far less.
        let allowed = self.high.saturating_add(Q::from_bits(self.high.to_bits() >> 1)).saturating_add(self.floor);
        let excess = measured > allowed || measured >= self.full_scale;
        let (this, other) = if driven {
            (&mut self.driven_excess, CoilFault::ShortToGround)
        } else {
            (&mut self.idle_excess, CoilFault::ShortToSupply)
        };
        let short = this.lasts(excess, short_ticks).then_some(other);
        let over = self.over_current.lasts(measured > self.over && !excess, short_ticks);
        // A third of what the hottest coil would carry: the freewheel's drop takes less.
        let missing = self.low > self.floor && measured.saturating_mul_int(3) < self.low;
        let open = self.open.lasts(missing, open_ticks);
        let short_of = Q::from_bits(given.wanted.to_bits() >> 3);
        let too_little = given.at_limit && measured < given.wanted.saturating_sub(short_of);
        let saturated = self.saturated.lasts(too_little, saturated_ticks);

        let suspicions = [self.open, self.driven_excess, self.idle_excess, self.over_current, self.saturated];
        self.quiet = self.low == Q::ZERO && self.high == Q::ZERO && suspicions == [Suspicion::default(); 5];
        short
            .or(over.then_some(CoilFault::OverCurrent))
            .or(open.then_some(CoilFault::Open))
            .or(saturated.then_some(CoilFault::Saturated))
    }

    /// Both envelopes, one tick on.
    fn follow(&mut self, volts: Q) {
        if volts == Q::ZERO && self.low == Q::ZERO && self.high == Q::ZERO {
            return;
        }
        let hot = volts.times(self.per_hottest);
        let cold = volts.times(self.per_coldest);
        self.low = if hot > self.low { self.nearer(self.low, hot) } else { hot };
        self.high = if cold < self.high { self.nearer(self.high, cold) } else { cold };
    }

    fn nearer(&self, from: Q, to: Q) -> Q {
        from.saturating_add(to.saturating_sub(from).times(self.step))
    }
}
