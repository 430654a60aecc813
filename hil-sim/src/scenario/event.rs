//! What goes wrong during a scenario, and when.

use serde::Deserialize;

use firmware::{Inputs, Request};

/// What an event does to the controller's inputs while it lasts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The emergency stop is pressed.
    EmergencyStop,
    /// The enable switch is off.
    EnableOff,
    /// The levers are in neutral.
    Neutral,
    /// No command arrives: the alive counter stands still.
    CommandLost,
    /// The swing sensor's wire is broken: code 0.
    SwingSensorOpen,
    /// The boom sensor's wire is broken: code 0.
    BoomSensorOpen,
    /// The arm sensor's wire is broken: code 0.
    ArmSensorOpen,
    /// The bucket sensor's wire is broken: code 0.
    BucketSensorOpen,
    /// The supply collapses to 0 V at its measurement.
    SupplyLost,
    /// A tick was late.
    TickOverrun,
}

/// An event from `at_s` until `until_s`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// What.
    pub kind: Kind,
    /// Start, s.
    pub at_s: f64,
    /// End, s.
    pub until_s: f64,
}

impl Event {
    pub(super) fn check(&self, duration_s: f64) -> Result<(), String> {
        if !(self.at_s >= 0.0 && self.at_s <= duration_s) {
            return Err(format!("`at_s` is {} but must be within 0…{duration_s}", self.at_s));
        }
        if !(self.until_s > self.at_s && self.until_s.is_finite()) {
            return Err(format!("`until_s` is {} but must be finite and above `at_s`, {}", self.until_s, self.at_s));
        }
        Ok(())
    }

    fn apply(&self, inputs: &mut Inputs, last_counter: u8) {
        match self.kind {
            Kind::EmergencyStop => inputs.emergency_stop = true,
            Kind::EnableOff => inputs.enable = false,
            Kind::Neutral => inputs.request = Request::Neutral,
            Kind::CommandLost => inputs.command_counter = last_counter,
            Kind::SwingSensorOpen => inputs.codes[0] = 0,
            Kind::BoomSensorOpen => inputs.codes[1] = 0,
            Kind::ArmSensorOpen => inputs.codes[2] = 0,
            Kind::BucketSensorOpen => inputs.codes[3] = 0,
            Kind::SupplyLost => inputs.supply_code = 0,
            Kind::TickOverrun => inputs.overrun = true,
        }
    }
}

/// All events of a scenario.
#[derive(Clone, Debug, Default)]
pub struct Events(Vec<Event>);

impl Events {
    /// Nothing goes wrong.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn new(events: Vec<Event>) -> Self {
        Self(events)
    }

    /// Does to `inputs` what the events under way at `time_s` do; `last_counter` is the command counter of the tick before.
    pub fn apply(&self, time_s: f64, inputs: &mut Inputs, last_counter: u8) {
        for event in self.0.iter().filter(|e| time_s >= e.at_s && time_s < e.until_s) {
            event.apply(inputs, last_counter);
        }
    }
}
