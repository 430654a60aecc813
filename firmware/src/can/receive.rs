//! Whether a received message may be used. Each message has its own watch; no message's state touches another's.

use super::message::Header;
use super::signal::{Word, states};
use super::{frame::CanFrame, id::Identifier, protect};

/// A counter may miss this many messages and still count as moving on: five fill the timeout.
const LARGEST_STEP: u8 = 5;

/// Messages in a row that must move on, at the start, after a leap and after silence: a replayed handful never gets this far.
const TRUSTED: u8 = 3;

/// What a message is good for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Validity {
    /// A good one came within the timeout.
    Fresh,
    /// Nothing came for the timeout, or not yet enough to trust the sender.
    Stale,
    /// None of the right length came within the timeout.
    Short,
    /// Within the timeout only ones with a wrong CRC came.
    BadChecksum,
    /// Within the timeout the counter stood still or leapt.
    FrozenCounter,
    /// The sender says that it has no value, or sent one that means nothing. At once, not after the timeout.
    OutOfRange,
}

impl Validity {
    /// Codes and names on the bus.
    pub const NAMES: [(u32, Word); 6] = states([
        (0, "fresh"),
        (1, "stale"),
        (2, "short"),
        (3, "bad_checksum"),
        (4, "frozen_counter"),
        (5, "out_of_range"),
    ]);

    /// As on the bus.
    pub const fn code(self) -> u32 {
        self as u32
    }
}

/// A value and whether it may be used: `value` is there exactly when `validity` is fresh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading<T> {
    /// The value.
    pub value: Option<T>,
    /// Why not, otherwise.
    pub validity: Validity,
}

/// One message: its last value, while it may be used.
#[derive(Clone, Copy, Debug)]
pub struct Received<T> {
    value: Option<T>,
    watch: Watch,
}

/// The watch over one message, whatever it says.
#[derive(Clone, Copy, Debug)]
struct Watch {
    timeout_ticks: u16,
    /// Ticks since the last good message, at most the timeout.
    age: u16,
    /// Ticks since the last message of any kind, at most the timeout.
    silence: u16,
    /// Why the last message was not good.
    reason: Validity,
    last_counter: Option<u8>,
    in_a_row: u8,
}

impl Watch {
    /// The payload of a frame of this message that can be trusted. An image holds this once, and not for every kind of value.
    #[inline(never)]
    fn trusted(&mut self, header: &Header, id: Identifier, frame: &CanFrame) -> Result<u64, Validity> {
        self.silence = 0;
        match frame.payload() {
            None => Err(Validity::Short),
            Some(payload) if header.protected => self.check(id, payload),
            Some(payload) => Ok(payload),
        }
    }

    /// CRC and counter.
    fn check(&mut self, id: Identifier, payload: u64) -> Result<u64, Validity> {
        let counter = protect::open(id, payload).ok_or(Validity::BadChecksum)?;
        let last = self.last_counter.replace(counter);
        let step = last.map(|last| counter.wrapping_sub(last) & 0xf);
        match step {
            None => return Err(Validity::Stale),
            Some(0) => return Err(Validity::FrozenCounter),
            Some(step) if step > LARGEST_STEP => {
                self.in_a_row = 0;
                return Err(Validity::FrozenCounter);
            }
            Some(_) => {}
        }
        if self.in_a_row < TRUSTED {
            self.in_a_row += 1;
        }
        if self.in_a_row < TRUSTED { Err(self.reason) } else { Ok(payload) }
    }
}

impl<T: Copy> Received<T> {
    pub(crate) const fn new(timeout_ticks: u16) -> Self {
        let watch = Watch {
            timeout_ticks,
            age: timeout_ticks,
            silence: timeout_ticks,
            reason: Validity::Stale,
            last_counter: None,
            in_a_row: 0,
        };
        Self { value: None, watch }
    }

    /// Takes a frame of this message in; true when it was good. One that cannot be trusted leaves the value as it was, to run out.
    pub(crate) fn take<E>(
        &mut self,
        header: &Header,
        id: Identifier,
        frame: &CanFrame,
        decode: impl FnOnce(u64) -> Result<T, E>,
    ) -> bool {
        let Self { value, watch } = self;
        match watch.trusted(header, id, frame).map(decode) {
            Ok(Ok(good)) => {
                (*value, watch.age, watch.reason) = (Some(good), 0, Validity::Stale);
                return true;
            }
            Ok(Err(_)) => (*value, watch.reason) = (None, Validity::OutOfRange),
            Err(reason) => watch.reason = reason,
        }
        false
    }

    /// A tick has passed.
    pub(crate) fn aged(&mut self) {
        let Self { value, watch } = self;
        if watch.age < watch.timeout_ticks {
            watch.age += 1;
            if watch.age == watch.timeout_ticks {
                (*value, watch.in_a_row) = (None, 0);
            }
        }
        if watch.silence < watch.timeout_ticks {
            watch.silence += 1;
        }
        if watch.silence == watch.timeout_ticks {
            (watch.reason, watch.last_counter) = (Validity::Stale, None);
        }
    }

    /// Whether the value may be used.
    pub fn validity(&self) -> Validity {
        if self.value.is_some() { Validity::Fresh } else { self.watch.reason }
    }

    /// The value and its validity.
    pub fn reading(&self) -> Reading<T> {
        Reading { value: self.value, validity: self.validity() }
    }
}
