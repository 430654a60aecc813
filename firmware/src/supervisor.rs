//! Watches every stage and alone opens the gate between motion and valve.
//!
//! ```text
//! Locked ── neutral, fresh, enable off, nothing wrong ──▶ Ready ── enable switched on ──▶ Running
//!    ▲                                                                                      │
//!    └──────────────────────────── enable switched off ─────────────────────────────────────┘
//! any state ── something wrong ──▶ Fault (latched) ── neutral, fresh, enable off, nothing wrong ──▶ Ready
//! ```
//! Outside `Running` every current is zero and the cut-off is open.

use kinematics_core::Cylinder;

use crate::command::Intent;
use crate::io::{Inputs, Request};

/// The supervisor's state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Waiting for neutral with the enable switch off.
    Locked,
    /// Waiting for the enable switch.
    Ready,
    /// The gate is open.
    Running,
    /// Something went wrong; the fault is latched.
    Fault,
}

impl State {
    const ALL: [Self; 4] = [Self::Locked, Self::Ready, Self::Running, Self::Fault];

    /// As a byte.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// From a byte.
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.code() == code)
    }
}

/// Why the machine was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The emergency stop was pressed.
    EmergencyStop,
    /// A tick did not finish in its period.
    Overrun,
    /// The supply voltage left its range.
    Supply,
    /// A position sensor's code left its range.
    Sensor(Cylinder),
    /// The lengths give no pose: a linkage does not close.
    Geometry,
    /// The command counter stood still longer than the timeout.
    CommandStale,
    /// A dig was asked for too far from its start.
    NotAtStart,
    /// A cylinder strayed too far from its reference.
    FollowingError,
    /// The reference left what the machine can reach.
    Trajectory,
}

impl Fault {
    /// Every fault, most urgent first.
    pub const ALL: [Self; 12] = [
        Self::EmergencyStop,
        Self::Overrun,
        Self::Supply,
        Self::Sensor(Cylinder::Swing),
        Self::Sensor(Cylinder::Boom),
        Self::Sensor(Cylinder::Arm),
        Self::Sensor(Cylinder::Bucket),
        Self::Geometry,
        Self::CommandStale,
        Self::NotAtStart,
        Self::FollowingError,
        Self::Trajectory,
    ];

    /// As a byte, never 0.
    pub const fn code(self) -> u8 {
        match self {
            Self::EmergencyStop => 1,
            Self::Overrun => 2,
            Self::Supply => 3,
            Self::Sensor(Cylinder::Swing) => 4,
            Self::Sensor(Cylinder::Boom) => 5,
            Self::Sensor(Cylinder::Arm) => 6,
            Self::Sensor(Cylinder::Bucket) => 7,
            Self::Geometry => 8,
            Self::CommandStale => 9,
            Self::NotAtStart => 10,
            Self::FollowingError => 11,
            Self::Trajectory => 12,
        }
    }

    /// From a byte.
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|fault| fault.code() == code)
    }

    /// A name for logs and JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::EmergencyStop => "emergency_stop",
            Self::Overrun => "tick_overrun",
            Self::Supply => "supply_out_of_range",
            Self::Sensor(Cylinder::Swing) => "swing_sensor_out_of_range",
            Self::Sensor(Cylinder::Boom) => "boom_sensor_out_of_range",
            Self::Sensor(Cylinder::Arm) => "arm_sensor_out_of_range",
            Self::Sensor(Cylinder::Bucket) => "bucket_sensor_out_of_range",
            Self::Geometry => "geometry_impossible",
            Self::CommandStale => "command_stale",
            Self::NotAtStart => "not_at_start",
            Self::FollowingError => "following_error",
            Self::Trajectory => "trajectory_unreachable",
        }
    }
}

/// What the stages report this tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// The operator's intent.
    pub intent: Intent,
    /// Supply voltage, V.
    pub supply_v: f32,
    /// First fault of the stages sensing, pose and motion.
    pub stage_fault: Option<Fault>,
}

/// Whether speeds may become currents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gate {
    /// Zero current, cut-off open.
    Closed,
    /// Currents flow.
    Open,
}

/// The supervisor.
#[derive(Clone, Copy, Debug)]
pub struct Supervisor {
    supply_range_v: [f32; 2],
    state: State,
    /// The latched fault: cleared only when running begins afresh.
    fault: Option<Fault>,
    enabled_before: bool,
}

impl Supervisor {
    pub(crate) const fn new(supply_range_v: [f32; 2]) -> Self {
        // A switch found on at power-up is no enable edge.
        Self { supply_range_v, state: State::Locked, fault: None, enabled_before: true }
    }

    /// Its state.
    pub fn state(&self) -> State {
        self.state
    }

    /// The latched fault.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// Judges one tick.
    pub fn judge(&mut self, inputs: &Inputs, watched: &Watched) -> Gate {
        let enable_edge = inputs.enable && !self.enabled_before;
        self.enabled_before = inputs.enable;
        let at_rest = watched.intent.fresh && watched.intent.request == Request::Neutral;

        if let Some(fault) = self.wrong(inputs, watched) {
            // The first fault stays named until the operator starts afresh; a later one is its consequence.
            if self.state != State::Fault {
                self.fault = Some(fault);
            }
            self.state = State::Fault;
            return Gate::Closed;
        }
        self.state = match self.state {
            State::Locked | State::Fault if at_rest && !inputs.enable => State::Ready,
            State::Ready if at_rest && enable_edge => {
                self.fault = None;
                State::Running
            }
            // Levers moved before enabling: back to neutral first.
            State::Ready if !at_rest => State::Locked,
            State::Running if !inputs.enable => State::Locked,
            same => same,
        };
        if self.state == State::Running { Gate::Open } else { Gate::Closed }
    }

    /// What is wrong this tick, most urgent first.
    fn wrong(&self, inputs: &Inputs, watched: &Watched) -> Option<Fault> {
        let [low, high] = self.supply_range_v;
        if inputs.emergency_stop {
            Some(Fault::EmergencyStop)
        } else if inputs.overrun {
            Some(Fault::Overrun)
        } else if !(watched.supply_v >= low && watched.supply_v <= high) {
            Some(Fault::Supply)
        } else if watched.stage_fault.is_some() {
            watched.stage_fault
        } else if self.state == State::Running && !watched.intent.fresh {
            Some(Fault::CommandStale)
        } else {
            None
        }
    }
}
