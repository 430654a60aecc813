//! Fourth stage: what the operator wants → actuator speeds. One file a mode: [`dig`] follows a trajectory, [`levers`] obeys.

mod creep;
mod dig;
mod levers;

use kinematics_core::{Cylinders, Machine};

use crate::command::Intent;
use crate::dig::Dig;
use crate::fault::Fault;
use crate::io::{Request, Speeds};
use crate::parameters::{MotionParameters, ValveDirection};

use dig::DigFollower;
use levers::Levers;

/// What the motion stage hands on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Actuator speeds.
    pub speeds: Speeds,
    /// Where the cylinders should be this tick, m.
    pub reference: Cylinders<f32>,
    /// 1 + the dig's tick, 0 when not digging.
    pub dig_tick: u32,
}

impl Wanted {
    /// To stand still at these lengths.
    pub(crate) const fn hold(lengths: &Cylinders<f32>) -> Self {
        Self { speeds: Speeds::ZERO, reference: *lengths, dig_tick: 0 }
    }
}

/// The motion stage.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    dig: Option<DigFollower>,
    levers: Levers,
    /// The request of the last tick; another one starts over.
    request: Request,
}

impl Motion {
    pub(crate) fn new(p: &MotionParameters, valves: &[[ValveDirection; 2]; 4], dig: Option<Dig<f32>>) -> Self {
        Self {
            dig: dig.map(|dig| DigFollower::new(p, dig)),
            levers: Levers::new(valves, p.smallest_speed_mps),
            request: Request::Neutral,
        }
    }

    /// Back to holding: whatever is asked for next starts over.
    pub(crate) fn reset(&mut self) {
        self.request = Request::Neutral;
        if let Some(dig) = &mut self.dig {
            dig.reset();
        }
    }

    /// Speeds for this tick; `running` tells that the gate was open in the last one, and without it motion starts over.
    ///
    /// # Errors
    /// [`Fault::NotConfigured`], [`Fault::NotAtStart`], [`Fault::FollowingError`], [`Fault::Trajectory`].
    pub fn follow(
        &mut self,
        machine: &Machine<f32>,
        running: bool,
        intent: &Intent,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        if !running || intent.request != self.request {
            self.reset();
        }
        if !running {
            return Ok(Wanted::hold(lengths));
        }
        self.request = intent.request;
        match intent.request {
            Request::Neutral => Ok(Wanted::hold(lengths)),
            Request::Dig => self.dig.as_mut().ok_or(Fault::NotConfigured)?.follow(machine, lengths),
            Request::Levers => Ok(Wanted { speeds: self.levers.speeds(intent.levers), ..Wanted::hold(lengths) }),
        }
    }
}
