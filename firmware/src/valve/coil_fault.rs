//! What can be wrong with a coil, and when it counts as wrong. [`super::coil_watch`] sees it.

use core::fmt;

use serde::{Deserialize, Serialize};

use super::interlock::Side;
use crate::io::{SPOOLS, Solenoids};
use crate::parameters::{ParameterError, ordered, within};

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

/// The names of one coil's faults, in the order of [`CoilFault::ALL`].
macro_rules! names {
    ($coil:literal) => {
        [
            concat!($coil, "_coil_short_to_ground"),
            concat!($coil, "_coil_short_to_supply"),
            concat!($coil, "_coil_cross"),
            concat!($coil, "_coil_over_current"),
            concat!($coil, "_coil_open"),
            concat!($coil, "_coil_saturated"),
        ]
    };
}

/// By spool, side and fault.
const NAMES: [Solenoids<[&str; CoilFault::ALL.len()]>; SPOOLS.len()] = [
    [names!("swing_extend"), names!("swing_retract")],
    [names!("boom_extend"), names!("boom_retract")],
    [names!("arm_extend"), names!("arm_retract")],
    [names!("bucket_extend"), names!("bucket_retract")],
];

impl FaultyCoil {
    /// Every fault of every coil, by their codes.
    pub const ALL: [Self; CoilFault::ALL.len() * SPOOLS.len() * 2] = {
        let first = Self { spool: 0, side: Side::Extend, fault: CoilFault::ShortToGround };
        let mut all = [first; CoilFault::ALL.len() * SPOOLS.len() * 2];
        let mut at = 0;
        while at < all.len() {
            all[at] = Self { spool: at / 2 % SPOOLS.len(), side: Side::BOTH[at % 2], fault: CoilFault::ALL[at / 8] };
            at += 1;
        }
        all
    };

    /// As a byte, 64…111.
    pub const fn code(&self) -> u8 {
        64 + self.fault as u8 * 8 + (self.spool as u8 & 3) * 2 + self.side as u8
    }

    /// From a byte.
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|coil| coil.code() == code)
    }

    /// Such as `boom_extend_coil_open`.
    pub const fn name(&self) -> &'static str {
        NAMES[self.spool & 3][self.side as usize][self.fault as usize]
    }

    /// Its coil's place among all coils, 0…7.
    pub const fn coil(&self) -> u32 {
        (self.spool as u32 & 3) * 2 + self.side as u32
    }
}

impl fmt::Display for FaultyCoil {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
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
        within("coil_watch.winding_c", coldest, [-60.0, 180.0])?;
        within("coil_watch.winding_c", hottest, [-60.0, 180.0])?;
        ordered(("coil_watch.winding_c[0]", coldest.into()), ("coil_watch.winding_c[1]", hottest.into()))?;
        within("coil_watch.slowest_s", self.slowest_s, [0.003, 0.5])?;
        within("coil_watch.floor_a", self.floor_a, [0.005, 1.0])?;
        within("coil_watch.over_current_a", self.over_current_a, [self.floor_a.into(), 10.0])?;
        // Fewer than three ticks would trip on two bad samples.
        within("coil_watch.open_ticks", self.open_ticks, [3.0, 1000.0])?;
        within("coil_watch.short_ticks", self.short_ticks, [3.0, 1000.0])?;
        within("coil_watch.saturated_ticks", self.saturated_ticks, [3.0, 10_000.0])
    }
}
