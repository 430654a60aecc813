//! What the simulated machine shows beside its positions: currents in the windings, oil, the ground as it is cut.

use firmware::io::Solenoids;

use crate::plant::Plant;
use crate::plant::coil::Solenoid;
use crate::plant::hydraulic::HydraulicPlant;

/// Ticks from one sample to the next: a boom rings at 2…5 Hz, a spool follows up to 10 Hz.
pub(super) const EVERY_TICKS: u32 = 5;

/// One moment inside the machine.
#[derive(Clone, Copy, Debug)]
pub struct Inside {
    /// s
    pub time_s: f64,
    /// True currents in the windings, a spool each, A.
    pub coils_a: [Solenoids<f64>; 4],
    /// The oil of a hydraulic machine.
    pub oil: Option<OilSeen>,
}

/// The oil of a hydraulic machine. Functions are swing, boom, arm, bucket.
#[derive(Clone, Copy, Debug)]
pub struct OilSeen {
    /// Each function's two sides, \[head, rod\], Pa above the atmosphere.
    pub pressures_pa: [[f64; 2]; 4],
    /// What each function's filling side takes, m³/s; positive extending.
    pub flows_m3ps: [f64; 4],
    /// Gallery, Pa above the atmosphere.
    pub pump_pa: f64,
    /// Delivery of the pump, m³/s.
    pub pump_m3ps: f64,
    /// Soil in the bucket, kg.
    pub load_kg: f64,
}

impl Inside {
    /// Of this plant.
    pub(super) fn of(plant: &Plant, time_s: f64) -> Self {
        let coils_a = plant.solenoids().each_ref().map(|spool| spool.each_ref().map(Solenoid::current_a));
        Self { time_s, coils_a, oil: plant.oil().map(OilSeen::of) }
    }
}

impl OilSeen {
    fn of(plant: &HydraulicPlant) -> Self {
        let [boom, arm, bucket] = plant.pressures_pa();
        Self {
            pressures_pa: [plant.swing_pressures_pa(), boom, arm, bucket],
            flows_m3ps: plant.flows_m3ps(),
            pump_pa: plant.pump_pressure_pa(),
            pump_m3ps: plant.pump_flow_m3ps(),
            load_kg: plant.load_kg(),
        }
    }
}

/// The ground over the run: how it was, and every sample of it that was lowered.
#[derive(Clone, Debug, Default)]
pub struct GroundSeen {
    /// Reach and height over the boom pin at the beginning, m.
    pub start: Vec<[f64; 2]>,
    /// In the order of time.
    pub cuts: Vec<Cut>,
    now: Vec<f64>,
}

/// One sample of the ground, lowered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// s
    pub time_s: f64,
    /// Which of [`GroundSeen::start`].
    pub sample: usize,
    /// Its height from now on, m over the boom pin.
    pub height_m: f64,
}

impl GroundSeen {
    /// Looks at the ground, where the plant has any.
    pub(super) fn look(&mut self, plant: &Plant, time_s: f64) {
        let Some(ground) = plant.oil().and_then(HydraulicPlant::ground) else { return };
        if self.start.is_empty() {
            self.start = ground.profile().collect();
            self.now = self.start.iter().map(|[_, height]| *height).collect();
        }
        for (sample, ([_, height_m], now)) in ground.profile().zip(&mut self.now).enumerate() {
            if height_m != *now {
                *now = height_m;
                self.cuts.push(Cut { time_s, sample, height_m });
            }
        }
    }
}
