//! Third stage: the operator's intent, and whether it is fresh.

use crate::io::{Inputs, Request};

/// A counter may miss this many messages and still count as moving on.
const LARGEST_STEP: u8 = 10;

/// Messages in a row that must move on after one that did not: a replayed handful of messages never gets this far.
const TRUSTED: u8 = 3;

/// What the operator wants now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Intent {
    /// The request; neutral when stale.
    pub request: Request,
    /// The levers, ±32767 at full deflection; zero when stale.
    pub levers: [i16; 4],
    /// The counter has moved within the timeout.
    pub fresh: bool,
}

/// The command stage: watches the alive counter.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    timeout_ticks: u16,
    last_counter: Option<u8>,
    /// Messages in a row that moved on, up to [`TRUSTED`].
    in_a_row: u8,
    /// Ticks since the counter last moved; at the timeout it stays.
    age: u16,
}

impl Command {
    pub(crate) const fn new(timeout_ticks: u16) -> Self {
        Self { timeout_ticks, last_counter: None, in_a_row: 0, age: timeout_ticks }
    }

    /// This tick's intent. Nothing is fresh before the counter has moved on three times; a step backwards or a leap starts over.
    pub fn read(&mut self, inputs: &Inputs) -> Intent {
        let step = self.last_counter.map_or(0, |last| inputs.command_counter.wrapping_sub(last));
        self.last_counter = Some(inputs.command_counter);
        if step > LARGEST_STEP {
            self.in_a_row = 0;
        } else if step > 0 && self.in_a_row < TRUSTED {
            self.in_a_row += 1;
        }
        if step > 0 && self.in_a_row == TRUSTED {
            self.age = 0;
        } else if self.age < self.timeout_ticks {
            self.age += 1;
        }
        let fresh = self.age < self.timeout_ticks;
        if fresh {
            Intent { request: inputs.request, levers: inputs.levers, fresh }
        } else {
            Intent { request: Request::Neutral, levers: [0; 4], fresh }
        }
    }
}
