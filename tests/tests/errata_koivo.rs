//! Koivo 1994: each equation of `docs/errata.md` as printed, which fails, and as corrected, which agrees with the maps.

use core::f64::consts::{PI, TAU};

use cross_tests::machines::{ZX200, frankel_distances};
use cross_tests::papers::koivo::{distances, four_bar};
use cross_tests::papers::{agree, all_agree, deg, rad, steps, turn_between};
use kinematics_core::chain::pitch_from_digging_angle;
use kinematics_core::distances::KoivoDistances;
use kinematics_core::swing::plane_through;
use kinematics_core::{Cylinders, Joints, Machine, Rotor, Vec2};
use libm::{atan, atan2, cos, sin, sqrt};

/// What the corrected forms have to keep to: m or rad.
const EXACT: f64 = 1e-9;

fn zx200() -> (Machine<f64>, KoivoDistances) {
    (Machine::new(&ZX200).unwrap(), distances(&ZX200))
}

fn backhoe() -> Machine<f64> {
    Machine::new(&frankel_distances().to_pins().unwrap()).unwrap()
}

fn joints(degrees: [f64; 3]) -> Joints<f64> {
    let [boom, arm, bucket] = degrees.map(Rotor::from_degrees);
    Joints { boom, arm, bucket }
}

/// Boom, arm and bucket angles, rad, at lengths in metres.
fn angles(machine: &Machine<f64>, [boom, arm, bucket]: [f64; 3]) -> [f64; 3] {
    let found = machine.cylinders_to_joints_any_stroke(&Cylinders { boom, arm, bucket }).unwrap();
    [found.boom, found.arm, found.bucket].map(Rotor::angle)
}

/// Lengths in the middle of the stroke, for the cylinders a test does not vary.
const MIDDLE: [f64; 3] = [2.4, 2.5, 2.1];

/// (2), (3a)–(3d) multiplied: base to frame `n`.
fn base_to(n: usize, a: [f64; 4], theta: [f64; 4]) -> [[f64; 4]; 4] {
    let mut out = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    for i in 0..n {
        let (c, s) = (cos(theta[i]), sin(theta[i]));
        let (ca, sa) = if i == 0 { (0.0, 1.0) } else { (1.0, 0.0) };
        let link =
            [[c, -ca * s, sa * s, a[i] * c], [s, ca * c, -sa * c, a[i] * s], [0.0, sa, ca, 0.0], [0.0, 0.0, 0.0, 1.0]];
        out = core::array::from_fn(|r| core::array::from_fn(|k| (0..4).map(|j| out[r][j] * link[j][k]).sum()));
    }
    out
}

fn apply(matrix: &[[f64; 4]; 4], p: [f64; 4]) -> [f64; 3] {
    core::array::from_fn(|r| (0..4).map(|k| matrix[r][k] * p[k]).sum())
}

const POSE: [f64; 3] = [20.0, -80.0, -60.0];

#[test]
fn koivo_4_takes_the_wrist_from_frame_3() {
    let (machine, _) = zx200();
    let a = machine.chain().lengths();
    let theta = [30.0, POSE[0], POSE[1], POSE[2]].map(rad);
    let wrist = machine.chain().wrist(&joints(POSE));
    let ours = [wrist.x * cos(theta[0]), wrist.x * sin(theta[0]), wrist.z];
    // D in frame 4 is one bucket length behind the tip.
    let printed = apply(&base_to(3, a, theta), [-a[3], 0.0, 0.0, 1.0]);
    let corrected = apply(&base_to(3, a, theta), [0.0, 0.0, 0.0, 1.0]);
    let off = (0..3).map(|i| (printed[i] - ours[i]) * (printed[i] - ours[i])).sum::<f64>().sqrt();
    println!("(4) with p_4 is off by {off:.6} m");
    agree("a4", off, 1.512634, 1e-9);
    all_agree("(4)", &corrected, &ours, EXACT);
}

