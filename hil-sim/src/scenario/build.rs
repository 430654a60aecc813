//! From a checked file to what a run needs: the controller's parameters and the plant.

use firmware::Parameters;
use firmware::diagnosis::DiagnosisParameters;
use firmware::dig::DigParameters;
use firmware::moves::{MoveParameters, Pitch};
use firmware::parameters::{
    Coil, MotionParameters, PositionSensor, ReachParameters, Supply, SwingSensor, ValveDirection,
};
use firmware::valve::coil_stage::CoilStageParameters;
use kinematics_core::geometry::Stroke;
use kinematics_core::planning::effort::Piston;
use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::reach::Target;
use kinematics_core::{Machine, PinGeometry};

use super::check::within;
use super::file::{self, Reading, ScenarioFile};
use super::plant::Built;
use super::{Events, Scenario, Start, Task};
use crate::machine_file::MachineFile;
use crate::plant::coil::SolenoidModel;
use crate::plant::hydraulic::HydraulicModel;
use crate::plant::{ActuatorModel, CoilModel};

/// Codes at the ends of a stroke: 0.5 V and 9.5 V of a 10 V converter, so that an open or shorted wire shows.
const END_CODES: [u16; 2] = [3277, 62258];
/// 0.25 V beyond either end is still an end.
const TOLERANCE_CODES: u16 = 1638;
/// Angle encoders point forward at half scale.
const ZERO_CODE: u16 = 32768;
/// The supply's divider: code 65535 at 40 V.
const SUPPLY_FULL_SCALE_V: f32 = 40.0;
/// The controller works between these, V.
const SUPPLY_RANGE_V: [f32; 2] = [9.0, 32.0];
/// The position sensors' supply, nominally 10 V, on a converter's channel of 10.24 V.
const SENSOR_SUPPLY: Supply = Supply { full_scale_v: 10.24, min_v: 9.5, max_v: 10.2 };

fn sensor(stroke: Stroke) -> PositionSensor {
    let [min_code, max_code] = END_CODES;
    PositionSensor { stroke, min_code, max_code, tolerance_codes: TOLERANCE_CODES }
}

fn dig(file: &file::Dig) -> DigParameters {
    let mut dig = DigParameters {
        start_x_m: file.start_x_m,
        start_z_m: file.start_z_m,
        ground_z_m: file.ground_z_m,
        reach_m: file.reach_m,
        plunge_m: file.plunge_m,
        scoop_radius_m: file.scoop_m,
        scoop_end_deg: file.scoop_end_deg,
        pitch_deg: [file.start_pitch_deg, file.reach_pitch_deg, file.plunge_pitch_deg, file.scoop_pitch_deg],
        until_s: [file.reach_until_s, file.plunge_until_s, file.scoop_until_s],
        hold_lead_s: 0.0,
    };
    if file.reading == Reading::AsPublished {
        dig.scoop_radius_m = dig.published_scoop_radius_m();
        dig.hold_lead_s = file.scoop_until_s / f64::from(file.samples);
    }
    dig
}

fn planned_move(m: &file::PlannedMove, plant: &[ActuatorModel; 4]) -> MoveParameters {
    let [_, cylinders @ ..] = plant;
    let piston = |bore_m, rod_m, count| Piston { bore_m, rod_m, count }.areas_m2();
    MoveParameters {
        start_m: [m.start_x_m, m.start_z_m],
        start_pitch_deg: m.start_pitch_deg,
        target_m: [m.target_x_m, m.target_z_m],
        pitch: match (m.pitch, m.lower_deg, m.upper_deg) {
            (file::PitchRule::Bounded, Some(lower_deg), Some(upper_deg)) => Pitch::Bounded { lower_deg, upper_deg },
            (file::PitchRule::Fixed, ..) => Pitch::Fixed,
            _ => Pitch::Free,
        },
        turn_per_knot_deg: m.turn_per_knot_deg,
        weights: [1.0; 3],
        speed_mps: cylinders.map(|model| model.full_speed.map(|speed| m.speed_share * speed)),
        acceleration_mps2: [m.acceleration_mps2; 3],
        jerk_mps3: [m.jerk_mps3; 3],
        areas_m2: [
            piston(m.boom_bore_m, m.boom_rod_m, m.boom_cylinders),
            piston(m.arm_bore_m, m.arm_rod_m, 1),
            piston(m.bucket_bore_m, m.bucket_rod_m, 1),
        ],
        flow_m3ps: m.flow_lpm / 60e3,
    }
}

