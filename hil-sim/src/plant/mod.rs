//! The simulated machine: coil duties in, cylinder lengths out. Fixed step, deterministic, the same for host and emulator.

pub mod coil;
pub mod cylinder;
pub mod sensors;

use firmware::Outputs;
use kinematics_core::Cylinders;

pub use cylinder::{Cylinder, CylinderModel};

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

/// Boom, arm and bucket with their spools.
#[derive(Clone, Debug)]
pub struct Plant {
    cylinders: [Cylinder; 3],
    coil: CoilModel,
}

impl Plant {
    /// At rest at these lengths.
    pub fn new(models: [CylinderModel; 3], coil: CoilModel, start: &Cylinders<f64>) -> Self {
        let mut lengths = [start.boom, start.arm, start.bucket].into_iter();
        let cylinders = models.map(|model| Cylinder::new(model, lengths.next().unwrap_or(model.stroke.min_m), STEP_S));
        Self { cylinders, coil }
    }

    /// One step under the outputs' duties at this supply voltage; an open cut-off lets no current through.
    pub fn step(&mut self, outputs: &Outputs, supply_v: f64) {
        let full_duty_a = if outputs.cut_off_closed { supply_v / self.coil.resistance_ohm } else { 0.0 };
        for (cylinder, [extend, retract]) in self.cylinders.iter_mut().zip(outputs.duties.into_iter().skip(1)) {
            let current = |duty: u16| f64::from(duty) / 65535.0 * full_duty_a;
            let command = (current(extend) - current(retract)) / self.coil.full_scale_a;
            cylinder.step(command.clamp(-1.0, 1.0), STEP_S);
        }
    }

    /// True lengths, m.
    pub fn lengths(&self) -> Cylinders<f64> {
        let [boom, arm, bucket] = [0, 1, 2].map(|i| self.cylinders[i].length_m());
        Cylinders { boom, arm, bucket }
    }

    /// Names of the cylinders a travel stop holds back.
    pub fn against_stops(&self) -> impl Iterator<Item = &'static str> {
        self.cylinders.iter().zip(["boom", "arm", "bucket"]).filter(|(c, _)| c.against_stop()).map(|(_, name)| name)
    }
}
