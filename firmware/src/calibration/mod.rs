//! Finding out what a machine's valves, sensors and bucket are like, on the machine itself.
//!
//! Each procedure is a small state machine fed once a tick, or once a touch; it gives what to drive next, and at the end a result or
//! why there is none. Nothing here writes parameters: a result is a proposal that a person approves.
//!
//! - [`valve_search`] — dead band and full speed of both directions of a spool;
//! - [`end_stops`] — the sensor's codes at both ends of a stroke;
//! - [`measure_up`] — length and direction of the bucket's tip, from touches of one point.

pub mod end_stops;
mod line;
pub mod measure_up;
pub mod valve_search;

/// What a procedure wants next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step<R, F> {
    /// Drive the spool with this signed fraction of full-scale current, −1…1, extending positive.
    Drive(f32),
    /// Done: stop driving.
    Done(R),
    /// Given up: stop driving.
    Failed(F),
}

/// Which way a spool moves its actuator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Extend; of a swing motor counter-clockwise.
    Extend,
    /// Retract.
    Retract,
}

impl Direction {
    const fn sign(self) -> f32 {
        match self {
            Self::Extend => 1.0,
            Self::Retract => -1.0,
        }
    }

    const fn other(self) -> Self {
        match self {
            Self::Extend => Self::Retract,
            Self::Retract => Self::Extend,
        }
    }
}
