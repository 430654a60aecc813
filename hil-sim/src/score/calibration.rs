//! The valve map as a calibration would leave it: the plant's own, with the errors a calibration has.

use firmware::valve::coil_stage::CoilStageParameters;
use firmware::valve::dither::DitherParameters;
use firmware::valve::flow_map::{FlowParameters, KNOTS};

use crate::dice::Dice;
use crate::plant::hydraulic::HydraulicModel;

/// Errors of a calibration: gain, dead band as a share of full scale, dead time.
const GAIN: f64 = 0.03;
const DEAD_BAND: f64 = 0.01;
const DEAD_TIME_S: f64 = 0.02;
/// Error of the load that runs ahead.
const OVERRUN: f64 = 0.1;

/// What the controller takes the valves for.
pub(super) struct Believed {
    pub(super) coils: CoilStageParameters,
    pub(super) preview_s: f64,
    /// See [`LawParameters::overrun_n`](firmware::law::LawParameters::overrun_n).
    pub(super) overrun_n: [[f32; 2]; 3],
}

/// The map of `plant`, each direction's gain and dead band and the dead time wrong by what a calibration may be.
pub(super) fn calibrated(plant: &HydraulicModel, coils: &CoilStageParameters, seed: u64) -> Believed {
    let mut dice = Dice::new(!seed);
    believed(plant, coils, |limit| limit * dice.within(-1.0, 1.0))
}

/// The map of `plant` without an error.
pub(super) fn exact(plant: &HydraulicModel, coils: &CoilStageParameters) -> Believed {
    believed(plant, coils, |_| 0.0)
}

fn believed(plant: &HydraulicModel, coils: &CoilStageParameters, mut error: impl FnMut(f64) -> f64) -> Believed {
    let mut coils = *coils;
    let full_a = plant.spool.full_scale_a;
    for (function, spool) in coils.spools.iter_mut().enumerate() {
        // Wider than the spool's play, which it takes away.
        let amplitude_a = (0.6 * plant.spool.hysteresis * full_a) as f32;
        spool.dither = DitherParameters { frequency_hz: 62.5, amplitude_a, fade_below_a: 2.0 * amplitude_a + 0.01 };
        for (direction, flow) in spool.flow.iter_mut().enumerate() {
            let band = plant.functions[function].dead_band[direction];
            let sign = if direction == 0 { 1.0 } else { -1.0 };
            let speed = |share: f64| plant.steady_speed(function, sign * (band + share * (1.0 - band)) * full_a).abs();
            let full = speed(1.0);
            let mut table: [f32; KNOTS] =
                std::array::from_fn(|knot| (speed(knot as f64 / (KNOTS - 1) as f64) / full) as f32);
            // Where the dead band ends nothing flows, whatever rounding leaves.
            table[0] = 0.0;
            *flow = FlowParameters {
                min_current_a: ((band + error(DEAD_BAND)) * full_a) as f32,
                full_speed: (full * (1.0 + error(GAIN))) as f32,
                flow_table: table,
                ..*flow
            };
        }
    }
    let overrun_n = [1, 2, 3].map(|function| {
        [0, 1].map(|direction| (plant.functions[function].overrun_n(direction) * (1.0 + error(OVERRUN))) as f32)
    });
    // Dead time, the spool's two lags, and the coil's.
    let lag_s = 2.0 / (core::f64::consts::TAU * plant.spool.natural_hz);
    Believed { coils, overrun_n, preview_s: plant.spool.dead_time_s + lag_s + 0.005 + error(DEAD_TIME_S) }
}
