//! One actuator: its code every tick, its motion every round.

use super::envelope::{Asked, Envelope, Model};
use super::parameters::ActuatorLimits;
use super::stuck::{Free, Sides, Stuck, StuckLimits};
use super::{GOING_ON_ROUNDS, JUMP_ROUNDS, OUTSIDE_ROUNDS, ROUND_S};
use crate::TICK_S;
use crate::constants::Constant;
use crate::sensing::SensorView;

/// Share of the measured speed that a round keeps: a time constant of five rounds.
const KEPT: f32 = 0.8;
/// From the kept sum of changes to a speed.
const PER_S: f32 = (1.0 - KEPT) / (KEPT * ROUND_S);
/// Share of its full speed at which oil that was pressed against a stop may push an actuator off it, however small the command that lets it.
const OF_SPRING: f32 = 0.5;
/// Share of that which a round keeps once the actuator is clear of the stop: a time constant of 0.2 s.
const SPRING_KEPT: f32 = 0.96;
/// The noise's standard deviation must be as many codes wide for its loss to be seen.
const NOISE_CODES: f32 = 3.0;

/// What is wrong, most urgent first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    Jump,
    Stuck,
    Against,
    Uncommanded,
}

/// An actuator.
#[derive(Clone, Copy, Debug)]
pub(super) struct Channel {
    code: u16,
    /// Changes within so many codes either way are no jump.
    most: u16,
    /// Rounds until a jump is forgotten.
    jumped: u8,
    pub(super) wrong: Option<Wrong>,
    /// The code at the last measurement, and at the one before.
    round_code: u16,
    round_before: u16,
    /// A code's worth of travel.
    unit: f32,
    /// Changes, the older the less.
    changes: f32,
    speed_margin: f32,
    /// The faster full speed, and one over it.
    full: f32,
    per_full: f32,
    envelope: Envelope,
    /// Speed that a stop may have given it, while it is commanded.
    spring: f32,
    /// Rounds since the release beyond what does not ring.
    going_on: u8,
    /// Rounds outside the envelope.
    outside: u8,
    limits: StuckLimits,
    stuck: Stuck,
    pub(super) moving: bool,
}

impl Channel {
    /// Where its limits lie.
    pub(super) const fn constant(&self) -> Constant {
        Constant::of(&self.limits)
    }

    pub(super) fn new(limits: &ActuatorLimits, SensorView { unit, stops }: SensorView) -> Self {
        let [out, back] = limits.full_speed;
        let (slower, faster) = if out < back { (out, back) } else { (back, out) };
        // The cast saturates, far below half of all codes for any sensible sensor.
        let most = core::cmp::min(((2.0 * faster * TICK_S + limits.jump) / unit) as u16, 32_000);
        Self {
            code: 0,
            most,
            jumped: 0,
            wrong: None,
            round_code: 0,
            round_before: 0,
            unit,
            changes: 0.0,
            speed_margin: limits.speed_margin,
            full: faster,
            per_full: 1.0 / faster,
            envelope: Envelope::default(),
            spring: 0.0,
            going_on: 0,
            outside: 0,
            limits: StuckLimits {
                travel: limits.stuck_travel,
                noisy: limits.noise >= NOISE_CODES * unit,
                creep: 0.1 * slower,
                stops,
            },
            stuck: Stuck::default(),
            moving: false,
        }
    }

    /// The first code ever.
    #[inline]
    pub(super) fn begin(&mut self, code: u16) {
        (self.code, self.round_code, self.round_before) = (code, code, code);
    }

    /// Standing at this code, nothing known.
    pub(super) fn restart(&mut self, code: u16) {
        self.begin(code);
        (self.jumped, self.wrong, self.changes, self.outside, self.going_on) = (0, None, 0.0, 0, 0);
        (self.moving, self.spring) = (false, 0.0);
        (self.envelope, self.stuck) = (Envelope::default(), Stuck::default());
    }

    /// Every tick; a jump sets `faulty`.
    #[inline(always)]
    pub(super) fn sample(&mut self, code: u16, faulty: &mut bool) {
        // The difference wraps as a swing's code does.
        let change = code.wrapping_sub(self.code);
        self.code = code;
        if change.wrapping_add(self.most) > 2 * self.most {
            // Whatever moved since the last round is lost in it.
            self.round_code = code;
            (self.jumped, self.wrong, *faulty) = (JUMP_ROUNDS, Some(Wrong::Jump), true);
        }
    }

    /// Speed as measured, m/s or rad/s.
    #[inline(always)]
    pub(super) fn speed(&self) -> f32 {
        self.changes * PER_S
    }

    /// How fast it may be moving, as a share of its full speed.
    #[inline(always)]
    pub(super) fn activity(&self) -> f32 {
        self.envelope.fastest() * self.per_full
    }

    /// First in a round: speed, and what the model makes of the command.
    #[inline(always)]
    pub(super) fn measure(&mut self, model: &Model, command: f32, turned: bool) -> Asked {
        let change = self.code.wrapping_sub(self.round_code).cast_signed();
        (self.round_before, self.round_code) = (self.round_code, self.code);
        self.changes = (self.changes + f32::from(change) * self.unit) * KEPT;
        let speed = self.speed();
        self.moving = speed > self.speed_margin || speed < -self.speed_margin;
        self.envelope.follow(model, command, speed, turned)
    }

    /// Second in a round: what is wrong; whether anything had to be named or forgotten. `others` is the largest activity of the other
    /// actuators, whose masses shake this one and which take its oil.
    #[inline(always)]
    pub(super) fn look(
        &mut self,
        (model, free): (&Model, Free),
        (asked, others): (&Asked, f32),
        sides: Sides<'_>,
    ) -> bool {
        let speed = self.speed();
        let (low, high) = self.envelope.bounds(model, asked);
        let mut margin = self.speed_margin + model.coupling * others * self.full;
        self.spring = if !asked.moves() {
            0.0
        } else if self.limits.near_stop(self.round_code) {
            OF_SPRING * self.full
        } else {
            self.spring * SPRING_KEPT
        };
        margin += self.spring;
        let inside = speed <= high + margin && speed >= low - margin;
        let codes = [self.round_before, self.round_code];
        // A swing motor, which has no sides here, coasts for as long as its brake valves let it.
        let goes_on = sides.is_some() && self.envelope.goes_on(model, speed, margin);
        self.going_on = if goes_on { self.going_on.saturating_add(1) } else { 0 };
        let sides = sides.filter(|_| others == 0.0 && self.envelope.settled());
        let stuck = self.stuck.follow(&self.limits, self.envelope.sure(), codes, self.unit, (free, sides));
        if inside && !stuck && self.going_on < GOING_ON_ROUNDS && self.wrong.is_none() {
            self.outside = 0;
            return false;
        }
        self.name(stuck, inside, asked.command * speed < 0.0);
        true
    }

    /// Names what is wrong, or forgets it. Not inlined: it is for faults.
    #[inline(never)]
    fn name(&mut self, stuck: bool, inside: bool, against: bool) {
        self.outside = if inside { 0 } else { self.outside.saturating_add(1) };
        self.jumped = self.jumped.saturating_sub(1);
        self.wrong = if self.jumped > 0 {
            Some(Wrong::Jump)
        } else if stuck {
            Some(Wrong::Stuck)
        } else if self.going_on >= GOING_ON_ROUNDS {
            Some(Wrong::Uncommanded)
        } else if self.outside < OUTSIDE_ROUNDS {
            None
        } else if against {
            Some(Wrong::Against)
        } else {
            Some(Wrong::Uncommanded)
        };
    }
}
