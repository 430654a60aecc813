//! Calibration by command, through the pins: a service tool on the bus asks, the controller drives the coils, the answer is on the bus.

use cross_tests::boards::{self, Wire};
use cross_tests::rig::scenario;
use firmware::Parameters;
use firmware::board::Controller;
use firmware::can::address::Addresses;
use firmware::service::{Found, Task};
use firmware::simulated::link::NAME;
use hil_sim::plant::Plant;
use hil_sim::scenario::Scenario;
use hil_sim::service::calibrate::{middle, search, with_random_valves};
use hil_sim::service::{Workshop, numbered, on_spool};
use kinematics_core::{Cylinders, Machine, PlaneTip, Rotor, Vec2};

#[test]
fn randomised_valves_are_found_within_one_percent_of_full_scale_and_three_of_gain() {
    let zx200 = scenario("dig-zx200");
    let (mut dead_band, mut gain, mut longest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for seed in 1..=3 {
        let machine = with_random_valves(&zx200, seed);
        for spool in 0..4 {
            let found = search(&machine, spool, seed).expect("a machine");
            assert_eq!((found.phase, found.reason), ("done", "none"), "seed {seed}, {}", found.spool);
            assert_eq!(found.rows.len(), 2);
            for row in &found.rows {
                dead_band = dead_band.max(row.dead_band_error().abs());
                gain = gain.max(row.gain_error().abs());
            }
            longest = longest.max(found.duration_s);
        }
    }
    println!("dead band {:.2} % of full scale, gain {:.2} %, longest {longest:.0} s", 100.0 * dead_band, 100.0 * gain);
    assert!(dead_band <= 0.01 && gain <= 0.03);
}

const BOOM: usize = 1;

/// In the middle of its strokes, on a controller that has these parameters while the machine is the scenario's.
fn workshop(scenario: &Scenario, parameters: &Parameters) -> Workshop {
    let mut workshop = Workshop::new(scenario, middle(&scenario.plant), 1).expect("a machine");
    workshop.install(Controller::new(parameters, Addresses::DEFAULT, &NAME).expect("parameters"));
    workshop
}

#[test]
fn a_sensors_end_codes_are_found_through_the_pins_within_a_fifth_of_a_millimetre() {
    let scenario = scenario("dig-zx200");
    let mut wrong = scenario.parameters;
    // As far off as the controller takes for the end, and farther.
    wrong.cylinder_sensors[0].min_code += 1000;
    wrong.cylinder_sensors[0].max_code -= 2500;
    let mut workshop = workshop(&scenario, &wrong);
    workshop.begin(on_spool(Task::EndStops, BOOM as u8));
    let mut ticks = 0;
    while workshop.heard.phase != "done" {
        workshop.ticks(100);
        ticks += 100;
        assert!(ticks < 120_000 && workshop.heard.phase != "aborted", "{:?}", workshop.heard);
    }
    workshop.ticks(200);
    let sensor = scenario.parameters.cylinder_sensors[0];
    let codes_per_m = f64::from(sensor.max_code - sensor.min_code) / (sensor.stroke.max_m - sensor.stroke.min_m);
    let found = workshop.heard.ends.expect("codes on the bus");
    for (found, is) in found.into_iter().zip([sensor.min_code, sensor.max_code]) {
        let off_m = (f64::from(found) - f64::from(is)) / codes_per_m;
        assert!(off_m.abs() <= 2e-4, "{off_m} m");
    }
}

#[test]
fn a_swing_motor_has_no_end_stops() {
    let scenario = scenario("dig-zx200");
    let mut workshop = workshop(&scenario, &scenario.parameters);
    workshop.rest();
    workshop.ask(on_spool(Task::EndStops, 0));
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "no_end_stops"));
}

#[test]
fn a_search_ends_with_its_reason_when_the_valve_is_dead_or_the_solenoids_are_swapped_or_enable_goes_off() {
    let zx200 = scenario("dig-zx200");
    let mut dead = zx200.clone();
    dead.plant[BOOM].dead_band[0] = 0.95;
    let found = search(&dead, BOOM, 1).expect("a machine");
    assert_eq!((found.phase, found.reason, found.rows.len()), ("aborted", "no_motion_extending", 0));

    let mut workshop = workshop(&zx200, &zx200.parameters);
    workshop.begin(on_spool(Task::ValveSearch, BOOM as u8));
    workshop.ticks(3000);
    assert_eq!(workshop.heard.phase, "under_way");
    workshop.enable = false;
    workshop.tick();
    let pins = workshop.pins.expect("a tick");
    assert!(pins.duties == [[0; 2]; 4] && !pins.cut_off_closed);
    workshop.ticks(200);
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("aborted", "enable_released"));
    assert_eq!(workshop.heard.valves, None);
}

