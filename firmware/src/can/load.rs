//! What the messages cost the bus at worst.

use super::message::{Entry, Rate, Sender};
use super::table::MESSAGES;

/// Bits a second.
pub const BIT_RATE: u32 = 500_000;

/// The most the bus may be loaded, percent.
pub const MOST_PERCENT: u32 = 45;

/// Of a frame with a 29-bit identifier, without data: bits that may be stuffed.
const STUFFED: u32 = 54;
/// Delimiters, acknowledgement, end of frame and the gap to the next, never stuffed.
const UNSTUFFED: u32 = 13;

/// Bits of a frame with a 29-bit identifier at most, stuff bits and the gap to the next included (Davis et al. 2007 (2)).
pub const fn worst_bits(data_bytes: u32) -> u32 {
    let open = STUFFED + 8 * data_bytes;
    open + UNSTUFFED + (open - 1) / 4
}

/// Messages a second at most.
pub const fn per_second(rate: Rate) -> u32 {
    let (Rate::Every { ms, .. } | Rate::AtMostEvery(ms)) = rate;
    1000_u32.div_ceil(ms as u32)
}

/// Bits a second at worst of all messages, or of the controller's own.
pub const fn bits_per_second(own_only: bool) -> u32 {
    let (mut sum, mut i) = (0, 0);
    while i < MESSAGES.len() {
        let Entry { header, .. } = MESSAGES[i];
        if !own_only || matches!(header.sender, Sender::Controller) {
            sum += per_second(header.rate) * worst_bits(header.bytes as u32);
        }
        i += 1;
    }
    sum
}

const _: () = assert!(bits_per_second(false) * 100 <= MOST_PERCENT * BIT_RATE, "the bus is loaded too much");
