//! The whole controller on the healthy hydraulic zx200: minutes of random levers in which something tripped once, and a small part of the
//! fault campaign. The long ones are `cargo hil soak` and `cargo hil faults`.

use hil_sim::faults::campaign;
use hil_sim::machine_file::MachineFile;
use hil_sim::place::Host;
use hil_sim::run::Run;
use hil_sim::shard::Shard;
use hil_sim::soak::{minute, soak};

const SEED: u64 = 1;

fn zx200() -> MachineFile {
    MachineFile::load("zx200").expect("a machine of the repository")
}

#[test]
fn minutes_of_hard_stops_long_swings_and_weights_that_drive_the_oil_trip_nothing() {
    // 3 and 119: the boom meets its stop; 40, 82, 85, 90: it swings on closed oil for seconds; 39: the bucket falls faster than it is asked to;
    // 5350: a falling boom, braked by its cushion, throws the arm.
    let report = soak(&zx200(), SEED, vec![3, 39, 40, 82, 85, 90, 119, 5350], || {}).unwrap();
    assert!(report.travel_m > 50.0, "no work: {} m", report.travel_m);
    assert_eq!(report.trips, []);
}

#[test]
fn a_boom_that_meets_its_stop_throws_no_cylinder_at_more_than_two_metres_a_second() {
    let machine = zx200();
    let (mut scenario, case) = minute(&machine, SEED, 3).unwrap();
    scenario.duration_s = 12.0;
    let mut host = Host::new(&scenario.parameters).unwrap();
    let log = Run::new(&scenario, case).unwrap().complete(&mut host, |_, _| {}).unwrap();
    assert!(log.stop_hits.iter().any(|hit| hit.cylinder == "boom"), "{:?}", log.stop_hits);
    let fastest = log.rows.windows(2).fold(0.0_f64, |fastest, pair| {
        let (a, b) = (pair[0].lengths, pair[1].lengths);
        let moved = [b.boom - a.boom, b.arm - a.arm, b.bucket - a.bucket];
        moved.iter().fold(fastest, |fastest, moved| fastest.max(moved.abs() / 0.001))
    });
    println!("fastest cylinder: {fastest:.2} m/s");
    assert!(fastest < 2.0, "{fastest}");
}

#[test]
fn a_quarter_of_a_campaign_of_one_seed_keeps_every_bound_and_trips_nothing_healthy() {
    let report = campaign(&zx200(), 1, SEED, Shard { index: 0, of: 4 }, || {}).unwrap();
    assert_eq!((report.runs, report.false_trips), (40, 0));
    assert!(report.faults.iter().map(|row| row.detected).sum::<usize>() > 15);
    for row in &report.faults {
        assert_ne!(row.bound_held, Some(false), "{row:?}");
    }
}
