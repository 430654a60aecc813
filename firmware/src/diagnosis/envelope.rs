//! The delay model: what speeds a healthy actuator may have after its commands so far, and which it must have.
//!
//! Dead time lies between none and the longest, so speed may be anything between the lowest and the highest command of that time. After
//! the highest it may fall off in a straight line over the run-on, and a released speed may ring back by its share. What runs on from the
//! end of the dead time is at most what was measured until then; and a mass on closed oil swings on as long as each swing is about as fast
//! as the one before it the other way. The speed it must have is the command nearest to zero of that time, less what may still run on the
//! other way, behind the slowest spool.
//!
//! Room for ringing is room for a spool that sticks open too. But what rings comes back: a released cylinder that stays beyond a closer line, on
//! which the measured speed itself falls to rest a run-on after the release, goes on.

use super::ROUND_S;
use super::parameters::DiagnosisParameters;

/// What was measured counts so many times: with a run-on of 2 s the memory of it fades by a fifth in half a swing of 0.4 s.
const MEASURED: f32 = 1.25;

/// Lately not faster than so many times the speed there must be, motion does not ring so far that it stands.
const CALM: f32 = 1.1;

/// What all actuators calculate with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model {
    /// Share of a speed that the run-on takes off in a round.
    run_on_share: f32,
    /// Share of a measured speed that a round remembers.
    remembered: f32,
    /// Share of the way to its command that the slowest spool goes in a round.
    lag_share: f32,
    over: f32,
    ring: f32,
    /// By how much less a speed bounces back than rings back.
    calmer: f32,
    /// From a run-on's level and slope to the line below which what does not ring falls.
    line: [f32; 2],
    /// Share of its full speed that the others at theirs shake an actuator with.
    pub(super) coupling: f32,
    /// Rounds of a span: three cover the longest dead time.
    pub(super) span_rounds: u8,
}

impl Model {
    /// Of valid parameters.
    pub(super) fn new(p: &DiagnosisParameters) -> Self {
        let share = |time_s: f32| if time_s > ROUND_S { ROUND_S / time_s } else { 1.0 };
        // The dead time is part of it, for at most half of it.
        let dead_s = if 2.0 * p.latest_start_s < p.run_on_s { p.latest_start_s } else { 0.5 * p.run_on_s };
        let steeper = p.run_on_s / (p.run_on_s - dead_s);
        // A run-on's level stands for 1.25 times what was measured, its slope for the level it began at.
        let measured = (1.0 + p.overshoot) / MEASURED;
        Self {
            line: [measured * steeper, measured * (steeper - 1.0) / share(p.run_on_s)],
            run_on_share: share(p.run_on_s),
            // Half the run-on: longer than from one swing to the next.
            remembered: 1.0 - share(0.5 * p.run_on_s),
            lag_share: share(p.spool_lag_s),
            over: 1.0 + p.overshoot,
            ring: p.ring,
            calmer: p.ring - p.rebound,
            coupling: p.coupling,
            // The cast saturates.
            span_rounds: (p.latest_start_s / (3.0 * ROUND_S) + 0.999) as u8,
        }
    }
}

/// A speed that may still be there: at once up with its command, down in a straight line.
#[derive(Clone, Copy, Debug, Default)]
struct RunOn {
    level: f32,
    slope: f32,
}

impl RunOn {
    #[inline(always)]
    fn follow(&mut self, command: f32, share: f32) {
        let fallen = self.level - self.slope;
        if command > fallen {
            *self = Self { level: command, slope: command * share };
        } else {
            self.level = if fallen > 0.0 { fallen } else { 0.0 };
        }
    }
}

/// Lowest and highest command of a stretch of time.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    low: f32,
    high: f32,
}

impl Span {
    /// Of both.
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self {
            low: if other.low < self.low { other.low } else { self.low },
            high: if other.high > self.high { other.high } else { self.high },
        }
    }
}

/// What an actuator was asked for, from a round's first tick to its second.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Asked {
    /// Of the dead time, and now.
    span: Span,
    pub(super) command: f32,
}

impl Asked {
    /// Something of it is not rest.
    #[inline(always)]
    pub(super) fn moves(&self) -> bool {
        self.span.low < 0.0 || self.span.high > 0.0
    }
}

