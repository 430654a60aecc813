//! Fourth stage: what the operator wants → actuator speeds. One file a mode: `dig` follows a trajectory, `planned` a move, `reach` goes to
//! a target past obstacles, `levers` obeys; `path`, `grade` and `tip_velocity` share the law of `coordinated`.

mod coordinated;
mod creep;
mod delay;
mod delays;
mod dig;
mod grade;
mod law;
mod levers;
mod limits;
mod modes;
mod overrun;
mod path;
mod planned;
mod profile;
mod reach;
mod resolve;
mod slew;
mod sum;
mod tip_velocity;
mod tracker;

use core::cell::Cell;

use kinematics_core::{Cylinders, Machine, Pose};

use crate::can::command::Slope;
use crate::command::Intent;
use crate::constants::Constant;
use crate::diagnosis::Pressures;
use crate::dig::Dig;
use crate::fault::Fault;
use crate::io::{Request, Speeds};
use crate::near::near;
use crate::parameters::{ParameterError, Parameters, ReachParameters};

use delays::{Delays, preview_ticks};
use dig::DigFollower;
use levers::Levers;
use modes::Modes;
use planned::MoveFollower;
use reach::ReachFollower;
use slew::Slew;

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
    #[inline]
    pub(crate) const fn hold(lengths: &Cylinders<f32>) -> Self {
        Self { speeds: Speeds::ZERO, reference: *lengths, dig_tick: 0 }
    }
}

/// What following a dig or a planned move or reaching past obstacles needs of memory: about 12 KiB, filled in place. An image gives it as a
/// static, so that it never lies on the stack.
#[derive(Clone, Debug)]
pub struct Followers {
    delays: Delays,
    planned: MoveFollower,
    /// The cells have no spare bit patterns, so `None` is zeros: an image needs no flash for them.
    dig: Option<Cell<DigFollower>>,
    reach: Option<Cell<ReachFollower>>,
    /// The coordinated modes.
    modes: Option<Cell<Modes>>,
}

impl Followers {
    /// Of nothing yet.
    pub const fn new() -> Self {
        Self { delays: Delays::new(), planned: MoveFollower::new(), dig: None, reach: None, modes: None }
    }

    /// Precomputes what the parameters ask for; the dig has been tried before.
    ///
    /// # Errors
    /// Why a move has no plan; what planning past obstacles lacks.
    pub(crate) fn plan(
        &mut self,
        p: &Parameters,
        machine: &Machine<f32>,
        dig: Option<Dig<f32>>,
    ) -> Result<(), ParameterError> {
        let followed = dig.and_then(|dig| DigFollower::new(&p.motion, machine, dig, &mut self.delays));
        self.dig = followed.map(Cell::new);
        if let Some(planned) = &p.planned_move {
            self.planned.plan(&p.motion, machine, planned, &mut self.delays).map_err(ParameterError::Move)?;
        }
        self.plan_modes(p, machine)?;
        self.reach = None;
        p.reach.as_ref().map_or(Ok(()), |reach| self.plan_reach(reach, p, machine))
    }

    #[inline(never)]
    fn plan_modes(&mut self, p: &Parameters, machine: &Machine<f32>) -> Result<(), ParameterError> {
        self.modes = None;
        if let Some(law) = &p.motion.law {
            self.delays.set_modes(preview_ticks(&p.motion));
            self.modes = Some(Cell::new(Modes::new(law, p, machine)?));
        }
        Ok(())
    }

    // Not inlined, so that the stack holds either's planning but not both.
    #[inline(never)]
    fn plan_reach(
        &mut self,
        reach: &ReachParameters,
        p: &Parameters,
        machine: &Machine<f32>,
    ) -> Result<(), ParameterError> {
        self.reach = Some(Cell::new(ReachFollower::new(reach, &p.geometry, machine, &p.coils.valves(), &p.motion)?));
        Ok(())
    }

    /// Whatever is asked for next starts over.
    pub(crate) fn start_over(&mut self) {
        if let Some(dig) = &mut self.dig {
            dig.get_mut().reset();
        }
        self.planned.reset();
        if let Some(reach) = &mut self.reach {
            reach.get_mut().reset();
        }
        if let Some(modes) = &mut self.modes {
            modes.get_mut().start_over();
        }
    }

