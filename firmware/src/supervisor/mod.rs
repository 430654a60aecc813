//! Watches every stage and alone opens the gate between motion and valve: self-test → neutral → enable → run → latched fault.
//!
//! [`machine`] holds the states and arrows; here the inputs become its facts. Outside `Running` every current is zero and the cut-off
//! is open. A latched fault needs neutral and a fresh enable; what [`Fault::needs_restart`] names, a restart.

pub mod machine;
pub mod self_test;

use crate::constants::Constant;
use crate::fault::{Fault, State};
use crate::io::{Inputs, Request};
use crate::parameters::Supply;
use crate::valve::coil_fault::FaultyCoil;
use machine::{Facts, next};

pub use self_test::{Check, SelfTest};

/// A relay falls or closes within these; its contact may be elsewhere for so long.
const CUT_OFF_TICKS: u16 = 50;

/// After so many ticks in neutral without motion enable drops: 10 s.
pub const IDLE_TICKS: u16 = 10_000;

/// So many ticks in a row that ran over are a fault; fewer are only told of.
pub const OVERRUN_TICKS: u8 = 3;

/// What the stages report this tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// Supply voltage, V.
    pub supply_v: f32,
    /// The position sensors' supply, V.
    pub sensor_supply_v: f32,
    /// The most urgent fault the coils' currents showed in the last tick.
    pub coil: Option<FaultyCoil>,
    /// First fault of the stages.
    pub stage_fault: Option<Fault>,
    /// Some actuator moves.
    pub moving: bool,
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
    self_test: SelfTest,
    /// All of its steps.
    self_test_passed: bool,
    enabled_before: bool,
    /// What the cut-off was told in the last tick.
    told_closed: bool,
    /// Ticks in a row the cut-off's contact has not been where it was told.
    cut_off_astray: u16,
    /// Ticks in a row that ran over.
    overruns: u8,
    /// Ticks in neutral without motion.
    idle: u16,
}

impl Supervisor {
    /// Waiting for the self-test, with these supplies' ranges.
    pub const fn new(supply: &Supply, sensor_supply: &Supply) -> Self {
        Self {
            supply_range_v: [supply.min_v, supply.max_v],
            sensor_supply_range_v: [sensor_supply.min_v, sensor_supply.max_v],
            state: State::SelfTest,
            fault: None,
            self_test: SelfTest::PENDING,
            self_test_passed: false,
            // A switch found on at power-up is no enable edge.
            enabled_before: true,
            told_closed: false,
            cut_off_astray: 0,
            overruns: 0,
            idle: 0,
        }
    }

    /// Where its limits lie.
    pub(crate) const fn constants(&self) -> [Constant; 2] {
        [Constant::of(&self.supply_range_v), Constant::of(&self.sensor_supply_range_v)]
    }

    /// Its state.
    #[inline]
    pub fn state(&self) -> State {
        self.state
    }

    /// The latched fault.
    #[inline]
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// Takes the start-up's report; before all of it has passed nothing is enabled.
    #[inline]
    pub fn self_tested(&mut self, report: &SelfTest) {
        (self.self_test, self.self_test_passed) = (*report, report.passed());
    }

    /// One more tick of a machine at work: it runs, it is wanted to, and nothing is wrong, `faulty` included. If so this is all of
    /// [`Self::judge`], which stays [`Gate::Open`], and else nothing has been judged yet.
    #[inline(always)]
    pub fn goes_on(&mut self, inputs: &Inputs, (supply_v, sensor_supply_v): (f32, f32), faulty: bool) -> bool {
        let goes_on = self.state == State::Running
            && self.self_test_passed
            && inputs.cut_off_closed
            && inputs.enable
            && !inputs.overrun
            && !inputs.emergency_stop
            && inputs.converters_sound == [true; 2]
            && inputs.command.as_ref().is_some_and(|intent| intent.request != Request::Neutral)
            && !faulty
            && within(supply_v, self.supply_range_v)
            && within(sensor_supply_v, self.sensor_supply_range_v);
        if goes_on {
            (self.cut_off_astray, self.overruns, self.idle) = (0, 0, 0);
            self.enabled_before = true;
        }
        goes_on
    }

