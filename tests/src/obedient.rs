//! A machine that does at once what its controller asks for, so that what is seen is the controller alone.

use firmware::{Outputs, Parameters};
use kinematics_core::Cylinders;

use crate::rig::Rig;

/// The machine and its controller.
#[derive(Clone, Debug)]
pub struct Obedient {
    /// The controller.
    pub rig: Rig,
    /// Its parameters.
    pub parameters: Parameters,
    lengths: Cylinders<f64>,
}

impl Obedient {
    /// Enabled and at rest at these lengths of boom, arm and bucket cylinder, m.
    pub fn new(parameters: Parameters, lengths: &[f64; 3]) -> Self {
        let mut rig = Rig::standing(&parameters, lengths);
        rig.start();
        let &[boom, arm, bucket] = lengths;
        Self { rig, parameters, lengths: Cylinders { boom, arm, bucket } }
    }

    /// One tick. The swing stays where it is.
    pub fn tick(&mut self) -> Outputs {
        let outputs = self.rig.tick();
        self.lengths.boom += f64::from(outputs.speeds.boom) * 1e-3;
        self.lengths.arm += f64::from(outputs.speeds.arm) * 1e-3;
        self.lengths.bucket += f64::from(outputs.speeds.bucket) * 1e-3;
        self.rig.stand_at(&self.parameters, &self.lengths);
        outputs
    }
}
