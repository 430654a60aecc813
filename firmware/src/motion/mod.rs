//! Fourth stage: what the operator wants → actuator speeds. One file a mode: `dig` follows a trajectory, `planned` a move, `reach` goes to
//! a target past obstacles, `levers` obeys.

mod creep;
mod dig;
mod levers;
mod planned;
mod reach;
mod tracker;

use kinematics_core::{Cylinders, Machine, PinGeometry, Pose};

use crate::command::Intent;
use crate::dig::Dig;
use crate::fault::Fault;
use crate::io::{Request, Speeds};
use crate::moves::Move;
use crate::parameters::{ParameterError, Parameters};

use dig::DigFollower;
use levers::Levers;
use planned::MoveFollower;
use reach::ReachFollower;

/// What the motion stage hands on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Actuator speeds.
    pub speeds: Speeds,
    /// Where the cylinders should be this tick, m.
    pub reference: Cylinders<f32>,
    /// 1 + the dig's or move's tick, 0 when following neither.
    pub dig_tick: u32,
}

impl Wanted {
    /// To stand still at these lengths.
    pub(crate) const fn hold(lengths: &Cylinders<f32>) -> Self {
        Self { speeds: Speeds::ZERO, reference: *lengths, dig_tick: 0 }
    }
}

/// The motion stage.
#[derive(Clone, Debug)]
pub struct Motion {
    dig: Option<DigFollower>,
    planned: Option<MoveFollower>,
    levers: Levers,
    reach: Option<ReachFollower>,
    /// The request of the last tick; another one starts over.
    request: Request,
}

impl Motion {
    /// Of validated parameters.
    ///
    /// # Errors
    /// What planning past obstacles lacks.
    pub(crate) fn new(
        p: &Parameters,
        machine: &Machine<f32>,
        dig: Option<Dig<f32>>,
        planned: Option<&Move>,
    ) -> Result<Self, ParameterError> {
        let (valves, smallest) = (&p.valves, p.motion.smallest_speed_mps);
        let geometry: &PinGeometry = &p.geometry;
        let reach = match &p.reach {
            Some(reach) => Some(ReachFollower::new(reach, geometry, machine, valves, &p.motion)?),
            None => None,
        };
        Ok(Self {
            dig: dig.map(|dig| DigFollower::new(&p.motion, dig)),
            planned: planned.map(|planned| MoveFollower::new(&p.motion, planned)),
            levers: Levers::new(valves, smallest),
            reach,
            request: Request::Neutral,
        })
    }

    /// Back to holding: whatever is asked for next starts over.
    pub(crate) fn reset(&mut self) {
        self.request = Request::Neutral;
        if let Some(dig) = &mut self.dig {
            dig.reset();
        }
        if let Some(planned) = &mut self.planned {
            planned.reset();
        }
        if let Some(reach) = &mut self.reach {
            reach.reset();
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
        pose: &Pose<f32>,
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
            Request::Move => self.planned.as_mut().ok_or(Fault::NotConfigured)?.follow(lengths),
            Request::Reach => self.reach.as_mut().ok_or(Fault::NotConfigured)?.follow(machine, pose, lengths),
            Request::Levers => Ok(Wanted { speeds: self.levers.speeds(intent.levers), ..Wanted::hold(lengths) }),
        }
    }
}