    /// Judges one tick.
    // Not inlined: what costs most is a machine at work.
    #[inline(never)]
    pub fn judge(&mut self, inputs: &Inputs, watched: &Watched) -> Gate {
        let at_rest = inputs.command.is_some_and(|intent| intent.request == Request::Neutral);
        self.count(inputs, at_rest && !watched.moving);

        let tested = self.self_test_passed;
        let grave = self.grave(watched, tested);
        let wrong = grave.or_else(|| self.wrong(inputs, watched));
        let facts = Facts::NONE
            .and_if(tested, Facts::SELF_TESTED)
            .and_if(at_rest, Facts::NEUTRAL)
            .and_if(inputs.enable, Facts::ENABLE)
            .and_if(inputs.enable && !self.enabled_before, Facts::ENABLE_EDGE)
            .and_if(self.idle >= IDLE_TICKS, Facts::IDLE)
            .and_if(wrong.is_some(), Facts::WRONG)
            .and_if(grave.is_some(), Facts::GRAVE);
        self.enabled_before = inputs.enable;

        let before = self.state;
        self.state = next(before, facts);
        match (before, self.state) {
            (State::Stopped, _) | (State::Fault, State::Fault) => {}
            // The first fault stays named until the operator starts afresh, a later one is its consequence; but one that needs a restart
            // says so.
            (_, State::Fault | State::Stopped) => self.fault = wrong,
            (_, State::Running) if before != State::Running => (self.fault, self.idle) = (None, 0),
            _ => {}
        }
        let gate = if self.state == State::Running { Gate::Open } else { Gate::Closed };
        self.told_closed = gate == Gate::Open;
        gate
    }

    #[inline]
    fn count(&mut self, inputs: &Inputs, idle: bool) {
        let astray = inputs.cut_off_closed != self.told_closed;
        self.cut_off_astray = if astray { self.cut_off_astray.saturating_add(1) } else { 0 };
        self.overruns = if inputs.overrun { self.overruns.saturating_add(1) } else { 0 };
        self.idle = if idle { self.idle.saturating_add(1) } else { 0 };
    }

    /// What only a restart clears, most urgent first.
    #[inline]
    fn grave(&self, watched: &Watched, tested: bool) -> Option<Fault> {
        if self.overruns >= OVERRUN_TICKS {
            Some(Fault::Overrun)
        } else if self.cut_off_astray > CUT_OFF_TICKS && !self.told_closed {
            Some(Fault::CutOffWelded)
        } else if watched.coil.is_none() && watched.stage_fault.is_none() && tested {
            None
        } else {
            self.gravest(watched)
        }
    }

    /// Not inlined: it is for faults, and for the time before the self-test has passed.
    #[inline(never)]
    fn gravest(&self, watched: &Watched) -> Option<Fault> {
        let coil = watched.coil.map(Fault::Coil);
        let grave = [coil, watched.stage_fault, self.self_test.fault()];
        grave.into_iter().flatten().find(|fault| fault.needs_restart())
    }

    /// What else is wrong this tick, most urgent first.
    #[inline]
    fn wrong(&self, inputs: &Inputs, watched: &Watched) -> Option<Fault> {
        let [sensors_sound, coils_sound] = inputs.converters_sound;
        if inputs.emergency_stop {
            Some(Fault::EmergencyStop)
        } else if self.cut_off_astray > CUT_OFF_TICKS {
            Some(Fault::CutOffStuckOpen)
        } else if !sensors_sound {
            Some(Fault::SensorConverter)
        } else if !coils_sound {
            Some(Fault::CoilConverter)
        } else if !within(watched.supply_v, self.supply_range_v) {
            Some(Fault::Supply)
        } else if let Some(coil) = watched.coil {
            Some(Fault::Coil(coil))
        } else if !within(watched.sensor_supply_v, self.sensor_supply_range_v) {
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

/// A supply that is no number is not within.
#[inline(always)]
fn within(volts: f32, [low, high]: [f32; 2]) -> bool {
    volts >= low && volts <= high
}