    /// And nothing is under way.
    pub(crate) fn reset(&mut self) {
        self.start_over();
        if let Some(modes) = &mut self.modes {
            modes.get_mut().reset();
        }
    }
}

impl Default for Followers {
    fn default() -> Self {
        Self::new()
    }
}

/// The motion stage; what it follows stands in [`Followers`].
#[derive(Clone, Debug)]
pub struct Motion {
    levers: Levers,
    slew: Option<Slew>,
    /// The request of the last tick; another one starts over.
    request: Request,
}

impl Motion {
    /// Of validated parameters.
    pub(crate) fn new(p: &Parameters) -> Self {
        Self {
            levers: Levers::new(&p.coils.valves(), p.motion.smallest_speed_mps),
            slew: p.motion.law.as_ref().map(Slew::new),
            request: Request::Neutral,
        }
    }

    /// Where the levers' constants lie.
    pub(crate) const fn constant(&self) -> Constant {
        Constant::of(&self.levers)
    }

    /// Back to standing still; the followers start over with it.
    pub(crate) fn reset(&mut self) {
        self.request = Request::Neutral;
        if let Some(slew) = &mut self.slew {
            slew.reset();
        }
    }

    /// Speeds for this tick; `running` tells that the gate was open in the last one, and without it motion starts over.
    ///
    /// # Errors
    /// [`Fault::NotConfigured`], [`Fault::NotAtStart`], [`Fault::FollowingError`], [`Fault::Trajectory`].
    #[inline]
    pub(crate) fn follow(
        &mut self,
        (machine, followers): (&Machine<f32>, &mut Followers),
        running: bool,
        (intent, slope, pressures_pa): (&Intent, Option<Slope>, &Pressures),
        pose: &Pose<f32>,
        lengths: &Cylinders<f32>,
    ) -> Result<Wanted, Fault> {
        if !running {
            self.reset();
            followers.reset();
            return Ok(Wanted::hold(lengths));
        }
        if intent.request != self.request {
            followers.start_over();
        }
        self.request = intent.request;
        // In every mode, so that the next one knows the loads from its first tick.
        if let Some(modes) = followers.modes.as_mut() {
            modes.get_mut().weigh(pressures_pa);
        }
        let wanted = match intent.request {
            Request::Neutral => Wanted::hold(lengths),
            Request::Dig => {
                let Followers { dig, delays, .. } = followers;
                dig.as_mut().ok_or(Fault::NotConfigured)?.get_mut().follow(machine, lengths, delays)?
            }
            Request::Move => {
                let Followers { planned, delays, .. } = followers;
                planned.follow(lengths, delays)?
            }
            Request::Reach => {
                let reach = near(&mut followers.reach);
                reach.as_mut().ok_or(Fault::NotConfigured)?.get_mut().follow(machine, pose, lengths)?
            }
            Request::Levers => {
                let asked = self.levers.speeds(intent.levers);
                let told = near(&self.slew).as_ref().map_or([0.0; 4], Slew::speeds);
                let modes = followers.modes.as_mut();
                let speeds = modes.map_or(asked, |modes| modes.get_mut().cushion(lengths, told, asked));
                Wanted { speeds, ..Wanted::hold(lengths) }
            }
            Request::TipVelocity | Request::Grade | Request::Path => {
                let speeds = || near(&self.slew).as_ref().map_or([0.0; 4], Slew::speeds);
                // Only grade follows a lever.
                let grades = intent.request == Request::Grade;
                let arm_mps = if grades { self.levers.arm_mps(intent.levers) } else { 0.0 };
                let Followers { delays, modes, .. } = followers;
                let modes = modes.as_mut().ok_or(Fault::NotConfigured)?.get_mut();
                modes.follow(machine, (intent, arm_mps, slope), (speeds, delays), pose, lengths)?
            }
        };
        let speeds = near(&mut self.slew).as_mut().map_or(wanted.speeds, |slew| slew.pass(wanted.speeds));
        Ok(Wanted { speeds, ..wanted })
    }
}