#[test]
fn koivo_11_lacks_a_root_and_has_its_fraction_upside_down() {
    let (machine, k) = zx200();
    let radius_squared = k.l_ah_m * k.l_ah_m + k.l_he_m * k.l_he_m;
    let h = |length: f64| k.l_ab_m * k.l_ab_m + radius_squared - length * length;
    let square = |length: f64| 4.0 * k.l_ab_m * k.l_ab_m * radius_squared - h(length) * h(length);
    let printed = |l: f64| -k.beta_rad - atan(k.l_ah_m / k.l_he_m) + atan(h(l) / square(l));
    let upright = |l: f64| -k.beta_rad - atan(k.l_ah_m / k.l_he_m) + atan(sqrt(square(l)) / h(l));
    let corrected = |l: f64| -k.beta_rad - atan2(k.l_ah_m, k.l_he_m) + atan2(sqrt(square(l)), h(l));
    let ours = |l: f64| angles(&machine, [l, MIDDLE[1], MIDDLE[2]])[0];
    println!("(11) at 2.4 m: {:.3}°, not {:.3}°", deg(printed(2.4)), deg(ours(2.4)));
    agree("printed at 2.4 m", deg(printed(2.4)), -72.502, 1e-3);
    agree("ours at 2.4 m", deg(ours(2.4)), 3.310, 1e-3);
    println!("(11) with the root, at 3 m: {:.3}°, not {:.3}°", deg(upright(3.0)), deg(ours(3.0)));
    agree("half a turn", turn_between(upright(3.0), ours(3.0)), PI, EXACT);
    let mut by_chance = 0;
    for l in steps(k.boom.min_m, k.boom.max_m, 500) {
        by_chance += u32::from(turn_between(printed(l), ours(l)) < 0.1);
        assert!(turn_between(corrected(l), ours(l)) < EXACT, "{l}");
    }
    println!("(11) within 0.1 rad at {by_chance} of 501 lengths");
    assert!(by_chance < 50);
}

#[test]
fn koivo_11_takes_a_cylinder_below_the_boom_pin() {
    let g = frankel_distances().to_pins().unwrap();
    let (machine, k) = (backhoe(), distances(&g));
    assert!(k.l_he_m < 0.0 && k.l_ah_m < 0.0, "A stands behind and above the boom pin");
    let radius_squared = k.l_ah_m * k.l_ah_m + k.l_he_m * k.l_he_m;
    for l in steps(k.boom.min_m, k.boom.max_m, 500) {
        let h = k.l_ab_m * k.l_ab_m + radius_squared - l * l;
        let turn = atan2(sqrt(4.0 * k.l_ab_m * k.l_ab_m * radius_squared - h * h), h);
        let ours = machine.cylinders_to_joints(&Cylinders { boom: l, arm: 0.9, bucket: 0.7 }).unwrap().boom.angle();
        let corrected = -k.beta_rad - atan2(k.l_ah_m, k.l_he_m) - turn;
        assert!(
            turn_between(corrected, ours) < 1e-7,
            "{l}: near the dead point the angle is only as sure as its length"
        );
        // The sign as printed, and the first arctangent as printed.
        let printed = -k.beta_rad - atan2(k.l_ah_m, k.l_he_m) + turn;
        let one_argument = -k.beta_rad - atan(k.l_ah_m / k.l_he_m) - turn;
        assert!(turn_between(printed, ours) > 0.05, "{l}");
        agree("half a turn", turn_between(one_argument, ours), PI, 1e-7);
        if l == k.boom.min_m {
            println!("(11) on frankel at {l:.4} m: {:.3}°, not {:.3}°", deg(printed), deg(ours));
        }
    }
}

