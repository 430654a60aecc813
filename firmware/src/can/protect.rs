//! The last two bytes of a protected message: a 4-bit alive counter in byte 7, bits 1–4, and a CRC in byte 8.
//!
//! The CRC is AUTOSAR's CRC-8: polynomial 2Fₕ, start FFₕ, final exclusive-or FFₕ, most significant bit first. It runs over the 29-bit
//! identifier as four bytes, lowest first, then bytes 1 to 7: a message under another's identifier does not pass. Over these 96
//! bits it sees every error of up to three bits, which the 4-bit sum of J1939's own protected messages does not.

use super::id::Identifier;
use super::signal::Signal;

/// Counts up by one with every message, from 15 to 0.
pub const COUNTER: Signal = Signal::bits("AliveCounter", 48, 4);
/// The CRC.
pub const CRC: Signal = Signal::bits("Crc", 56, 8);

const POLYNOMIAL: u8 = 0x2f;

/// What eight shifts make of each byte.
const TABLE: [u8; 256] = table();

const fn table() -> [u8; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut rest = byte as u8;
        let mut bit = 0;
        while bit < 8 {
            rest = if rest & 0x80 == 0 { rest << 1 } else { (rest << 1) ^ POLYNOMIAL };
            bit += 1;
        }
        table[byte] = rest;
        byte += 1;
    }
    table
}

/// The CRC of a payload under an identifier; byte 8 of the payload does not count.
pub fn crc(id: Identifier, payload: u64) -> u8 {
    let [p1, p2, p3, p4, p5, p6, p7, _] = payload.to_le_bytes();
    let [i1, i2, i3, i4] = id.raw().to_le_bytes();
    let bytes = [i1, i2, i3, i4, p1, p2, p3, p4, p5, p6, p7];
    // A byte always finds its entry in a table of 256.
    !bytes.into_iter().fold(0xff_u8, |crc, byte| TABLE[usize::from(crc ^ byte)])
}

/// The payload with its counter and CRC.
pub fn seal(id: Identifier, counter: u8, payload: u64) -> u64 {
    let counted = COUNTER.put(payload, counter.into());
    CRC.put(counted, crc(id, counted).into())
}

/// The counter, when the CRC is right.
pub fn open(id: Identifier, payload: u64) -> Option<u8> {
    (CRC.code_in(payload) == u32::from(crc(id, payload))).then(|| COUNTER.code_in(payload) as u8)
}
