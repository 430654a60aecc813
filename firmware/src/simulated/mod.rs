//! The reference ECU's board made of simulated chips, and what enters and leaves it each tick: the same in the harness and in the
//! emulated image.
//!
//! - [`Wires`] — volts, switches and CAN frames at the board's connectors; [`Pins`] — what the board does about them;
//! - [`SimulatedBoard`] — the drivers of [`crate::board`] on the chips of `sim-chips`, byte by byte;
//! - [`link`] — the conversation between the emulated image and the harness.

mod board;
pub mod link;
mod wires;

pub use board::SimulatedBoard;
pub use wires::{FRAMES_IN, FRAMES_OUT, PIN_BYTES, Pins, WIRE_BYTES, WireError, Wires};
