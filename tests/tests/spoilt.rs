//! The controller's memory and its timer spoilt in the emulator.

use hil_sim::shard::Shard;
use hil_sim::spoilt::{Report, Row, campaign};

/// Turned bits of this test; `cargo hil flips` turns more.
const BITS: u32 = 40;

fn row<'a>(report: &'a Report, name: &str) -> &'a Row {
    report.rows.iter().find(|row| row.name == name).unwrap_or_else(|| panic!("no row `{name}`"))
}

#[test]
#[ignore = "needs the emulator: run cargo xtask test"]
fn turned_bits_of_constants_and_a_lost_timer_end_with_the_outputs_off_and_are_named() {
    let report = campaign(BITS, 1, Shard::WHOLE, || ()).unwrap_or_else(|error| panic!("{error}"));
    println!("{report:#?}");
    let watched = row(&report, "bit_of_watched_constants");
    assert!(watched.runs > 0 && watched.off == watched.runs, "{watched:?}");
    // A round of the watch, and the last one's rest; a bit may also be noticed by what it does.
    assert!(watched.off_ms.is_some_and(|ms| ms <= 500), "{watched:?}");
    assert!(watched.off_by.contains_key("parameters_corrupt"), "{watched:?}");
    let timer = row(&report, "timer_lost");
    assert_eq!((timer.runs, timer.off, timer.off_ms), (4, 4, Some(50)), "{timer:?}");
    assert_eq!(timer.off_by.keys().copied().collect::<Vec<_>>(), ["watchdog"]);
    let tick = row(&report, "one_tick_lost");
    assert_eq!((tick.runs, tick.astray, tick.off), (4, 0, 0), "{tick:?}");
    // What is not promised is counted: state has no second copy.
    let state = row(&report, "bit_of_controller_state");
    assert_eq!(state.runs, state.no_effect + state.off + state.slight + state.astray);
    assert!(report.holds());
    assert!(report.watch_instructions.is_some_and(|most| most <= 40), "{:?}", report.watch_instructions);
}
