//! A calibration or a jog under way: the position's code in, a current out.

use super::answer::Reason;
use super::found::Found;
use super::limits::SpoolLimits;
use super::request::{ServiceRequest, Task};
use crate::calibration::end_stops::{EndStopFailure, EndStopParameters, EndStops};
use crate::calibration::valve_search::{SearchFailure, ValveSearch};
use crate::calibration::{Direction, Step};

/// A jog ends by itself after so long, ticks.
pub const JOG_TICKS: u32 = 10 * crate::TICKS_PER_S;

/// What is under way.
#[derive(Clone, Copy, Debug)]
pub enum Procedure {
    /// Nothing.
    None,
    /// A valve search.
    Valve(ValveSearch),
    /// An end-stop search.
    Ends(EndStops),
    /// A jog, with its ticks so far.
    Jog(u32),
}

/// What it wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    /// This signed current, A; extending positive.
    Current(f32),
    /// To end, with this.
    Found(Found),
    /// To end without.
    Failed(Reason),
}

impl Procedure {
    /// Of a task that drives.
    ///
    /// # Errors
    /// Why it cannot begin.
    pub(crate) fn of(request: &ServiceRequest, limits: &SpoolLimits) -> Result<Self, Reason> {
        match request.task {
            Task::ValveSearch => ValveSearch::new(limits.search()).map(Self::Valve).map_err(|_| Reason::NoRoomToSearch),
            Task::EndStops if limits.has_ends() => {
                EndStops::new(EndStopParameters::default()).map(Self::Ends).map_err(|_| Reason::NoRoomToSearch)
            }
            Task::EndStops => Err(Reason::NoEndStops),
            Task::Jog => Ok(Self::Jog(0)),
            _ => Ok(Self::None),
        }
    }

    /// One tick.
    pub(crate) fn step(&mut self, request: &ServiceRequest, limits: &SpoolLimits, code: u16) -> Wish {
        match self {
            Self::None => Wish::Failed(Reason::Withdrawn),
            Self::Valve(search) => match search.step(limits.position(code)) {
                Step::Drive(share) => Wish::Current(limits.amperes(share)),
                Step::Done(valve) => Wish::Found(Found::Valve(request.spool, valve)),
                Step::Failed(why) => Wish::Failed(of_search(why)),
            },
            Self::Ends(ends) => match ends.step(code) {
                Step::Drive(share) => Wish::Current(limits.amperes(share)),
                Step::Done(codes) => Wish::Found(Found::Ends(request.spool, codes)),
                Step::Failed(why) => Wish::Failed(of_ends(why)),
            },
            Self::Jog(ticks) => {
                *ticks += 1;
                if *ticks > JOG_TICKS {
                    return Wish::Failed(Reason::TooLong);
                }
                Wish::Current(limits.jog(request.current_a))
            }
        }
    }

    /// How far it is, 0…1.
    pub(crate) fn progress(&self) -> f32 {
        match self {
            Self::None => 0.0,
            Self::Valve(search) => search.progress(),
            Self::Ends(ends) => ends.progress(),
            Self::Jog(ticks) => *ticks as f32 / JOG_TICKS as f32,
        }
    }
}

fn of_search(why: SearchFailure) -> Reason {
    match why {
        SearchFailure::NoMotion(Direction::Extend) => Reason::NoMotionExtending,
        SearchFailure::NoMotion(Direction::Retract) => Reason::NoMotionRetracting,
        SearchFailure::WrongWay(_) => Reason::WrongWay,
        SearchFailure::NoRoom(_) => Reason::OutOfRoom,
        SearchFailure::Inconsistent(_) => Reason::Inconsistent,
    }
}

fn of_ends(why: EndStopFailure) -> Reason {
    match why {
        EndStopFailure::TimeOut(_) => Reason::NeverStill,
        EndStopFailure::TooShort => Reason::StrokeTooShort,
        EndStopFailure::Reversed => Reason::SensorReversed,
    }
}
