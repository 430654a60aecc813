//! Dead band and full speed of both directions of a spool.
//!
//! 1. **Search**: the current rises step by step until the actuator moves, first extending, then retracting.
//! 2. **Measure**: at two currents beyond what was found, in each direction, the settled speed is the slope of the position.
//! 3. **Solve**: the line through both speeds meets zero speed at the dead band and full-scale current at the full speed. What was
//!    found in 1 must agree.
//!
//! Currents are fractions of full scale; positions are m, of a swing motor rad.

use super::line::Line;
use super::{Direction, Step};
use crate::parameters::{ParameterError, ValveDirection, ordered, within};

/// Ticks averaged at rest and at the end of each step of the search.
const AVERAGED: u32 = 64;

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValveSearchParameters {
    /// First current of the search.
    pub start: f32,
    /// Step of the search.
    pub increment: f32,
    /// Largest current of the search: beyond it the direction does not work.
    pub largest: f32,
    /// Ticks each step is held, and the actuator is left to settle: longer than dead time and spool together.
    pub dwell_ticks: u32,
    /// This much motion within a step means it moves, m or rad.
    pub threshold: f32,
    /// Ticks of a measured speed.
    pub window_ticks: u32,
    /// Both measured currents, as fractions of the way from the found dead band to full scale.
    pub measured_at: [f32; 2],
    /// Positions to stay between, m or rad.
    pub room: [f32; 2],
}

impl ValveSearchParameters {
    /// For a cylinder with this stroke, m: every default is in range for it.
    pub fn for_cylinder(min_m: f32, max_m: f32) -> Self {
        Self {
            start: 0.02,
            increment: 0.005,
            largest: 0.6,
            dwell_ticks: 700,
            threshold: 0.0005,
            window_ticks: 300,
            measured_at: [0.1, 0.3],
            room: [min_m, max_m],
        }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        let [first, second] = self.measured_at;
        let [low, high] = self.room;
        within("search.start", self.start, [0.0, 0.5])?;
        within("search.increment", self.increment, [0.001, 0.05])?;
        within("search.largest", self.largest, [self.start.into(), 0.9])?;
        within("search.dwell_ticks", self.dwell_ticks, [f64::from(2 * AVERAGED), 5000.0])?;
        within("search.threshold", self.threshold, [1e-5, 0.1])?;
        within("search.window_ticks", self.window_ticks, [100.0, 5000.0])?;
        within("search.measured_at", first, [0.02, 0.9])?;
        within("search.measured_at", second, [f64::from(first) + 0.05, 1.0])?;
        ordered(("search.room[0]", low.into()), ("search.room[1]", high.into()))
    }
}

/// Why a search gave up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchFailure {
    /// No motion up to the largest current.
    NoMotion(Direction),
    /// It moves against the current: solenoids or sensor are swapped.
    WrongWay(Direction),
    /// The actuator came to the end of its room.
    NoRoom(Direction),
    /// Both ways of finding the dead band disagree, or more current gives no more speed.
    Inconsistent(Direction),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// No current until everything stands; the last ticks are averaged.
    Rest,
    Search {
        current: f32,
    },
    /// Which of both currents is measured.
    Measure {
        point: usize,
    },
}

/// What is known of a direction so far.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    /// Where motion began.
    dead_band: f32,
    /// Speeds at both measured currents.
    speeds: [f32; 2],
}

impl Found {
    fn measured_at(&self, fraction: f32) -> f32 {
        self.dead_band + fraction * (1.0 - self.dead_band)
    }
}

/// The search of one spool.
#[derive(Clone, Copy, Debug)]
pub struct ValveSearch {
    p: ValveSearchParameters,
    phase: Phase,
    /// The phase after the rest.
    next: Phase,
    direction: Direction,
    ticks: u32,
    /// Where the actuator stood before this step.
    before: f32,
    line: Line,
    extend: Found,
    retract: Found,
}

/// Both directions: \[extend, retract\].
pub type FoundValve = [ValveDirection; 2];

