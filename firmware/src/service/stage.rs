//! The service stage: what may begin when, and what ends it.
//!
//! ```text
//! Idle ── a task that drives, disabled ──▶ Waiting ── the supervisor opens the gate ──▶ Driving
//!  ▲                                          │                                            │
//!  │◀──── withdrawn, stale, changed, fault ───┘      done, failed, withdrawn, stale, changed, enable off,
//!  │                                                          levers moved, fault
//!  └────────────────────── enable off, a second ago ── Ended ◀─────────────────────────────┘
//! Idle ── a bucket or keeping, disabled ──▶ Due ── proved disabled ──▶ Away ── the errand is back ──▶ Back ──▶ Idle
//! ```
//! While `Ended` lasts the supervisor is told that the enable switch is off; from `Due` to `Back`, that there is no command: neither can
//! run. A task is begun once: the same again needs that it was withdrawn between.

use kinematics_core::{Joints, Vec2};

use super::answer::{Answer, Phase, Reason};
use super::errand::Job;
use super::found::Found;
use super::limits::SpoolLimits;
use super::procedure::{Procedure, Wish};
use super::request::{ServiceRequest, Task};
use crate::calibration::measure_up::{MeasureUp, MeasureUpError};
use crate::fault::State;
use crate::io::{Inputs, Request};
use crate::parameters::Parameters;
use crate::supervisor::Gate;

/// What moved has come to rest after so long: dead time, spool and oil together.
const SETTLE_TICKS: u16 = 1000;

/// Where the stage is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Run {
    Idle,
    Waiting,
    Driving,
    Ended,
    /// An errand waits for the proof that the board is disabled.
    Due,
    /// An errand is run beside the ticks: they may come late.
    Away,
    /// The tick after.
    Back,
}

/// What the stage looks at before a task begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Situation {
    pub(crate) state: State,
    /// `None` while nothing is fitted.
    pub(crate) wrist: Option<Vec2<f32>>,
    pub(crate) joints: Joints<f32>,
}

/// The stage.
#[derive(Clone, Copy, Debug)]
pub struct Service {
    limits: [SpoolLimits; 4],
    run: Run,
    /// The task begun or refused, until it is withdrawn.
    heard: Option<ServiceRequest>,
    procedure: Procedure,
    touches: MeasureUp,
    touched: f32,
    answer: Answer,
    /// Ticks since a task ended.
    settled: u16,
    /// Buckets in the store's record; 0 without a store.
    buckets: u8,
    /// The record is another than the one the application was built from.
    kept: bool,
}

impl Service {
    /// Of valid parameters.
    #[inline(never)]
    pub(crate) fn new(parameters: &Parameters) -> Self {
        Self {
            limits: SpoolLimits::all(parameters),
            run: Run::Idle,
            heard: None,
            procedure: Procedure::None,
            touches: MeasureUp::new(),
            touched: 0.0,
            answer: Answer::NONE,
            settled: 0,
            buckets: 0,
            kept: false,
        }
    }

    /// What it has to say.
    pub fn answer(&self) -> &Answer {
        &self.answer
    }

    /// An errand is under way, or was until this tick.
    pub(crate) fn is_away(&self) -> bool {
        matches!(self.run, Run::Away | Run::Back)
    }

    /// An errand is about to begin, under way or just over.
    #[inline(always)]
    pub(crate) fn runs_errand(&self) -> bool {
        matches!(self.run, Run::Due | Run::Away | Run::Back)
    }

    /// There is something to do, or to forget.
    #[inline(always)]
    pub(crate) fn attends(&self, inputs: &Inputs) -> bool {
        inputs.service.is_some() || self.heard.is_some() || self.run != Run::Idle
    }

    /// Hears the command; true when this tick is the service's.
    #[inline(never)]
    pub(crate) fn hear(&mut self, inputs: &Inputs, now: &Situation) -> bool {
        if self.run == Run::Idle {
            match asked(inputs) {
                None => self.heard = None,
                Some(request) if self.heard.is_some_and(|heard| heard.is(request)) => {}
                Some(request) => {
                    self.heard = Some(*request);
                    self.begin(request, inputs, now);
                }
            }
        }
        self.run != Run::Idle
    }

