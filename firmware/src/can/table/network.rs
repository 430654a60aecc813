//! J1939's own messages: diagnostics, transport, addresses.

use crate::can::message::{Header, Message, Rate, Sender};
use crate::can::signal::{Signal, Word, states, words};

const fn network(name: &'static str, pgn: u32, priority: u8, rate: Rate, about: &'static str) -> Header {
    Header {
        name: words(name),
        about: words(about),
        pgn,
        priority,
        sender: Sender::Controller,
        rate,
        bytes: 8,
        protected: false,
    }
}

/// Ticks between two messages of the diagnostics at least, and between two packets of a broadcast (J1939-21: 50 to 200 ms).
pub const DIAGNOSTICS_GAP_MS: u16 = 50;
/// Ticks between two answers to requests for the address at least.
pub const CLAIM_GAP_MS: u16 = 50;

const LAMP: [(u32, Word); 2] = states([(0, "off"), (1, "on")]);

/// Active trouble codes, J1939-73. One, or none: this frame. More: the same bytes, four for each code, by transport.
pub static DM1: Message<10> = Message {
    header: network(
        "Dm1",
        65226,
        6,
        Rate::AtMostEvery(DIAGNOSTICS_GAP_MS),
        "Active faults (J1939-73 DM1): every second and on change, no fault's change sooner than a second after its last. No fault: \
         all zero. With more than one, each adds four bytes and the message is broadcast in packets.",
    ),
    signals: [
        Signal::states("ProtectLamp", 0, 2, &LAMP),
        Signal::states("AmberWarningLamp", 2, 2, &LAMP),
        Signal::states("RedStopLamp", 4, 2, &LAMP),
        Signal::states("MalfunctionLamp", 6, 2, &LAMP),
        Signal::bits("SpnLow", 16, 16),
        Signal::bits("Fmi", 32, 5),
        Signal::bits("SpnHigh", 37, 3),
        Signal::bits("Occurrences", 40, 7),
        Signal::bits("ConversionMethod", 47, 1),
        Signal::bits("LampFlash", 8, 8),
    ],
};

const CONTROL: [(u32, Word); 1] = states([(32, "broadcast_announce")]);

/// Announces a broadcast in packets, J1939-21.
pub static TRANSPORT_CONTROL: Message<4> = Message {
    header: network(
        "TransportControl",
        60416,
        7,
        Rate::AtMostEvery(DIAGNOSTICS_GAP_MS),
        "TP.CM_BAM (J1939-21): announces a broadcast in packets.",
    ),
    signals: [
        Signal::states("Control", 0, 8, &CONTROL),
        Signal::bits("Bytes", 8, 16),
        Signal::bits("Packets", 24, 8),
        Signal::bits("AnnouncedPgn", 40, 24),
    ],
};

/// A packet of a broadcast, J1939-21.
pub static TRANSPORT_DATA: Message<8> = Message {
    header: network(
        "TransportData",
        60160,
        7,
        Rate::AtMostEvery(DIAGNOSTICS_GAP_MS),
        "TP.DT (J1939-21): seven bytes of the announced message, the last packet filled with FF hex.",
    ),
    signals: [
        Signal::bits("Sequence", 0, 8),
        Signal::bits("Byte1", 8, 8),
        Signal::bits("Byte2", 16, 8),
        Signal::bits("Byte3", 24, 8),
        Signal::bits("Byte4", 32, 8),
        Signal::bits("Byte5", 40, 8),
        Signal::bits("Byte6", 48, 8),
        Signal::bits("Byte7", 56, 8),
    ],
};

/// The controller's NAME, J1939-81.
pub static ADDRESS_CLAIMED: Message<10> = Message {
    header: network(
        "AddressClaimed",
        60928,
        6,
        Rate::AtMostEvery(CLAIM_GAP_MS),
        "The controller's NAME (J1939-81): at the start, when asked, and against another claim; from address 254 it says that the \
         address is lost, after which nothing more is sent.",
    ),
    signals: [
        Signal::bits("Identity", 0, 21),
        Signal::bits("Manufacturer", 21, 11),
        Signal::bits("EcuInstance", 32, 3),
        Signal::bits("FunctionInstance", 35, 5),
        Signal::bits("Function", 40, 8),
        Signal::bits("Reserved", 48, 1),
        Signal::bits("VehicleSystem", 49, 7),
        Signal::bits("VehicleSystemInstance", 56, 4),
        Signal::bits("IndustryGroup", 60, 3),
        Signal::bits("ArbitraryAddress", 63, 1),
    ],
};

/// A request, answered for the address alone.
pub static REQUEST: Message<1> = Message {
    header: Header {
        sender: Sender::Any,
        bytes: 3,
        ..network(
            "Request",
            59904,
            6,
            Rate::AtMostEvery(CLAIM_GAP_MS),
            "Asks for a PGN (J1939-21); only 60928 is answered.",
        )
    },
    signals: [Signal::bits("RequestedPgn", 0, 24)],
};
