//! `docs/fault-table.md` and its figure are what the fault campaign gives: all of it runs again.

use cross_tests::rig::workspace;
use hil_sim::fault_table::{MACHINE, SEED, SEEDS, files, page};
use hil_sim::faults::{KINDS, Report, campaign};
use hil_sim::machine_file::MachineFile;
use hil_sim::shard::Shard;

fn report(shard: Shard) -> Report {
    let machine = MachineFile::load(MACHINE).unwrap_or_else(|error| panic!("{error}"));
    campaign(&machine, SEEDS, SEED, shard, || ()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_table_and_its_figure_are_what_the_campaign_gives() {
    for (name, text) in files(&report(Shard::WHOLE)) {
        let found = std::fs::read_to_string(workspace().join(name)).unwrap_or_default();
        assert!(found == text, "{name} is out of date: run cargo hil fault-table");
    }
}

#[test]
fn a_bound_that_is_not_held_and_a_fault_that_was_missed_stand_in_the_table() {
    let mut report = report(Shard { index: 0, of: 1000 });
    let row = report.faults.iter_mut().find(|row| row.name == "coil_open").expect("a row");
    (row.bound_held, row.detected, row.undetected) = (Some(false), 7, 3);
    let page = page(&report);
    let line = page.lines().find(|line| line.starts_with("| `coil_open` | coil's wire off |")).expect("its line");
    assert!(line.contains("| 7 | 3 |") && line.ends_with("| 50, **not held** |"), "{line}");
    let lines =
        page.lines().filter(|line| line.ends_with("held |") || line.ends_with("none |") || line.ends_with("** |"));
    assert_eq!(lines.count(), KINDS.len(), "a line each fault");
}
