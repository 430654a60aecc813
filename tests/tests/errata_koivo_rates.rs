//! Koivo 1994's velocities, (30)–(37): as printed and as corrected, against differences of the maps.

use core::f64::consts::PI;

use cross_tests::machines::ZX200;
use cross_tests::papers::koivo::{distances, four_bar};
use cross_tests::papers::{agree, all_agree, rad, rate, steps};
use kinematics_core::distances::KoivoDistances;
use kinematics_core::{Joints, Machine, Rotor};
use libm::{cos, sin};

/// What the corrected forms have to keep to: m/rad.
const EXACT: f64 = 1e-9;
const POSE: [f64; 3] = [20.0, -80.0, -60.0];

fn zx200() -> (Machine<f64>, KoivoDistances) {
    (Machine::new(&ZX200).unwrap(), distances(&ZX200))
}

fn joints(degrees: [f64; 3]) -> Joints<f64> {
    let [boom, arm, bucket] = degrees.map(Rotor::from_degrees);
    Joints { boom, arm, bucket }
}

/// Base to tip at swing and joints, rad: position, and the bucket's x axis.
fn tip_and_turn(machine: &Machine<f64>, theta: [f64; 4]) -> [f64; 12] {
    let [swing, boom, arm, bucket] = theta.map(Rotor::from_angle);
    let matrix = machine.chain().base_to_tip(swing, &Joints { boom, arm, bucket });
    core::array::from_fn(|i| matrix[i % 3][i / 3])
}

/// Tip velocity and angular velocity in the base frame when joint `i` turns at 1 rad/s, by differences.
fn twist(machine: &Machine<f64>, theta: [f64; 4], i: usize) -> [f64; 6] {
    let moved = |t: f64| {
        let mut theta = theta;
        theta[i] += t;
        tip_and_turn(machine, theta)
    };
    let (here, speed) = (moved(0.0), rate(moved, 0.0));
    // Ω = Ṙ·Rᵀ.
    let omega = |r: usize, c: usize| (0..3).map(|k| speed[3 * k + r] * here[3 * k + c]).sum::<f64>();
    [speed[9], speed[10], speed[11], omega(2, 1), omega(0, 2), omega(1, 0)]
}

/// (31) as printed.
fn jacobian(a: [f64; 4], theta: [f64; 4]) -> [[f64; 4]; 4] {
    let [t1, t2, t3, t4] = theta;
    let (c1, s1) = (cos(t1), sin(t1));
    let (x4, z4) = (a[3] * cos(t2 + t3 + t4), a[3] * sin(t2 + t3 + t4));
    let (x3, z3) = (x4 + a[2] * cos(t2 + t3), z4 + a[2] * sin(t2 + t3));
    let (x2, z2) = (x3 + a[1] * cos(t2), z3 + a[1] * sin(t2));
    let a14 = x2 + a[0];
    [
        [-s1 * a14, -c1 * z2, -c1 * z3, -c1 * z4],
        [c1 * a14, -s1 * z2, -s1 * z3, -s1 * z4],
        [0.0, x2, x3, x4],
        [0.0, 1.0, 1.0, 1.0],
    ]
}

#[test]
fn koivo_31_calls_the_pitch_rate_omega_y() {
    let (machine, _) = zx200();
    let a = machine.chain().lengths();
    for swing in [0.0, 30.0, 90.0, 150.0] {
        let theta = [swing, POSE[0], POSE[1], POSE[2]].map(rad);
        let printed = jacobian(a, theta);
        for i in 0..4 {
            let exact = twist(&machine, theta, i);
            let column = printed.map(|row| row[i]);
            all_agree("(31) rows 1 to 3", &column[..3], &exact[..3], EXACT);
            let corrected = if i == 0 { 0.0 } else { -cos(theta[0]) };
            agree("ω_oy", corrected, exact[4], EXACT);
            if i > 0 {
                assert!((column[3] - exact[4]).abs() > 0.1, "swing {swing}");
                println!("(31) row 4 at swing {swing}°: {}, not {:.6}", column[3], exact[4]);
                // What row 4 is: the rate of φ about the boom's axis (s1, −c1, 0).
                agree("pitch rate", exact[3] * sin(theta[0]) - exact[4] * cos(theta[0]), 1.0, EXACT);
            }
        }
    }
}

#[test]
fn koivo_37_lacks_the_rate_of_its_sensor() {
    let (machine, k) = zx200();
    let at = |bucket: f64| {
        let mut j = joints(POSE);
        j.bucket = Rotor::from_angle(bucket);
        let l = machine.joints_to_cylinders_any_stroke(&j).unwrap().bucket;
        let e = four_bar(&ZX200, l, j.bucket);
        [l, e.e1, e.e2, e.e3]
    };
    for degrees in steps(-130.0, 30.0, 32) {
        let [l, e1, e2, e3] = at(rad(degrees));
        let [l_rate, e1_rate, _, e3_rate] = rate(at, rad(degrees));
        let ratio = k.l_kl_m * k.l_ld_m * sin(e1) / (k.l_kg_m * k.l_gd_m * sin(e2));
        let by_34 = |rate: f64| -k.l_jl_m * k.l_kl_m * sin(k.nu1_rad - e1) / l * rate;
        // Without a rate of ε3 there is only zero to put in.
        let without = 1.0 / (1.0 + ratio);
        let with = (1.0 - e3_rate) / (1.0 + ratio);
        let corrected = k.l_gd_m * sin(e2) / (k.l_kl_m * sin(e3));
        agree("(37) with the sensor's rate", with, e1_rate, 1e-8);
        agree("without ε3's rate", corrected, e1_rate, 1e-8);
        agree("(34)", by_34(corrected), l_rate, 1e-8);
        println!("(37), (34) at {degrees}° without ε̇3: {:.4} m/rad, not {l_rate:.4}", by_34(without));
        if degrees == -60.0 {
            agree("printed", by_34(without), -0.2643, 1e-4);
            agree("exact", l_rate, -0.3878, 1e-4);
        }
    }
}

#[test]
fn koivo_checked_rates_of_boom_and_arm_are_right() {
    let (machine, k) = zx200();
    let lengths = |boom: f64, arm: f64| {
        let mut j = joints(POSE);
        (j.boom, j.arm) = (Rotor::from_angle(boom), Rotor::from_angle(arm));
        let c = machine.joints_to_cylinders_any_stroke(&j).unwrap();
        [c.boom, c.arm]
    };
    for part in steps(0.0, 1.0, 20) {
        let (boom, arm) = (rad(-43.0 + part * 112.0), rad(-153.0 + part * 118.0));
        let [l_be, l_fi] = lengths(boom, arm);
        let (s, c) = (sin(boom + k.beta_rad), cos(boom + k.beta_rad));
        let by_32 = k.l_ab_m * ((k.l_ab_m * s + k.l_ah_m) * c - (k.l_ab_m * c - k.l_he_m) * s) / l_be;
        agree("(32)", by_32, rate(|t| lengths(t, arm), boom)[0], EXACT);
        let psi = 3.0 * PI - arm - k.gamma1_rad - k.gamma2_rad;
        let by_33 = -k.l_fc_m * k.l_ci_m * sin(psi) / l_fi;
        agree("(33)", by_33, rate(|t| lengths(boom, t), arm)[1], EXACT);
    }
}
