//! Frankel 2003: each equation or listing of `docs/errata.md` as printed, which fails, and as corrected, which agrees with the maps.

use core::f64::consts::{PI, TAU};

use cross_tests::golden::Golden;
use cross_tests::machines::{INCH_M, frankel_distances};
use cross_tests::papers::frankel::{
    CORRECTED, LINKS, Reverse, bucket_cylinder, bucket_displacement, cyl_to_joint, frame_of_the_program,
    joint_to_cyl_1_to_3, loop_angles_printed, loop_solutions, t23d, tg34,
};
use cross_tests::papers::{agree, all_agree, deg, rad, rate, steps, turn_between};
use kinematics_core::{Cylinder, Joints, Machine, PlaneTip, PoseError, Rotor};
use libm::{atan, atan2, cos, hypot, sin, sqrt};

/// What the corrected forms have to keep to: rad or in.
const EXACT: f64 = 1e-9;
/// θ2, θ3, θ4 of the pose named in the page, degrees.
const POSE: [f64; 3] = [20.0, -80.0, -60.0];

fn machine() -> Machine<f64> {
    Machine::new(&frankel_distances().to_pins().unwrap()).unwrap()
}

fn joints(degrees: [f64; 3]) -> Joints<f64> {
    let [boom, arm, bucket] = degrees.map(Rotor::from_degrees);
    Joints { boom, arm, bucket }
}

/// The bucket displacement at swing and joints, degrees.
fn displacement(swing: f64, degrees: [f64; 3]) -> [[f64; 4]; 3] {
    let pose = machine().joints_to_tip(&joints(degrees), Rotor::from_degrees(swing));
    let tip = [pose.x, pose.y, pose.z()].map(|x| x / INCH_M);
    // The program's φ is the pitch less half a turn.
    bucket_displacement(tip, rad(swing), rad(degrees.iter().sum()) - PI)
}

/// Asserts that θ1…θ4 (rad) are these (degrees), whole turns left out.
#[track_caller]
fn are(found: [f64; 4], swing: f64, degrees: [f64; 3]) {
    for (found, exact) in found.into_iter().zip([swing, degrees[0], degrees[1], degrees[2]]) {
        assert!(turn_between(found, rad(exact)) < EXACT, "{}°, not {exact}°", deg(found));
    }
}

/// Runs `printed` and the corrected analysis over poses and swings; `wrong` says where the printed form must fail.
fn fails_where(printed: &Reverse, wrong: impl Fn(f64, [f64; 3]) -> bool) {
    let mut failures = 0;
    for swing in [-60.0, 0.0, 30.0, 60.0, 120.0] {
        for boom in steps(-60.0, 45.0, 7) {
            for bucket in steps(-150.0, 20.0, 8) {
                let pose = [boom, -80.0, bucket];
                let b = displacement(swing, pose);
                if machine().chain().tip(&joints(pose)).reach <= 0.0 {
                    // Behind the swing axis the same tip has two swings; which, no matrix of the bucket tells.
                    continue;
                }
                are(CORRECTED.angles(&b), swing, pose);
                let found = printed.angles(&b);
                let off = found.iter().zip([swing, pose[0], pose[1], pose[2]]);
                let off = off.map(|(a, b)| turn_between(*a, rad(b))).fold(0.0, |m: f64, x| if x >= m { x } else { m });
                // Not a number counts as wrong: the arm's cosine leaves ±1.
                let nan = found.iter().any(|x| x.is_nan());
                assert_eq!(nan || off > 1e-3, wrong(swing, pose), "swing {swing}°, {pose:?}: off by {off}");
                failures += u32::from(wrong(swing, pose));
            }
        }
    }
    assert!(failures > 0);
}

#[test]
fn frankel_1_takes_the_swing_from_the_bucket_instead_of_the_tip() {
    let by_1: fn(&[[f64; 4]; 3]) -> f64 = |b| atan2(b[1][0], b[0][0]);
    let by_program: fn(&[[f64; 4]; 3]) -> f64 = |b| atan(b[1][0] / b[0][0]);
    let cos_pitch = |pose: [f64; 3]| cos(rad(pose.iter().sum()));
    fails_where(&Reverse { swing: by_1, ..CORRECTED }, |_, pose| cos_pitch(pose) < 0.0);
    fails_where(&Reverse { swing: by_program, ..CORRECTED }, |swing, _| swing.abs() > 90.0);
    let b = displacement(30.0, POSE);
    println!("(1) at 30°: {:.3}°, program {:.3}°", deg(by_1(&b)), deg(by_program(&b)));
    agree("(1)", deg(by_1(&b)), -150.0, 1e-9);
    // An upright bucket leaves nothing to take the swing from.
    let b = displacement(30.0, [20.0, -80.0, -30.0]);
    assert!(hypot(b[0][0], b[1][0]) < 1e-15);
    let b = displacement(120.0, POSE);
    println!("program at 120°: {:.3}°", deg(by_program(&b)));
    agree("the program at 120°", deg(by_program(&b)), -60.0, 1e-9);
}

