//! The power goes at every single byte of a write: one good record is always left, the old one or the new one.

use cross_tests::boards::{approved, board, record};
use firmware::board::Disabled;
use firmware::store::{Loaded, OtherCopy, Sealed, Store};
use sim_chips::nor_flash::NorFlash;

const SECTOR: usize = 4096;
type Flash = NorFlash<SECTOR>;

fn write(store: &mut Store<Flash>, sealed: &Sealed) -> bool {
    store.write(&Disabled::new(&mut board()).unwrap(), sealed).is_ok()
}

/// A store that holds the old record, in both sectors.
fn old() -> Store<Flash> {
    let mut store = Store::new(Flash::new()).unwrap();
    assert!(write(&mut store, &approved(0.1)));
    store
}

/// Bytes a whole write erases and programs.
fn bytes_of_a_write() -> usize {
    let mut store = old();
    let before = store.flash().changed();
    assert!(write(&mut store, &approved(0.2)));
    store.flash().changed() - before
}

fn load(store: &mut Store<Flash>, when: &str) -> Loaded {
    store.load().unwrap_or_else(|error| panic!("{when}: {error}"))
}

#[test]
fn a_cut_at_any_byte_leaves_the_old_record_or_the_new_one() {
    let all = bytes_of_a_write();
    let (before, next) = (old(), approved(0.2));
    let (mut old_left, mut new_left) = (0, 0);
    let mut switched = false;
    for cut in 0..=all {
        let mut store = before.clone();
        store.flash().cut_power_after(cut);
        let finished = write(&mut store, &next);
        store.flash().restore_power();
        let loaded = load(&mut store, &format!("cut after {cut} of {all} bytes"));
        if loaded.record == record(0.1) {
            old_left += 1;
            assert!(!switched, "the old record came back at byte {cut}");
            assert!(!finished);
        } else {
            assert_eq!((loaded.record, loaded.sequence), (record(0.2), 2));
            new_left += 1;
            switched = true;
        }
        if cut == 0 {
            assert_eq!(loaded.other, OtherCopy::Same, "nothing was touched");
        }
    }
    println!("{all} bytes: old record left by {old_left} cuts, new one by {new_left}");
    assert!(old_left > SECTOR && new_left > SECTOR, "both sectors were cut");
}

#[test]
fn the_next_write_mends_whatever_a_cut_left() {
    let all = bytes_of_a_write();
    let (before, next, after) = (old(), approved(0.2), approved(0.3));
    // A prime step meets every place within the words.
    for cut in (0..=all).step_by(7) {
        let mut store = before.clone();
        store.flash().cut_power_after(cut);
        write(&mut store, &next);
        store.flash().restore_power();
        assert!(write(&mut store, &after), "cut after {cut}");
        let loaded = load(&mut store, "after mending");
        assert_eq!((loaded.record, loaded.other), (record(0.3), OtherCopy::Same), "cut after {cut}");
    }
}

#[test]
fn a_second_cut_in_the_repair_of_the_first_still_leaves_a_record() {
    let all = bytes_of_a_write();
    let (before, next, after) = (old(), approved(0.2), approved(0.3));
    for first in (0..=all).step_by(211) {
        for second in (0..=all).step_by(97) {
            let mut store = before.clone();
            store.flash().cut_power_after(first);
            write(&mut store, &next);
            store.flash().cut_power_after(second);
            write(&mut store, &after);
            store.flash().restore_power();
            let left = load(&mut store, &format!("cuts after {first} and {second} bytes")).record;
            assert!([record(0.1), record(0.2), record(0.3)].contains(&left), "cuts after {first} and {second}");
        }
    }
}

#[test]
fn a_first_write_that_is_cut_leaves_nothing_that_is_taken_for_a_record() {
    let sealed = approved(0.1);
    let mut whole = Store::new(Flash::new()).unwrap();
    assert!(write(&mut whole, &sealed));
    let all = whole.flash().changed();
    let mut loads = 0;
    for cut in 0..=all {
        let mut store = Store::new(Flash::new()).unwrap();
        store.flash().cut_power_after(cut);
        write(&mut store, &sealed);
        store.flash().restore_power();
        if let Ok(loaded) = store.load() {
            assert_eq!(loaded.record, record(0.1), "cut after {cut}");
            loads += 1;
        }
    }
    assert!(loads > 0 && loads <= all / 2 + 1, "{loads} of {all} cuts left the record");
}
