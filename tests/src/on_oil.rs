//! A controller on the hydraulic plant, its requests set by hand.

use firmware::{Outputs, Parameters};
use hil_sim::plant::{Driven, Plant};
use hil_sim::scenario::Scenario;
use kinematics_core::{Cylinders, Machine, PlaneTip, Rotor};

use crate::rig::Rig;

/// The plant and its controller.
pub struct OnOil {
    /// The controller.
    pub rig: Rig,
    /// The plant.
    pub plant: Plant,
    parameters: Parameters,
    machine: Machine<f64>,
}

/// What is seen of a tick.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// What the controller says.
    pub outputs: Outputs,
    /// The true tip: reach and height, m.
    pub tip: [f64; 2],
    /// The true lengths.
    pub lengths: Cylinders<f64>,
}

impl OnOil {
    /// Enabled and at rest at these lengths of boom, arm and bucket cylinder, m.
    pub fn at_lengths(scenario: &Scenario, lengths: [f64; 3]) -> Self {
        let [boom, arm, bucket] = lengths;
        let mut rig = Rig::standing(&scenario.parameters, &lengths);
        rig.start();
        let model = scenario.hydraulic.as_ref().expect("a hydraulic plant");
        Self {
            rig,
            plant: Plant::hydraulic(model, scenario.coil, [0.0, boom, arm, bucket])
                .expect("a start within the strokes"),
            parameters: scenario.parameters,
            machine: Machine::new(&scenario.parameters.geometry).expect("a valid geometry"),
        }
    }

    /// The same with the tip at this reach and height, m, and pitch, degrees.
    pub fn at_tip(scenario: &Scenario, [reach, height, pitch]: [f64; 3]) -> Self {
        let machine = Machine::<f64>::new(&scenario.parameters.geometry).expect("a valid geometry");
        let tip = PlaneTip { reach, height, pitch: Rotor::from_degrees(pitch) };
        let Cylinders { boom, arm, bucket } = machine.tip_to_cylinders(&tip).expect("a place within reach");
        Self::at_lengths(scenario, [boom, arm, bucket])
    }

    /// One tick.
    pub fn tick(&mut self) -> Seen {
        self.rig.stand_at(&self.parameters, &self.lengths());
        if let Some(pressures_pa) = self.plant.pressures_pa() {
            self.rig.inputs.pressures_pa = pressures_pa.map(|sides| sides.map(|pressure| Some(pressure as f32)));
        }
        self.rig.solenoids = *self.plant.solenoids();
        let outputs = self.rig.tick();
        let Outputs { duties, cut_off_closed, .. } = outputs;
        self.plant.step(&Driven { duties, cut_off_closed, supply_v: 24.0 });
        let lengths = self.lengths();
        let tip = self.machine.cylinders_to_tip(&lengths, Rotor::IDENTITY).expect("a place within reach").plane;
        Seen { outputs, tip: [tip.reach, tip.height], lengths }
    }

    fn lengths(&self) -> Cylinders<f64> {
        let [_, boom, arm, bucket] = self.plant.positions();
        Cylinders { boom, arm, bucket }
    }
}
