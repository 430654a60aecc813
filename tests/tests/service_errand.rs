//! What service does beside the ticks: while a bucket is fitted and the store written nothing can move, and no power cut loses a record.

use cross_tests::boards::{board, record_of};
use cross_tests::rig::{Rig, is_safe, scenario};
use firmware::board::Disabled;
use firmware::service::{Phase, Reason, Task};
use firmware::store::{Sealed, Store, StoredRecord};
use firmware::{Ecu, Intent, Outputs, Request, State};
use hil_sim::service::{ParameterStore, Workshop, calibrate::middle, numbered};
use sim_chips::nor_flash::NorFlash;

/// The digging zx200 with a second bucket a twentieth longer.
fn record() -> StoredRecord {
    record_of(&scenario("dig-zx200"), &[1.05])
}

fn stored(record: &StoredRecord) -> ParameterStore {
    let mut store = Store::new(NorFlash::new()).expect("two sectors");
    let mut sealed = Sealed::new(record).expect("a record");
    sealed.approve();
    store.write(&Disabled::new(&mut board()).expect("a healthy board"), &sealed).expect("a healthy flash");
    store
}

/// In the middle of its strokes, with its record in the store.
fn workshop(errand_ticks: u32) -> Workshop {
    let scenario = scenario("dig-zx200");
    let mut workshop = Workshop::new(&scenario, middle(&scenario.plant), 1).expect("a machine");
    workshop.start_with(&record()).expect("a record");
    workshop.errand_ticks = errand_ticks;
    workshop.rest();
    workshop
}

#[test]
fn while_another_bucket_is_fitted_nothing_can_move_and_there_is_no_pose() {
    let mut workshop = workshop(500);
    workshop.request = Some(numbered(Task::MountBucket, 1));
    assert!((0..25).any(|_| !workshop.tick().pose_valid), "the maps are lent when the command is there");
    // Whatever the operator does meanwhile.
    for tick in 0..450 {
        workshop.enable = tick % 100 > 50;
        let request = if tick % 70 > 35 { Request::Dig } else { Request::Neutral };
        workshop.intent = Some(Intent { request, ..Intent::NEUTRAL });
        let outputs = workshop.tick();
        assert!(is_safe(&outputs) && !outputs.pose_valid && outputs.fault.is_none(), "{tick}: {outputs:?}");
    }
    assert_eq!((workshop.heard.phase, workshop.heard.bucket), ("under_way", 0));
    workshop.enable = false;
    workshop.ticks(200);
    assert_eq!((workshop.heard.phase, workshop.heard.bucket), ("done", 1));
    assert!(workshop.tick().pose_valid);
}

#[test]
fn an_errand_that_takes_its_time_ends_as_one_that_takes_none() {
    let mut ends = [0, 1, 733].map(|errand_ticks| {
        let mut workshop = workshop(errand_ticks);
        workshop.ask(numbered(Task::MountBucket, 1));
        workshop.ticks(1000);
        workshop.tick()
    });
    let [at_once, ..] = ends;
    assert!(at_once.pose_valid);
    for Outputs { pose, lengths, .. } in &mut ends {
        // The sensors' noise goes on meanwhile: it is all that differs.
        assert!(
            (pose.plane.reach - at_once.pose.plane.reach).abs() < 2e-3
                && (lengths.arm - at_once.lengths.arm).abs() < 5e-4
        );
    }
}

#[test]
fn a_task_asked_for_meanwhile_is_begun_when_the_errand_is_back() {
    let mut workshop = workshop(500);
    workshop.ask(numbered(Task::MountBucket, 1));
    workshop.ask(numbered(Task::MountBucket, 0));
    assert_eq!((workshop.heard.phase, workshop.heard.bucket), ("under_way", 0));
    workshop.ticks(450);
    assert_eq!((workshop.heard.phase, workshop.heard.bucket), ("under_way", 1), "the second");
    workshop.ticks(400);
    assert_eq!((workshop.heard.phase, workshop.heard.bucket), ("done", 0));
}

