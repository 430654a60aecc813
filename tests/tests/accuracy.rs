//! The promised accuracy, measured over the whole stroke of every machine and held to `docs/accuracy.md`.
//!
//! `cargo test -p cross-tests --test accuracy -- --nocapture` prints every number of that page.

use cross_tests::machines::{self, Named};
use cross_tests::measure::{Bench, Worst, worst_of};
use cross_tests::oracle::{apart, direction, intersection};
use cross_tests::stated::swing;
use cross_tests::stated::{hold, row};
use cross_tests::sweep::{Random, lengths};
use cross_tests::wide::{Point, Wide};
use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinders, Machine, PinGeometry, Real, Rotor, STROKE_TOLERANCE_M};

fn machine(name: &str) -> PinGeometry {
    let found = machines::all().unwrap().into_iter().find(|(one, _): &Named| *one == name);
    found.unwrap().1
}

fn print(name: &str, precision: &str, what: &str, worst: &[Worst]) {
    for (one, cylinder) in worst.iter().zip(["boom", "arm", "bucket"]) {
        let of = if worst.len() == 1 { "" } else { cylinder };
        println!("{name} {precision} {what} {of}: {one}");
    }
}

/// Measures one machine in one precision; `promise` is the promised tip error relative to reach.
fn measure<T: Real>(name: &str, precision: &str, promise: f64) {
    let bench = Bench::<T>::new(&machine(name));
    let reach = machine(name).reach_m();
    println!(
        "{name} {precision}: reach {reach:.2} m, {} poses, {:?} lengths",
        bench.pose_count(),
        bench.length_counts()
    );
    let joints = bench.joints();
    let [forward, pitch] = bench.forward();
    let inverse = bench.inverse();
    let round_trip = bench.round_trip();
    let tip_round_trip = bench.tip_round_trip();
    print(name, precision, "joint rotor [rad]", &joints);
    print(name, precision, "cylinders → tip [of reach]", &[forward]);
    print(name, precision, "cylinders → pitch rotor [rad]", &[pitch]);
    print(name, precision, "tip → cylinders [m]", &inverse);
    print(name, precision, "cylinders → tip → cylinders [m]", &round_trip);
    print(name, precision, "tip → cylinders → tip [of reach]", &[tip_round_trip]);
    let (refused, excess) = bench.refused_round_trips();
    println!("{name} {precision} round trips refused at an end of a stroke: {refused}, by at most {excess}");
    let [joints, inverse, round_trip] = [joints, inverse, round_trip].map(|of| worst_of(&of));
    println!(
        "| {name} | {precision} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |",
        joints.value, forward.value, inverse.value, round_trip.value, tip_round_trip.value
    );
    // What is refused missed the end by no more than the round trip's own error: never in f64, nearly never in f32.
    assert!(excess.value <= round_trip.value && (round_trip.value > STROKE_TOLERANCE_M || refused == 0), "{excess}");
    assert!(forward.value <= promise, "{name} {precision}: tip error {forward}, promised {promise:e} of reach");
    let stated = row(name, precision);
    hold("joint rotors", joints.value, stated.joints);
    hold("cylinders → tip", forward.value, stated.forward);
    hold("tip → cylinders", inverse.value, stated.inverse);
    hold("cylinders → tip → cylinders", round_trip.value, stated.round_trip);
    hold("tip → cylinders → tip", tip_round_trip.value, stated.tip_round_trip);
}

/// The promise to the ECU: 1e-6 of the machine's reach.
const F32: f64 = 1e-6;
const F64: f64 = 1e-12;

#[test]
fn frankel_in_f32_keeps_its_promise_over_the_whole_stroke() {
    measure::<f32>("frankel", "f32", F32);
}

#[test]
fn frankel_in_f64_keeps_its_promise_over_the_whole_stroke() {
    measure::<f64>("frankel", "f64", F64);
}

#[test]
fn exact_mini_in_f32_keeps_its_promise_over_the_whole_stroke() {
    measure::<f32>("exact-mini", "f32", F32);
}

#[test]
fn exact_mini_in_f64_keeps_its_promise_over_the_whole_stroke() {
    measure::<f64>("exact-mini", "f64", F64);
}

#[test]
fn zx120_in_f32_keeps_its_promise_over_the_whole_stroke() {
    measure::<f32>("zx120", "f32", F32);
}

#[test]
fn zx120_in_f64_keeps_its_promise_over_the_whole_stroke() {
    measure::<f64>("zx120", "f64", F64);
}

#[test]
fn zx200_in_f32_keeps_its_promise_over_the_whole_stroke() {
    measure::<f32>("zx200", "f32", F32);
}

#[test]
fn zx200_in_f64_keeps_its_promise_over_the_whole_stroke() {
    measure::<f64>("zx200", "f64", F64);
}

/// A length inside the stroke, half of them crowding towards its ends.
fn any_length(stroke: Stroke, random: &mut Random) -> f32 {
    let part = random.unit();
    let part = if random.bits() & 1 == 0 { part } else { part.powi(9) };
    let part = if random.bits() & 1 == 0 { part } else { 1.0 - part };
    (stroke.min_m + part * (stroke.max_m - stroke.min_m)) as f32
}

