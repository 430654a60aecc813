//! Parameters in flash: two copies, every fault named, nothing written but from a board that cannot move.

use cross_tests::boards::{Wire, approved, board, record};
use embedded_storage::nor_flash::NorFlash as _;
use firmware::board::{BoardError, Disabled, NotDisabled};
use firmware::store::copy::{COPY_BYTES, DATA_BYTES, HEADER_BYTES, decode};
use firmware::store::{CopyFault, FlashFit, LoadError, OtherCopy, Sealed, Store, WriteError};
use sim_chips::nor_flash::NorFlash;

const SECTOR: usize = 4096;
type Flash = NorFlash<SECTOR>;

fn empty() -> Store<Flash> {
    Store::new(Flash::new()).unwrap()
}

fn write(store: &mut Store<Flash>, sealed: &Sealed) -> Result<u32, WriteError> {
    store.write(&Disabled::new(&mut board()).unwrap(), sealed)
}

/// A store after one write.
fn written() -> Store<Flash> {
    let mut store = empty();
    assert_eq!(write(&mut store, &approved(0.1)), Ok(1));
    store
}

#[test]
fn what_is_written_is_loaded_from_either_sector() {
    let loaded = written().load().unwrap();
    assert_eq!((loaded.record, loaded.sequence, loaded.other), (record(0.1), 1, OtherCopy::Same));
    for (spoilt, place) in [(0, HEADER_BYTES + 40), (1, SECTOR + HEADER_BYTES + 40)] {
        let mut store = written();
        store.flash().flip(place, 0x10);
        let loaded = store.load().unwrap();
        assert_eq!((loaded.record, loaded.other), (record(0.1), OtherCopy::Bad(CopyFault::Data)), "sector {spoilt}");
        // Writing again mends it.
        assert_eq!(write(&mut store, &approved(0.1)), Ok(2));
        assert_eq!(store.load().unwrap().other, OtherCopy::Same);
    }
}

#[test]
fn a_flipped_bit_anywhere_in_one_copy_leaves_the_other() {
    let sealed = approved(0.1);
    for place in 0..sealed.as_bytes().len() {
        for sector in [0, SECTOR] {
            let mut store = written();
            store.flash().flip(sector + place, 1 << (place % 8));
            let loaded = store.load().unwrap_or_else(|error| panic!("byte {place}: {error}"));
            assert_eq!(loaded.record, record(0.1));
            assert!(matches!(loaded.other, OtherCopy::Bad(_)), "byte {place} of sector at {sector} went unseen");
        }
    }
}

#[test]
fn every_fault_of_both_copies_is_named() {
    assert_eq!(empty().load(), Err(LoadError::BothBad([CopyFault::Empty; 2])));
    let mut store = written();
    store.flash().flip(0, 0x01);
    store.flash().flip(SECTOR + HEADER_BYTES, 0x01);
    let error = store.load().unwrap_err();
    assert_eq!(error, LoadError::BothBad([CopyFault::Header, CopyFault::Data]));
    assert_eq!(error.to_string(), "first copy: no intact header; second copy: the data do not fit their CRC");
    let mut store = written();
    store.flash().flip(HEADER_BYTES, 0x01);
    store.flash().flip(SECTOR, 0x01);
    assert_eq!(store.load(), Err(LoadError::BothBad([CopyFault::Data, CopyFault::Header])));
}

/// The CRC-32 of ISO 3309, bit by bit: the tests' own.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
    })
}

/// A copy with some header bytes changed and the header's CRC made good again.
fn reheaded(change: impl FnOnce(&mut [u8])) -> Vec<u8> {
    reheaded_from(&approved(0.1), change)
}

fn reheaded_from(sealed: &Sealed, change: impl FnOnce(&mut [u8])) -> Vec<u8> {
    let mut bytes = sealed.as_bytes().to_vec();
    change(&mut bytes);
    let crc = crc32(&bytes[..HEADER_BYTES - 4]);
    bytes[HEADER_BYTES - 4..HEADER_BYTES].copy_from_slice(&crc.to_le_bytes());
    bytes
}

