//! J1939-21's 29-bit identifier: priority, parameter group number (PGN), destination and source.
//!
//! ```text
//! 28…26 priority | 25 extended data page | 24 data page | 23…16 PDU format | 15…8 PDU specific | 7…0 source
//! ```
//! A PDU format below 240 (PDU1) addresses one node, named in PDU specific, which is then no part of the PGN. From 240 up (PDU2)
//! everyone is addressed and PDU specific belongs to the PGN.

use embedded_can::ExtendedId;

/// The destination that means everyone.
pub const GLOBAL: u8 = 0xff;
/// The source of a node without an address.
pub const NULL: u8 = 0xfe;

/// First PDU format without a destination.
const FIRST_PDU2: u32 = 240;

/// An identifier's parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identifier {
    /// 0 wins the bus first, 7 last.
    pub priority: u8,
    /// 18 bits; the lowest eight are zero for PDU1.
    pub pgn: u32,
    /// [`GLOBAL`] for PDU2.
    pub destination: u8,
    /// Who sends.
    pub source: u8,
}

/// Whether a PGN's messages carry a destination.
pub const fn is_addressed(pgn: u32) -> bool {
    (pgn >> 8) & 0xff < FIRST_PDU2
}

impl Identifier {
    /// To everyone.
    pub const fn global(priority: u8, pgn: u32, source: u8) -> Self {
        Self { priority, pgn, destination: GLOBAL, source }
    }

    /// Takes an identifier apart.
    pub fn of(id: ExtendedId) -> Self {
        let raw = id.as_raw();
        let [source, specific, _, top] = raw.to_le_bytes();
        let pgn = (raw >> 8) & 0x3_ffff;
        let (pgn, destination) = if is_addressed(pgn) { (pgn & 0x3_ff00, specific) } else { (pgn, GLOBAL) };
        Self { priority: top >> 2, pgn, destination, source }
    }

    /// The 29 bits. Bits of a field that do not fit it are dropped.
    pub const fn raw(self) -> u32 {
        let specific = if is_addressed(self.pgn) { (self.pgn & 0x3_ff00) | self.destination as u32 } else { self.pgn };
        (self.priority as u32 & 7) << 26 | (specific & 0x3_ffff) << 8 | self.source as u32
    }

    /// As embedded-can's identifier.
    pub const fn extended(self) -> ExtendedId {
        match ExtendedId::new(self.raw()) {
            Some(id) => id,
            // `raw` has 29 bits.
            None => ExtendedId::MAX,
        }
    }
}
