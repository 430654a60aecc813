//! The sensor's codes at both ends of a stroke: the actuator is driven gently against each until it stands.

use super::line::Line;
use super::{Direction, Step};
use crate::parameters::{ParameterError, within};

/// How to look for the ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndStopParameters {
    /// Current, as a fraction of full scale: enough to move, little enough to press gently.
    pub current: f32,
    /// Ticks averaged; two averages in a row this near each other mean it stands.
    pub window_ticks: u32,
    /// How near, codes.
    pub still_codes: f32,
    /// Ticks after which an end must have been reached.
    pub time_out_ticks: u32,
    /// Fewer codes than this between the ends are no stroke.
    pub least_span_codes: u16,
}

impl Default for EndStopParameters {
    fn default() -> Self {
        Self { current: 0.5, window_ticks: 500, still_codes: 8.0, time_out_ticks: 60_000, least_span_codes: 10_000 }
    }
}

impl EndStopParameters {
    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        within("end_stops.current", self.current, [0.05, 0.7])?;
        within("end_stops.window_ticks", self.window_ticks, [250.0, 5000.0])?;
        within("end_stops.still_codes", self.still_codes, [0.5, 200.0])?;
        within("end_stops.time_out_ticks", self.time_out_ticks, [1000.0, 600_000.0])?;
        within("end_stops.least_span_codes", self.least_span_codes, [1000.0, 65_535.0])
    }
}

/// Codes at the shortest and the longest length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EndCodes {
    /// Retracted.
    pub min_code: u16,
    /// Extended.
    pub max_code: u16,
}

/// Why there are no codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndStopFailure {
    /// It never stood still.
    TimeOut(Direction),
    /// Too few codes between the ends: it did not move, or the sensor does not follow.
    TooShort,
    /// The code falls while the actuator extends: the sensor is swapped.
    Reversed,
}

/// The search for both ends: first retracted, then extended.
#[derive(Clone, Copy, Debug)]
pub struct EndStops {
    p: EndStopParameters,
    direction: Direction,
    ticks: u32,
    window: Line,
    last: Option<f32>,
    retracted: f32,
}

impl EndStops {
    /// Checks the parameters once.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn new(p: EndStopParameters) -> Result<Self, ParameterError> {
        p.validate()?;
        let direction = Direction::Retract;
        Ok(Self { p, direction, ticks: 0, window: Line::default(), last: None, retracted: 0.0 })
    }

    /// One tick: the sensor reads `code`.
    pub fn step(&mut self, code: u16) -> Step<EndCodes, EndStopFailure> {
        self.ticks += 1;
        if self.ticks > self.p.time_out_ticks {
            return Step::Failed(EndStopFailure::TimeOut(self.direction));
        }
        self.window.add(f32::from(code));
        if self.window.count() < self.p.window_ticks {
            return Step::Drive(self.direction.sign() * self.p.current);
        }
        let mean = self.window.mean();
        let moved = self.last.map(|last| mean - last);
        (self.window, self.last) = (Line::default(), Some(mean));
        let still = moved.is_some_and(|moved| moved <= self.p.still_codes && moved >= -self.p.still_codes);
        if !still {
            return Step::Drive(self.direction.sign() * self.p.current);
        }
        match self.direction {
            Direction::Retract => {
                (self.direction, self.ticks, self.last, self.retracted) = (self.direction.other(), 0, None, mean);
                Step::Drive(self.direction.sign() * self.p.current)
            }
            Direction::Extend => self.codes(mean),
        }
    }

    /// How far it is, 0…1: an end is a half.
    pub const fn progress(&self) -> f32 {
        match self.direction {
            Direction::Retract => 0.0,
            Direction::Extend => 0.5,
        }
    }

    fn codes(&self, extended: f32) -> Step<EndCodes, EndStopFailure> {
        let span = extended - self.retracted;
        let least = f32::from(self.p.least_span_codes);
        if span <= -least {
            Step::Failed(EndStopFailure::Reversed)
        } else if span < least {
            Step::Failed(EndStopFailure::TooShort)
        } else {
            // The casts saturate.
            Step::Done(EndCodes { min_code: (self.retracted + 0.5) as u16, max_code: (extended + 0.5) as u16 })
        }
    }
}
