//! Helpers of the hydraulic plant's tests: plants of the shipped machines, levers as currents, and motions timed.

use hil_sim::machine_file::MachineFile;
use hil_sim::plant::hydraulic::{HydraulicModel, HydraulicPlant};

/// Machines with a hydraulic plant.
pub const MACHINES: [&str; 2] = ["zx200", "frankel"];

/// Indices of the functions.
pub const BOOM: usize = 1;
/// See [`BOOM`].
pub const ARM: usize = 2;
/// See [`BOOM`].
pub const BUCKET: usize = 3;

/// The plant of a shipped machine, without payload and ground.
pub fn model(machine: &str) -> HydraulicModel {
    let file = MachineFile::load(machine).unwrap_or_else(|error| panic!("{error}"));
    HydraulicModel::of(&file).unwrap_or_else(|error| panic!("{error}"))
}

/// At rest at these positions.
pub fn at(model: &HydraulicModel, start: [f64; 4]) -> HydraulicPlant {
    HydraulicPlant::new(model, start).unwrap_or_else(|error| panic!("{error}"))
}

/// Solenoid currents of levers −1…1 of full scale.
pub fn currents(model: &HydraulicModel, levers: [f64; 4]) -> [[f64; 2]; 4] {
    levers.map(|lever| {
        let amperes = lever.abs() * model.spool.full_scale_a;
        if lever > 0.0 { [amperes, 0.0] } else { [0.0, amperes] }
    })
}

/// One lever.
pub fn lever(function: usize, deflection: f64) -> [f64; 4] {
    let mut levers = [0.0; 4];
    levers[function] = deflection;
    levers
}

/// Positions of all strokes at this share of each, the swing at zero (a swing cylinder half out).
pub fn shares(model: &HydraulicModel, [boom, arm, bucket]: [f64; 3]) -> [f64; 4] {
    let g = &model.geometry;
    let at = |stroke: kinematics_core::geometry::Stroke, share: f64| stroke.min_m + share * (stroke.max_m - stroke.min_m);
    let swing = g.swing.map_or(0.0, |pins| at(pins.stroke, 0.5));
    [swing, at(g.boom.stroke, boom), at(g.arm.stroke, arm), at(g.bucket.stroke, bucket)]
}

/// Ticks under these levers.
pub fn run(plant: &mut HydraulicPlant, model: &HydraulicModel, levers: [f64; 4], ticks: u32) {
    let currents = currents(model, levers);
    (0..ticks).for_each(|_| plant.step(currents));
}

/// Time from the lever until a cylinder that starts at one end of its stroke has reached the other, s.
pub fn full_stroke(plant: &mut HydraulicPlant, model: &HydraulicModel, function: usize, deflection: f64) -> f64 {
    let currents = currents(model, lever(function, deflection));
    for tick in 1..20_000 {
        plant.step(currents);
        if plant.against_stops()[function] {
            let stroke = model.functions[function].stroke.expect("a cylinder");
            let end = if deflection > 0.0 { stroke.max_m } else { stroke.min_m };
            if (plant.positions()[function] - end).abs() < 1e-3 {
                return f64::from(tick) * 1e-3;
            }
        }
    }
    f64::INFINITY
}
