//! The simulated operator: switches, levers, and the messages that carry them.

use firmware::{Inputs, Request};

use crate::scenario::{Events, Scenario, Task};

/// A new command message every this many ticks.
const MESSAGE_TICKS: u32 = 10;

/// The operator of one scenario.
#[derive(Clone, Debug)]
pub struct Operator {
    enable_s: f64,
    begin_s: f64,
    task: Task,
    supply_code: u16,
    events: Events,
    tick: u32,
    sent: u8,
}

impl Operator {
    /// Follows the scenario's timetable.
    pub fn new(scenario: &Scenario) -> Self {
        let full_scale_v = f64::from(scenario.parameters.supply.full_scale_v);
        Self {
            enable_s: scenario.enable_s,
            begin_s: scenario.begin_s,
            task: scenario.task.clone(),
            // The cast saturates.
            supply_code: (scenario.supply_v / full_scale_v * 65535.0 + 0.5) as u16,
            events: scenario.events.clone(),
            tick: 0,
            sent: 0,
        }
    }

    /// The controller's inputs at `time_s`, called once a tick.
    pub fn inputs(&mut self, time_s: f64, codes: [u16; 4]) -> Inputs {
        let last_sent = self.sent;
        let fresh = self.tick.is_multiple_of(MESSAGE_TICKS);
        self.tick = self.tick.wrapping_add(1);
        let mut inputs = Inputs {
            codes,
            supply_code: self.supply_code,
            command_counter: if fresh { last_sent.wrapping_add(1) } else { last_sent },
            request: if time_s >= self.begin_s { self.task.request() } else { Request::Neutral },
            levers: self.task.levers(time_s),
            enable: time_s >= self.enable_s,
            emergency_stop: false,
            overrun: false,
        };
        self.events.apply(time_s, &mut inputs, last_sent);
        self.sent = inputs.command_counter;
        inputs
    }
}
