//! The protection of a message: AUTOSAR's CRC-8 over identifier and bytes, which sees every error of up to three bits.

use crc::{CRC_8_AUTOSAR, Crc};
use firmware::can::id::Identifier;
use firmware::can::protect::{COUNTER, CRC, crc, open, seal};
use proptest::prelude::*;

/// The checksum of another implementation over the same bytes.
fn other(id: Identifier, payload: u64) -> u8 {
    let bytes = [&id.raw().to_le_bytes()[..], &payload.to_le_bytes()[..7]].concat();
    Crc::<u8>::new(&CRC_8_AUTOSAR).checksum(&bytes)
}

const ID: Identifier = Identifier::global(3, 65281, 0x81);

/// What the CRC of one error alone is, under a CRC that is linear: by it every pattern of errors is told from none.
fn syndromes() -> Vec<u8> {
    let none = Identifier::of(embedded_can::ExtendedId::ZERO);
    let zero = crc(none, 0);
    // The identifier's 29 bits, 56 of the bytes, and 8 of the CRC itself.
    let of_id = (0..29).map(|bit| {
        let raw = embedded_can::ExtendedId::new(1 << bit).unwrap();
        crc(Identifier::of(raw), 0) ^ zero
    });
    let of_bytes = (0..56).map(|bit| crc(none, 1 << bit) ^ zero);
    of_id.chain(of_bytes).chain((0..8).map(|bit| 1 << bit)).collect()
}

#[test]
fn every_error_of_up_to_three_bits_is_seen() {
    let all = syndromes();
    assert_eq!(all.len(), 93);
    let mut patterns = 0;
    for (i, a) in all.iter().enumerate() {
        assert_ne!(*a, 0);
        for (j, b) in all.iter().enumerate().skip(i + 1) {
            assert_ne!(a ^ b, 0, "bits {i} and {j}");
            for (k, c) in all.iter().enumerate().skip(j + 1) {
                assert_ne!(a ^ b ^ c, 0, "bits {i}, {j} and {k}");
                patterns += 1;
            }
        }
    }
    assert_eq!(patterns, 93 * 92 * 91 / 6);
}

#[test]
fn another_message_under_the_same_bytes_does_not_pass() {
    let sealed = seal(ID, 5, 0x1234);
    assert_eq!(open(ID, sealed), Some(5));
    for other in [Identifier { pgn: 65282, ..ID }, Identifier { source: 0x82, ..ID }, Identifier { priority: 6, ..ID }]
    {
        assert_eq!(open(other, sealed), None, "{other:?}");
    }
}

proptest! {
    #[test]
    fn the_crc_is_that_of_another_implementation(raw in 0_u32..1 << 29, payload: u64) {
        let id = Identifier::of(embedded_can::ExtendedId::new(raw).unwrap());
        prop_assert_eq!(crc(id, payload), other(id, payload));
    }

    // What the syndromes above rest on.
    #[test]
    fn the_crc_is_linear(a: u64, b: u64) {
        let zero = crc(ID, 0);
        prop_assert_eq!(crc(ID, a) ^ crc(ID, b) ^ zero, crc(ID, a ^ b));
    }

    #[test]
    fn a_sealed_payload_opens_and_keeps_everything_else(payload: u64, counter in 0_u8..16) {
        let sealed = seal(ID, counter, payload);
        prop_assert_eq!(open(ID, sealed), Some(counter));
        let bare = |payload: u64| CRC.put(COUNTER.put(payload, 0), 0);
        prop_assert_eq!(bare(sealed), bare(payload));
    }

    #[test]
    fn a_flipped_bit_does_not_open(payload: u64, counter in 0_u8..16, bit in 0_u32..64) {
        prop_assert_eq!(open(ID, seal(ID, counter, payload) ^ 1 << bit), None);
    }
}