#[test]
fn versions_lengths_and_data_that_are_no_record_are_named() {
    assert_eq!(crc32(b"123456789"), 0xcbf4_3926, "the check value of CRC-32");
    assert!(decode(&reheaded(|_| ())).unwrap().approved);
    assert_eq!(decode(&reheaded(|b| b[4] = 9)), Err(CopyFault::Version { found: 9 }));
    assert_eq!(decode(&reheaded(|b| b[14] = 1)), Err(CopyFault::Length { found: 0x1_0000 + length() }));
    assert_eq!(decode(&reheaded(|b| b[12] += 1)), Err(CopyFault::Length { found: length() + 1 }));
    assert_eq!(decode(&approved(0.1).as_bytes()[..HEADER_BYTES - 1]), Err(CopyFault::Header));
    // Data with their CRC made good, but no record; and a record with a value out of its range.
    let redone = |change: &dyn Fn(&mut [u8])| {
        reheaded(|bytes| {
            change(&mut bytes[HEADER_BYTES..]);
            let crc = crc32(&bytes[HEADER_BYTES..]);
            bytes[16..20].copy_from_slice(&crc.to_le_bytes());
        })
    };
    let decoded = decode(&redone(&|data| data[17..].fill(0xff)));
    assert!(matches!(decoded, Err(CopyFault::Malformed | CopyFault::Record(_))), "{decoded:?}");
    let nameless = decode(&redone(&|data| data[..16].fill(0))).unwrap_err();
    assert_eq!(nameless.to_string(), "`machine` must be 1 to 16 printable ASCII characters");
    // Another record's data under this one's approval.
    let swapped = decode(&redone(&|data| data[0] = b'F')).unwrap();
    assert!(!swapped.approved, "an approval is of these very data");
}

fn length() -> u32 {
    (approved(0.1).as_bytes().len() - HEADER_BYTES) as u32
}

#[test]
fn random_bytes_are_no_record_and_no_panic() {
    let mut state = 1_u64;
    for _ in 0..2000 {
        let mut bytes = reheaded(|bytes| {
            for byte in &mut bytes[HEADER_BYTES..] {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                *byte = (state >> 56) as u8;
            }
            let crc = crc32(&bytes[HEADER_BYTES..]);
            bytes[16..20].copy_from_slice(&crc.to_le_bytes());
        });
        assert!(decode(&bytes).is_err());
        bytes.truncate((state >> 40) as usize % COPY_BYTES);
        assert!(decode(&bytes).is_err());
    }
}

#[test]
fn a_record_nobody_signed_off_is_neither_written_nor_loaded() {
    let unsigned = Sealed::new(&record(0.2)).unwrap();
    let mut store = written();
    let before = store.flash().changed();
    assert_eq!(write(&mut store, &unsigned), Err(WriteError::NotApproved));
    assert_eq!(store.flash().changed(), before, "nothing was touched");
    // Put there past the store, it is refused and the older record is not taken for it.
    let mut flash = Flash::new();
    let mut bytes = unsigned.as_bytes().to_vec();
    bytes.resize(bytes.len().next_multiple_of(4), 0xff);
    flash.write(0, &bytes).unwrap();
    assert_eq!(Store::new(flash).unwrap().load(), Err(LoadError::NotApproved));
}

#[test]
fn an_older_record_is_not_taken_for_a_newer_one_that_decayed() {
    // A write was cut between its two sectors.
    let numbered = |sealed: &Sealed, sequence: u8| {
        let mut bytes = reheaded_from(sealed, |bytes| bytes[8] = sequence);
        bytes.resize(bytes.len().next_multiple_of(4), 0xff);
        bytes
    };
    let mut flash = Flash::new();
    flash.write(0, &numbered(&approved(0.1), 1)).unwrap();
    flash.write(SECTOR as u32, &numbered(&approved(0.2), 2)).unwrap();
    let mut store = Store::new(flash).unwrap();
    let loaded = store.load().unwrap();
    assert_eq!((loaded.record, loaded.sequence, loaded.other), (record(0.2), 2, OtherCopy::Older));
    store.flash().flip(SECTOR + HEADER_BYTES + 9, 0x40);
    assert_eq!(store.load(), Err(LoadError::OnlyOlder(CopyFault::Data)));
    // Writing keeps the good one to the last, old as it is.
    store.flash().cut_power_after(SECTOR);
    assert!(write(&mut store, &approved(0.3)).is_err());
    store.flash().restore_power();
    assert_eq!(store.load().unwrap().record, record(0.1));
}

