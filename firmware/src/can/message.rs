//! What a message is: its identifier, its rate and its signals.

use super::frame::CanFrame;
use super::id::Identifier;
use super::protect;
use super::signal::{Signal, Unusable, Word};

/// Who sends a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sender {
    /// This controller.
    Controller,
    /// The operator's levers, panel or remote control.
    Operator,
    /// The slope sensor on the chassis.
    SlopeSensor,
    /// The pressure sensors' gateway.
    PressureSensors,
    /// The engineer's service tool.
    ServiceTool,
    /// Any node.
    Any,
}

impl Sender {
    /// As in the DBC file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Controller => "Controller",
            Self::Operator => "Operator",
            Self::SlopeSensor => "SlopeSensor",
            Self::PressureSensors => "PressureSensors",
            Self::ServiceTool => "ServiceTool",
            Self::Any => "Vector__XXX",
        }
    }
}

/// How often a message is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// At a constant period; `phase_ms` after each multiple of it where this controller sends.
    Every {
        /// Period, ms.
        ms: u16,
        /// Phase, ms.
        phase_ms: u16,
    },
    /// On an event, but never sooner than so long after the last one, ms.
    AtMostEvery(u16),
}

/// All of a message but its signals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Header {
    /// In CamelCase.
    pub name: Word,
    /// What it is for.
    pub about: Word,
    /// Parameter group number.
    pub pgn: u32,
    /// 0…7.
    pub priority: u8,
    /// Who sends it.
    pub sender: Sender,
    /// How often.
    pub rate: Rate,
    /// Bytes on the bus: eight but for J1939's request.
    pub bytes: u8,
    /// Its last two signals are alive counter and CRC, see [`protect`].
    pub protected: bool,
}

/// A message of `N` signals; bits without a signal are ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Message<const N: usize> {
    /// Everything else.
    pub header: Header,
    /// Its signals.
    pub signals: [Signal; N],
}

/// A message without its number of signals, for tables.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The message's header.
    pub header: &'static Header,
    /// Its signals.
    pub signals: &'static [Signal],
}

impl Header {
    /// The identifier of a sender at this address.
    pub const fn identifier(&self, source: u8) -> Identifier {
        Identifier::global(self.priority, self.pgn, source)
    }

    /// Whether the controller sends it in the millisecond `now_ms` of a schedule that began at 0.
    pub const fn is_due(&self, now_ms: u32) -> bool {
        match self.rate {
            // Checked, so that no division by zero can be linked.
            Rate::Every { ms, phase_ms } => {
                matches!(now_ms.checked_rem(ms as u32), Some(into_period) if into_period == phase_ms as u32)
            }
            Rate::AtMostEvery(_) => false,
        }
    }

    /// The frame of a sender at this address; a protected message gets the counter and its CRC.
    #[inline(never)]
    pub fn frame(&self, source: u8, counter: u8, payload: u64) -> CanFrame {
        let id = self.identifier(source);
        let payload = if self.protected { protect::seal(id, counter, payload) } else { payload };
        CanFrame::of_payload(id.extended(), payload)
    }
}

impl<const N: usize> Message<N> {
    /// For tables.
    pub const fn entry(&'static self) -> Entry {
        Entry { header: &self.header, signals: &self.signals }
    }

    /// The payload with these codes, unused bits one.
    pub fn pack(&self, codes: [u32; N]) -> u64 {
        pack(&self.signals, &codes)
    }

    /// Every signal's code.
    pub fn unpack(&self, payload: u64) -> [u32; N] {
        self.signals.each_ref().map(|signal| signal.code_in(payload))
    }

    /// The payload with these values; a value that cannot be sent becomes its signal's error code.
    pub fn encode(&self, values: [f32; N]) -> u64 {
        encode(&self.signals, &values)
    }

    /// The payload that says of every signal that it is at fault.
    pub fn faulty(&self) -> u64 {
        faulty(&self.signals)
    }

    /// Every signal's value, or why there is none.
    pub fn decode(&self, payload: u64) -> [Result<f32, Unusable>; N] {
        self.signals.each_ref().map(|signal| signal.value(signal.code_in(payload)))
    }

    /// As [`Header::frame`].
    pub fn frame(&self, source: u8, counter: u8, payload: u64) -> CanFrame {
        self.header.frame(source, counter, payload)
    }
}

// An image holds these once, and not for every number of signals.

#[inline(never)]
fn pack(signals: &[Signal], codes: &[u32]) -> u64 {
    signals.iter().zip(codes).fold(u64::MAX, |payload, (signal, &code)| signal.put(payload, code))
}

#[inline(never)]
fn encode(signals: &[Signal], values: &[f32]) -> u64 {
    signals.iter().zip(values).fold(u64::MAX, |payload, (signal, &value)| signal.put(payload, signal.code(value)))
}

#[inline(never)]
fn faulty(signals: &[Signal]) -> u64 {
    signals.iter().fold(u64::MAX, |payload, signal| signal.put(payload, signal.error()))
}