#[test]
fn frankel_2_turns_about_the_wrong_axis() {
    let transcribed: fn(f64) -> [[f64; 3]; 3] = |t| [[1.0, 0.0, 0.0], [0.0, cos(t), sin(t)], [0.0, -sin(t), cos(t)]];
    for frame in [transcribed, frame_of_the_program] {
        let wrong_at_zero = frame(0.0)[1][2] == 0.0;
        fails_where(&Reverse { frame, ..CORRECTED }, |swing, _| swing != 0.0 || wrong_at_zero);
    }
    let found = Reverse { frame: frame_of_the_program, ..CORRECTED }.angles(&displacement(30.0, POSE));
    println!("Rdisp's frame at 30°: {:.3?}°", found.map(deg));
    agree("θ2 of the program", deg(found[1]), -5.804, 1e-3);
}

#[test]
fn frankel_6_with_10_puts_the_wrist_two_buckets_off() {
    fails_where(&Reverse { wrist: 1.0, ..CORRECTED }, |_, _| true);
    let found = Reverse { wrist: 1.0, ..CORRECTED }.angles(&displacement(0.0, POSE));
    println!("(6), (10): {:.3?}°", found.map(deg));
    agree("θ2", deg(found[1]), -12.612, 1e-3);
}

#[test]
fn frankel_sine_of_theta_3_is_negative() {
    fails_where(&Reverse { elbow: 1.0, ..CORRECTED }, |_, _| true);
    let found = Reverse { elbow: 1.0, ..CORRECTED }.angles(&displacement(0.0, POSE));
    println!("sin θ3 > 0: {:.3?}°", found.map(deg));
    agree("θ3", deg(found[2]), 80.0, 1e-9);
}

#[test]
fn frankel_23_holds_without_swing_alone() {
    let by_23: fn(&[[f64; 4]; 3], f64) -> f64 = |b, _| atan2(b[2][0], b[0][0]);
    fails_where(&Reverse { pitch: by_23, ..CORRECTED }, |swing, pose| {
        let pitch = rad(pose.iter().sum());
        // Right where the bucket stands upright, and where it lies level with the swing in front.
        let level = sin(pitch).abs() < 1e-9 && swing.abs() < 90.0;
        swing != 0.0 && cos(pitch).abs() > 1e-9 && !level
    });
    let found = by_23(&displacement(45.0, POSE), 0.0);
    agree("(23) at 45°, not −120°", deg(found), -112.208, 1e-3);
}

#[test]
fn frankel_12_and_14_hold_without_swing_alone() {
    let machine = machine();
    let exact = machine.joints_to_cylinders(&joints(POSE)).unwrap().bucket / INCH_M;
    let (forearm, pitch) = (rad(POSE[0] + POSE[1]), rad(POSE.iter().sum()));
    let at = |swing: f64| {
        let [phi1, phi2] = loop_angles_printed(rad(swing), forearm, pitch);
        bucket_cylinder(phi1, loop_solutions([phi1, phi2])[0], PI)
    };
    println!("(12), (14) at 0°: {:.4} in, at 45°: {:.4} in; exact {exact:.4} in", at(0.0), at(45.0));
    agree("without swing", at(0.0), exact, EXACT);
    agree("printed at 45°", at(45.0), 30.23, 5e-3);
    agree("exact", exact, 31.97, 5e-3);
    // The angles in the plane do not know of the swing.
    for bucket in steps(-157.0, 27.0, 100) {
        let mut j = joints(POSE);
        j.bucket = Rotor::from_degrees(bucket);
        let exact = machine.joints_to_cylinders(&j).unwrap().bucket / INCH_M;
        let phi = [forearm - t23d(), forearm + rad(bucket) + tg34()];
        agree("corrected", bucket_cylinder(phi[0], loop_solutions(phi)[0], PI), exact, EXACT);
    }
}

