//! Parameter records: bytes as they stand, and the same as data under a header that fits them.

use std::sync::LazyLock;

use firmware::board::Controller;
use firmware::can::address::Addresses;
use firmware::simulated::link::NAME;
use firmware::simulated::{SimulatedBoard, Wires};
use firmware::store::copy::{DATA_BYTES, FORMAT_VERSION, HEADER_BYTES, decode};
use firmware::store::{CopyFault, Decoded, Sealed, StoredRecord};
use firmware::{Parameters, SelfTest};

use super::sound;

/// Ticks that a controller built from an accepted record runs.
const TICKS: u32 = 20;

/// A copy in flash; the first byte says whether a header is put in front that fits what follows.
pub fn parameter_record(bytes: &[u8]) {
    let [kind, rest @ ..] = bytes else { return };
    let copy = if kind & 1 == 0 { rest.to_vec() } else { [&header(rest)[..], rest].concat() };
    let decoded = decode(&copy);
    if kind & 1 == 1 && rest.len() <= DATA_BYTES {
        reads_as_postcard_does(rest, &decoded);
    }
    match decoded {
        Err(fault) => {
            // As text: a value at fault that is NaN does not equal itself.
            let again = Sealed::from_bytes(&copy).map(drop).map_err(|fault| fault.to_string());
            assert_eq!(again, Err(fault.to_string()));
        }
        Ok(decoded) => {
            let sealed = Sealed::from_bytes(&copy).expect("as it was decoded");
            assert_eq!(sealed.is_approved(), decoded.approved);
            let again = Sealed::new(&decoded.record).unwrap_or_else(|fault| panic!("{fault}"));
            // The bytes and not the values: a NaN in a value would not equal itself.
            let record = decode(again.as_bytes()).unwrap_or_else(|fault| panic!("{fault}")).record;
            assert_eq!(postcard::to_stdvec(&record).ok(), postcard::to_stdvec(&decoded.record).ok());
            let bucket = usize::from(kind >> 1) % firmware::store::MAX_BUCKETS;
            runs(&record, bucket);
        }
    }
}

/// The firmware's own reading of a record's data takes what serde and postcard take, and refuses what they refuse.
fn reads_as_postcard_does(data: &[u8], decoded: &Result<Decoded, CopyFault>) {
    let whole = postcard::take_from_bytes::<StoredRecord>(data).ok().filter(|(_, rest)| rest.is_empty());
    match (whole, decoded) {
        (None, decoded) => assert_eq!(decoded.as_ref().err(), Some(&CopyFault::Malformed)),
        (Some(_), Err(fault)) => assert!(matches!(fault, CopyFault::Record(_)), "{fault}"),
        (Some((record, _)), Ok(decoded)) => {
            assert_eq!(postcard::to_stdvec(&record).ok(), postcard::to_stdvec(&decoded.record).ok());
        }
    }
}

/// What is accepted runs without a NaN, or is refused by name.
fn runs(record: &StoredRecord, bucket: usize) {
    match record.parameters_for(bucket) {
        Err(error) => assert!(error.to_string().contains('`'), "{error}"),
        Ok(parameters) => accepted(&parameters),
    }
}

/// Parameters that their own check has passed.
pub(super) fn accepted(parameters: &Parameters) {
    static WIRES: LazyLock<Wires> = LazyLock::new(middle);
    let mut controller = match Controller::new(parameters, Addresses::DEFAULT, &NAME) {
        Ok(controller) => controller,
        Err(error) => return assert!(error.to_string().contains('`'), "{error}"),
    };
    controller.self_tested(&SelfTest::PASSED);
    let mut board = SimulatedBoard::new().expect("good chips");
    let mut wires = *WIRES;
    for tick in 0..TICKS {
        // Every code in turn, and both switches.
        wires.volts[0][(tick % 4) as usize] = 10.0 * (tick as f32) / (TICKS as f32);
        wires.enable = tick > TICKS / 2;
        board.connect(&wires);
        sound(&controller.cycle(board.parts(), false));
        wires.cut_off_closed = board.pins().cut_off_closed;
    }
}

/// Sensors in mid-stroke, supplies good, coils without current.
fn middle() -> Wires {
    let mut volts = [[0.0; 8]; 2];
    volts[0] = [5.0, 5.0, 5.0, 5.0, 24.0 * 10.24 / 40.0, 10.0, 0.0, 0.0];
    Wires {
        volts,
        converters: [None; 2],
        enable: false,
        emergency_stop_released: true,
        cut_off_closed: false,
        overrun: false,
        frames: [None; firmware::simulated::FRAMES_IN],
    }
}

/// A header that fits these data, nobody's approval in it.
pub fn header(data: &[u8]) -> [u8; HEADER_BYTES] {
    const CRC: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let words = [u32::from_le_bytes(*b"XCPR"), FORMAT_VERSION, 1, data.len() as u32, CRC.checksum(data), !0, !0];
    let mut header: Vec<u8> = words.into_iter().flat_map(u32::to_le_bytes).collect();
    header.extend(CRC.checksum(&header).to_le_bytes());
    header.try_into().expect("eight words")
}
