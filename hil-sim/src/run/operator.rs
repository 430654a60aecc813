//! The simulated operator: switches, and what the panel's messages ask for.

use firmware::{Intent, Request};

use crate::scenario::{Events, Kind, Scenario, Task};

/// The operator of one scenario.
#[derive(Clone, Debug)]
pub struct Operator {
    enable_s: f64,
    begin_s: f64,
    task: Task,
    events: Events,
}

/// What the operator does at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doing {
    /// The enable switch.
    pub enable: bool,
    /// The emergency stop is pressed.
    pub emergency_stop: bool,
    /// What the messages ask for; `None` when none are sent.
    pub intent: Option<Intent>,
}

impl Operator {
    /// Follows the scenario's timetable.
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            enable_s: scenario.enable_s,
            begin_s: scenario.begin_s,
            task: scenario.task.clone(),
            events: scenario.events.clone(),
        }
    }

    /// What the operator does at `time_s`.
    pub fn at(&self, time_s: f64) -> Doing {
        let now = |kind| self.events.has(kind, time_s);
        let working = time_s >= self.begin_s && !now(Kind::Neutral);
        let request = if working { self.task.request() } else { Request::Neutral };
        let intent = Intent { request, levers: self.task.levers(time_s), tip: self.task.tip(time_s) };
        Doing {
            enable: time_s >= self.enable_s && !now(Kind::EnableOff),
            emergency_stop: now(Kind::EmergencyStop),
            intent: (!now(Kind::CommandLost)).then_some(intent),
        }
    }
}