#[test]
fn a_random_search_in_f32_finds_nothing_beyond_what_is_stated() {
    // Against the f64 maps, whose own error above is a millionth of f32's: cheap enough for millions of poses.
    const POSES: u32 = 2_000_000;
    for (name, geometry) in machines::all().unwrap() {
        let (single, double) = (Machine::<f32>::new(&geometry).unwrap(), Machine::<f64>::new(&geometry).unwrap());
        let mut random = Random::new(99);
        let (mut forward, mut round_trip, mut refused) = (0.0f64, 0.0f64, 0);
        for _ in 0..POSES {
            let [boom, arm, bucket] = [geometry.boom.stroke, geometry.arm.stroke, geometry.bucket.stroke]
                .map(|stroke| any_length(stroke, &mut random));
            let tip = single.cylinders_to_tip(&Cylinders { boom, arm, bucket }, Rotor::IDENTITY).unwrap().plane;
            let sent = [boom, arm, bucket].map(f64::from);
            let wide = Cylinders { boom: sent[0], arm: sent[1], bucket: sent[2] };
            let exact = double.cylinders_to_tip(&wide, Rotor::IDENTITY).unwrap().plane;
            let off = libm::hypot(f64::from(tip.reach) - exact.reach, f64::from(tip.height) - exact.height);
            forward = forward.max(off / geometry.reach_m());
            let joints = single.tip_to_joints(&tip).unwrap();
            let back = single.joints_to_cylinders_any_stroke(&joints).unwrap();
            for (back, sent) in [back.boom, back.arm, back.bucket].into_iter().zip(sent) {
                round_trip = round_trip.max((f64::from(back) - sent).abs());
            }
            refused += u32::from(single.tip_to_cylinders(&tip).is_err());
        }
        println!(
            "{name} f32, {POSES} random poses: cylinders → tip {forward:.2e} of reach, cylinders → tip → cylinders \
             {round_trip:.2e} m, {refused} refused on the way back, at an end of a stroke"
        );
        let stated = row(name, "f32");
        assert!(forward <= stated.forward, "{name}: {forward:e}, stated {:e}", stated.forward);
        assert!(round_trip <= stated.round_trip, "{name}: {round_trip:e}, stated {:e}", stated.round_trip);
        assert!(refused == 0 || round_trip > STROKE_TOLERANCE_M, "{name}: {refused}");
        assert!(refused < POSES / 10_000, "{name}: {refused}");
    }
}

fn measure_swing<T: Real>(precision: &str) {
    let geometry = machine("frankel");
    let machine = Machine::<T>::new(&geometry).unwrap();
    let cylinder = machine.swing_cylinder().unwrap();
    let pins = geometry.swing.unwrap();
    let [base, rod] = [pins.base, pins.rod].map(|v| Point::new(v.x, v.z));
    let mut worst = Worst::default();
    for length in lengths::<T>(pins.stroke, &mut Random::new(7)) {
        let rod_eye = intersection(Point::new(0.0, 0.0), rod.norm(), base, Wide::from_f64(length.to_f64()), true);
        let found = cylinder.rotor(length).unwrap();
        let error = apart(direction(found), rod_eye.turned_back(rod).unit());
        worst = worst_of(&[worst, Worst { value: error, at: [length.to_f64(); 3] }]);
    }
    println!("frankel swing rotor, {precision}: {:.2e} rad at {} m", worst.value, worst.at[0]);
    hold("swing rotor", worst.value, swing(precision));
}

#[test]
fn frankels_swing_cylinder_is_as_accurate_over_its_stroke() {
    measure_swing::<f32>("f32");
    measure_swing::<f64>("f64");
}

#[test]
fn the_sweep_comes_as_near_to_frankels_dead_point_as_the_boom_does() {
    let geometry = machine("frankel");
    let pins = geometry.boom;
    let straight = pins.base.norm() + pins.rod.norm();
    let lengths = lengths::<f32>(pins.stroke, &mut Random::new(1));
    let longest = f64::from(*lengths.last().unwrap());
    let (nearest, end) = (straight - longest, straight - pins.stroke.max_m);
    println!("frankel boom: straight at {straight} m, the sweep stops {nearest:.2e} m short, the stroke {end:.2e} m");
    assert!(end < 0.0042 * 0.0254 && nearest < end);
    let machine = Machine::<f64>::new(&geometry).unwrap();
    let [arm, bucket] = [geometry.arm.stroke.max_m, geometry.bucket.stroke.max_m];
    let [at_end, before] = [0.0, 1e-9].map(|short| {
        let boom = pins.stroke.max_m - short;
        machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap().boom.angle()
    });
    let slope = 1e-3 * (at_end - before).abs() / 1e-9;
    println!("frankel boom at its longest: {slope:.3} rad/mm");
    assert!((slope - 0.15).abs() < 0.005);
    assert!(lengths.iter().filter(|l| straight - f64::from(**l) < 1.2 * end).count() > 64);
}
