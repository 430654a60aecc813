//! Scenarios on the host: the dig is followed closely, faults end in standstill, bad files are refused by field.

use std::path::Path;

use cross_tests::rig::{is_safe, scenario, scenario_names, workspace};
use firmware::valve::coil_fault::{CoilFault, FaultyCoil};
use firmware::valve::interlock::Side;
use firmware::{Fault, State};
use hil_sim::place::Host;
use hil_sim::run::{Log, Outcome, Run, Summary};
use hil_sim::scenario::Scenario;
use kinematics_core::Cylinder;

fn run(scenario: &Scenario, seed: u64) -> (Log, Summary) {
    let mut host = Host::new(&scenario.parameters).expect("accepted parameters");
    let log = Run::new(scenario, seed).expect("an accepted dig").complete(&mut host, |_, _| {}).expect("a host run");
    let summary = Summary::of(scenario, "host", seed, &log, None);
    (log, summary)
}

#[test]
fn every_dig_is_followed_within_thirty_millimetres_rms_whatever_the_noise() {
    for name in ["dig", "dig-zx200", "dig-exact-mini"] {
        for seed in 1..=5 {
            let (_, summary) = run(&scenario(name), seed);
            let (rms, max) = (summary.tip_error_rms_m.unwrap(), summary.tip_error_max_m.unwrap());
            println!("{name}, seed {seed}: {:.2} mm RMS, {:.2} mm max", rms * 1e3, max * 1e3);
            assert!(summary.dig_completed == Some(true) && summary.outcome() == Outcome::Done, "{name}: {summary:?}");
            assert!(rms <= 0.030, "{name}, seed {seed}: {rms}");
        }
    }
}

#[test]
fn without_preview_the_same_dig_is_followed_much_worse() {
    let (_, ours) = run(&scenario("dig"), 1);
    let mut blind = scenario("dig");
    blind.parameters.motion.preview_s = 0.0;
    let (_, without) = run(&blind, 1);
    let ratio = without.tip_error_rms_m.unwrap() / ours.tip_error_rms_m.unwrap();
    println!("without preview {ratio:.1} times the error");
    assert!(ratio > 2.0, "{ratio}");
}

#[test]
fn a_seed_repeats_a_run_bit_for_bit_and_another_does_not() {
    let mut scenario = scenario("dig");
    scenario.duration_s = 2.0;
    assert_eq!(run(&scenario, 3).0.output_hash, run(&scenario, 3).0.output_hash);
    assert_ne!(run(&scenario, 3).0.output_hash, run(&scenario, 4).0.output_hash);
}

#[test]
fn the_estimate_of_the_tip_is_not_what_the_error_is_taken_from() {
    // A sensor that reads short makes the controller's own estimate agree with the reference while the true tip is off.
    let mut scenario = scenario("dig");
    scenario.sensor_noise_m = 0.0;
    let honest = run(&scenario, 1).1.tip_error_rms_m.unwrap();
    for sensor in &mut scenario.parameters.cylinder_sensors {
        sensor.min_code += 1400;
        sensor.max_code += 1400;
    }
    let (log, summary) = run_with_true_sensors(&scenario);
    let estimated: f64 = log
        .rows
        .iter()
        .filter_map(|row| {
            let [x, z] = row.reference?;
            let plane = row.outputs.pose.plane;
            Some(libm::hypot(f64::from(plane.reach) - x, f64::from(plane.height) - z))
        })
        .fold(0.0, |worst, e| if e > worst { e } else { worst });
    println!("true {:.1} mm RMS, estimate at most {:.1} mm", summary.tip_error_rms_m.unwrap() * 1e3, estimated * 1e3);
    assert!(summary.tip_error_rms_m.unwrap() > 3.0 * honest);
}

/// The controller believes its spoilt parameters; the sensors follow the true strokes.
fn run_with_true_sensors(spoilt: &Scenario) -> (Log, Summary) {
    let mut host = Host::new(&spoilt.parameters).expect("accepted parameters");
    let mut truth = spoilt.clone();
    truth.parameters.cylinder_sensors = scenario("dig").parameters.cylinder_sensors;
    let log = Run::new(&truth, 1).expect("an accepted dig").complete(&mut host, |_, _| {}).expect("a host run");
    let summary = Summary::of(&truth, "host", 1, &log, None);
    (log, summary)
}

/// The boom's extending solenoid has lost a wire.
const OPEN: FaultyCoil = FaultyCoil { spool: 1, side: Side::Extend, fault: CoilFault::Open };

