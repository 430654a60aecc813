//! The conversation between the emulated image and the harness.
//!
//! ```text
//! harness → image   u32 length, parameter record (postcard)
//! image → harness   u32 length, text of the error; length 0: ready
//! each tick:
//! harness → image   KIND_TICK, Wires              (or KIND_END and padding)
//! image → harness   Outputs, Pins, u32 start of the tick [ns of virtual time], u32 instructions of `Ecu::tick`
//! at the end:
//! image → harness   u32 deepest use of the stack, bytes
//! ```
//! What is measured travels beside the outputs, never in them.

use super::PIN_BYTES;
use crate::can::address::Name;
use crate::frame::OUTPUT_BYTES;

/// First byte of a message that asks for a tick.
pub const KIND_TICK: u8 = 1;
/// First byte of the message that ends the run.
pub const KIND_END: u8 = 0;
/// Room for a parameter record, bytes.
pub const RECORD_BYTES: usize = 2048;
/// Outputs, pins and the two measurements, bytes.
pub const REPLY_BYTES: usize = OUTPUT_BYTES + PIN_BYTES + 8;
/// The simulated controller's NAME on the bus.
pub const NAME: Name = Name { identity: 1, manufacturer: 0, ecu_instance: 0, function_instance: 0 };