#[test]
fn koivo_13_needs_the_quadrant() {
    let (machine, k) = zx200();
    let parts = |l: f64| {
        let h = k.l_fc_m * k.l_fc_m + k.l_ci_m * k.l_ci_m - l * l;
        (sqrt(4.0 * k.l_fc_m * k.l_fc_m * k.l_ci_m * k.l_ci_m - h * h), h)
    };
    let from = 3.0 * PI - k.gamma1_rad - k.gamma2_rad;
    let printed = |l: f64| from - atan(parts(l).0 / parts(l).1);
    let corrected = |l: f64| from - atan2(parts(l).0, parts(l).1);
    let ours = |l: f64| angles(&machine, [MIDDLE[0], l, MIDDLE[2]])[1];
    let mut wrong = 0;
    for l in steps(k.arm.min_m, k.arm.max_m, 500) {
        assert!(turn_between(corrected(l), ours(l)) < EXACT, "{l}");
        if parts(l).1 < 0.0 {
            wrong += 1;
            agree("half a turn", turn_between(printed(l), ours(l)), PI, EXACT);
        }
    }
    assert!(wrong > 100);
    println!(
        "(13) wrong at {wrong} of 501 lengths; at 3 m {:.3}°, not {:.3}°",
        deg(printed(3.0)) - 360.0,
        deg(ours(3.0))
    );
    println!("(13) fails from {:.4} m", sqrt(k.l_fc_m * k.l_fc_m + k.l_ci_m * k.l_ci_m));
}

#[test]
fn koivo_15_needs_the_quadrant() {
    let (_, k) = zx200();
    let parts = |l: f64| {
        let h = k.l_jl_m * k.l_jl_m + k.l_kl_m * k.l_kl_m - l * l;
        (sqrt(4.0 * k.l_jl_m * k.l_jl_m * k.l_kl_m * k.l_kl_m - h * h), h)
    };
    let printed = |l: f64| k.nu1_rad - atan(parts(l).0 / parts(l).1);
    let corrected = |l: f64| k.nu1_rad - atan2(parts(l).0, parts(l).1);
    let (machine, _) = zx200();
    let ours = |l: f64| {
        let bucket =
            machine.cylinders_to_joints_any_stroke(&Cylinders { boom: 2.4, arm: 2.5, bucket: l }).unwrap().bucket;
        four_bar(&ZX200, l, bucket).e1
    };
    let mut wrong = 0;
    for l in steps(k.bucket.min_m, k.bucket.max_m, 500) {
        assert!(turn_between(corrected(l), ours(l)) < EXACT, "{l}");
        if parts(l).1 < 0.0 {
            wrong += 1;
            agree("half a turn", turn_between(printed(l), ours(l)), PI, EXACT);
        }
    }
    assert!(wrong > 100);
    println!("(15) wrong at {wrong} of 501; at 2.5 m {:.3}°, not {:.3}°", deg(printed(2.5)), deg(ours(2.5)));
    println!("(15) fails from {:.4} m", sqrt(k.l_jl_m * k.l_jl_m + k.l_kl_m * k.l_kl_m));
}

/// The bucket pin in the base frame and the true angles.
fn bucket_pin(machine: &Machine<f64>, swing: f64, degrees: [f64; 3]) -> [f64; 3] {
    let wrist = machine.chain().wrist(&joints(degrees));
    [wrist.x * cos(swing), wrist.x * sin(swing), wrist.z]
}

#[test]
fn koivo_23_needs_the_quadrant() {
    let (machine, _) = zx200();
    for degrees in [-170.0, -100.0, -60.0, 60.0, 100.0, 135.0, 179.0] {
        let [x, y, z] = bucket_pin(&machine, rad(degrees), POSE);
        let printed = atan(y / x);
        let corrected = plane_through(x, y, z, Rotor::IDENTITY).unwrap().0.angle();
        agree("swing", corrected, rad(degrees), EXACT);
        if degrees.abs() > 90.0 {
            agree("half a turn", turn_between(printed, rad(degrees)), PI, EXACT);
        }
        println!("(23) at {degrees}°: {:.3}°", deg(printed));
    }
}

