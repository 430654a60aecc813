//! J1939 identifiers and frames: PDU1 and PDU2 told apart, nothing lost, and no frame of another kind let in.

use embedded_can::{ExtendedId, Frame, Id, StandardId};
use firmware::can::CanFrame;
use firmware::can::id::{GLOBAL, Identifier, is_addressed};
use firmware::can::table::MESSAGES;
use proptest::prelude::*;

/// A frame as a HAL has it: any identifier, maybe remote.
struct Theirs {
    id: Id,
    data: Vec<u8>,
    remote: bool,
}

impl Frame for Theirs {
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        Some(Self { id: id.into(), data: data.to_vec(), remote: false })
    }
    fn new_remote(id: impl Into<Id>, _: usize) -> Option<Self> {
        Some(Self { id: id.into(), data: Vec::new(), remote: true })
    }
    fn is_extended(&self) -> bool {
        matches!(self.id, Id::Extended(_))
    }
    fn is_remote_frame(&self) -> bool {
        self.remote
    }
    fn id(&self) -> Id {
        self.id
    }
    fn dlc(&self) -> usize {
        self.data.len()
    }
    fn data(&self) -> &[u8] {
        &self.data
    }
}

fn extended(raw: u32) -> ExtendedId {
    ExtendedId::new(raw).unwrap()
}

#[test]
fn identifiers_of_the_standard_are_read_as_it_says() {
    // DM1 from 80 hex; a request for everyone from F9; TSC1 (PGN 0) for engine 00 from 0B; ETC1 (PGN F002) from 03.
    for (raw, priority, pgn, destination, source) in [
        (0x18fe_ca80, 6, 65226, GLOBAL, 0x80),
        (0x18ea_fff9, 6, 59904, GLOBAL, 0xf9),
        (0x0c00_000b, 3, 0, 0x00, 0x0b),
        (0x0cf0_0203, 3, 61442, GLOBAL, 0x03),
        (0x1cec_2180, 7, 60416, 0x21, 0x80),
        // The data page belongs to the PGN.
        (0x1df0_0203, 7, 0x1_f002, GLOBAL, 0x03),
    ] {
        let id = Identifier { priority, pgn, destination, source };
        assert_eq!(Identifier::of(extended(raw)), id, "{raw:08x}");
        assert_eq!(id.raw(), raw, "{raw:08x}");
    }
    assert!(is_addressed(0xef00) && !is_addressed(0xf000));
}

#[test]
fn no_two_messages_share_an_identifier() {
    let mut pgns: Vec<u32> = MESSAGES.iter().map(|entry| entry.header.pgn).collect();
    pgns.sort_unstable();
    pgns.dedup();
    assert_eq!(pgns.len(), MESSAGES.len());
}

#[test]
fn frames_of_another_kind_do_not_become_ours() {
    let standard = Id::Standard(StandardId::new(0x123).unwrap());
    let theirs = |id, length| CanFrame::of_frame(&Theirs::new(id, &vec![7; length]).unwrap());
    assert!(theirs(standard, 8).is_none());
    assert!(CanFrame::of_frame(&Theirs::new_remote(extended(5), 8).unwrap()).is_none());
    assert!(theirs(Id::Extended(extended(5)), 9).is_none());
    let ours = theirs(Id::Extended(extended(5)), 3).unwrap();
    assert_eq!((ours.id(), ours.data(), ours.dlc(), ours.is_extended()), (extended(5).into(), &[7; 3][..], 3, true));
    assert!(!ours.is_remote_frame() && CanFrame::new_remote(extended(5), 0).is_none());
    assert_eq!((ours.payload(), ours.first_three()), (None, Some(0x0007_0707)));
    assert_eq!(theirs(Id::Extended(extended(5)), 2).unwrap().first_three(), None);
}

proptest! {
    #[test]
    fn every_identifier_survives_being_taken_apart(raw in 0_u32..1 << 29) {
        prop_assert_eq!(Identifier::of(extended(raw)).raw(), raw);
        prop_assert_eq!(Identifier::of(extended(raw)).extended(), extended(raw));
    }

    #[test]
    fn every_data_frame_comes_through_unchanged(raw in 0_u32..1 << 29, data in prop::collection::vec(any::<u8>(), 0..=8)) {
        let ours = CanFrame::of_frame(&Theirs::new(extended(raw), &data).unwrap()).unwrap();
        prop_assert_eq!(ours.data(), &data[..]);
        prop_assert_eq!(ours.extended_id(), extended(raw));
        let whole = <[u8; 8]>::try_from(data).ok().map(u64::from_le_bytes);
        prop_assert_eq!(ours.payload(), whole);
    }
}
