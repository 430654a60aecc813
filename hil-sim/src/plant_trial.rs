//! What `cargo hil plant` asks of a machine's hydraulic plant: full-lever strokes both ways, timed and sampled.

use serde::Serialize;

use crate::plant::STEP_S;
use crate::plant::hydraulic::{HydraulicModel, HydraulicPlant, StartError};

/// Cylinders in the trial, with their index among the functions.
const CYLINDERS: [(&str, usize); 3] = [("boom", 1), ("arm", 2), ("bucket", 3)];
/// Where the other cylinders stand, as a share of their strokes.
const STANDING: [f64; 3] = [0.7, 0.5, 0.5];
/// Longest stroke, ticks.
const MOST_TICKS: u32 = 15_000;
/// The lever stays for this long after the stop, ticks.
const AFTER_TICKS: u32 = 500;

/// One tick of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Since the lever, s.
    pub time_s: f64,
    /// Length of the cylinder, m.
    pub position_m: f64,
    /// m/s.
    pub speed_mps: f64,
    /// Head side, rod side, gallery; Pa above the atmosphere.
    pub pressures_pa: [f64; 3],
    /// Delivery of the pump, m³/s.
    pub flow_m3ps: f64,
}

/// A whole stroke at full lever.
#[derive(Clone, Debug, Serialize)]
pub struct Stroke {
    /// The cylinder.
    pub cylinder: &'static str,
    /// Extending, or retracting.
    pub extending: bool,
    /// From the lever to where the cushion begins, s.
    pub to_cushion_s: Option<f64>,
    /// From the lever to the stop, s.
    pub to_stop_s: Option<f64>,
    /// Largest speed, m/s.
    pub top_speed_mps: f64,
    /// Every tick.
    #[serde(skip)]
    pub samples: Vec<Sample>,
}

/// Everything `cargo hil plant` shows.
#[derive(Clone, Debug, Serialize)]
pub struct PlantReport {
    /// The machine.
    pub machine: String,
    /// Boom, arm, bucket, each out and in.
    pub strokes: Vec<Stroke>,
}

impl PlantReport {
    /// Runs all of it.
    ///
    /// # Errors
    /// The plant cannot stand where a stroke begins.
    pub fn new(machine: &str, model: &HydraulicModel) -> Result<Self, StartError> {
        let cases = CYLINDERS.into_iter().flat_map(|cylinder| [(cylinder, true), (cylinder, false)]);
        let strokes = cases.map(|((name, function), extending)| stroke(model, name, function, extending));
        Ok(Self { machine: machine.to_owned(), strokes: strokes.collect::<Result<_, _>>()? })
    }
}

/// Positions of swing, boom, arm, bucket with the cylinders at these shares of their strokes.
pub fn standing(model: &HydraulicModel, shares: [f64; 3]) -> [f64; 4] {
    let [boom, arm, bucket] = shares;
    let at = |i: usize, share: f64| model.functions[i].stroke.map_or(0.0, |s| s.min_m + share * (s.max_m - s.min_m));
    [at(0, 0.5), at(1, boom), at(2, arm), at(3, bucket)]
}

fn stroke(
    model: &HydraulicModel,
    cylinder: &'static str,
    function: usize,
    extending: bool,
) -> Result<Stroke, StartError> {
    let mut shares = STANDING;
    shares[function - 1] = if extending { 0.0 } else { 1.0 };
    let mut plant = HydraulicPlant::new(model, standing(model, shares))?;
    let full_a = model.spool.full_scale_a;
    let mut currents = [[0.0; 2]; 4];
    currents[function] = if extending { [full_a, 0.0] } else { [0.0, full_a] };
    let ends = model.functions[function].stroke.map_or([0.0; 2], |s| [s.min_m, s.max_m]);
    let cushion_m = model.functions[function].cushions[usize::from(extending)].length_m;
    let mut found =
        Stroke { cylinder, extending, to_cushion_s: None, to_stop_s: None, top_speed_mps: 0.0, samples: Vec::new() };
    let mut left = MOST_TICKS;
    let mut ticks = 0;
    while left > 0 {
        plant.step(currents);
        (left, ticks) = (left - 1, ticks + 1);
        let time_s = f64::from(ticks) * STEP_S;
        let (position_m, speed_mps) = (plant.positions()[function], plant.velocities()[function]);
        let to_go = if extending { ends[1] - position_m } else { position_m - ends[0] };
        if found.to_cushion_s.is_none() && to_go <= cushion_m {
            found.to_cushion_s = Some(time_s);
        }
        if found.to_stop_s.is_none() && to_go < 5e-4 {
            found.to_stop_s = Some(time_s);
            left = AFTER_TICKS;
        }
        if speed_mps.abs() > found.top_speed_mps {
            found.top_speed_mps = speed_mps.abs();
        }
        let [head, rod] = plant.pressures_pa()[function - 1];
        let pressures_pa = [head, rod, plant.pump_pressure_pa()];
        found.samples.push(Sample { time_s, position_m, speed_mps, pressures_pa, flow_m3ps: plant.pump_flow_m3ps() });
    }
    Ok(found)
}