/// (25) with either arctangent, for p_z, d and the links.
fn boom_by_25(pz: f64, d: f64, a: [f64; 4], tan: impl Fn(f64, f64) -> f64) -> f64 {
    let k = pz * pz + d * d + a[1] * a[1] - a[2] * a[2];
    tan(pz, d) + tan(sqrt(4.0 * a[1] * a[1] * (pz * pz + d * d) - k * k), k)
}

#[test]
fn koivo_25_needs_the_quadrant() {
    let machine = backhoe();
    let a = machine.chain().lengths();
    let both = |degrees: [f64; 3]| {
        let wrist = machine.chain().wrist(&joints(degrees));
        let (pz, d) = (wrist.z, wrist.x - a[0]);
        (boom_by_25(pz, d, a, |y, x| atan(y / x)), boom_by_25(pz, d, a, atan2), d)
    };
    for boom in steps(-85.0, 49.0, 40) {
        for arm in steps(-120.0, -17.0, 40) {
            let (printed, corrected, d) = both([boom, arm, -60.0]);
            assert!(turn_between(corrected, rad(boom)) < EXACT, "{boom} {arm}");
            assert_eq!(turn_between(printed, rad(boom)) > 3.0, d < 0.0, "{boom} {arm}");
        }
    }
    let (printed, corrected, d) = both([-70.0, -110.0, -60.0]);
    println!("(25) at −70/−110 on frankel, d = {d:.4} m: {:.3}°, not {:.3}°", deg(printed), deg(corrected));
}

#[test]
fn koivo_26_needs_the_quadrant() {
    let (machine, _) = zx200();
    let a = machine.chain().lengths();
    let parts = |degrees: [f64; 3]| {
        let wrist = machine.chain().wrist(&joints(degrees));
        let (pz, d) = (wrist.z, wrist.x - a[0]);
        let (c2, s2) = (cos(rad(degrees[0])), sin(rad(degrees[0])));
        (c2 * pz - s2 * d, s2 * pz + c2 * d - a[1])
    };
    for arm in steps(-153.0, -35.0, 200) {
        let (y, x) = parts([20.0, arm, -60.0]);
        assert!(turn_between(atan2(y, x), rad(arm)) < EXACT, "{arm}");
        let off = turn_between(atan(y / x), rad(arm));
        if arm < -90.0 {
            agree("half a turn", off, PI, EXACT);
        }
    }
    let (y, x) = parts([20.0, -120.0, -60.0]);
    println!("(26) at −120°: {:.3}°", deg(atan(y / x)));
    agree("printed", deg(atan(y / x)), 60.0, 1e-9);
}

#[test]
fn koivo_27_forgets_the_swing_and_turns_height_into_width() {
    let (machine, _) = zx200();
    let a4 = machine.chain().lengths()[3];
    for swing in [0.0, 30.0, 45.0, 90.0, -120.0] {
        let (swing, pitch) = (rad(swing), rad(POSE.iter().sum()));
        let pose = machine.joints_to_tip(&joints(POSE), Rotor::from_angle(swing));
        let n = [pose.x, pose.y, pose.z()];
        let ours = bucket_pin(&machine, swing, POSE);
        let printed = [n[0] - a4 * cos(pitch), n[1] + a4 * sin(pitch), n[2]];
        let corrected =
            [n[0] - a4 * cos(swing) * cos(pitch), n[1] - a4 * sin(swing) * cos(pitch), n[2] - a4 * sin(pitch)];
        all_agree("(27)", &corrected, &ours, EXACT);
        let off = (0..3).map(|i| (printed[i] - ours[i]) * (printed[i] - ours[i])).sum::<f64>().sqrt();
        println!("(27) at swing {:.0}°: off by {off:.4} m", deg(swing));
        assert!(off > 1.0);
        for (degrees, stated) in [(0.0, 1.8526), (90.0, 2.5608)] {
            if (deg(swing) - degrees).abs() < 1e-9 {
                agree("off", off, stated, 1e-4);
            }
        }
    }
    // It is right where the bucket line is level and the swing zero, and nowhere else that matters.
    let level = joints([20.0, -80.0, 60.0]);
    let pose = machine.joints_to_tip(&level, Rotor::IDENTITY);
    agree("level", pose.x - a4, machine.chain().wrist(&level).x, EXACT);
}

