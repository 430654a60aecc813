//! Watches every stage and alone opens the gate between motion and valve.
//!
//! ```text
//! Locked ── neutral, fresh, enable off, nothing wrong ──▶ Ready ── enable switched on ──▶ Running
//!    ▲                                                                                      │
//!    └──────────────────────────── enable switched off ─────────────────────────────────────┘
//! any state ── something wrong ──▶ Fault (latched) ── neutral, fresh, enable off, nothing wrong ──▶ Ready
//! ```
//! Outside `Running` every current is zero and the cut-off is open.

use crate::fault::{Fault, State};
use crate::io::{Inputs, Request};
use crate::parameters::Supply;
use crate::valve::coil_fault::FaultyCoil;

/// A relay falls or closes within these; its contact may be elsewhere for so long.
const CUT_OFF_TICKS: u16 = 50;

/// What the stages report this tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// Supply voltage, V.
    pub supply_v: f32,
    /// The position sensors' supply, V.
    pub sensor_supply_v: f32,
    /// The most urgent fault the coils' currents showed in the last tick.
    pub coil: Option<FaultyCoil>,
    /// First fault of the stages sensing, pose and motion.
    pub stage_fault: Option<Fault>,
}

/// Whether speeds may become currents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gate {
    /// Zero current, cut-off open.
    Closed,
    /// Currents flow.
    Open,
}

/// The supervisor.
#[derive(Clone, Copy, Debug)]
pub struct Supervisor {
    supply_range_v: [f32; 2],
    sensor_supply_range_v: [f32; 2],
    state: State,
    /// The latched fault: cleared only when running begins afresh.
    fault: Option<Fault>,
    enabled_before: bool,
    /// What the cut-off was told in the last tick.
    told_closed: bool,
    /// Ticks in a row the cut-off's contact has not been where it was told.
    cut_off_astray: u16,
}

impl Supervisor {
    pub(crate) const fn new(supply: &Supply, sensor_supply: &Supply) -> Self {
        // A switch found on at power-up is no enable edge.
        Self {
            supply_range_v: [supply.min_v, supply.max_v],
            sensor_supply_range_v: [sensor_supply.min_v, sensor_supply.max_v],
            state: State::Locked,
            fault: None,
            enabled_before: true,
            told_closed: false,
            cut_off_astray: 0,
        }
    }

    /// Its state.
    pub fn state(&self) -> State {
        self.state
    }

    /// The latched fault.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// Judges one tick.
    pub fn judge(&mut self, inputs: &Inputs, watched: &Watched) -> Gate {
        let gate = self.decide(inputs, watched);
        self.told_closed = gate == Gate::Open;
        gate
    }

    fn decide(&mut self, inputs: &Inputs, watched: &Watched) -> Gate {
        self.cut_off_astray =
            if inputs.cut_off_closed == self.told_closed { 0 } else { self.cut_off_astray.saturating_add(1) };
        let enable_edge = inputs.enable && !self.enabled_before;
        self.enabled_before = inputs.enable;
        let at_rest = inputs.command.is_some_and(|intent| intent.request == Request::Neutral);

        if let Some(fault) = self.wrong(inputs, watched) {
            // The first fault stays named until the operator starts afresh; a later one is its consequence.
            if self.state != State::Fault {
                self.fault = Some(fault);
            }
            self.state = State::Fault;
            return Gate::Closed;
        }
        self.state = match self.state {
            State::Locked | State::Fault if at_rest && !inputs.enable => State::Ready,
            State::Ready if at_rest && enable_edge => {
                self.fault = None;
                State::Running
            }
            // Levers moved before enabling: back to neutral first.
            State::Ready if !at_rest => State::Locked,
            State::Running if !inputs.enable => State::Locked,
            same => same,
        };
        if self.state == State::Running { Gate::Open } else { Gate::Closed }
    }

    /// What is wrong this tick, most urgent first.
    fn wrong(&self, inputs: &Inputs, watched: &Watched) -> Option<Fault> {
        // Written so that NaN is outside.
        let outside = |volts: f32, [low, high]: [f32; 2]| !(volts >= low && volts <= high);
        let [sensors_sound, coils_sound] = inputs.converters_sound;
        if inputs.emergency_stop {
            Some(Fault::EmergencyStop)
        } else if inputs.overrun {
            Some(Fault::Overrun)
        } else if self.cut_off_astray > CUT_OFF_TICKS {
            Some(if self.told_closed { Fault::CutOffStuckOpen } else { Fault::CutOffWelded })
        } else if !sensors_sound {
            Some(Fault::SensorConverter)
        } else if !coils_sound {
            Some(Fault::CoilConverter)
        } else if outside(watched.supply_v, self.supply_range_v) {
            Some(Fault::Supply)
        } else if let Some(coil) = watched.coil {
            Some(Fault::Coil(coil))
        } else if outside(watched.sensor_supply_v, self.sensor_supply_range_v) {
            Some(Fault::SensorSupply)
        } else if watched.stage_fault.is_some() {
            watched.stage_fault
        } else if self.state == State::Running && inputs.command.is_none() {
            Some(Fault::CommandStale)
        } else {
            None
        }
    }
}
