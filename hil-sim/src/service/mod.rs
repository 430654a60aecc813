//! An engineer with a service tool at the simulated machine: commands on CAN in, answers on CAN out, switches by hand.
//!
//! [`Workshop`] is the machine with its controller on simulated chips; [`calibrate`] searches every valve of a machine through it.

pub mod calibrate;
mod heard;

use firmware::board::{Controller, Disabled};
use firmware::can::address::Addresses;
use firmware::service::{Done, Errand, ServiceRequest, Task};
use firmware::simulated::link::NAME;
use firmware::simulated::{Pins, SimulatedBoard};
use firmware::store::{Sealed, Store, StoredRecord};
use firmware::{Fitted, Intent, Outputs, SelfTest};
use kinematics_core::Machine;
use sim_chips::nor_flash::NorFlash;

use crate::plant::{Driven, Plant, SwingDrive};
use crate::run::bus::{Bus, Said};
use crate::run::wiring::{Measured, Wiring};
use crate::run::{Doing, RunError};
use crate::scenario::{Events, Scenario};

pub use heard::{FoundTip, FoundValves, Heard};

/// The simulated sectors with the firmware's store.
pub type ParameterStore = Store<NorFlash<4096>>;

/// A simulated machine with its controller, and the hands on switches, levers and service tool.
pub struct Workshop {
    /// The machine, to be broken or moved.
    pub plant: Plant,
    /// The application.
    pub controller: Controller,
    /// Its board.
    pub board: SimulatedBoard,
    /// The enable switch.
    pub enable: bool,
    /// The emergency stop is pressed.
    pub emergency_stop: bool,
    /// What the operator's panel says; `None` when it is silent.
    pub intent: Option<Intent>,
    /// What the service tool says; `None` when it is silent.
    pub request: Option<ServiceRequest>,
    /// The last answers on the bus.
    pub heard: Heard,
    /// What the board did in the last tick.
    pub pins: Option<Pins>,
    /// The ECU's parameter sectors, where it has a record.
    pub store: Option<ParameterStore>,
    /// So many ticks pass while an errand is run; at 0 it is back before the next.
    pub errand_ticks: u32,
    errand: Option<(u32, Errand<Fitted>)>,
    supply_v: f64,
    cut_off_closed: bool,
    events: Events,
    bus: Bus,
    wiring: Wiring,
    ticks: u32,
}

impl Workshop {
    /// The scenario's machine and controller, its actuators at these positions; the scenario's task and events are left out.
    ///
    /// # Errors
    /// Parameters the controller refuses.
    pub fn new(scenario: &Scenario, positions: [f64; 4], seed: u64) -> Result<Self, RunError> {
        let refused =
            |error: &dyn std::fmt::Display| RunError::Place(crate::place::PlaceError::Parameters(error.to_string()));
        let swing = SwingDrive::of(&Machine::new(&scenario.machine.geometry)?);
        let controller =
            Controller::new(&scenario.parameters, Addresses::DEFAULT, &NAME).map_err(|error| refused(&error))?;
        let mut workshop = Self {
            plant: Plant::new(scenario.plant, scenario.coil, positions),
            controller,
            board: SimulatedBoard::new().map_err(|error| refused(&error))?,
            enable: false,
            emergency_stop: false,
            intent: Some(Intent::NEUTRAL),
            request: Some(idle()),
            heard: Heard::default(),
            pins: None,
            store: None,
            errand_ticks: 0,
            errand: None,
            supply_v: scenario.supply_v,
            cut_off_closed: false,
            events: Events::default(),
            bus: Bus::default(),
            wiring: Wiring::new(&scenario.parameters, swing, scenario.sensor_noise_m, seed),
            ticks: 0,
        };
        workshop.controller.self_tested(&SelfTest::PASSED);
        Ok(workshop)
    }

    /// Another controller in place of the one there, its self-test passed.
    pub fn install(&mut self, mut controller: Controller) {
        controller.self_tested(&SelfTest::PASSED);
        self.controller = controller;
    }