    fn begin(&mut self, request: &ServiceRequest, inputs: &Inputs, now: &Situation) {
        let (task, spool) = (request.task, request.spool);
        self.answer = Answer { task, spool, phase: Phase::Done, reason: Reason::None, progress: 0.0, ..self.answer };
        let moves_nothing = matches!(task, Task::Touch | Task::MeasureUp);
        let disabled = matches!(now.state, State::Locked | State::Ready) && !inputs.enable && !inputs.cut_off_closed;
        let refusal = match now.state {
            State::Fault | State::Stopped | State::SelfTest => Some(Reason::Fault),
            _ if !moves_nothing && !disabled => Some(Reason::Enabled),
            _ => self.enter(request, now).err(),
        };
        if let Some(reason) = refusal {
            (self.answer.phase, self.answer.reason) = (Phase::Refused, reason);
        }
    }

    fn enter(&mut self, request: &ServiceRequest, now: &Situation) -> Result<(), Reason> {
        match request.task {
            Task::None => {}
            Task::MountBucket if request.number >= self.buckets => return Err(Reason::NoSuchBucket),
            Task::MountBucket if self.kept => return Err(Reason::RestartFirst),
            Task::Keep if self.answer.found.is_none() => return Err(Reason::NothingFound),
            Task::Keep if self.buckets == 0 => return Err(Reason::NotStored),
            Task::MountBucket | Task::Keep => (self.run, self.answer.phase) = (Run::Due, Phase::UnderWay),
            Task::Touch => self.touch(request.number, now),
            Task::MeasureUp => {
                let bucket = self.touches.bucket().map_err(|why| match why {
                    MeasureUpError::TooFew { .. } => Reason::TooFewTouches,
                    MeasureUpError::TooAlike { .. } => Reason::TouchesTooAlike,
                })?;
                (self.answer.found, self.answer.progress) = (Some(Found::Bucket(bucket)), 1.0);
            }
            Task::ValveSearch | Task::EndStops | Task::Jog => {
                let limits = self.limits.get(usize::from(request.spool)).ok_or(Reason::NoEndStops)?;
                self.procedure = Procedure::of(request, limits)?;
                (self.run, self.answer.phase) = (Run::Waiting, Phase::Waiting);
            }
        }
        Ok(())
    }

    fn touch(&mut self, number: u8, now: &Situation) {
        if number == 0 {
            (self.touches, self.touched) = (MeasureUp::new(), 0.0);
        } else if let Some(wrist) = now.wrist {
            self.touches.touch(wrist, &now.joints);
            self.touched = if self.touched < 100.0 { self.touched + 1.0 } else { 100.0 };
        }
        self.answer.progress = 0.01 * self.touched;
    }

    /// What the supervisor and the sensing are to see of this tick's inputs, and what drives: a spool and its signed current, A.
    #[inline(never)]
    pub(crate) fn before(&mut self, inputs: &mut Inputs) -> Option<(usize, f32)> {
        match self.run {
            Run::Idle => None,
            Run::Due | Run::Away | Run::Back => {
                // Nothing can move, and a flash that erases stops the ticks.
                (inputs.command, inputs.overrun) = (None, false);
                if self.run == Run::Back {
                    self.run = Run::Idle;
                }
                None
            }
            Run::Waiting => {
                if let Some(reason) = self.given_up(inputs) {
                    self.end(reason);
                    self.run = Run::Idle;
                }
                None
            }
            Run::Ended => {
                self.settled = self.settled.saturating_add(1);
                if !inputs.enable && self.settled >= SETTLE_TICKS {
                    self.run = Run::Idle;
                }
                inputs.enable = false;
                None
            }
            Run::Driving => self.drive(inputs),
        }
    }

