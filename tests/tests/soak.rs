//! The whole controller on the healthy hydraulic zx200: minutes of random levers in which something tripped once, and a small part of the
//! fault campaign. The long ones are `cargo hil soak` and `cargo hil faults`.

use hil_sim::faults::campaign;
use hil_sim::machine_file::MachineFile;
use hil_sim::place::Host;
use hil_sim::run::Run;
use hil_sim::shard::Shard;
use hil_sim::soak::{Operator, minute, work};

const SEED: u64 = 1;

fn zx200() -> MachineFile {
    MachineFile::load("zx200").expect("a machine of the repository")
}

fn works_without_a_trip(operator: Operator, minutes: &[u64]) {
    let machine = zx200();
    for &run in minutes {
        let (travel_m, trip) = work(&machine, SEED, run, operator).unwrap();
        assert!(travel_m > 0.5, "minute {run}: no work: {travel_m} m");
        assert_eq!(trip, None);
    }
}

#[test]
fn minutes_of_hard_stops_long_swings_and_weights_that_drive_the_oil_trip_nothing() {
    // 3 and 119: the boom meets its stop; 40, 82, 85, 90: it swings on closed oil for seconds; 39: the bucket falls faster than it is asked to;
    // 280: oil pressed against a stop pushes the bucket off it; 4353: an arm at its stop is let go when the bucket leaves its own; 5350: a falling
    // boom, braked by its cushion, throws the arm.
    works_without_a_trip(Operator::Several, &[3, 39, 40, 82, 85, 90, 119, 280, 4353, 5350]);
}

#[test]
fn minutes_of_one_lever_at_a_time_trip_nothing_where_no_other_motion_excuses_what_rings() {
    // 31 and 811: a released boom swings back; 323: an arm rings on under a small command, 567: a swing; 183 and 247: a boom that is slowed stands for
    // a while; 2903, 5947: what moves slowly stands while it rings; 1147, 5211, 5619: all three cylinders at their stops; 3575: a bucket is pushed
    // off its stop, and clear of it still faster than it was told.
    works_without_a_trip(Operator::OneAtATime, &[31, 183, 247, 323, 567, 811, 1147, 2903, 3575, 5211, 5619, 5947]);
}

#[test]
fn a_boom_that_meets_its_stop_throws_no_cylinder_at_more_than_two_metres_a_second() {
    let machine = zx200();
    let (mut scenario, case) = minute(&machine, SEED, 3, Operator::Several).unwrap();
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