#[test]
fn a_fault_scenario_ends_in_zero_current_and_standstill_with_the_fault_named() {
    let cases = [
        ("dig-emergency-stop", Fault::EmergencyStop, 9.0, 0.0),
        ("dig-sensor-open", Fault::Sensor(Cylinder::Arm), 6.0, 0.0),
        ("dig-coil-open", Fault::Coil(OPEN), 4.5, 0.05),
        // The last message came at 11.98 s; 100 ms later the command is stale.
        ("dig-command-lost", Fault::CommandStale, 12.0, 0.1),
    ];
    for (name, fault, from_s, within_s) in cases {
        let (log, summary) = run(&scenario(name), 1);
        assert_eq!(summary.outcome(), Outcome::Violated, "{name}");
        assert_eq!(summary.outcome().exit_status(), 3, "{name}");
        let [seen] = log.faults[..] else { panic!("{name}: {:?}", log.faults) };
        assert_eq!(seen.fault, fault, "{name}");
        assert!(seen.at_s >= from_s && seen.at_s <= from_s + within_s + 1e-9, "{name}: {} s", seen.at_s);
        let after: Vec<_> = log.rows.iter().filter(|row| row.time_s >= seen.at_s).collect();
        assert!(after.iter().all(|row| is_safe(&row.outputs) && row.outputs.state == State::Fault), "{name}");
        // Dead time 100 ms and spool lag 50 ms after the cut-off the machine stands still.
        let settled: Vec<_> = after.iter().filter(|row| row.time_s >= seen.at_s + 0.6).collect();
        let (first, last) = (settled.first().unwrap(), settled.last().unwrap());
        assert_eq!(first.lengths, last.lengths, "{name}");
    }
}

#[test]
fn the_published_dig_exits_with_two_and_names_the_arm() {
    let scenario = scenario("dig-published");
    let Err(hil_sim::run::RunError::Refused(found)) = Run::new(&scenario, 1) else { panic!("it was accepted") };
    let summary = Summary::without_run(&scenario, "host", 1, found);
    assert_eq!(summary.outcome().exit_status(), 2);
    assert!(summary.refused.unwrap().iter().all(|v| v.cylinder == "arm"));
}

/// The numeric lines of a scenario: line index, key.
fn numeric_lines(text: &str) -> Vec<(usize, String)> {
    let key_of_number = |line: &str| {
        let (key, value) = line.split_once('=')?;
        value.trim().parse::<f64>().ok()?;
        Some(key.trim().to_owned())
    };
    text.lines().enumerate().filter_map(|(i, line)| Some((i, key_of_number(line)?))).collect()
}

fn error(text: &str) -> String {
    match Scenario::from_toml(text, Path::new("spoilt.toml")) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(error) => error.to_string(),
    }
}

fn with_line(text: &str, at: usize, line: Option<&str>) -> String {
    let lines = text.lines().enumerate();
    lines.filter_map(|(i, old)| if i == at { line } else { Some(old) }).collect::<Vec<_>>().join("\n")
}

#[test]
fn every_numeric_line_missing_misspelt_or_not_a_number_is_refused_by_name() {
    for name in scenario_names() {
        let text = std::fs::read_to_string(workspace().join("scenarios").join(&name).with_extension("toml")).unwrap();
        let lines = numeric_lines(&text);
        assert!(lines.len() > 30, "{name}: {lines:?}");
        for (at, key) in lines {
            // A fence names the limits there are; a machine on its hydraulics may carry nothing; a swing may never run ahead.
            let optional = [
                "payload_kg",
                "ceiling_m",
                "floor_m",
                "front_m",
                "left_m",
                "right_m",
                "swing_right_deg",
                "swing_left_deg",
                "swing_overrun_deg_s2",
            ];
            let missing = (!optional.contains(&key.as_str())).then(|| with_line(&text, at, None));
            let spoilt = [
                with_line(&text, at, Some(&format!("{key}x = 1.0"))),
                with_line(&text, at, Some(&format!("{key} = nan"))),
                with_line(&text, at, Some(&format!("{key} = inf"))),
                with_line(&text, at, Some(&format!("{key} = \"1\""))),
                with_line(&text, at, Some(&format!("{key} = -1e9"))),
            ];
            for text in spoilt.into_iter().chain(missing) {
                let message = error(&text);
                assert!(message.contains(&key) && message.contains("spoilt.toml"), "{name}, {key}: {message}");
            }
        }
    }
}

#[test]
fn an_unknown_machine_event_or_table_is_refused_by_name() {
    let text = std::fs::read_to_string(workspace().join("scenarios/dig-emergency-stop.toml")).unwrap();
    let cases = [
        (text.replace("\"frankel\"", "\"no-such-machine\""), "no-such-machine"),
        (text.replace("\"emergency_stop\"", "\"earthquake\""), "earthquake"),
        (text.replace("\"as_meant\"", "\"as_wished\""), "reading"),
        (text.replace("[motion]", "[emotion]"), "motion"),
        (text.replace("at_s = 9.0", "at_s = 99.0"), "at_s"),
        (text.replace("until_s = 9.5", "until_s = 8.0"), "until_s"),
    ];
    for (text, named) in cases {
        let message = error(&text);
        assert!(message.contains(named), "{message}");
    }
}

#[test]
fn a_dig_that_ends_between_two_ticks_is_completed_too() {
    let mut scenario = scenario("dig");
    scenario.parameters.dig.as_mut().expect("a dig").until_s[2] = 20.0004;
    let mut host = Host::new(&scenario.parameters).unwrap();
    let log = Run::new(&scenario, 1).unwrap().complete(&mut host, |_, _| {}).unwrap();
    let summary = Summary::of(&scenario, "host", 1, &log, None);
    assert_eq!(summary.dig_completed, Some(true), "{summary:?}");
}
