//! A path of straight segments: the tip keeps to it with valves that are not quite known and a pump that gives too little.

use cross_tests::rig::{Rig, scenario};
use cross_tests::ways::{Across, across_path, run};
use firmware::{Ecu, Fault, Request};
use hil_sim::run::{Log, Row};
use hil_sim::scenario::Scenario;

/// The plant as calibration leaves it: gain ± 3 %, dead band ± 1 % of full scale, dead time ± 20 ms, of the cylinders in turn.
fn off_calibration(scenario: &mut Scenario, case: u32) {
    for (index, model) in scenario.plant.iter_mut().enumerate() {
        let sign = |bit: usize| if (case >> ((bit + index) % 6)) & 1 == 1 { 1.0 } else { -1.0 };
        model.full_speed = model.full_speed.map(|speed| speed * (1.0 + 0.03 * sign(0)));
        model.dead_band = [model.dead_band[0] + 0.01 * sign(1), model.dead_band[1] + 0.01 * sign(2)];
        model.dead_time_s += 0.02 * if case & 1 == 1 { 1.0 } else { -1.0 };
    }
}

fn worst(name: &str, speed_mps: f64) -> (f64, f64) {
    let (mut square_sum, mut max_m) = (0.0, 0.0);
    for case in 0..16 {
        let mut scenario = scenario(name);
        off_calibration(&mut scenario, case);
        scenario.parameters.path.as_mut().expect("a path").speed_mps = speed_mps;
        scenario.duration_s *= 0.5 / speed_mps;
        let log = run(&scenario, u64::from(case));
        assert!(log.faults.is_empty(), "{name}, case {case}: {:?}", log.faults);
        let Across { rms_m, max_m: max, .. } = across_path(&scenario, &log);
        println!("{name} at {speed_mps} m/s, case {case}: {:.1} mm RMS, {:.1} mm max", rms_m * 1e3, max * 1e3);
        square_sum += rms_m * rms_m;
        max_m = f64::max(max_m, max);
    }
    (libm::sqrt(square_sum / 16.0), max_m)
}

#[test]
fn levelling_stays_within_ten_millimetres_rms_with_valves_off_their_calibration() {
    for speed_mps in [0.3, 0.5] {
        let (rms_m, max_m) = worst("level-zx200", speed_mps);
        println!("all: {:.1} mm RMS, {:.1} mm max", rms_m * 1e3, max_m * 1e3);
        assert!(rms_m <= 0.010 && max_m <= 0.030, "{speed_mps}: {rms_m} {max_m}");
    }
}

/// When the path was over, s.
fn took(log: &Log) -> f64 {
    log.rows.iter().filter(|row| row.outputs.dig_tick > 0).map(|row| row.time_s).fold(0.0, f64::max)
}

#[test]
fn half_the_pump_flow_costs_time_and_not_the_path() {
    for name in ["level-zx200", "square-zx200"] {
        let mut scenario = scenario(name);
        scenario.duration_s = 40.0;
        off_calibration(&mut scenario, 11);
        let full = run(&scenario, 1);
        scenario.parameters.motion.law.as_mut().expect("a law").flow_m3ps = 0.5 * 200.0 / 60e3;
        let half = run(&scenario, 1);
        assert!(full.faults.is_empty() && half.faults.is_empty());
        let (a, b) = (across_path(&scenario, &full), across_path(&scenario, &half));
        println!("{name}: {a:.4?} in {:.1} s, {b:.4?} in {:.1} s", took(&full), took(&half));
        assert!(took(&half) > 1.2 * took(&full), "the flow was no limit");
        // Slower, the tip may keep nearer to its path.
        assert!(b.rms_m <= 1.1 * a.rms_m && b.max_m <= 1.1 * a.max_m, "{a:?} {b:?}");
    }
}

