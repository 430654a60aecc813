//! What the controller knew when the first fault was latched.

use kinematics_core::Cylinders;

use crate::command::Intent;
use crate::fault::{Fault, State};
use crate::io::Speeds;

/// Kept from the first fault until the first fault after running has begun afresh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreezeFrame {
    /// The tick of the fault.
    pub tick: u32,
    /// The fault.
    pub fault: Fault,
    /// The supervisor's state before it.
    pub state: State,
    /// Position sensors' codes: swing, boom, arm, bucket.
    pub codes: [u16; 4],
    /// Cylinder lengths, m: the last valid ones.
    pub lengths: Cylinders<f32>,
    /// Speeds as measured.
    pub speeds: Speeds,
    /// Supply voltage, V.
    pub supply_v: f32,
    /// What the operator asked for, where it was fresh.
    pub command: Option<Intent>,
    /// Speeds last sent to the valves.
    pub sent: Speeds,
}
