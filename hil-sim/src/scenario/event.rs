//! What goes wrong during a scenario, and when.

use serde::Deserialize;

/// What an event does at the board's connectors while it lasts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The emergency stop is pressed.
    EmergencyStop,
    /// The enable switch is off.
    EnableOff,
    /// The levers are in neutral.
    Neutral,
    /// The operator's panel sends nothing.
    CommandLost,
    /// The swing sensor's wire is broken: 0 V.
    SwingSensorOpen,
    /// The boom sensor's wire is broken: 0 V.
    BoomSensorOpen,
    /// The arm sensor's wire is broken: 0 V.
    ArmSensorOpen,
    /// The bucket sensor's wire is broken: 0 V.
    BucketSensorOpen,
    /// The supply collapses to 0 V at its measurement.
    SupplyLost,
    /// A tick was late.
    TickOverrun,
    /// The converter of the position sensors and the supplies does not answer.
    SensorConverterLost,
    /// The converter of the coil currents does not answer.
    CoilConverterLost,
    /// A coil's wire is off: of the boom's extending solenoid.
    BoomCoilOpen,
    /// The wire of the boom's extending solenoid touches the supply.
    BoomCoilShortToSupply,
    /// The wire of the boom's extending solenoid touches ground.
    BoomCoilShortToGround,
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

    /// Whether an event of this kind is under way at `time_s`.
    pub fn has(&self, kind: Kind, time_s: f64) -> bool {
        self.0.iter().any(|event| event.kind == kind && time_s >= event.at_s && time_s < event.until_s)
    }
}