impl ValveSearch {
    /// Checks the parameters once.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn new(p: ValveSearchParameters) -> Result<Self, ParameterError> {
        p.validate()?;
        Ok(Self {
            p,
            phase: Phase::Rest,
            next: Phase::Search { current: p.start },
            direction: Direction::Extend,
            ticks: 0,
            before: 0.0,
            line: Line::default(),
            extend: Found::default(),
            retract: Found::default(),
        })
    }

    /// One tick: the actuator stands at `position`.
    pub fn step(&mut self, position: f32) -> Step<FoundValve, SearchFailure> {
        let [low, high] = self.p.room;
        let moving = self.phase != Phase::Rest;
        // Only towards the end: the way back is free.
        let out = match self.direction {
            Direction::Extend => position >= high,
            Direction::Retract => position <= low,
        };
        if moving && out {
            return Step::Failed(SearchFailure::NoRoom(self.direction));
        }
        self.ticks += 1;
        match self.phase {
            Phase::Rest => self.rest(position),
            Phase::Search { current } => self.search(current, position),
            Phase::Measure { point } => self.measure(point, position),
        }
    }

    /// How far it is, 0…1: the searches count two fifths each, the measurements the rest.
    pub fn progress(&self) -> f32 {
        let of_search = |current: f32| 0.4 * current / self.p.largest;
        let phase = if self.phase == Phase::Rest { self.next } else { self.phase };
        match (phase, self.direction) {
            (Phase::Rest, _) => 0.0,
            (Phase::Search { current }, Direction::Extend) => of_search(current),
            (Phase::Search { current }, Direction::Retract) => 0.4 + of_search(current),
            (Phase::Measure { point }, Direction::Extend) => 0.8 + 0.1 * point as f32,
            (Phase::Measure { point }, Direction::Retract) => 0.85 + 0.1 * point as f32,
        }
    }

    fn found(&mut self) -> &mut Found {
        match self.direction {
            Direction::Extend => &mut self.extend,
            Direction::Retract => &mut self.retract,
        }
    }

    fn enter(&mut self, phase: Phase) {
        (self.phase, self.ticks, self.line) = (phase, 0, Line::default());
    }

    /// Stand still first, then `next` in that direction.
    fn rest_before(&mut self, direction: Direction, next: Phase) {
        (self.direction, self.next) = (direction, next);
        self.enter(Phase::Rest);
    }

    fn rest(&mut self, position: f32) -> Step<FoundValve, SearchFailure> {
        if self.ticks > self.p.dwell_ticks - AVERAGED {
            self.line.add(position);
        }
        if self.ticks >= self.p.dwell_ticks {
            self.before = self.line.mean();
            self.enter(self.next);
        }
        Step::Drive(0.0)
    }

    fn search(&mut self, current: f32, position: f32) -> Step<FoundValve, SearchFailure> {
        if self.ticks > self.p.dwell_ticks - AVERAGED {
            self.line.add(position);
        }
        if self.ticks >= self.p.dwell_ticks {
            let moved = (self.line.mean() - self.before) * self.direction.sign();
            if moved <= -self.p.threshold {
                return Step::Failed(SearchFailure::WrongWay(self.direction));
            }
            if moved >= self.p.threshold {
                self.found().dead_band = current;
                match self.direction {
                    Direction::Extend => {
                        self.rest_before(Direction::Retract, Phase::Search { current: self.p.start });
                    }
                    Direction::Retract => self.rest_before(Direction::Extend, Phase::Measure { point: 0 }),
                }
                return Step::Drive(0.0);
            }
            let next = current + self.p.increment;
            if next > self.p.largest {
                return Step::Failed(SearchFailure::NoMotion(self.direction));
            }
            self.before = self.line.mean();
            self.enter(Phase::Search { current: next });
        }
        Step::Drive(self.direction.sign() * current)
    }

    fn measure(&mut self, point: usize, position: f32) -> Step<FoundValve, SearchFailure> {
        let fraction = self.p.measured_at.get(point).copied().unwrap_or_default();
        let current = self.found().measured_at(fraction);
        if self.ticks > self.p.dwell_ticks {
            self.line.add(position);
        }
        if self.line.count() >= self.p.window_ticks {
            let speed = self.line.slope() * self.direction.sign() * crate::TICKS_PER_S as f32;
            if let Some(slot) = self.found().speeds.get_mut(point) {
                *slot = speed;
            }
            match (self.direction, point) {
                (Direction::Retract, 0) => self.rest_before(Direction::Extend, Phase::Measure { point: 1 }),
                (Direction::Retract, _) => return self.solve(),
                (Direction::Extend, _) => self.rest_before(Direction::Retract, self.phase),
            }
            return Step::Drive(0.0);
        }
        Step::Drive(self.direction.sign() * current)
    }

    fn solve(&self) -> Step<FoundValve, SearchFailure> {
        match (self.line_through(&self.extend), self.line_through(&self.retract)) {
            (Some(extend), Some(retract)) => Step::Done([extend, retract]),
            (None, _) => Step::Failed(SearchFailure::Inconsistent(Direction::Extend)),
            (_, None) => Step::Failed(SearchFailure::Inconsistent(Direction::Retract)),
        }
    }

    /// The straight line through both speeds; `None` where it does not fit what the search found.
    fn line_through(&self, found: &Found) -> Option<ValveDirection> {
        let [low, high] = self.p.measured_at.map(|fraction| found.measured_at(fraction));
        let [slow, fast] = found.speeds;
        let slope = (fast - slow) / (high - low);
        let dead_band = low - slow / slope;
        // Motion shows some steps later than it begins; it never begins later than it shows.
        let fits = dead_band <= found.dead_band + self.p.increment && dead_band >= found.dead_band - 0.1;
        (slope > 0.0 && dead_band >= 0.0 && fits)
            .then_some(ValveDirection { dead_band, full_speed: slope * (1.0 - dead_band) })
    }
}
