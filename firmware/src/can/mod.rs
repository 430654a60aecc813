//! The CAN bus: SAE J1939 identifiers, addresses, commands and sensors in, telemetry and diagnostics out.
//!
//! - [`frame`], [`id`] and [`address`] — frames, 29-bit identifiers, the claim of an address (J1939-21, J1939-81);
//! - [`signal`] and [`message`] — how a signal lies in a payload, and what a message is;
//! - [`table`] — every message of the bus, once: encoders, decoders, `docs/icd.md` and `docs/excavator.dbc` all come from it;
//! - [`protect`] and [`receive`] — alive counter and CRC, and whether a received value may be used;
//! - [`command`] and [`inbox`] — what the operator and the sensors say;
//! - [`telemetry`], [`dm1`] and [`load`] — what the controller says, its active faults, and what all of it costs the bus;
//! - [`node`] — all of it together: three calls a tick.

pub mod address;
pub mod command;
pub mod dm1;
pub mod frame;
pub mod id;
pub mod inbox;
pub mod load;
pub mod message;
pub mod node;
pub mod protect;
pub mod receive;
pub mod signal;
pub mod table;
pub mod telemetry;

pub use frame::CanFrame;
pub use node::Node;