#[test]
fn frankel_15_has_two_solutions_and_the_search_may_find_the_wrong_one() {
    let machine = machine();
    let rows = Golden::read("frankel_dig").columns(["t_s", "tip_x_in", "tip_z_in", "phi_seed_deg"]);
    let mut wrong = Vec::new();
    for [time, x, z, phi] in rows {
        let tip = PlaneTip { reach: x * INCH_M, height: z * INCH_M, pitch: Rotor::from_degrees(phi + 180.0) };
        let j = machine.tip_to_joints(&tip).unwrap();
        let exact = machine.joints_to_cylinders_any_stroke(&j).unwrap().bucket / INCH_M;
        let forearm = (j.boom * j.arm).angle();
        let phi = [forearm - t23d(), j.pitch().angle() + tg34()];
        let [right, other] = loop_solutions(phi).map(|phi4| bucket_cylinder(phi[0], phi4, PI));
        agree("the machine's assembly", right, exact, EXACT);
        if time > 18.6 - 1e-6 {
            assert!(other - right > 8.5, "{time}");
            wrong.push(other);
        }
    }
    println!("the other assembly in the last rows: {wrong:.3?} in");
    assert_eq!(wrong.len(), 14);
    // What the published run reports there, beyond the limit of 38.6144 in.
    assert!(wrong.iter().all(|l| (39.61..39.68).contains(l)));
}

#[test]
fn frankel_16_and_its_program_differ_by_a_whole_turn_that_does_not_matter() {
    for phi4 in steps(-3.0, 3.0, 30) {
        agree("(18)", bucket_cylinder(0.3, phi4, -PI), bucket_cylinder(0.3, phi4, PI), 1e-12);
    }
}

#[test]
fn frankel_7_gives_a_length_beyond_the_dead_point() {
    let machine = machine();
    // The example of `pos_to_cyl`: tip at (0, 0, −103) in, φ = 100°.
    let tip = PlaneTip { reach: 0.0, height: -103.0 * INCH_M, pitch: Rotor::from_degrees(280.0) };
    let j = machine.tip_to_joints(&tip).unwrap();
    let theta = [j.boom, j.arm, j.bucket].map(Rotor::angle);
    let [_, boom, stick] = joint_to_cyl_1_to_3([0.0, theta[0], theta[1]]);
    let phi = [theta[0] + theta[1] - t23d(), theta[0] + theta[1] + theta[2] + tg34()];
    let bucket = bucket_cylinder(phi[0], loop_solutions(phi)[0], PI);
    println!("pos_to_cyl's example: {:.3?}°, cylinders {boom:.4}, {stick:.4}, {bucket:.4} in", theta.map(deg));
    agree("θ2", deg(theta[0]), -90.407, 1e-3);
    // They are three of the listed limits.
    all_agree("limits", &[boom, stick, bucket], &[46.5434, 27.6990, 22.0242], 1e-4);
    let back = cyl_to_joint([12.0, boom, stick, bucket])[1];
    println!("and back: θ2 {:.3}°", deg(back));
    agree("θ2 of the same cylinders", deg(back), -86.762, 1e-3);
    // The maps refuse what no cylinder length reaches, and come back from everywhere else.
    let found = machine.joints_to_cylinders_any_stroke(&j);
    assert!(matches!(found, Err(PoseError::NoAssembly { cylinder: Cylinder::Boom, .. })), "{found:?}");
    for degrees in steps(-86.0, 49.0, 100) {
        let sent = Joints { boom: Rotor::from_degrees(degrees), ..joints(POSE) };
        let cylinders = machine.joints_to_cylinders(&sent).unwrap();
        let again = machine.cylinders_to_joints(&cylinders).unwrap();
        assert!(turn_between(again.boom.angle(), rad(degrees)) < EXACT, "{degrees}°");
    }
}

#[test]
fn frankel_cyl_to_joint_returns_no_swing() {
    let machine = machine();
    let swing_cylinder = machine.swing_cylinder().unwrap();
    for swing in [-30.0, 10.0, 25.0] {
        let rotor = Rotor::from_degrees(swing);
        let length = swing_cylinder.length(rotor).unwrap();
        let cylinders = machine.joints_to_cylinders(&joints(POSE)).unwrap();
        let rc = [length, cylinders.boom, cylinders.arm, cylinders.bucket].map(|l| l / INCH_M);
        let printed = cyl_to_joint(rc)[0];
        agree("printed", printed, 0.0, 0.0);
        // (4) solved for θ1.
        let (r0j, r0k) = (sqrt(136.0), 5.5);
        let corrected = cross_tests::papers::frankel::corner(r0j, r0k, rc[0]) - PI + atan(10.0 / 6.0);
        agree("corrected", corrected, rad(swing), EXACT);
        agree("(4)", joint_to_cyl_1_to_3([rad(swing), 0.0, -1.0])[0], rc[0], EXACT);
    }
}

