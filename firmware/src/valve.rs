//! Last stage: actuator speeds → coil currents → PWM duties.
//!
//! [`coil_stage::CoilStage`] is the stage: [`flow_map`] → [`interlock`] → [`ramp`] → [`dither`] → [`current_loop`], watched by
//! [`coil_watch`].

pub mod coil_fault;
pub mod coil_stage;
pub mod coil_watch;
pub mod current_loop;
pub mod dither;
pub mod flow_map;
pub mod interlock;
pub mod number;
pub mod ramp;
mod spool;

use crate::io::Solenoids;

/// What the coils get.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coils {
    /// A, a spool each.
    pub currents: [Solenoids<f32>; 4],
    /// PWM duties, a spool each; 65535 is always on.
    pub duties: [Solenoids<u16>; 4],
}

impl Coils {
    /// No current anywhere.
    pub const OFF: Self = Self { currents: [[0.0; 2]; 4], duties: [[0; 2]; 4] };
}