#[test]
fn koivo_13_18_26_and_28_count_whole_turns_differently() {
    let (machine, k) = zx200();
    let [l2, l3, l4] = MIDDLE;
    let [boom, arm, bucket] = angles(&machine, MIDDLE);
    let h = k.l_fc_m * k.l_fc_m + k.l_ci_m * k.l_ci_m - l3 * l3;
    let root = sqrt(4.0 * k.l_fc_m * k.l_fc_m * k.l_ci_m * k.l_ci_m - h * h);
    let by_13 = 3.0 * PI - k.gamma1_rad - k.gamma2_rad - atan2(root, h);
    let rotor = machine.cylinders_to_joints(&Cylinders { boom: l2, arm: l3, bucket: l4 }).unwrap().bucket;
    let e = four_bar(&ZX200, l4, rotor);
    let by_18 = PI - k.nu2_rad - k.nu3_rad + e.e1 + e.e2 + e.e3;
    println!("(13) {:.3}°, (26) {:.3}°; (18) {:.3}°, ours {:.3}°", deg(by_13), deg(arm), deg(by_18), deg(bucket));
    agree("(13) is one turn above (26)", by_13 - arm, TAU, EXACT);
    agree("(18) is one turn above", by_18 - bucket, TAU, EXACT);
    // (28) with the angle of (13) gives θ4 itself, with that of (26) one turn more: the sum θ_b + θ_dg is the pitch.
    let pitch = boom + arm + bucket;
    agree("(28) after (13)", pitch + (TAU - boom - by_13), bucket, EXACT);
    agree("(28) after (26)", pitch + (TAU - boom - arm), bucket + TAU, EXACT);
    let (bottom, digging) = (rad(35.0), pitch - rad(35.0));
    let corrected = pitch_from_digging_angle(Rotor::from_angle(bottom), Rotor::from_angle(digging));
    assert!(turn_between(corrected.angle(), pitch) < EXACT);
}

#[test]
fn koivo_29_needs_the_quadrant() {
    let (machine, k) = zx200();
    let mut wrong = 0;
    for l in steps(k.bucket.min_m, k.bucket.max_m, 500) {
        let rotor =
            machine.cylinders_to_joints_any_stroke(&Cylinders { boom: 2.4, arm: 2.5, bucket: l }).unwrap().bucket;
        let e = four_bar(&ZX200, l, rotor);
        let e4 = rotor.angle() + PI + k.nu2_rad + k.nu3_rad - e.e3;
        let (y, x) = (k.l_kg_m * k.l_gd_m * sin(e4), k.l_kg_m * k.l_gd_m * cos(e4) - k.l_kl_m * k.l_ld_m);
        let h = k.l_kg_m * k.l_kg_m + k.l_gd_m * k.l_gd_m - k.l_kl_m * k.l_kl_m - k.l_ld_m * k.l_ld_m;
        let root = sqrt(4.0 * (y * y + x * x) - h * h);
        let corrected = atan2(y, x) - atan2(root, h);
        let printed = atan(y / x) - atan(root / h);
        assert!(turn_between(corrected, e.e1) < EXACT, "{l}: {corrected} {}", e.e1);
        // The length is that of (14), which the paper's closing list of equations leaves out.
        let by_14 =
            |e1: f64| sqrt(k.l_jl_m * k.l_jl_m + k.l_kl_m * k.l_kl_m - 2.0 * k.l_jl_m * k.l_kl_m * cos(k.nu1_rad - e1));
        agree("(14)", by_14(corrected), l, EXACT);
        if (x < 0.0) != (h < 0.0) {
            wrong += 1;
            agree("half a turn", turn_between(printed, e.e1), PI, 1e-9);
            if (2.2..2.203).contains(&l) {
                println!("(29) at {l:.3} m: ε1 {:.3}°, not {:.3}°: L {:.4} m", deg(printed), deg(e.e1), by_14(printed));
            }
        }
    }
    println!("(29) wrong at {wrong} of 501 lengths");
    assert_eq!(wrong, 501);
}