fn reach(reach: &file::Reach, obstacles: &[file::Obstacle]) -> Result<ReachParameters, String> {
    let sphere = |o: &file::Obstacle| Sphere { x: o.x_m, y: o.y_m, z: o.z_m, radius: o.radius_m };
    if obstacles.len() > 2 {
        return Err(format!("`obstacle`: {} of them, but the controller keeps away from at most 2", obstacles.len()));
    }
    Ok(ReachParameters {
        target: Target { x: reach.target_x_m, y: reach.target_y_m, z: reach.target_z_m },
        tolerance_m: reach.tolerance_m,
        obstacles: [0, 1].map(|i| obstacles.get(i).map(sphere)),
        speeds_rad_s: [reach.swing_rad_s, reach.boom_rad_s, reach.arm_rad_s, reach.bucket_rad_s],
    })
}

/// The one task of the file.
fn task(file: &mut ScenarioFile) -> Result<Task, String> {
    if let Some(task) = super::modes::task(file)? {
        return Ok(task);
    }
    let moves = std::mem::take(&mut file.lever);
    if file.planned_move.is_some() {
        let alone = file.dig.is_none() && moves.is_empty() && file.start.is_none();
        return if alone {
            Ok(Task::Move)
        } else {
            Err("`dig`, `lever` and `start` must be left out with `move`".to_owned())
        };
    }
    if file.reach.is_some() {
        return match (&file.dig, moves.is_empty(), file.start) {
            (None, true, Some(start)) => Ok(Task::Reach { start }),
            (None, true, None) => Err("`start` is missing: where the machine stands before it reaches".to_owned()),
            _ => Err("`reach` stands alone: without `dig` and `lever`".to_owned()),
        };
    }
    if !file.obstacle.is_empty() {
        return Err("`obstacle` is for `reach`, which is missing".to_owned());
    }
    match (&file.dig, moves.is_empty(), file.start) {
        (Some(_), true, None) => Ok(Task::Dig),
        (Some(_), true, Some(_)) => Err("`start` must be left out with `dig`, which says where it starts".to_owned()),
        (None, false, Some(start)) => Ok(Task::Levers { start, moves }),
        (None, false, None) => Err("`start` is missing: where the machine stands before the levers move".to_owned()),
        (Some(_), false, _) => Err("either `dig` or `lever`, not both".to_owned()),
        (None, true, _) => {
            Err("one of `dig`, `lever`, `move` and `reach` is needed: what the operator does".to_owned())
        }
    }
}

/// What is healthy of these valves, and of sensors with the plant's noise.
fn diagnosis(valves: &[[ValveDirection; 2]; 4], plant: &super::plant::Plant) -> DiagnosisParameters {
    let mut diagnosis =
        DiagnosisParameters::of_full_speeds(valves.map(|spool| spool.map(|direction| direction.full_speed)));
    for actuator in &mut diagnosis.actuators {
        *actuator = actuator.with_noise(plant.sensor_noise_m as f32);
    }
    diagnosis
}

/// The start's lengths lie within the strokes.
fn start_ranges(start: &Start, g: &PinGeometry) -> Result<(), String> {
    let range = |stroke: Stroke| [stroke.min_m, stroke.max_m];
    within(&[
        ("start.swing_deg", start.swing_deg, [-180.0, 180.0]),
        ("start.boom_m", start.boom_m, range(g.boom.stroke)),
        ("start.arm_m", start.arm_m, range(g.arm.stroke)),
        ("start.bucket_m", start.bucket_m, range(g.bucket.stroke)),
    ])
}

