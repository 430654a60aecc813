//! Frankel 2003's dig: the derivation and `dig.m` as printed, against the dig as its text and sketches mean it.

use cross_tests::golden::Golden;
use cross_tests::machines::INCH_M;
use cross_tests::papers::frankel::dig;
use cross_tests::papers::{agree, all_agree, deg, steps};
use firmware::dig::{Dig, DigParameters};
use kinematics_core::Rotor;
use libm::{atan2, cos, hypot, sin};

/// What the corrected forms have to keep to: in or degrees.
const EXACT: f64 = 1e-9;

/// The time, x and z of the published dig's arguments with `n` samples.
fn published(scoop: f64, n: usize) -> Vec<[f64; 4]> {
    dig(90.0, 60.0, scoop, n)
}

#[test]
fn frankel_dig_matches_the_published_rows() {
    let golden = Golden::read("frankel_dig").columns(["t_s", "tip_x_in", "tip_z_in", "phi_seed_deg"]);
    for (row, golden) in published(45.0, 200).iter().zip(&golden) {
        for (found, exact) in row.iter().zip(golden) {
            agree("dig", *found, *exact, 1e-6);
        }
    }
    assert_eq!(golden.len(), 200);
}

/// The dig as its text and sketches mean it: t (s) → x, z (in) and the pitch less half a turn.
fn meant(time: f64) -> [f64; 3] {
    let tip = Dig::<f64>::new(&DigParameters {
        start_x_m: 30.0 * INCH_M,
        start_z_m: 2.0 * INCH_M,
        ground_z_m: -13.0 * INCH_M,
        reach_m: 90.0 * INCH_M,
        plunge_m: 60.0 * INCH_M,
        scoop_radius_m: 45.0 * INCH_M,
        scoop_end_deg: -165.0,
        pitch_deg: [160.0, 320.0, 300.0, 160.0],
        until_s: [4.0, 8.0, 20.0],
        hold_lead_s: 0.0,
    })
    .tip(time);
    let phi = tip.pitch * Rotor { cos: -1.0, sin: 0.0 };
    [tip.reach / INCH_M, tip.height / INCH_M, deg(phi.angle())]
}

#[test]
fn frankel_dig_never_uses_scoop() {
    assert_eq!(published(45.0, 200), published(10.0, 200));
    let radius = |x: f64, z: f64, centre: [f64; 2]| hypot(x - centre[0], z - centre[1]);
    for row in published(45.0, 200).iter().filter(|row| row[0] >= 8.0) {
        agree("radius of the printed arc", radius(row[1], row[2], [54.0, -18.0]), 55.317, 1e-3);
    }
    // The arc of radius `scoop` that begins at the plunge's end in the same direction.
    let direction = atan2(-42.0, 36.0);
    let centre = [90.0 - 45.0 * cos(direction), -60.0 - 45.0 * sin(direction)];
    for time in steps(8.0, 20.0, 50) {
        let [x, z, _] = meant(time);
        agree("radius as meant", radius(x, z, centre), 45.0, EXACT);
    }
}

#[test]
fn frankel_dig_plunges_at_the_last_sample_of_the_reach() {
    for (n, x) in [(100, 87.0), (200, 88.5), (500, 89.4), (1000, 89.7)] {
        let held = published(45.0, n).iter().find(|row| row[0] > 6.0).unwrap()[1];
        agree("printed", held, x, 1e-9);
    }
    for time in steps(4.0, 8.0, 20) {
        agree("as meant", meant(time)[0], 90.0, EXACT);
    }
    // As printed, x jumps where the scoop begins.
    let rows = published(45.0, 200);
    let [before, after] = [7.95, 8.05].map(|t| rows.iter().find(|row| row[0] > t).unwrap()[1]);
    println!("from {before} to {after} in within one sample");
    agree("before", before, 88.5, 1e-9);
    assert!(after > 89.0);
}

#[test]
fn frankel_dig_scoops_for_one_sample_where_the_reach_ends() {
    for n in [10, 20, 40, 80] {
        let at = *published(45.0, n).iter().find(|row| row[0] == 4.0).unwrap();
        println!("N = {n}: {at:?}");
        all_agree("printed", &at[1..], &[108.3257, -28.4270, 166.6667], 1e-4);
    }
    all_agree("as meant", &meant(4.0), &[90.0, -13.0, 140.0], EXACT);
}

#[test]
fn frankel_dig_ends_one_sample_early() {
    let last = *published(45.0, 200).last().unwrap();
    println!("last row {last:?}");
    agree("t", last[0], 19.9, 1e-9);
    agree("φ", last[3], -18.8333, 1e-4);
    agree("φ as meant", meant(20.0)[2], -20.0, EXACT);
}

#[test]
fn frankel_z_of_the_reach_rises() {
    // z0 = 2, ground = 13 below: the derivation's sign, and the program's.
    let (z0, ground, t1) = (2.0, 13.0, 4.0);
    let printed = |t: f64| z0 + (z0 - ground) / t1 * t;
    let corrected = |t: f64| z0 - (z0 + ground) / t1 * t;
    println!("z(t1) printed {} in", printed(t1));
    agree("printed", printed(t1), -9.0, EXACT);
    agree("corrected, where the plunge begins", corrected(t1), -ground, EXACT);
    for row in published(45.0, 200).iter().filter(|row| row[0] < 4.0 - 1e-9) {
        agree("as meant", meant(row[0])[1], corrected(row[0]), EXACT);
        agree("the program", corrected(row[0]), row[2], EXACT);
    }
}
