//! What the application reads and what it drives, each tick.

use kinematics_core::{Cylinders, Pose, Rotor};

use crate::can::command::Slope;
use crate::command::Intent;
use crate::fault::{Fault, State};
use crate::service::ServiceRequest;

/// The four spools and their position sensors, in the order of every array here.
pub const SPOOLS: [&str; 4] = ["swing", "boom", "arm", "bucket"];

/// What the operator asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// Levers in neutral: hold still.
    Neutral,
    /// Follow the dig trajectory.
    Dig,
    /// Move each actuator as its lever says.
    Levers,
    /// Follow the planned move.
    Move,
    /// Bring the tip to the target of the parameters, past their obstacles.
    Reach,
    /// Move the tip at the velocity asked for.
    TipVelocity,
    /// The arm's lever moves the arm; boom and bucket keep the tip on the plane of the parameters.
    Grade,
    /// Follow the path of the parameters.
    Path,
}

/// Speeds of the four actuators: cylinders m/s, extending positive; a swing motor rad/s, counter-clockwise positive, a swing
/// cylinder m/s as the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Speeds {
    /// Swing motor or cylinder.
    pub swing: f32,
    /// Boom cylinder.
    pub boom: f32,
    /// Arm cylinder.
    pub arm: f32,
    /// Bucket cylinder.
    pub bucket: f32,
}

impl Speeds {
    /// Standstill.
    pub const ZERO: Self = Self { swing: 0.0, boom: 0.0, arm: 0.0, bucket: 0.0 };

    /// In the order of [`SPOOLS`].
    #[inline]
    pub const fn to_array(self) -> [f32; 4] {
        [self.swing, self.boom, self.arm, self.bucket]
    }

    /// From the order of [`SPOOLS`].
    #[inline]
    pub const fn from_array([swing, boom, arm, bucket]: [f32; 4]) -> Self {
        Self { swing, boom, arm, bucket }
    }
}

/// Everything that enters a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// Position sensors' ADC codes: swing, boom, arm, bucket.
    pub codes: [u16; 4],
    /// ADC code of the battery voltage.
    pub supply_code: u16,
    /// ADC code of the position sensors' supply.
    pub sensor_supply_code: u16,
    /// ADC codes of the coil currents, a spool each.
    pub coil_codes: [Solenoids<u16>; 4],
    /// Whether each converter answered soundly: that of the position sensors and the supplies, that of the coil currents. The codes of
    /// one that did not mean nothing.
    pub converters_sound: [bool; 2],
    /// What the operator asks for; `None` without a fresh command.
    pub command: Option<Intent>,
    /// How the chassis stands; `None` while unknown.
    pub slope: Option<Slope>,
    /// Pressures above ambient of boom, arm and bucket cylinder, \[head, rod\], Pa; each `None` while unknown.
    pub pressures_pa: [[Option<f32>; 2]; 3],
    /// What the service tool asks for; `None` without a fresh command.
    pub service: Option<ServiceRequest>,
    /// The master cut-off's own contact is closed.
    pub cut_off_closed: bool,
    /// The enable switch.
    pub enable: bool,
    /// The emergency stop is pressed.
    pub emergency_stop: bool,
    /// The previous tick did not finish in time; measured by the board, an input here to keep ticks reproducible.
    pub overrun: bool,
}

/// One spool's two solenoids: \[extend, retract\].
pub type Solenoids<T> = [T; 2];

/// Everything that leaves a tick. Nothing measured on the board is in here, so host and ECU agree bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// Ticks since construction.
    pub tick: u32,
    /// The supervisor's state.
    pub state: State,
    /// The latched fault.
    pub fault: Option<Fault>,
    /// The tick before did not finish in time; some in a row are a fault.
    pub late: bool,
    /// The master cut-off is closed, so that current can flow.
    pub cut_off_closed: bool,
    /// The pose of this tick is valid; otherwise `pose` and `lengths` are the last valid ones.
    pub pose_valid: bool,
    /// Measured cylinder lengths, m.
    pub lengths: Cylinders<f32>,
    /// Bucket pose from them.
    pub pose: Pose<f32>,
    /// Ticks since the dig or move began, 0 when following neither.
    pub dig_tick: u32,
    /// Reference cylinder lengths of this tick, m; the measured ones when none is followed.
    pub reference: Cylinders<f32>,
    /// Actuator speeds the motion stage asked for, behind an open gate.
    pub asked: Speeds,
    /// The smallest clearance the fence found, m; `f32::MAX` where there is nothing to be clear of or the gate is closed.
    pub clearance_m: f32,
    /// Actuator speeds that passed fence and gate.
    pub speeds: Speeds,
    /// Coil currents, A, a spool each.
    pub currents: [Solenoids<f32>; 4],
    /// PWM duties, 65535 is always on, a spool each.
    pub duties: [Solenoids<u16>; 4],
}

/// The pose before the first valid one: everything level and zero, never used for motion.
pub(crate) const NO_POSE: Pose<f32> = Pose {
    swing: Rotor::IDENTITY,
    joints: kinematics_core::Joints { boom: Rotor::IDENTITY, arm: Rotor::IDENTITY, bucket: Rotor::IDENTITY },
    plane: kinematics_core::PlaneTip { reach: 0.0, height: 0.0, pitch: Rotor::IDENTITY },
    x: 0.0,
    y: 0.0,
};

/// All lengths zero.
pub(crate) const NO_LENGTHS: Cylinders<f32> = Cylinders { boom: 0.0, arm: 0.0, bucket: 0.0 };

/// `x` between `low` and `high`. `f32::clamp` would link a panic for limits in the wrong order, `f32::min` and `max` differ on ±0
/// between host and ECU.
#[inline]
pub(crate) fn limited(x: f32, low: f32, high: f32) -> f32 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}
