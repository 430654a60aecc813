//! The simulated machine: coil duties in, actuator positions out. Fixed step, deterministic, the same for host and emulator.

pub mod actuator;
pub mod coil;
pub mod hydraulic;
pub mod sensors;
pub mod swing;

use firmware::io::{SPOOLS, Solenoids};

use coil::{Broken, Drive, Solenoid, SolenoidModel};
use hydraulic::{HydraulicModel, HydraulicPlant, StartError};

pub use actuator::{Actuator, ActuatorModel, Defect};
pub use swing::SwingDrive;

/// One step of the plant, s: one control tick.
pub const STEP_S: f64 = 0.001;

/// The solenoids, all alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoilModel {
    /// Full-scale current, A.
    pub full_scale_a: f64,
    /// The winding.
    pub winding: SolenoidModel,
    /// Its temperature, °C.
    pub temperature_c: f64,
}

/// What drives the plant over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// PWM duties, 65535 is always on, a spool each.
    pub duties: [Solenoids<u16>; 4],
    /// The master cut-off's contact is closed.
    pub cut_off_closed: bool,
    /// Supply, V.
    pub supply_v: f64,
}

/// Swing, boom, arm and bucket with their spools and solenoids.
#[derive(Clone, Debug)]
pub struct Plant {
    solenoids: [Solenoids<Solenoid>; 4],
    machine: Machine,
    full_scale_a: f64,
}

/// What the solenoids move.
#[derive(Clone, Debug)]
enum Machine {
    /// Actuators at set speeds.
    Speeds(Box<[Actuator; 4]>),
    /// Oil and masses.
    Hydraulic(Box<HydraulicPlant>),
}

impl Plant {
    /// At rest at these positions: cylinder lengths, m, and the angle of a swing motor, rad.
    pub fn new(models: [ActuatorModel; 4], coil: CoilModel, start: [f64; 4]) -> Self {
        let mut start = start.into_iter();
        // As many positions as models.
        let actuators = models.map(|model| Actuator::new(model, start.next().unwrap_or_default(), STEP_S));
        Self::of(Machine::Speeds(Box::new(actuators)), coil)
    }

    /// A hydraulic machine at rest at these positions.
    ///
    /// # Errors
    /// The start is outside a stroke.
    pub fn hydraulic(model: &HydraulicModel, coil: CoilModel, start: [f64; 4]) -> Result<Self, StartError> {
        let plant = HydraulicPlant::new(model, start)?;
        Ok(Self::of(Machine::Hydraulic(Box::new(plant)), coil))
    }

    fn of(machine: Machine, coil: CoilModel) -> Self {
        let solenoid = Solenoid::new(coil.winding, coil.temperature_c);
        Self { solenoids: [[solenoid; 2]; 4], machine, full_scale_a: coil.full_scale_a }
    }

    /// One step: duties to currents, currents to motion.
    pub fn step(&mut self, driven: &Driven) {
        let Driven { cut_off_closed, supply_v, .. } = *driven;
        for (solenoids, duties) in self.solenoids.iter_mut().zip(driven.duties) {
            for (solenoid, duty) in solenoids.iter_mut().zip(duties) {
                solenoid.step(&Drive { duty: f64::from(duty) / 65535.0, supply_v, cut_off_closed }, STEP_S);
            }
        }
        let currents = self.solenoids.each_ref().map(|spool| spool.each_ref().map(Solenoid::current_a));
        match &mut self.machine {
            Machine::Speeds(actuators) => {
                for (actuator, [extend, retract]) in actuators.iter_mut().zip(currents) {
                    let command = (extend - retract) / self.full_scale_a;
                    actuator.step(command.clamp(-1.0, 1.0), STEP_S);
                }
            }
            Machine::Hydraulic(plant) => plant.step(currents),
        }
    }

    /// The solenoids, a spool each.
    pub fn solenoids(&self) -> &[Solenoids<Solenoid>; 4] {
        &self.solenoids
    }

    /// Breaks a solenoid, or repairs it.
    pub fn set_broken(&mut self, spool: usize, side: usize, broken: Option<Broken>) {
        self.solenoids[spool][side].broken = broken;
    }

    /// Spoils a spool or its oil, or repairs it.
    pub fn set_defect(&mut self, spool: usize, defect: Option<Defect>) {
        match &mut self.machine {
            Machine::Speeds(actuators) => actuators[spool].defect = defect,
            Machine::Hydraulic(plant) => plant.set_defect(spool, defect),
        }
    }

    /// Pressures of boom, arm and bucket, \[head, rod\], Pa; `None` of a plant without oil.
    pub fn pressures_pa(&self) -> Option<[[f64; 2]; 3]> {
        self.oil().map(HydraulicPlant::pressures_pa)
    }

    /// The hydraulic machine, where it is one.
    pub fn oil(&self) -> Option<&HydraulicPlant> {
        match &self.machine {
            Machine::Speeds(_) => None,
            Machine::Hydraulic(plant) => Some(plant),
        }
    }

    /// True positions of swing, boom, arm, bucket: m, a swing motor rad.
    pub fn positions(&self) -> [f64; 4] {
        match &self.machine {
            Machine::Speeds(actuators) => actuators.as_ref().each_ref().map(Actuator::position),
            Machine::Hydraulic(plant) => plant.positions(),
        }
    }

    /// Names of the cylinders a travel stop holds back.
    pub fn against_stops(&self) -> impl Iterator<Item = &'static str> {
        let held = match &self.machine {
            Machine::Speeds(actuators) => actuators.as_ref().each_ref().map(Actuator::against_stop),
            Machine::Hydraulic(plant) => plant.against_stops(),
        };
        held.into_iter().zip(SPOOLS).filter(|&(held, _)| held).map(|(_, name)| name)
    }
}
