//! Third stage: the operator's intent, and whether it is fresh.

use crate::io::{Inputs, Request};

/// What the operator wants now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Intent {
    /// The request; neutral when stale.
    pub request: Request,
    /// The counter has moved within the timeout.
    pub fresh: bool,
}

/// The command stage: watches the alive counter.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    timeout_ticks: u16,
    last_counter: Option<u8>,
    /// Ticks since the counter last moved; at the timeout it stays.
    age: u16,
}

impl Command {
    pub(crate) const fn new(timeout_ticks: u16) -> Self {
        Self { timeout_ticks, last_counter: None, age: timeout_ticks }
    }

    /// This tick's intent. Nothing is fresh before the counter has moved once.
    pub fn read(&mut self, inputs: &Inputs) -> Intent {
        let moved = self.last_counter.is_some_and(|last| last != inputs.command_counter);
        self.last_counter = Some(inputs.command_counter);
        if moved {
            self.age = 0;
        } else if self.age < self.timeout_ticks {
            self.age += 1;
        }
        let fresh = self.age < self.timeout_ticks;
        Intent { request: if fresh { inputs.request } else { Request::Neutral }, fresh }
    }
}