/// One actuator's model.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Envelope {
    /// The span under way, and the two before it: the last first.
    now: Span,
    past: [Span; 2],
    /// The three before it together.
    before: Span,
    out: RunOn,
    back: RunOn,
    /// Fastest measured speeds out and back, the older the less.
    swung: [f32; 2],
    /// Commands are over, the longest dead time too.
    released: bool,
    sure: f32,
}

impl Envelope {
    /// The speed there must be, if nothing holds the actuator back.
    #[inline]
    pub(super) fn sure(&self) -> f32 {
        self.sure
    }

    /// What ran on from before is at most twice the speed there must be, and it was not much faster lately than that: else its ringing may
    /// stand still for a while, which takes a swing as fast as the motion, so that it was twice as fast half a swing before.
    #[inline(always)]
    pub(super) fn settled(&self) -> bool {
        let ([swung_out, swung_back], sure) = (self.swung, self.sure);
        let (sure, swung) = if sure > 0.0 { (sure, swung_out) } else { (-sure, swung_back) };
        self.fastest() <= 2.0 * sure && swung <= CALM * sure
    }

    /// The fastest it may run on.
    #[inline(always)]
    pub(super) fn fastest(&self) -> f32 {
        let (out, back) = (self.out.level, self.back.level);
        if out > back { out } else { back }
    }

    /// Whether it is released and faster, by more than this margin, than what does not ring may still be. What comes back the other way
    /// rings.
    #[inline(always)]
    pub(super) fn goes_on(&self, model: &Model, speed: f32, margin: f32) -> bool {
        let (speed, run_on, other) =
            if speed > 0.0 { (speed, self.out, self.back) } else { (-speed, self.back, self.out) };
        let [of_level, of_slope] = model.line;
        let beyond = speed - margin;
        self.released
            && run_on.level > other.level
            && beyond > 0.0
            && beyond > of_level * run_on.level - of_slope * run_on.slope
    }

    /// One round under this command with this measured speed, `turned` at the end of every span.
    #[inline(always)]
    pub(super) fn follow(&mut self, model: &Model, command: f32, speed: f32, turned: bool) -> Asked {
        let command_now = Span { low: command, high: command };
        self.now = self.now.and(command_now);
        let span = self.now.and(self.before);
        if turned {
            let [last, one_before] = self.past;
            self.past = [self.now, last];
            self.before = self.now.and(last).and(one_before);
            self.now = command_now;
        }
        self.out.follow(span.high, model.run_on_share);
        self.back.follow(-span.low, model.run_on_share);
        self.swing(model, speed);
        let released = span.low == 0.0 && span.high == 0.0;
        if released && !self.released {
            self.release(model);
        }
        self.released = released;
        Asked { span, command }
    }

    /// What follows of it: lowest and highest speed, and the speed there must be.
    #[inline(always)]
    pub(super) fn bounds(&mut self, model: &Model, asked: &Asked) -> (f32, f32) {
        let Asked { span: Span { low, high }, command } = *asked;
        let (out, back) = (self.out.level, self.back.level);
        // What may still run on the other way is owed.
        let must = if low > back {
            low - back
        } else if high < -out {
            high + out
        } else {
            // Released or reversed: the past promises nothing.
            self.sure = 0.0;
            0.0
        };
        self.sure += (must - self.sure) * model.lag_share;
        let bounce = model.calmer * command;
        let (bounce_out, bounce_back) = if command > 0.0 { (bounce, 0.0) } else { (0.0, -bounce) };
        // A small command does not end what rings.
        let [swung_out, swung_back] = self.swung;
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let rung_back = larger(model.ring * out, MEASURED * swung_out);
        let rung_out = larger(model.ring * back, MEASURED * swung_back);
        (-(model.over * back + rung_back - bounce_out), model.over * out + rung_out - bounce_back)
    }

    /// What runs on from here is at most what was measured.
    fn release(&mut self, model: &Model) {
        let [out, back] = self.swung;
        let most = MEASURED * if out > back { out } else { back } / model.over;
        for run_on in [&mut self.out, &mut self.back] {
            if run_on.level > most {
                *run_on = RunOn { level: most, slope: most * model.run_on_share };
            }
        }
    }

    /// Remembers how fast it went either way: on closed oil a mass is hardly damped, and swings on when the run-on is over.
    #[inline(always)]
    fn swing(&mut self, model: &Model, speed: f32) {
        let [out, back] = &mut self.swung;
        *out *= model.remembered;
        *back *= model.remembered;
        if speed > *out {
            *out = speed;
        } else if -speed > *back {
            *back = -speed;
        }
    }
}
