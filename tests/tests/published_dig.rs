//! Frankel's published dig against the travel limits, through our own maps: what the planner must refuse.

use cross_tests::golden::Golden;
use cross_tests::machines::{INCH_M, frankel_distances};
use kinematics_core::{Machine, PlaneTip, Rotor};

/// Time of each row [s] and the cylinders it needs [in].
fn rows() -> Vec<(f64, [f64; 3])> {
    let machine = Machine::<f64>::new(&frankel_distances().to_pins().unwrap()).unwrap();
    let columns = Golden::read("frankel_dig").columns(["t_s", "tip_x_in", "tip_z_in", "phi_seed_deg"]);
    let rows = columns.into_iter().map(|[time, x, z, phi]| {
        let tip = PlaneTip { reach: x * INCH_M, height: z * INCH_M, pitch: Rotor::from_degrees(phi + 180.0) };
        let joints = machine.tip_to_joints(&tip).unwrap();
        let found = machine.joints_to_cylinders_any_stroke(&joints).unwrap();
        (time, [found.boom, found.arm, found.bucket].map(|length| length / INCH_M))
    });
    rows.collect()
}

#[test]
fn the_arm_cylinder_leaves_its_travel_at_nine_rows_at_the_start_and_the_end() {
    let outside: Vec<(f64, f64)> =
        rows().into_iter().map(|(time, [_, arm, _])| (time, arm)).filter(|(_, arm)| *arm > 41.9298).collect();
    println!("arm beyond 41.9298 in: {outside:.4?}");
    assert_eq!(outside.len(), 9);
    assert!(outside.iter().all(|(time, _)| *time <= 0.2 + 1e-9 || *time >= 19.4 - 1e-9));
    let longest = outside.iter().map(|(_, arm)| *arm).fold(0.0, f64::max);
    assert!((longest - 42.68).abs() < 0.005, "{longest}");
    assert!(rows().iter().all(|(_, [_, arm, _])| *arm > 27.6990));
}

#[test]
fn the_boom_cylinder_is_below_the_calculated_minimum_at_37_rows_but_above_the_listed_one() {
    let boom: Vec<f64> = rows().into_iter().map(|(_, [boom, ..])| boom).collect();
    let shortest = boom.iter().copied().fold(f64::INFINITY, f64::min);
    println!(
        "boom below 30.7529 in at {} rows, shortest {shortest:.4} in",
        boom.iter().filter(|l| **l < 30.7529).count()
    );
    assert_eq!(boom.iter().filter(|length| **length < 30.7529).count(), 37);
    assert!(shortest > 29.0 && boom.iter().all(|length| *length < 46.5434));
}

#[test]
fn the_bucket_cylinder_of_the_last_fourteen_rows_is_short_and_inside_its_travel() {
    let all = rows();
    let (first, last) = all.split_at(all.len() - 14);
    assert!(last.iter().all(|(time, _)| *time >= 18.6 - 1e-9) && first.iter().all(|(time, _)| *time < 18.6 - 1e-9));
    let bucket: Vec<f64> = last.iter().map(|(_, [.., bucket])| *bucket).collect();
    println!("bucket of the last 14 rows: {bucket:.4?} in");
    assert!(bucket.iter().all(|length| (30.42..=30.65).contains(&((length * 100.0).round() / 100.0))));
    assert!(all.iter().all(|(_, [.., bucket])| (22.0242..=38.6144).contains(bucket)));
}

#[test]
fn the_strict_map_refuses_exactly_the_rows_outside_the_travel() {
    let machine = Machine::<f64>::new(&frankel_distances().to_pins().unwrap()).unwrap();
    let columns = Golden::read("frankel_dig").columns(["tip_x_in", "tip_z_in", "phi_seed_deg"]);
    let refused = columns.into_iter().filter(|[x, z, phi]| {
        let tip = PlaneTip { reach: x * INCH_M, height: z * INCH_M, pitch: Rotor::from_degrees(phi + 180.0) };
        machine.tip_to_cylinders(&tip).is_err()
    });
    assert_eq!(refused.count(), 9);
}