    fn drive(&mut self, inputs: &mut Inputs) -> Option<(usize, f32)> {
        let not_neutral = inputs.command.is_some_and(|intent| intent.request != Request::Neutral);
        let stop = if !inputs.enable {
            Some(Reason::EnableReleased)
        } else if not_neutral {
            Some(Reason::NotNeutral)
        } else {
            self.given_up(inputs)
        };
        if let Some(reason) = stop {
            return self.stop(inputs, reason);
        }
        let Some(request) = asked(inputs).copied() else { return self.stop(inputs, Reason::Withdrawn) };
        let spool = usize::from(request.spool);
        let (limits, code) = (self.limits.get(spool)?, inputs.codes.get_mut(spool)?);
        let wish = self.procedure.step(&request, limits, *code);
        if let Procedure::Ends(_) = self.procedure {
            *code = limits.within_ends(*code);
        }
        self.answer.progress = self.procedure.progress();
        match wish {
            Wish::Current(current_a) => Some((spool, current_a)),
            Wish::Found(found) => {
                (self.answer.found, self.answer.progress) = (Some(found), 1.0);
                self.stop(inputs, Reason::None)
            }
            Wish::Failed(reason) => self.stop(inputs, reason),
        }
    }

    /// The command does not stand any more.
    fn given_up(&self, inputs: &Inputs) -> Option<Reason> {
        match (&inputs.service, &self.heard) {
            (None, _) => Some(Reason::Stale),
            (Some(now), _) if now.task == Task::None => Some(Reason::Withdrawn),
            (Some(now), Some(heard)) if now.is(heard) => None,
            _ => Some(Reason::Changed),
        }
    }

    /// Nothing drives from this tick on; the supervisor closes the gate in it.
    fn stop(&mut self, inputs: &mut Inputs, reason: Reason) -> Option<(usize, f32)> {
        inputs.enable = false;
        self.end(reason);
        None
    }

    fn end(&mut self, reason: Reason) {
        // A jog that is let go is done.
        let done = reason == Reason::None || matches!(self.procedure, Procedure::Jog(_)) && reason == Reason::Withdrawn;
        self.answer.phase = if done { Phase::Done } else { Phase::Aborted };
        self.answer.reason = if done { Reason::None } else { reason };
        (self.run, self.procedure, self.settled) = (Run::Ended, Procedure::None, 0);
    }

    /// What the supervisor made of it.
    #[inline(never)]
    pub(crate) fn after(&mut self, gate: Gate, state: State) {
        match (self.run, gate) {
            (Run::Waiting, Gate::Open) => (self.run, self.answer.phase) = (Run::Driving, Phase::UnderWay),
            (Run::Waiting, Gate::Closed) if matches!(state, State::Fault | State::Stopped) => {
                self.end(Reason::Fault);
                self.run = Run::Idle;
            }
            (Run::Driving, Gate::Closed) => self.end(Reason::Fault),
            _ => {}
        }
    }

    /// There is a store; its record has so many buckets, and this one of them is mounted.
    pub(crate) fn set_buckets(&mut self, count: u8, mounted: u8) {
        (self.buckets, self.answer.bucket) = (count, Some(mounted));
    }

    #[inline(always)]
    pub(crate) fn errand_is_due(&self) -> bool {
        self.run == Run::Due
    }

    /// What is due, once.
    pub(crate) fn send(&mut self) -> Option<Job> {
        let bucket = self.answer.bucket.filter(|_| self.run == Run::Due)?;
        let job = match self.answer.task {
            Task::MountBucket => Job::Mount { bucket: self.heard?.number, before: bucket },
            _ => Job::Keep { found: self.answer.found?, bucket },
        };
        self.run = Run::Away;
        Some(job)
    }

    /// An errand is back, or was not possible.
    pub(crate) fn returned(&mut self, mounted: Option<u8>, outcome: Result<(), Reason>) {
        self.run = Run::Back;
        self.answer.bucket = mounted.or(self.answer.bucket);
        self.answer.progress = 1.0;
        (self.answer.phase, self.answer.reason) = match outcome {
            Ok(()) => (Phase::Done, Reason::None),
            Err(reason) => (Phase::Refused, reason),
        };
        self.kept |= self.answer.task == Task::Keep && outcome.is_ok();
    }
}

/// The task asked for, if any.
fn asked(inputs: &Inputs) -> Option<&ServiceRequest> {
    inputs.service.as_ref().filter(|request| request.task != Task::None)
}
