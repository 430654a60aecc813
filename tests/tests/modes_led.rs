//! Modes the operator leads: tip velocity and grade.

use cross_tests::obedient::Obedient;
use cross_tests::rig::{Rig, scenario};
use cross_tests::ways::{across, run};
use firmware::can::command::Slope;
use firmware::{Fault, Parameters, Request};
use hil_sim::run::Log;
use kinematics_core::Rotor;

/// Lengths with the tip 7.5 m out on the ground, m.
const ON_THE_PLANE: [f64; 3] = [2.4743624, 1.8883742, 2.5020006];

/// On the plane, a machine that does at once what its controller asks for.
fn obedient() -> Obedient {
    let mut parameters = scenario("grade-zx200").parameters;
    parameters.motion.preview_s = 0.0;
    let plane = parameters.grade.as_mut().expect("a plane");
    (plane.point_x_m, plane.tolerance_m) = (7.5, 1.0);
    Obedient::new(parameters, &ON_THE_PLANE)
}

/// Direction of the tip's way while the arm's lever is held, in the machine's frame.
fn graded(slope: Option<Slope>) -> f64 {
    let mut machine = obedient();
    machine.rig.inputs.slope = slope;
    (machine.rig.request, machine.rig.levers) = (Request::Grade, [0, 0, 16_000, 0]);
    let ticks = (0..6000).map(|_| machine.tick());
    let tips: Vec<_> = ticks.inspect(|o| assert_eq!(o.fault, None)).map(|o| o.pose.plane).collect();
    // The plane is reached first.
    let (from, to) = (tips[4000], tips[5999]);
    f64::from((to.height - from.height) / (to.reach - from.reach))
}

#[test]
fn the_plane_is_level_however_the_chassis_stands_and_as_the_machine_where_that_is_unknown() {
    let level = Slope { roll: Rotor::IDENTITY, pitch: Rotor::IDENTITY };
    let nose_down = Slope { pitch: Rotor::from_degrees(5.0), ..level };
    // Straight ahead the roll does not tilt the boom's plane.
    let rolled = Slope { roll: Rotor::from_degrees(8.0), ..nose_down };
    let up = (5.0_f64).to_radians().tan();
    for (slope, wanted) in [(None, 0.0), (Some(level), 0.0), (Some(nose_down), up)] {
        let found = graded(slope);
        assert!((found - wanted).abs() < 2e-3, "{slope:?}: {found} for {wanted}");
    }
    let found = graded(Some(rolled));
    assert!((found - up / 8.0_f64.to_radians().cos()).abs() < 2e-3, "{found}");
}

#[test]
fn too_far_from_the_plane_grading_is_refused_and_without_a_plane_not_configured() {
    let mut parameters = scenario("grade-zx200").parameters;
    for (spoil, fault) in [
        ((|p| p.grade.as_mut().expect("a plane").point_z_m += 0.5) as fn(&mut Parameters), Fault::NotAtStart),
        (|p| p.grade = None, Fault::NotConfigured),
        (|p| p.motion.law = None, Fault::NotConfigured),
    ] {
        spoil(&mut parameters);
        let mut rig = Rig::standing(&parameters, &ON_THE_PLANE);
        rig.start();
        rig.request = Request::Grade;
        assert_eq!(rig.tick().fault, Some(fault));
    }
}

#[test]
fn grading_keeps_the_tip_on_the_plane_and_the_bucket_at_its_angle() {
    let scenario = scenario("grade-zx200");
    let plane = scenario.parameters.grade.expect("a plane");
    let log = run(&scenario, 1);
    assert!(log.faults.is_empty(), "{:?}", log.faults);
    let off = across(&log, |[_, z]| z - plane.point_z_m);
    println!("{off:?}");
    assert!(off.ticks > 10_000 && off.rms_m < 0.003 && off.max_m < 0.010, "{off:?}");
    let reach = |time_s: f64| log.rows[(time_s * 1e3) as usize].tip.expect("a tip")[0];
    println!("from {:.2} m to {:.2} m and back to {:.2} m", reach(1.0), reach(8.0), reach(14.0));
    assert!(reach(1.0) - reach(8.0) > 2.0 && reach(14.0) - reach(8.0) > 1.0);
    let pitch = |row: &hil_sim::run::Row| row.joints.map(|j| (j.boom * j.arm * j.bucket).angle().to_degrees());
    let first = pitch(&log.rows[0]).expect("a pose");
    let turned = log.rows.iter().filter_map(pitch).map(|angle| (angle - first).abs()).fold(0.0, f64::max);
    println!("the bucket turned by {turned:.2}° at most");
    assert!(turned < 0.5, "{turned}");
}

fn moved(log: &Log, from_s: f64, to_s: f64) -> [f64; 2] {
    let tip = |time_s: f64| log.rows[(time_s * 1e3) as usize].tip.expect("a tip");
    let ([x0, z0], [x1, z1]) = (tip(from_s), tip(to_s));
    [(x1 - x0) / (to_s - from_s), (z1 - z0) / (to_s - from_s)]
}

#[test]
fn the_tip_goes_as_fast_as_asked_in_both_directions_and_stands_still_after() {
    let log = run(&scenario("tip-velocity-zx200"), 1);
    assert!(log.faults.is_empty() && log.stop_hits.is_empty(), "{:?}", log.faults);
    for (from_s, to_s, wanted) in [(2.5, 5.0, [-0.4, 0.0]), (6.5, 8.0, [0.0, 0.4]), (11.0, 12.0, [0.3, -0.2])] {
        let found = moved(&log, from_s, to_s);
        println!("{from_s}…{to_s} s: {found:.4?} m/s for {wanted:?}");
        assert!((found[0] - wanted[0]).abs() < 0.006 && (found[1] - wanted[1]).abs() < 0.006, "{found:?} {wanted:?}");
    }
    let after = log.rows.iter().filter(|row| row.time_s > 13.5);
    assert!(after.map(|row| row.outputs).all(|outputs| outputs.currents == [[0.0; 2]; 4]), "coils are still at rest");
}

#[test]
fn towards_the_end_of_a_stroke_the_tip_slows_and_stands_before_it() {
    let mut scenario = scenario("tip-velocity-zx200");
    let hil_sim::scenario::Task::TipVelocity { moves, .. } = &mut scenario.task else { panic!("a led tip") };
    moves.truncate(1);
    moves[0].x_mps = 0.6;
    moves[0].until_s = 9.0;
    let log = run(&scenario, 1);
    assert!(log.faults.is_empty() && log.stop_hits.is_empty(), "{:?} {:?}", log.faults, log.stop_hits);
    let arm_m = log.rows.last().expect("rows").lengths.arm;
    println!("the arm's cylinder ends at {arm_m:.4} m");
    assert!(arm_m > 1.808 && arm_m < 1.815, "{arm_m}");
}
