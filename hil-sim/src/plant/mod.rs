//! The simulated machine: coil duties in, actuator positions out. Fixed step, deterministic, the same for host and emulator.

pub mod actuator;
pub mod coil;
pub mod hydraulic;
pub mod sensors;
pub mod swing;

use firmware::Outputs;
use firmware::io::SPOOLS;

pub use actuator::{Actuator, ActuatorModel};
pub use swing::SwingDrive;

/// One step of the plant, s: one control tick.
pub const STEP_S: f64 = 0.001;

/// Electrical facts the plant needs to turn a duty into a current.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoilModel {
    /// Full-scale current, A.
    pub full_scale_a: f64,
    /// Winding resistance, Ω.
    pub resistance_ohm: f64,
}

/// Swing, boom, arm and bucket with their spools.
#[derive(Clone, Debug)]
pub struct Plant {
    actuators: [Actuator; 4],
    coil: CoilModel,
}

impl Plant {
    /// At rest at these positions: cylinder lengths, m, and the angle of a swing motor, rad.
    pub fn new(models: [ActuatorModel; 4], coil: CoilModel, start: [f64; 4]) -> Self {
        let mut start = start.into_iter();
        // As many positions as models.
        let actuators = models.map(|model| Actuator::new(model, start.next().unwrap_or_default(), STEP_S));
        Self { actuators, coil }
    }

    /// One step under the outputs' duties at this supply voltage; an open cut-off lets no current through.
    pub fn step(&mut self, outputs: &Outputs, supply_v: f64) {
        let full_duty_a = if outputs.cut_off_closed { supply_v / self.coil.resistance_ohm } else { 0.0 };
        for (actuator, [extend, retract]) in self.actuators.iter_mut().zip(outputs.duties) {
            let current = |duty: u16| f64::from(duty) / 65535.0 * full_duty_a;
            let command = (current(extend) - current(retract)) / self.coil.full_scale_a;
            actuator.step(command.clamp(-1.0, 1.0), STEP_S);
        }
    }

    /// True positions of swing, boom, arm, bucket: m, a swing motor rad.
    pub fn positions(&self) -> [f64; 4] {
        self.actuators.each_ref().map(Actuator::position)
    }

    /// Names of the cylinders a travel stop holds back.
    pub fn against_stops(&self) -> impl Iterator<Item = &'static str> {
        self.actuators.iter().zip(SPOOLS).filter(|(actuator, _)| actuator.against_stop()).map(|(_, name)| name)
    }
}
