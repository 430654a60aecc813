//! What can be read of a hydraulic machine.

use super::super::digging::Digging;
use super::super::ground::Ground;
use super::super::ledger::Ledger;
use super::super::oil::ATMOSPHERE_PA;
use super::HydraulicPlant;

impl HydraulicPlant {
    /// True positions of swing, boom, arm, bucket: m, a swing motor rad.
    pub fn positions(&self) -> [f64; 4] {
        self.actuators.positions
    }

    /// Their rates, m/s or rad/s.
    pub fn velocities(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|i| self.actuators.arms[i] * self.rates[i])
    }

    /// What the filling side of swing, boom, arm, bucket takes by its motion, m³/s; positive extending.
    pub fn flows_m3ps(&self) -> [f64; 4] {
        let speeds = self.velocities();
        [0, 1, 2, 3].map(|i| {
            let [head, rod] = self.functions[i].model.areas;
            speeds[i] * if speeds[i] > 0.0 { head } else { rod }
        })
    }

    /// Moment arms dL/dθ the forces act through, m/rad; 1 for a motor.
    pub fn moment_arms(&self) -> [f64; 4] {
        self.actuators.arms
    }

    /// Joint angles of swing, boom, arm, bucket, rad.
    pub fn angles(&self) -> [f64; 4] {
        self.angles
    }

    /// Pressures of boom, arm, bucket × head, rod; Pa above the atmosphere.
    pub fn pressures_pa(&self) -> [[f64; 2]; 3] {
        [1, 2, 3].map(|i| self.circuit.pressures(i).map(|pressure| pressure - ATMOSPHERE_PA))
    }

    /// Pressures of the swing's two sides, Pa above the atmosphere.
    pub fn swing_pressures_pa(&self) -> [f64; 2] {
        self.circuit.pressures(0).map(|pressure| pressure - ATMOSPHERE_PA)
    }

    /// What pressures push with, N (a swing motor: N·m).
    pub fn pushes(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|i| self.functions[i].model.push(self.circuit.pressures(i)))
    }

    /// Pressure of the gallery, Pa above the atmosphere.
    pub fn pump_pressure_pa(&self) -> f64 {
        self.circuit.gallery.pressure_pa - ATMOSPHERE_PA
    }

    /// Delivery of the pump, m³/s.
    pub fn pump_flow_m3ps(&self) -> f64 {
        self.circuit.pump.flow_m3ps
    }

    /// Places of the spools, −1…1, extending positive.
    pub fn spools(&self) -> [f64; 4] {
        self.places
    }

    /// Force of the soil on the tip: along the reach, upwards; N.
    pub fn soil_force_n(&self) -> [f64; 2] {
        self.soil_force
    }

    /// Soil in the bucket beside the model's own payload, kg.
    pub fn load_kg(&self) -> f64 {
        self.digging.as_ref().map_or(0.0, Digging::load_kg)
    }

    /// The ground as it is cut, where there is any.
    pub fn ground(&self) -> Option<&Ground> {
        self.digging.as_ref().map(|digging| &digging.ground)
    }

    /// Whether the last tick ended with a travel stop holding swing, boom, arm, bucket back.
    pub fn against_stops(&self) -> [bool; 4] {
        self.against_stop
    }

    /// An empty ledger for this plant.
    pub fn ledger(&self) -> Ledger {
        self.circuit.ledger()
    }

    /// Oil in gallery and chambers, m³ at atmospheric pressure.
    pub fn oil_m3(&self) -> f64 {
        self.circuit.content_m3()
    }

    /// Energy of the machine's oil above what it had in the tank, of motion, and of height; J.
    pub fn energy_j(&self) -> [f64; 3] {
        let moving = self.body.kinetic_energy(&self.posture, self.rates);
        [self.circuit.energy_j(), moving, self.body.potential_energy(&self.posture)]
    }
}
