//! The state machine alone: facts, the table of transitions, and the one function that reads it.
//!
//! Everything the supervisor may do stands in [`transitions`]; tests try every state with every set of facts, and the drawing in
//! `docs/supervisor.svg` is made from it.

use crate::fault::State;

/// What the machine decides by, a set: this tick's inputs, each a yes or no.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Facts(u8);

impl Facts {
    /// None of them.
    pub const NONE: Self = Self(0);
    /// Every step of the start-up self-test has passed.
    pub const SELF_TESTED: Self = Self(1);
    /// The operator, freshly heard, has everything in neutral.
    pub const NEUTRAL: Self = Self(1 << 1);
    /// The enable switch is on.
    pub const ENABLE: Self = Self(1 << 2);
    /// It was switched on in this tick.
    pub const ENABLE_EDGE: Self = Self(1 << 3);
    /// Neutral, and nothing has moved for [`super::IDLE_TICKS`].
    pub const IDLE: Self = Self(1 << 4);
    /// Something is wrong.
    pub const WRONG: Self = Self(1 << 5);
    /// Something is wrong after which only a restart is trusted.
    pub const GRAVE: Self = Self(1 << 6);

    /// Every fact with a name for drawings.
    pub const NAMED: [(Self, &str); 7] = [
        (Self::SELF_TESTED, "self-test passed"),
        (Self::NEUTRAL, "neutral"),
        (Self::ENABLE, "enable on"),
        (Self::ENABLE_EDGE, "enable switched on"),
        (Self::IDLE, "idle 10 s"),
        (Self::WRONG, "fault"),
        (Self::GRAVE, "grave fault"),
    ];

    /// These and those.
    #[must_use]
    #[inline]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// These and, where `holds`, those.
    #[must_use]
    #[inline]
    pub const fn and_if(self, holds: bool, other: Self) -> Self {
        if holds { self.and(other) } else { self }
    }

    /// Whether all of those are among these.
    #[inline]
    pub const fn has(self, all: Self) -> bool {
        self.0 & all.0 == all.0
    }

    /// Whether any of those is among these.
    #[inline]
    pub const fn has_any(self, of: Self) -> bool {
        self.0 & of.0 != 0
    }
}

/// One arrow: it is taken when all of `all` hold and none of `none`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition {
    /// What must hold.
    pub all: Facts,
    /// What must not.
    pub none: Facts,
    /// Where it leads.
    pub to: State,
}

const fn arrow(all: Facts, none: Facts, to: State) -> Transition {
    Transition { all, none, to }
}

const STOP: Transition = arrow(Facts::GRAVE, Facts::NONE, State::Stopped);
const LATCH: Transition = arrow(Facts::WRONG, Facts::NONE, State::Fault);
/// Neutral with the enable switch off: then it can be switched on afresh.
const AT_REST: Facts = Facts::NEUTRAL.and(Facts::SELF_TESTED);

static SELF_TEST: [Transition; 3] = [STOP, LATCH, arrow(Facts::SELF_TESTED, Facts::NONE, State::Locked)];
static LOCKED: [Transition; 3] = [STOP, LATCH, arrow(AT_REST, Facts::ENABLE, State::Ready)];
static READY: [Transition; 4] = [
    STOP,
    LATCH,
    // Levers moved before enabling: back to neutral first.
    arrow(Facts::NONE, Facts::NEUTRAL, State::Locked),
    arrow(AT_REST.and(Facts::ENABLE).and(Facts::ENABLE_EDGE), Facts::NONE, State::Running),
];
static RUNNING: [Transition; 4] = [
    STOP,
    LATCH,
    arrow(Facts::NONE, Facts::ENABLE, State::Locked),
    // Enable must be switched off and on again.
    arrow(Facts::IDLE, Facts::NONE, State::Locked),
];
static FAULT: [Transition; 2] = [STOP, arrow(AT_REST, Facts::ENABLE.and(Facts::WRONG), State::Ready)];
static STOPPED: [Transition; 0] = [];

/// The arrows out of a state; the first that fits is taken, none means to stay.
#[inline]
pub fn transitions(from: State) -> &'static [Transition] {
    match from {
        State::SelfTest => &SELF_TEST,
        State::Locked => &LOCKED,
        State::Ready => &READY,
        State::Running => &RUNNING,
        State::Fault => &FAULT,
        State::Stopped => &STOPPED,
    }
}

/// The state after this tick.
#[inline]
pub fn next(state: State, facts: Facts) -> State {
    let taken = transitions(state).iter().find(|arrow| facts.has(arrow.all) && !facts.has_any(arrow.none));
    taken.map_or(state, |arrow| arrow.to)
}
