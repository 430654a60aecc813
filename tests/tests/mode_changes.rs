//! From any mode into any other, in motion: no speed jumps by more than the acceleration limits allow, and nothing faults.

use cross_tests::obedient::Obedient;
use cross_tests::rig::scenario;
use firmware::can::command::TipVelocity;
use firmware::parameters::Parameters;
use firmware::{Outputs, Request};
use kinematics_core::{Machine, PlaneTip, Rotor};

/// Where path, dig and move begin: reach and height, m; pitch, degrees.
const START: [f64; 3] = [7.2, -1.6, 240.0];

/// Every request, with the levers it goes by. What the command `hold` asks for is neutral (`can_receive`).
const ALL: [(Request, [i16; 4]); 8] = [
    (Request::Neutral, [0; 4]),
    (Request::Levers, [0, 8_000, -16_000, -9_000]),
    (Request::TipVelocity, [0; 4]),
    (Request::Grade, [0, 0, 16_000, 0]),
    (Request::Path, [0; 4]),
    (Request::Dig, [0; 4]),
    (Request::Move, [0; 4]),
    (Request::Reach, [0; 4]),
];

/// A machine whose controller has everything to do, all of it from one place.
fn parameters() -> Parameters {
    let [x, z, pitch] = START;
    let mut p = scenario("level-zx200").parameters;
    p.motion.preview_s = 0.0;
    // A mode begins where the one before it left the machine.
    (p.motion.start_tolerance_m, p.motion.following_error_m) = (0.5, 0.5);
    let knots = &mut p.path.as_mut().expect("a path").knots;
    for (knot, x_m) in knots.iter_mut().flatten().zip([x, 4.5]) {
        (knot.x_m, knot.z_m, knot.pitch_deg) = (x_m, z, pitch);
    }
    p.grade = scenario("grade-zx200").parameters.grade;
    let plane = p.grade.as_mut().expect("a plane");
    (plane.point_x_m, plane.point_z_m, plane.tolerance_m) = (x, z, 1.0);
    p.dig = scenario("dig-zx200").parameters.dig;
    let dig = p.dig.as_mut().expect("a dig");
    (dig.start_x_m, dig.start_z_m, dig.ground_z_m, dig.pitch_deg[0]) = (x, z, -1.9573, pitch);
    p.planned_move = scenario("move-least-effort").parameters.planned_move;
    let planned = p.planned_move.as_mut().expect("a move");
    (planned.start_m, planned.start_pitch_deg, planned.target_m) = ([x, z], pitch - 360.0, [4.5, z]);
    p.reach = scenario("obstacle-over").parameters.reach;
    let reach = p.reach.as_mut().expect("a target");
    reach.obstacles = [None; 2];
    (reach.target.x, reach.target.y, reach.target.z) = (5.0, 0.0, -1.0);
    p
}

fn machine() -> Obedient {
    let parameters = parameters();
    let [reach, height, pitch] = START;
    let start = PlaneTip { reach, height, pitch: Rotor::from_degrees(pitch) };
    let lengths = Machine::<f64>::new(&parameters.geometry).expect("a geometry").tip_to_cylinders(&start);
    let lengths = lengths.expect("a start within reach");
    Obedient::new(parameters, &[lengths.boom, lengths.arm, lengths.bucket])
}

/// Ticks until the request's speeds are large, or at most so many: planning takes its time.
fn under_way(machine: &mut Obedient, ticks: usize, mut seen: impl FnMut(&Outputs)) -> f32 {
    let mut fastest = 0.0_f32;
    for _ in 0..ticks {
        let outputs = machine.tick();
        seen(&outputs);
        fastest = outputs.speeds.to_array().into_iter().map(f32::abs).fold(0.0, f32::max);
        if fastest > 0.06 {
            break;
        }
    }
    fastest
}

#[test]
fn from_any_mode_in_motion_into_any_other_no_speed_jumps_and_nothing_faults() {
    for from in ALL {
        for to in ALL {
            let mut machine = machine();
            let steps = machine.parameters.motion.law.expect("a law").acceleration.map(|a| a * 1e-3);
            machine.rig.tip = TipVelocity { x_mps: -0.3, z_mps: 0.1, pitch_radps: 0.1 };
            let mut before = [0.0_f32; 4];
            let mut smooth = |outputs: &Outputs| {
                assert_eq!(outputs.fault, None, "{from:?} → {to:?}");
                let speeds = outputs.speeds.to_array();
                for ((speed, before), step) in speeds.into_iter().zip(before).zip(steps) {
                    let change = (speed - before).abs();
                    assert!(change <= step * 1.001, "{from:?} → {to:?}: {before} → {speed}");
                }
                before = speeds;
            };
            for (request, levers) in [from, to] {
                (machine.rig.request, machine.rig.levers) = (request, levers);
                let fastest = under_way(&mut machine, 6000, &mut smooth);
                assert!(fastest > 0.06 || request == Request::Neutral, "{from:?} → {to:?}: {fastest}");
            }
            // And on, from the ramp into what was asked for.
            for _ in 0..400 {
                smooth(&machine.tick());
            }
        }
    }
}
