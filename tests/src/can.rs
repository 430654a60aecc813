//! A controller's node on a bench bus: frames in and out by hand, one tick at a time.

use embedded_can::Frame;
use firmware::can::address::{Addresses, Name};
use firmware::can::dm1::ActiveFaults;
use firmware::can::id::Identifier;
use firmware::can::inbox::Inbox;
use firmware::can::message::{Message, Sender};
use firmware::can::table::MESSAGES;
use firmware::can::table::network::ADDRESS_CLAIMED;
use firmware::can::{CanFrame, Node};
use firmware::{Fault, Outputs};

use crate::rig::Rig;

/// A maker's NAME for tests.
pub const NAME: Name = Name { identity: 0x1_2345, manufacturer: 0x2a5, ecu_instance: 1, function_instance: 2 };

/// A node with what it sees each tick.
#[derive(Clone, Debug)]
pub struct Bench {
    /// The node.
    pub node: Node,
    /// The application's outputs of every tick.
    pub outputs: Outputs,
    /// Active faults of every tick.
    pub active: ActiveFaults,
    /// Ticks so far.
    pub now: u32,
}

impl Bench {
    /// Freshly powered, the application's outputs those of a healthy machine at rest.
    pub fn new() -> Self {
        let node = Node::new(Addresses::DEFAULT, &NAME).unwrap();
        Self { node, outputs: Rig::new().ticks(3), active: ActiveFaults::NONE, now: 0 }
    }

    /// The same with its address claimed.
    pub fn claimed() -> Self {
        let mut bench = Self::new();
        while !bench.node.has_address() {
            bench.tick(&[]);
            assert!(bench.now < 300, "the address is never ours");
        }
        bench
    }

    /// One tick with these frames arriving; gives what is sent.
    pub fn tick(&mut self, frames: &[CanFrame]) -> Vec<CanFrame> {
        self.now += 1;
        self.node.aged();
        frames.iter().for_each(|frame| self.node.receive(frame));
        self.node.due(&self.outputs, self.active).into_iter().flatten().collect()
    }

    /// Several ticks in silence; what was sent, each with its tick, counted from 0.
    pub fn ticks(&mut self, count: u32) -> Vec<(u32, CanFrame)> {
        (0..count).flat_map(|at| self.tick(&[]).into_iter().map(move |frame| (at, frame))).collect()
    }

    /// What was received.
    pub fn inbox(&self) -> &Inbox {
        self.node.inbox()
    }
}

impl Default for Bench {
    fn default() -> Self {
        Self::new()
    }
}

/// A frame as its sender would send it.
pub fn sent<const N: usize>(message: &Message<N>, counter: u8, values: [f32; N]) -> CanFrame {
    from(message, counter, message.encode(values))
}

/// The same from a payload.
pub fn from<const N: usize>(message: &Message<N>, counter: u8, payload: u64) -> CanFrame {
    message.frame(address(message.header.sender), counter, payload)
}

/// Where a sender is on the bench.
pub fn address(sender: Sender) -> u8 {
    Addresses::DEFAULT.of(sender).unwrap_or(0x27)
}

/// The frame under another identifier.
pub fn under(frame: &CanFrame, id: Identifier) -> CanFrame {
    CanFrame::new(id.extended(), frame.data()).unwrap()
}

/// The frame with some bytes left.
pub fn cut(frame: &CanFrame, bytes: usize) -> CanFrame {
    CanFrame::new(frame.extended_id(), &frame.data()[..bytes]).unwrap()
}

/// The frame with one bit of its payload turned.
pub fn flipped(frame: &CanFrame, bit: u32) -> CanFrame {
    CanFrame::of_payload(frame.extended_id(), frame.payload().unwrap() ^ (1 << bit))
}

/// The frames of one message among those sent.
pub fn of(pgn: u32, frames: &[(u32, CanFrame)]) -> Vec<(u32, CanFrame)> {
    frames.iter().filter(|(_, frame)| Identifier::of(frame.extended_id()).pgn == pgn).copied().collect()
}

/// Another node's claim of an address.
pub fn claim(source: u8, name: u64) -> CanFrame {
    ADDRESS_CLAIMED.frame(source, 0, name)
}

/// All faults.
pub fn all_faults() -> ActiveFaults {
    Fault::ALL.into_iter().fold(ActiveFaults::NONE, ActiveFaults::with)
}

/// A message's name by its PGN.
pub fn name(pgn: u32) -> Option<&'static str> {
    MESSAGES.iter().find(|entry| entry.header.pgn == pgn).map(|entry| entry.header.name)
}
