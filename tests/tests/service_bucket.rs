//! Another bucket by command, through the pins: everything built from the geometry is the new bucket's, and nothing is while enabled.

use cross_tests::boards;
use cross_tests::rig::scenario;
use firmware::service::Task;
use firmware::store::StoredRecord;
use firmware::{Intent, Outputs, Request};
use hil_sim::scenario::Scenario;
use hil_sim::service::{Workshop, numbered};
use kinematics_core::{Cylinders, Machine};

/// The dig's machine with its own bucket, one a twentieth longer, and one with which the dig is out of reach.
fn record(scenario: &Scenario) -> StoredRecord {
    boards::record_of(scenario, &[1.05, 4.0])
}

/// At the dig's start with this bucket, on a controller that believes in the record's.
fn at_the_dig(scenario: &Scenario, record: &StoredRecord, bucket: usize) -> Workshop {
    let machine = Machine::<f64>::new(&record.geometry_for(bucket).expect("a bucket")).expect("a geometry");
    let dig = firmware::dig::Dig::<f64>::new(scenario.parameters.dig.as_ref().expect("a dig"));
    let Cylinders { boom, arm, bucket: curl } = machine.tip_to_cylinders(&dig.tip(0.0)).expect("within reach");
    let mut workshop = Workshop::new(scenario, [0.0, boom, arm, curl], 1).expect("a machine");
    workshop.start_with(record).expect("a record");
    workshop
}

fn dig(workshop: &mut Workshop) -> Vec<Outputs> {
    workshop.rest();
    workshop.enable = true;
    workshop.ticks(20);
    workshop.intent = Some(Intent { request: Request::Dig, ..Intent::NEUTRAL });
    (0..4000).map(|_| workshop.tick()).collect()
}

#[test]
fn after_the_change_the_dig_is_that_of_a_controller_built_for_the_bucket() {
    let scenario = scenario("dig-zx200");
    let record = record(&scenario);
    let mut changed = at_the_dig(&scenario, &record, 1);
    let mut built = at_the_dig(&scenario, &StoredRecord { mounted: 1, ..record }, 1);
    for workshop in [&mut changed, &mut built] {
        workshop.rest();
        workshop.ask(numbered(Task::MountBucket, 1));
        workshop.ticks(1000);
        assert_eq!((workshop.heard.phase, workshop.heard.reason, workshop.heard.bucket), ("done", "none", 1));
    }
    let (changed, built) = (dig(&mut changed), dig(&mut built));
    assert!(built.last().is_some_and(|last| last.dig_tick > 3000 && last.fault.is_none()));
    for (changed, built) in changed.iter().zip(&built) {
        assert_eq!((changed.pose, changed.speeds, changed.duties), (built.pose, built.speeds, built.duties));
    }
}

#[test]
fn the_pose_is_the_new_buckets_from_the_next_tick_on_and_the_old_ones_again_when_it_cannot_be_used() {
    let scenario = scenario("dig-zx200");
    let record = record(&scenario);
    let mut workshop = at_the_dig(&scenario, &record, 0);
    workshop.rest();
    let tip = |outputs: &Outputs| outputs.pose.plane;
    let own = tip(&workshop.tick());
    workshop.request = Some(numbered(Task::MountBucket, 1));
    let mut last = own;
    let longer = (0..200).map(|_| tip(&workshop.tick())).find(|now| {
        let leap = (now.reach - last.reach).abs() + (now.height - last.height).abs();
        last = *now;
        leap > 0.02
    });
    let longer = longer.expect("a leap of the tip");
    let apart = ((longer.reach - own.reach).powi(2) + (longer.height - own.height).powi(2)).sqrt();
    let expected = 0.05 * scenario.parameters.geometry.bucket_m as f32;
    assert!((apart - expected).abs() < 0.005, "{apart} m instead of {expected} m");

    workshop.rest();
    workshop.ask(numbered(Task::MountBucket, 2));
    workshop.ticks(2000);
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "bucket_unusable"));
    assert_eq!(workshop.heard.bucket, 1);
    let after = tip(&workshop.tick());
    assert!((after.reach - longer.reach).abs() < 0.005 && (after.height - longer.height).abs() < 0.005);

    workshop.rest();
    workshop.ask(numbered(Task::MountBucket, 5));
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "no_such_bucket"));
}

#[test]
fn while_enabled_the_change_is_refused_and_while_it_lasts_nothing_can_be_enabled() {
    let scenario = scenario("dig-zx200");
    let record = record(&scenario);
    let mut workshop = at_the_dig(&scenario, &record, 0);
    workshop.ticks(500);
    workshop.enable = true;
    workshop.ticks(100);
    workshop.ask(numbered(Task::MountBucket, 1));
    workshop.ticks(300);
    assert_eq!((workshop.heard.phase, workshop.heard.reason, workshop.heard.bucket), ("refused", "enabled", 0));

    workshop.rest();
    workshop.errand_ticks = 1000;
    workshop.request = Some(numbered(Task::MountBucket, 1));
    // The message's way in: at most a period.
    workshop.ticks(25);
    workshop.enable = true;
    for _ in 0..2000 {
        workshop.tick();
        assert!(!workshop.pins.as_ref().expect("a tick").cut_off_closed, "enabled in the middle of the change");
    }
    assert_eq!(workshop.heard.bucket, 1);
}

#[test]
fn without_a_store_there_is_no_bucket_to_mount() {
    let scenario = scenario("dig-zx200");
    let mut workshop = Workshop::new(&scenario, hil_sim::service::calibrate::middle(&scenario.plant), 1).expect("one");
    workshop.rest();
    workshop.ask(numbered(Task::MountBucket, 0));
    assert_eq!((workshop.heard.phase, workshop.heard.reason), ("refused", "no_such_bucket"));
}