#[test]
fn the_mounted_bucket_is_the_one_of_the_next_start() {
    let mut workshop = workshop(0);
    workshop.ask(numbered(Task::MountBucket, 1));
    let loaded = workshop.store.as_mut().expect("a store").load().expect("a record");
    assert_eq!((loaded.record, loaded.sequence), (StoredRecord { mounted: 1, ..record() }, 2));
    // Once more the same: nothing is written.
    workshop.rest();
    workshop.ask(numbered(Task::MountBucket, 1));
    assert_eq!((workshop.heard.phase, workshop.heard.bucket), ("done", 1));
    assert_eq!(workshop.store.as_mut().expect("a store").load().expect("a record").sequence, 2);
}

/// Stands still on the bench and has been asked for bucket 1.
fn asked() -> Rig {
    let mut rig = Rig::with(&scenario("dig-zx200").parameters);
    rig.ecu.set_buckets(2, 0);
    rig.ticks(5);
    rig.inputs.service = Some(numbered(Task::MountBucket, 1));
    assert!(!rig.ecu.errand_is_due());
    assert!(is_safe(&rig.tick()) && rig.ecu.errand_is_due());
    rig
}

fn permit() -> Disabled {
    Disabled::new(&mut board()).expect("a healthy board")
}

#[test]
fn a_power_cut_at_any_time_leaves_one_bucket_noted_and_the_answer_says_which() {
    let before = stored(&record());
    let mut whole = before.clone();
    asked().ecu.errand(permit()).expect("due").run(&mut whole);
    let all = whole.flash().changed() - before.clone().flash().changed();
    assert!(all > 2 * 4096, "both sectors are erased and written");
    let mut left = [0; 2];
    // A prime step meets every place within the words.
    for cut in (0..=all).step_by(211) {
        let (mut rig, mut store) = (asked(), before.clone());
        let errand = rig.ecu.errand(permit()).expect("due");
        store.flash().cut_power_after(cut);
        rig.ecu.done(errand.run(&mut store));
        store.flash().restore_power();
        let noted =
            store.load().unwrap_or_else(|error| panic!("cut after {cut} of {all} bytes: {error}")).record.mounted;
        assert_eq!(store.load().map(|loaded| loaded.record), Ok(StoredRecord { mounted: noted, ..record() }));
        let answer = *rig.ecu.answer();
        let expected = if noted == 1 { (Phase::Done, Reason::None) } else { (Phase::Refused, Reason::NotStored) };
        assert_eq!(
            (answer.phase, answer.reason, answer.bucket),
            (expected.0, expected.1, Some(noted)),
            "cut after {cut}"
        );
        // The maps are those of the noted bucket, whichever it is.
        rig.inputs.service = None;
        let mut fresh = Rig::with(&scenario("dig-zx200").parameters);
        fresh.ecu = Ecu::new(&record().parameters_for(noted.into()).expect("a bucket")).expect("parameters");
        let [here, there] = [&mut rig, &mut fresh].map(|rig| rig.ticks(3).pose.plane);
        assert!((here.reach - there.reach).abs() + (here.height - there.height).abs() < 5e-3, "{here:?}, {there:?}");
        left[usize::from(noted)] += 1;
    }
    println!("{all} bytes: the bucket before left by {} cuts, the new one by {}", left[0], left[1]);
    assert!(left.iter().all(|count| *count > 5), "{left:?}");
}

#[test]
fn a_lost_errand_leaves_the_machine_disabled() {
    let mut rig = asked();
    drop(rig.ecu.errand(permit()).expect("due"));
    rig.inputs.service = None;
    for tick in 0..3000 {
        rig.inputs.enable = tick % 100 > 50;
        let outputs = rig.tick();
        assert!(is_safe(&outputs) && outputs.state != State::Running, "{tick}");
    }
    assert_eq!(rig.ecu.answer().phase, Phase::UnderWay);
}

#[test]
fn an_errand_is_given_once_and_only_after_it_was_asked_for() {
    let mut rig = Rig::with(&scenario("dig-zx200").parameters);
    rig.ecu.set_buckets(2, 0);
    rig.ticks(5);
    assert!(rig.ecu.errand(permit()).is_none());
    let mut rig = asked();
    let _errand = rig.ecu.errand(permit()).expect("due");
    rig.ticks(5);
    assert!(!rig.ecu.errand_is_due() && rig.ecu.errand(permit()).is_none());
}