/// The valve stage as a calibration would leave it; of a hydraulic function with its curve.
fn coils(
    valves: &[[ValveDirection; 2]; 4],
    coil: &Coil,
    inductance_h: f32,
    hydraulic: Option<&HydraulicModel>,
) -> CoilStageParameters {
    let mut stage = CoilStageParameters::plain(valves, coil, inductance_h);
    for (function, spool) in stage.spools.iter_mut().enumerate() {
        for (flow, sign) in spool.flow.iter_mut().zip([1.0, -1.0]).filter(|_| hydraulic.is_some()) {
            let [min_a, max_a] = [flow.min_current_a, flow.max_current_a].map(f64::from);
            let last = flow.flow_table.len() - 1;
            for (knot, share) in flow.flow_table.iter_mut().enumerate().take(last).skip(1) {
                let current_a = min_a + (max_a - min_a) * knot as f64 / last as f64;
                let speed = |a: f64| hydraulic.map_or(0.0, |model| model.steady_speed(function, sign * a));
                *share = (speed(current_a) / speed(max_a)) as f32;
            }
        }
    }
    stage
}

pub(super) fn scenario(mut file: ScenarioFile, machine: MachineFile) -> Result<Scenario, String> {
    let g = &machine.geometry;
    let task = task(&mut file)?;
    if let Task::Levers { start, .. }
    | Task::Reach { start }
    | Task::Grade { start, .. }
    | Task::TipVelocity { start, .. } = &task
    {
        start_ranges(start, g)?;
    }
    let p = &file.plant;
    // Loading the machine has checked its geometry.
    let maps = Machine::new(g).map_err(|error| error.to_string())?;
    let Built { actuators: plant, hydraulic } = p.build(&machine, &maps)?;
    // The controller knows its valves as a calibration would leave them: here exactly.
    let valves = plant.map(|model| {
        [0, 1].map(|d| ValveDirection { dead_band: model.dead_band[d] as f32, full_speed: model.full_speed[d] as f32 })
    });
    let coil = Coil { full_scale_a: p.coil_full_scale_a as f32, resistance_ohm: p.coil_resistance_ohm as f32 };
    let m = &file.motion;
    let [min_v, max_v] = SUPPLY_RANGE_V;
    let parameters = Parameters {
        geometry: *g,
        swing_sensor: g
            .swing
            .map_or(SwingSensor::Angle { zero_code: ZERO_CODE }, |s| SwingSensor::Cylinder(sensor(s.stroke))),
        cylinder_sensors: [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(sensor),
        coils: coils(&valves, &coil, p.coil_inductance_h as f32, hydraulic.as_ref()),
        supply: Supply { full_scale_v: SUPPLY_FULL_SCALE_V, min_v, max_v },
        sensor_supply: SENSOR_SUPPLY,
        diagnosis: diagnosis(&valves, p),
        motion: MotionParameters {
            preview_s: m.preview_s as f32,
            gain_per_s: m.gain_per_s as f32,
            smallest_speed_mps: m.smallest_speed_mps as f32,
            start_tolerance_m: m.start_tolerance_m as f32,
            following_error_m: m.following_error_m as f32,
            law: file.law.map(|law| law.parameters()),
        },
        dig: file.dig.as_ref().map(dig),
        fence: file
            .fence
            .as_ref()
            .map(|fence| fence.parameters(&machine, plant[1].dead_time_s, plant[1].spool_lag_s))
            .transpose()?,
        planned_move: file.planned_move.as_ref().map(|m| planned_move(m, &plant)),
        reach: file.reach.as_ref().map(|reach| self::reach(reach, &file.obstacle)).transpose()?,
        path: file.path.map(|path| path.parameters(&file.knot)).transpose()?,
        grade: file.grade.map(|grade| grade.parameters()),
    };
    parameters.validate().map_err(|error| error.to_string())?;
    Ok(Scenario {
        name: file.name,
        description: file.description,
        duration_s: file.duration_s,
        enable_s: file.operator.enable_s,
        begin_s: file.operator.begin_s,
        task,
        parameters,
        plant,
        hydraulic,
        coil: CoilModel {
            full_scale_a: p.coil_full_scale_a,
            winding: SolenoidModel {
                resistance_ohm: p.coil_resistance_ohm,
                inductance_h: p.coil_inductance_h,
                saturation_a: 2.5 * p.coil_full_scale_a,
                freewheel_v: 0.7,
                clamp_v: 40.0,
            },
            temperature_c: 20.0,
        },
        supply_v: p.supply_v,
        sensor_noise_m: p.sensor_noise_m,
        events: Events::new(file.event),
        machine,
    })
}