#[test]
fn a_cell_that_no_longer_erases_is_found_and_the_old_record_stays() {
    for place in [HEADER_BYTES + 100, 20] {
        let mut store = written();
        store.flash().wear_out(SECTOR + place);
        assert_eq!(write(&mut store, &approved(0.2)), Err(WriteError::Verify { sector: 1 }), "byte {place}");
        let loaded = store.load().unwrap();
        assert_eq!((loaded.record, loaded.sequence), (record(0.1), 1));
    }
}

#[test]
fn sequence_numbers_go_on_counting_past_the_last() {
    let mut store = empty();
    let mut flash = Flash::new();
    let mut last = reheaded(|bytes| bytes[8..12].copy_from_slice(&u32::MAX.to_le_bytes()));
    last.resize(last.len().next_multiple_of(4), 0xff);
    flash.write(0, &last).unwrap();
    *store.flash() = flash;
    assert_eq!(store.load().unwrap().sequence, u32::MAX);
    assert_eq!(write(&mut store, &approved(0.2)), Ok(0));
    assert_eq!(store.load().unwrap().record, record(0.2));
    assert_eq!(write(&mut store, &approved(0.3)), Ok(1));
    assert_eq!(store.load().unwrap().record, record(0.3));
}

#[test]
fn a_flash_that_does_not_fit_is_refused() {
    assert!(matches!(Store::new(NorFlash::<2048>::new()), Err(FlashFit::SectorTooSmall)));
    assert!(Store::new(NorFlash::<16_384>::new()).is_ok());
    assert!(approved(0.1).as_bytes().len() < COPY_BYTES, "{} of {DATA_BYTES} bytes used", length());
    println!("a record of two buckets: {} bytes of {DATA_BYTES}", length());
}

#[test]
fn only_a_board_that_cannot_move_may_write() {
    let mut healthy = board();
    healthy.solenoids[2][1].duty = 900;
    healthy.cut_off.0.set(Some(true));
    assert!(Disabled::new(&mut healthy).is_ok());
    assert!(healthy.solenoids.iter().flatten().all(|pwm| pwm.duty == 0), "the proof switches everything off");
    assert_eq!(healthy.cut_off.0.get(), Some(false));

    let mut welded = board();
    welded.cut_off_read_back = Wire::new(true);
    assert_eq!(Disabled::new(&mut welded).unwrap_err(), NotDisabled::CutOffClosed);

    let mut blind = board();
    blind.cut_off_read_back.0 = std::rc::Rc::new(std::cell::Cell::new(None));
    assert_eq!(Disabled::new(&mut blind).unwrap_err(), NotDisabled::Board(BoardError::CutOffReadBack));

    let mut deaf = board();
    deaf.solenoids[1][0].works = false;
    deaf.solenoids[3][0].duty = 5;
    assert_eq!(Disabled::new(&mut deaf).unwrap_err(), NotDisabled::Board(BoardError::Solenoid(1, 0)));
    assert_eq!(deaf.solenoids[3][0].duty, 0, "one bad output keeps no other on");
}

#[test]
fn buckets_change_the_tip_and_nothing_else() {
    let record = record(0.1);
    let own = record.parameters_for(0).unwrap();
    let ditch = record.parameters_for(1).unwrap();
    assert_eq!(own, record.parameters);
    assert_eq!(ditch.geometry.bucket_m, own.geometry.bucket_m * 1.1);
    assert_eq!((ditch.geometry.bucket.stroke, ditch.geometry.bucket.rocker_m), {
        let bucket = own.geometry.bucket;
        (bucket.stroke, bucket.rocker_m)
    });
    for missing in [2, 7, 8, usize::MAX] {
        let error = record.parameters_for(missing).unwrap_err().to_string();
        assert_eq!(error, format!("`buckets[{missing}]` is empty"));
    }
}

#[test]
fn a_bucket_that_does_not_fit_the_machine_is_refused_by_field() {
    let mut long = record(0.1);
    long.buckets[1].as_mut().unwrap().bucket_m = -1.0;
    let error = Sealed::new(&long).unwrap_err().to_string();
    assert!(error.contains("`buckets[1]`") && error.contains("`links.bucket_m`"), "{error}");
    let mut gap = record(0.1);
    gap.buckets[3] = gap.buckets[1];
    assert_eq!(Sealed::new(&gap).unwrap_err().to_string(), "`buckets[2]` is empty");
    let mut none = record(0.1);
    none.buckets = [None; 8];
    assert_eq!(Sealed::new(&none).unwrap_err().to_string(), "`buckets[0]` is empty");
}