#[test]
fn asked_speeds_stay_within_flow_and_full_speeds() {
    let mut scenario = scenario("square-zx200");
    scenario.duration_s = 40.0;
    let law = scenario.parameters.motion.law.as_mut().expect("a law");
    law.flow_m3ps = 100.0 / 60e3;
    let (areas, flow) = (law.areas_m2, law.flow_m3ps);
    let log = run(&scenario, 1);
    let mut most = 0.0_f32;
    for row in &log.rows {
        let [_, cylinders @ ..] = row.outputs.speeds.to_array();
        let taken = cylinders.iter().zip(areas).map(|(v, [head, rod])| if *v > 0.0 { v * head } else { -v * rod });
        most = f32::max(most, taken.sum());
    }
    println!("at most {:.1} l/min of {:.1}", most * 60e3, flow * 60e3);
    assert!(most > 0.85 * flow && most <= 1.0001 * flow);
}

#[test]
fn at_the_end_the_coils_are_still() {
    for case in [0, 5, 11] {
        let mut scenario = scenario("level-zx200");
        off_calibration(&mut scenario, case);
        scenario.duration_s = 14.0;
        let log = run(&scenario, 1);
        let after = log.rows.iter().filter(|row| row.time_s > 10.0);
        assert!(after.map(|row| row.outputs).all(|outputs| outputs.currents == [[0.0; 2]; 4]), "case {case}");
    }
}

#[test]
fn slope_wall_and_square_are_followed_like_the_level() {
    for name in ["slope-zx200", "trench-zx200", "square-zx200"] {
        let mut scenario = scenario(name);
        off_calibration(&mut scenario, 6);
        let log = run(&scenario, 1);
        assert!(log.faults.is_empty() && log.stop_hits.is_empty(), "{name}: {:?}", log.faults);
        let off = across_path(&scenario, &log);
        println!("{name}: {:.1} mm RMS, {:.1} mm max", off.rms_m * 1e3, off.max_m * 1e3);
        assert!(off.rms_m <= 0.010 && off.max_m <= 0.030, "{name}: {off:?}");
    }
}

/// The cycle of this scenario ends without a fault in time, swings to 90° and back within these angles, and keeps within this of its path.
fn assert_cycle(name: &str, [there_deg, back_deg]: [f64; 2], most_m: f64) {
    let scenario = scenario(name);
    let log = run(&scenario, 1);
    assert!(log.faults.is_empty() && log.stop_hits.is_empty(), "{:?} {:?}", log.faults, log.stop_hits);
    let degrees = |row: &Row| row.swing.expect("a swing").angle().to_degrees();
    let farthest = log.rows.iter().map(degrees).fold(0.0, f64::max);
    let last = log.rows.last().expect("rows");
    let off = across_path(&scenario, &log);
    println!("swung to {farthest:.2}°, back to {:.2}°, {off:?}, {:.1} s", degrees(last), took(&log));
    assert!((farthest - 90.0).abs() < there_deg && degrees(last).abs() < back_deg);
    assert!(took(&log) < scenario.duration_s - 1.0 && off.max_m < most_m);
}

#[test]
fn a_cycle_digs_swings_dumps_and_comes_back() {
    assert_cycle("load-and-dump-zx200", [1.5, 1.0], 0.03);
}

#[test]
fn the_cycle_is_done_on_the_machines_own_hydraulics_too() {
    assert_cycle("load-and-dump-zx200-hydraulic", [4.0, 1.5], 0.2);
}

#[test]
fn away_from_its_first_knot_a_path_is_refused_and_beyond_the_strokes_it_has_no_controller() {
    let mut parameters = scenario("level-zx200").parameters;
    let mut rig = Rig::standing(&parameters, &[2.4, 2.2, 2.3]);
    rig.start();
    rig.request = Request::Path;
    assert_eq!(rig.tick().fault, Some(Fault::NotAtStart));
    parameters.path.as_mut().expect("a path").knots[1].as_mut().expect("a knot").x_m = 2.0;
    let error = Ecu::new(&parameters).expect_err("a refusal").to_string();
    assert!(error.contains("`path` on segment 0"), "{error}");
}
