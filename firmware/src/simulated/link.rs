//! The conversation between the emulated image and the harness.
//!
//! ```text
//! harness → image   u32 length, parameter record (postcard)
//! image → harness   u32 length, text of the error; length 0: ready
//! each tick:
//! harness → image   Request
//! image → harness   Reply, or to a Spoil the u32 of a Zone
//! at the end:
//! image → harness   u32 deepest use of the stack, bytes; of `spoilt-emulated` the most instructions of its watch
//! ```
//! What is measured travels beside the outputs, never in them.

use core::fmt;

use super::{PIN_BYTES, Pins, WIRE_BYTES, WireError, Wires};
use crate::Outputs;
use crate::can::address::Name;
use crate::frame::{FrameError, OUTPUT_BYTES};

const KIND_END: u8 = 0;
const KIND_TICK: u8 = 1;
const KIND_FLIP: u8 = 2;
const KIND_LOSE: u8 = 3;
/// Room for a parameter record, bytes.
pub const RECORD_BYTES: usize = 2048;
/// Longest text of a refusal, bytes: what does not fit is cut.
pub const REFUSAL_BYTES: usize = 256;
/// A request, bytes.
pub const REQUEST_BYTES: usize = 1 + WIRE_BYTES;
/// A reply, bytes.
pub const REPLY_BYTES: usize = OUTPUT_BYTES + PIN_BYTES + 8;
/// The simulated controller's NAME on the bus.
pub const NAME: Name = Name { identity: 1, manufacturer: 0, ecu_instance: 0, function_instance: 0 };

/// What the harness asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// A tick with these at the connectors.
    Tick(Wires),
    /// The end of the run.
    End,
    /// Something shall break, now, before the next tick: only the image `spoilt-emulated` does it.
    Spoil(Spoil),
}

/// What shall break in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spoil {
    /// One bit of the controller's memory turns.
    Flip {
        /// Its byte, of the controller's; beyond them it starts over.
        byte: u32,
        /// 0 to 7.
        bit: u8,
    },
    /// The timer's next interrupts are lost: so many, `u32::MAX` for ever.
    LoseTicks(u32),
}

/// Where in the controller's memory a bit was turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Zone {
    /// Among the constants that are read over and over.
    Watched,
    /// Elsewhere in the controller: its state.
    State,
    /// In what planned motion needs of memory.
    Followers,
}

impl Zone {
    /// Every zone.
    pub const ALL: [Self; 3] = [Self::Watched, Self::State, Self::Followers];

    /// As a word.
    pub const fn code(self) -> u32 {
        self as u32
    }

    /// From a word.
    pub fn from_code(code: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|zone| zone.code() == code)
    }
}

impl Request {
    /// As bytes.
    pub fn to_bytes(&self) -> [u8; REQUEST_BYTES] {
        let mut bytes = [0; REQUEST_BYTES];
        let [kind, rest @ ..] = &mut bytes;
        match self {
            Self::Tick(wires) => (*kind, *rest) = (KIND_TICK, wires.to_bytes()),
            Self::End => *kind = KIND_END,
            Self::Spoil(spoil) => {
                let (what, numbers) = match *spoil {
                    Spoil::Flip { byte, bit } => (KIND_FLIP, [byte, bit.into()]),
                    Spoil::LoseTicks(ticks) => (KIND_LOSE, [ticks, 0]),
                };
                *kind = what;
                rest.iter_mut().zip(numbers.into_iter().flat_map(u32::to_le_bytes)).for_each(|(to, from)| *to = from);
            }
        }
        bytes
    }

    /// From bytes.
    ///
    /// # Errors
    /// A byte that means nothing.
    pub fn from_bytes(bytes: &[u8; REQUEST_BYTES]) -> Result<Self, WireError> {
        let [kind, rest @ ..] = bytes;
        let mut numbers = rest.iter().copied();
        let [first, second] = [(); 2].map(|()| u32::from_le_bytes(taken(&mut numbers)));
        match *kind {
            KIND_TICK => Wires::from_bytes(rest).map(Self::Tick),
            KIND_END => Ok(Self::End),
            KIND_FLIP => match u8::try_from(second) {
                Ok(bit @ 0..8) => Ok(Self::Spoil(Spoil::Flip { byte: first, bit })),
                _ => Err(WireError { field: "bit", value: second as u8 }),
            },
            KIND_LOSE => Ok(Self::Spoil(Spoil::LoseTicks(first))),
            value => Err(WireError { field: "kind", value }),
        }
    }
}

/// What the image gives back for a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// The application's outputs.
    pub outputs: Outputs,
    /// What the board put on its pins.
    pub pins: Pins,
    /// Start of the tick in virtual time, ns, wrapping.
    pub started_ns: u32,
    /// Instructions of `Ecu::tick`.
    pub instructions: u32,
}

/// Bytes that are no [`Reply`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReplyError {
    /// The outputs are none.
    Outputs(FrameError),
    /// The pins are none.
    Pins(WireError),
}

impl fmt::Display for ReplyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outputs(error) => write!(f, "outputs: {error}"),
            Self::Pins(error) => write!(f, "pins: {error}"),
        }
    }
}

impl core::error::Error for ReplyError {}

impl Reply {
    /// As bytes.
    pub fn to_bytes(&self) -> [u8; REPLY_BYTES] {
        let mut bytes = [0; REPLY_BYTES];
        let measured = (u64::from(self.instructions) << 32 | u64::from(self.started_ns)).to_le_bytes();
        let parts = self.outputs.to_bytes().into_iter().chain(self.pins.to_bytes()).chain(measured);
        bytes.iter_mut().zip(parts).for_each(|(to, from)| *to = from);
        bytes
    }

    /// From bytes.
    ///
    /// # Errors
    /// A byte that names nothing.
    pub fn from_bytes(bytes: &[u8; REPLY_BYTES]) -> Result<Self, ReplyError> {
        let mut rest = bytes.iter().copied();
        let outputs: [u8; OUTPUT_BYTES] = taken(&mut rest);
        let pins: [u8; PIN_BYTES] = taken(&mut rest);
        let [started_ns, instructions] = [taken(&mut rest), taken(&mut rest)].map(u32::from_le_bytes);
        Ok(Self {
            outputs: Outputs::from_bytes(&outputs).map_err(ReplyError::Outputs)?,
            pins: Pins::from_bytes(&pins).map_err(ReplyError::Pins)?,
            started_ns,
            instructions,
        })
    }
}

/// The next bytes of a buffer that has them.
fn taken<const N: usize>(bytes: &mut impl Iterator<Item = u8>) -> [u8; N] {
    [(); N].map(|()| bytes.next().unwrap_or(0))
}
