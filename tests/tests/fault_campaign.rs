//! Rows of the fault campaign that need no hours: what is spoilt before the start, and what is tried elsewhere.

use hil_sim::faults::{Cause, ELSEWHERE, KINDS, campaign};
use hil_sim::machine_file::MachineFile;
use hil_sim::shard::Shard;

#[test]
fn a_parameter_record_spoilt_in_both_copies_is_refused_before_anything_moves() {
    let machine = MachineFile::load("zx200").unwrap_or_else(|error| panic!("{error}"));
    let kind = KINDS.iter().position(|kind| kind.cause == Cause::Record).expect("a row of it");
    // The first case of each round is the healthy one.
    let only = Shard { index: kind as u64 + 1, of: KINDS.len() as u64 + 1 };
    let report = campaign(&machine, 40, 3, only, || ()).unwrap_or_else(|error| panic!("{error}"));
    let row = report.faults.iter().find(|row| row.name == KINDS[kind].name).expect("its row");
    assert_eq!((row.runs, row.detected, row.undetected), (200, 200, 0), "{row:?}");
    assert_eq!(row.named.get("record_refused"), Some(&200), "{row:?}");
    assert_eq!(row.bound_held, Some(true));
    assert!(row.tip_travel_mm.is_some_and(|travel| travel.max == 0.0));
}

#[test]
fn what_is_tried_in_emulation_only_has_a_row_that_says_so_and_no_runs() {
    let machine = MachineFile::load("zx200").unwrap_or_else(|error| panic!("{error}"));
    let none = Shard { index: 999, of: 1000 };
    let report = campaign(&machine, 1, 1, none, || ()).unwrap_or_else(|error| panic!("{error}"));
    for (name, _) in ELSEWHERE {
        let row = report.faults.iter().find(|row| row.name == name).unwrap_or_else(|| panic!("no row {name}"));
        assert_eq!((row.runs, row.bound_ms), (0, None));
        assert!(row.reason.is_some_and(|reason| reason.contains("in emulation, `cargo hil flips`")), "{row:?}");
    }
}