#[test]
fn frankel_joint_angles_do_not_come_back() {
    let machine = machine();
    let cylinders = machine.joints_to_cylinders(&joints(POSE)).unwrap();
    let rc = [300.0 * INCH_M, cylinders.boom, cylinders.arm, cylinders.bucket].map(|l| l / INCH_M);
    let forward = cyl_to_joint(rc);
    // Rdisp with the angle (23) at swing zero, where it holds but for the program's half turn.
    let b = displacement(0.0, POSE);
    let back = Reverse { pitch: |b, _| atan2(b[2][0], b[0][0]), ..CORRECTED }.angles(&b);
    println!("cyl_to_joint {:.3?}°, Rdisp {:.3?}°", forward.map(deg), back.map(deg));
    agree("θ3", forward[2] - back[2], TAU, EXACT);
    agree("θ4", forward[3] - back[3], TAU, EXACT);
    agree("θ3 is ours", back[2], rad(POSE[1]), EXACT);
}

/// Tip velocity (m/s) and angular velocity in the base frame when joint `i` turns at 1 rad/s, by differences.
fn twist(theta: [f64; 4], i: usize) -> [f64; 6] {
    let machine = machine();
    let moved = |t: f64| -> [f64; 12] {
        let mut theta = theta;
        theta[i] += t;
        let [swing, boom, arm, bucket] = theta.map(Rotor::from_angle);
        let matrix = machine.chain().base_to_tip(swing, &Joints { boom, arm, bucket });
        core::array::from_fn(|i| matrix[i % 3][i / 3])
    };
    let (here, speed) = (moved(0.0), rate(moved, 0.0));
    let omega = |r: usize, c: usize| (0..3).map(|k| speed[3 * k + r] * here[3 * k + c]).sum::<f64>();
    [speed[9], speed[10], speed[11], omega(2, 1), omega(0, 2), omega(1, 0)]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[test]
fn frankel_jacobian_turns_every_joint_about_the_vertical_and_stops_at_the_wrist() {
    let theta = [30.0, POSE[0], POSE[1], POSE[2]].map(rad);
    let a = LINKS.map(|a| a * INCH_M);
    // p0…p4, the pins and the tip.
    let reach = [0.0, a[0], a[1] * cos(theta[1]), a[2] * cos(theta[1] + theta[2]), a[3] * cos(theta[1..].iter().sum())];
    let rise = [0.0, 0.0, a[1] * sin(theta[1]), a[2] * sin(theta[1] + theta[2]), a[3] * sin(theta[1..].iter().sum())];
    let pin = |n: usize| {
        let (x, z) = (reach[..=n].iter().sum::<f64>(), rise[..=n].iter().sum::<f64>());
        [x * cos(theta[0]), x * sin(theta[0]), z]
    };
    let column = |i: usize, axis: [f64; 3], end: usize| {
        let arm: [f64; 3] = core::array::from_fn(|k| pin(end)[k] - pin(i)[k]);
        let v = cross(axis, arm);
        [v[0], v[1], v[2], axis[0], axis[1], axis[2]]
    };
    let vertical = [0.0, 0.0, 1.0];
    for i in 0..4 {
        let exact = twist(theta, i);
        let printed = column(i, vertical, 3);
        let axis = if i == 0 { vertical } else { [sin(theta[0]), -cos(theta[0]), 0.0] };
        let corrected = column(i, axis, 4);
        let off = |found: [f64; 6]| {
            found.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, |m: f64, x| if x > m { x } else { m })
        };
        println!("Jacobian column {}: printed {printed:.3?}, exact {exact:.3?}", i + 1);
        assert!(off(corrected) < EXACT && off(printed) > 0.1, "column {i}");
        // The program never lifts the bucket.
        assert_eq!(printed[2], 0.0);
    }
}

#[test]
fn frankel_checked_cylinders_and_matrices_are_right() {
    let machine = machine();
    for part in steps(0.0, 1.0, 50) {
        let degrees = [-86.0 + part * 135.0, -120.0 + part * 103.0, -157.0 + part * 184.0];
        let c = machine.joints_to_cylinders(&joints(degrees)).unwrap();
        let [_, boom, stick] = joint_to_cyl_1_to_3([0.0, rad(degrees[0]), rad(degrees[1])]);
        agree("(7)", boom * INCH_M, c.boom, EXACT);
        agree("(9)", stick * INCH_M, c.arm, EXACT);
        let back = cyl_to_joint([12.0, boom, stick, c.bucket / INCH_M]);
        assert!(turn_between(back[1], rad(degrees[0])) < 1e-7 && turn_between(back[2], rad(degrees[1])) < EXACT);
    }
    // B of the simulation is Koivo's (9) but for the half turn.
    let b = displacement(40.0, POSE);
    let ours = machine.chain().base_to_tip(Rotor::from_degrees(40.0), &joints(POSE));
    for (row, ours) in b.iter().zip(ours) {
        for (column, (found, exact)) in row.iter().zip(ours).enumerate() {
            let exact = if column == 3 { exact / INCH_M } else { exact };
            agree("B", *found, exact, EXACT);
        }
    }
}