    /// The controller that starts with this record in its store.
    ///
    /// # Errors
    /// What it refuses, or that the store does not take it.
    pub fn start_with(&mut self, record: &StoredRecord) -> Result<(), Box<dyn std::error::Error>> {
        let mut store = Store::new(NorFlash::new()).map_err(|fit| format!("{fit:?}"))?;
        let mut sealed = Sealed::new(record)?;
        sealed.approve();
        store.write(&Disabled::new(self.board.parts())?, &sealed)?;
        let record = store.load()?.record;
        let parameters = record.parameters_for(record.mounted.into())?;
        self.install(Controller::new(&parameters, Addresses::DEFAULT, &NAME)?);
        self.controller.set_buckets(record.bucket_count(), record.mounted);
        self.store = Some(store);
        Ok(())
    }

    /// What is done beside the ticks, once its time has passed; without a store nobody does it.
    fn beside_the_ticks(&mut self) {
        let Some(store) = &mut self.store else { return };
        let due = self.controller.errand(self.board.parts());
        self.errand = due.map(|errand| (self.errand_ticks, errand)).or(self.errand.take());
        if let Some((_, errand)) = self.errand.take_if(|(left, _)| *left == 0) {
            let done: Done<Fitted> = errand.run(store);
            self.controller.done(done);
        }
        if let Some((left, _)) = &mut self.errand {
            *left -= 1;
        }
    }

    /// One tick of all of it.
    pub fn tick(&mut self) -> Outputs {
        let said = Said { intent: self.intent, slope_deg: [0.0; 2], pressures_pa: self.plant.pressures_pa() };
        let mut frames = self.bus.frames(&said);
        if let ([.., last], Some(request)) = (&mut frames, &self.request) {
            *last = self.bus.service(request);
        }
        let doing = Doing { enable: self.enable, emergency_stop: self.emergency_stop, intent: self.intent };
        let (cut_off_closed, supply_v) = (self.cut_off_closed, self.supply_v);
        let measured =
            Measured { positions: self.plant.positions(), solenoids: self.plant.solenoids(), supply_v, cut_off_closed };
        let wires = self.wiring.wires(&measured, &doing, frames, &self.events, 0.0);
        self.board.connect(&wires);
        let outputs = self.controller.cycle(self.board.parts(), false);
        let pins = self.board.pins();
        self.beside_the_ticks();
        // The relay's contact follows within the tick.
        self.cut_off_closed = pins.cut_off_closed;
        self.plant.step(&Driven { duties: pins.duties, cut_off_closed: pins.cut_off_closed, supply_v });
        pins.frames.iter().flatten().for_each(|frame| self.heard.hear(frame));
        self.pins = Some(pins);
        self.ticks += 1;
        outputs
    }

    /// Several ticks; gives the last outputs.
    pub fn ticks(&mut self, count: u32) -> Option<Outputs> {
        (0..count).map(|_| self.tick()).last()
    }

    /// Ticks since the beginning.
    pub fn now(&self) -> u32 {
        self.ticks
    }

    /// Withdraws what was asked for, enable off, long enough that everybody has heard it.
    pub fn rest(&mut self) {
        (self.enable, self.request) = (false, Some(idle()));
        self.ticks(1500);
    }

    /// Asks for a task, and lets the answer come.
    pub fn ask(&mut self, request: ServiceRequest) {
        self.request = Some(request);
        self.ticks(200);
    }

    /// Asks for a task that drives, and switches enable on.
    pub fn begin(&mut self, request: ServiceRequest) {
        self.rest();
        self.ask(request);
        self.enable = true;
    }
}

/// A service tool that is there and wants nothing.
pub const fn idle() -> ServiceRequest {
    ServiceRequest { task: Task::None, spool: 0, number: 0, current_a: 0.0 }
}

/// A task on a spool.
pub const fn on_spool(task: Task, spool: u8) -> ServiceRequest {
    ServiceRequest { task, spool, ..idle() }
}

/// A task with a number.
pub const fn numbered(task: Task, number: u8) -> ServiceRequest {
    ServiceRequest { task, number, ..idle() }
}
