//! Helpers of the hydraulic plant's tests: plants of the shipped machines, levers as currents, and motions timed.

use hil_sim::machine_file::MachineFile;
use hil_sim::plant::hydraulic::{HydraulicModel, HydraulicPlant};
use kinematics_core::{Cylinders, Machine, Rotor};

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
    let at =
        |stroke: kinematics_core::geometry::Stroke, share: f64| stroke.min_m + share * (stroke.max_m - stroke.min_m);
    let swing = g.swing.map_or(0.0, |pins| at(pins.stroke, 0.5));
    [swing, at(g.boom.stroke, boom), at(g.arm.stroke, arm), at(g.bucket.stroke, bucket)]
}

/// Positions with arm and bucket at these shares and the bucket's tip on the ground; the boom's stroke falls to it.
pub fn on_ground(machine: &str, model: &HydraulicModel, [arm, bucket]: [f64; 2]) -> [f64; 4] {
    let ground = -MachineFile::load(machine).unwrap_or_else(|error| panic!("{error}")).boom_pin_height_m;
    let maps = Machine::<f64>::new(&model.geometry).expect("a shipped machine");
    let height = |share: f64| {
        let [_, boom, arm, bucket] = shares(model, [share, arm, bucket]);
        let pose =
            maps.cylinders_to_tip(&Cylinders { boom, arm, bucket }, Rotor::IDENTITY).expect("within the strokes");
        pose.z() - ground
    };
    let (mut low, mut high) = if height(0.0) < height(1.0) { (0.0, 1.0) } else { (1.0, 0.0) };
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if height(middle) < 0.0 { low = middle } else { high = middle }
    }
    shares(model, [high, arm, bucket])
}

/// Ticks under these levers.
pub fn run(plant: &mut HydraulicPlant, model: &HydraulicModel, levers: [f64; 4], ticks: u32) {
    let currents = currents(model, levers);
    (0..ticks).for_each(|_| plant.step(currents));
}

/// Time from the lever until the cylinder is at this length, s; infinite after 20 s.
pub fn time_to(
    plant: &mut HydraulicPlant,
    model: &HydraulicModel,
    function: usize,
    deflection: f64,
    end_m: f64,
) -> f64 {
    let currents = currents(model, lever(function, deflection));
    for tick in 1..20_000 {
        plant.step(currents);
        if (plant.positions()[function] - end_m) * deflection.signum() > -5e-4 {
            return f64::from(tick) * 1e-3;
        }
    }
    f64::INFINITY
}

/// Levers that look like work: each function goes out and back at its own pace, with pauses.
pub fn work(tick: u32) -> [f64; 4] {
    let wave = |period: u32, shift: u32, size: f64| match (tick + shift) % period * 10 / period {
        0..=2 => size,
        4..=6 => -size,
        _ => 0.0,
    };
    [wave(4000, 0, 0.6), wave(5200, 700, 0.8), wave(3700, 300, 0.9), wave(2900, 1500, 0.7)]
}