#[test]
fn koivo_checked_positions_are_right() {
    let (machine, k) = zx200();
    let again = k.to_pins().unwrap();
    agree("labels and pins", (again.bucket.base - ZX200.bucket.base).norm(), 0.0, EXACT);
    let a = machine.chain().lengths();
    for l in steps(0.0, 1.0, 50) {
        let part = |s: kinematics_core::geometry::Stroke| s.min_m + l * (s.max_m - s.min_m);
        let lengths = [part(k.boom), part(k.arm), part(k.bucket)];
        let [boom, arm, bucket] = angles(&machine, lengths);
        let theta = [rad(40.0), boom, arm, bucket];
        // (2), (3), (5), (8), (9)
        let [b, r, u] = [boom, arm, bucket].map(Rotor::from_angle);
        let joints = Joints { boom: b, arm: r, bucket: u };
        let pose = machine.joints_to_tip(&joints, Rotor::from_angle(theta[0]));
        all_agree("(8)", &apply(&base_to(4, a, theta), [0.0, 0.0, 0.0, 1.0]), &[pose.x, pose.y, pose.z()], EXACT);
        // (10), (12), (14), (16), (17)
        let y = k.l_ab_m * sin(boom + k.beta_rad) + k.l_ah_m;
        let x = k.l_ab_m * cos(boom + k.beta_rad) - k.l_he_m;
        agree("(10)", sqrt(y * y + x * x), lengths[0], EXACT);
        let psi = 3.0 * PI - arm - k.gamma1_rad - k.gamma2_rad;
        let square = k.l_fc_m * k.l_fc_m + k.l_ci_m * k.l_ci_m - 2.0 * k.l_fc_m * k.l_ci_m * cos(psi);
        agree("(12)", sqrt(square), lengths[1], EXACT);
        let e = four_bar(&ZX200, lengths[2], u);
        agree("(16)", e.e1 + e.e2 + e.e3, bucket + TAU - PI + k.nu2_rad + k.nu3_rad, EXACT);
        let left = k.l_kg_m * k.l_kg_m + k.l_gd_m * k.l_gd_m - 2.0 * k.l_kg_m * k.l_gd_m * cos(e.e2);
        let right = k.l_kl_m * k.l_kl_m + k.l_ld_m * k.l_ld_m - 2.0 * k.l_kl_m * k.l_ld_m * cos(e.e1);
        agree("(17)", left, right, EXACT);
        // (20), (22), (24)
        let p = bucket_pin(&machine, theta[0], [boom, arm, bucket].map(deg));
        let d = cos(theta[0]) * p[0] + sin(theta[0]) * p[1] - a[0];
        agree("(22) 1", d * cos(boom) + p[2] * sin(boom) - a[1], a[2] * cos(arm), EXACT);
        agree("(22) 2", -d * sin(boom) + p[2] * cos(boom), a[2] * sin(arm), EXACT);
        agree("(22) 3", sin(theta[0]) * p[0] - cos(theta[0]) * p[1], 0.0, EXACT);
        let right = p[2] * p[2] + d * d + a[1] * a[1] - a[2] * a[2];
        agree("(24)", 2.0 * a[1] * (p[2] * sin(boom) + d * cos(boom)), right, EXACT);
        let back = machine.chain().joints_from_wrist(Vec2::new(d + a[0], p[2]), pose.plane.pitch).unwrap();
        agree("(25)", back.boom.angle(), boom, 1e-8);
    }
}