#[test]
fn a_bucket_is_measured_up_by_command_and_kept_only_with_the_cut_off_open() {
    let scenario = scenario("dig-zx200");
    let geometry = scenario.parameters.geometry;
    let truth = Machine::<f64>::new(&geometry).expect("a geometry");
    // The controller believes the bucket longer than it is, and its tip elsewhere.
    let (length, offset) = (geometry.bucket_m - 0.06, Rotor::from_degrees(3.0));
    let mut workshop = workshop(&scenario, &scenario.parameters);
    workshop.start_with(&boards::record_of(&scenario, &[1.1])).expect("a record");
    let (point, tip) = (Vec2::new(6.5, -1.0), offset.to_vec().scale(length));
    workshop.rest();
    workshop.ask(numbered(Task::Touch, 0));
    let mut touches = 0;
    for turn in 0..12 {
        let turned = Rotor::from_degrees(-140.0 + 100.0 * f64::from(turn) / 11.0);
        let wrist = point - turned.rotate(tip);
        let believed = wrist + turned.to_vec().scale(geometry.bucket_m);
        let plane = PlaneTip { reach: believed.x, height: believed.z, pitch: turned };
        let Ok(Cylinders { boom, arm, bucket }) = truth.tip_to_cylinders(&plane) else { continue };
        workshop.plant = Plant::new(scenario.plant, scenario.coil, [0.0, boom, arm, bucket]);
        // It was put there in no time: the jump is named, and forgotten in neutral.
        workshop.rest();
        touches += 1;
        workshop.ask(numbered(Task::Touch, touches));
        assert_eq!(workshop.heard.phase, "done", "{:?}", workshop.heard);
    }
    assert!(touches >= 5, "only {touches} touches can be reached");
    workshop.ask(numbered(Task::MeasureUp, 0));
    workshop.ticks(200);
    let found = workshop.heard.tip.unwrap_or_else(|| panic!("no tip on the bus: {:?}", workshop.heard));
    let (off_m, off_rad) = (f64::from(found.length_m) - length, f64::from(found.offset_sin) - offset.sin);
    assert!(off_m.abs() <= 0.002 && off_rad.abs() <= 0.002, "{off_m} m, {off_rad} rad");

    // Keeping it is a command of its own, and nothing is written before, nor while the board is not proved disabled.
    let mut store = workshop.store.take().expect("a store");
    let before = store.flash().changed();
    workshop.ask(numbered(Task::Keep, 0));
    assert_eq!((workshop.heard.task, workshop.heard.phase), ("keep", "under_way"));
    let mut welded = boards::board();
    welded.cut_off_read_back = Wire::new(true);
    assert!(workshop.controller.errand(&mut welded).is_none(), "the cut-off reads closed");
    workshop.ticks(200);
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "enabled"));
    assert_eq!(store.flash().changed(), before);
    workshop.store = Some(store);
    workshop.rest();
    workshop.ask(numbered(Task::Keep, 0));
    assert_eq!((workshop.heard.task, workshop.heard.phase), ("keep", "done"));
    let store = workshop.store.as_mut().expect("a store");
    let kept = store.load().expect("approved").record.geometry_for(0).expect("a bucket");
    assert!((kept.bucket_m - length).abs() < 0.002);
    // The tip lies on the bucket's x axis again: the coupler pin has turned with it.
    let pin = offset.inverse().rotate(geometry.bucket.coupler_pin);
    assert!((kept.bucket.coupler_pin.x - pin.x).abs() < 0.002 && (kept.bucket.coupler_pin.z - pin.z).abs() < 0.002);

    // The store's record is not any more the one the controller works with: no bucket of it is mounted before the restart.
    workshop.rest();
    workshop.ask(numbered(Task::MountBucket, 1));
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "restart_first"));
}

#[test]
fn nothing_found_is_nothing_to_keep_and_too_few_touches_are_no_bucket() {
    let scenario = scenario("dig-zx200");
    let mut workshop = workshop(&scenario, &scenario.parameters);
    workshop.rest();
    workshop.ask(numbered(Task::Keep, 0));
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "nothing_found"));
    workshop.ask(numbered(Task::Touch, 1));
    workshop.ask(numbered(Task::MeasureUp, 0));
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "too_few_touches"));
}

#[test]
fn found_values_in_the_record_are_the_valves_own() {
    use firmware::parameters::ValveDirection;
    let scenario = scenario("dig-zx200");
    let found = [0.11, 0.22].map(|dead_band| ValveDirection { dead_band, full_speed: 0.5 + dead_band });
    let kept = Found::Valve(2, found).in_record(&boards::record_of(&scenario, &[]), 0).expect("a valid record");
    assert_eq!(kept.parameters.coils.valves()[2].map(|v| v.full_speed), found.map(|v| v.full_speed));
    for (kept, found) in kept.parameters.coils.valves()[2].iter().zip(found) {
        assert!((kept.dead_band - found.dead_band).abs() < 1e-6);
    }
    assert_eq!(kept.parameters.coils.valves()[1], scenario.parameters.coils.valves()[1]);
}
