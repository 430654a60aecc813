//! What the controller answers to a service command.

use super::received::{SPOOL_NAMES, TASKS};
use super::sent::telemetry;
use crate::can::message::{Header, Message};
use crate::can::protect::{COUNTER, CRC};
use crate::can::signal::{Scale, Signal, Word, states, words};
use crate::service::{Phase, Reason};

/// Period of the answers, ms.
const PERIOD_MS: u16 = 100;

const PHASE_COUNT: usize = Phase::ALL.len();
const REASON_COUNT: usize = Reason::ALL.len();

/// How far a task is.
pub const PHASES: [(u32, Word); PHASE_COUNT] = {
    let mut named = [(0, words("")); PHASE_COUNT];
    let mut i = 0;
    while i < PHASE_COUNT {
        named[i] = (Phase::ALL[i] as u32, words(Phase::ALL[i].name()));
        i += 1;
    }
    named
};

/// Why a task was refused, aborted, or failed.
pub const REASONS: [(u32, Word); REASON_COUNT] = {
    let mut named = [(0, words("")); REASON_COUNT];
    let mut i = 0;
    while i < REASON_COUNT {
        named[i] = (Reason::ALL[i] as u32, words(Reason::ALL[i].name()));
        i += 1;
    }
    named
};

const FOUND: [(u32, Word); 4] = states([(0, "nothing"), (1, "valve"), (2, "end_stops"), (3, "bucket")]);
const PERCENT: Scale = Scale { factor: 0.4, offset: 0.0, unit: words("%") };
const LENGTH: Scale = Scale { factor: 0.0001, offset: 0.0, unit: words("m") };

/// What is under way.
pub static ANSWER: Message<9> = Message {
    header: Header {
        protected: true,
        ..telemetry(
            "ServiceAnswer",
            65304,
            [PERIOD_MS, 8],
            "The last service task: how far it is, why it ended, what kind of values it left, and the mounted bucket.",
        )
    },
    signals: [
        Signal::states("Task", 0, 4, &TASKS),
        Signal::states("Phase", 4, 4, &PHASES),
        Signal::states("Reason", 8, 8, &REASONS),
        Signal::states("Spool", 16, 4, &SPOOL_NAMES),
        Signal::bits("Bucket", 20, 4),
        Signal::measured("Progress", 24, 8, PERCENT, [0.0, 100.0]),
        Signal::states("Found", 32, 4, &FOUND),
        COUNTER,
        CRC,
    ],
};

const SHARE: Scale = Scale { factor: 0.0025, offset: 0.0, unit: words("%") };
const SPEED: Scale = Scale { factor: 0.0001, offset: 0.0, unit: words("") };

/// Both directions of a valve.
pub static FOUND_VALVE: Message<4> = Message {
    header: telemetry(
        "ServiceFoundValve",
        65305,
        [PERIOD_MS, 9],
        "A valve search's result, not available without one: dead bands as shares of full-scale current, speeds at full scale in \
         m/s, of a swing motor rad/s.",
    ),
    signals: [
        Signal::measured("ExtendDeadBand", 0, 16, SHARE, [0.0, 100.0]),
        Signal::measured("ExtendFullSpeed", 16, 16, SPEED, [0.0, 6.4]),
        Signal::measured("RetractDeadBand", 32, 16, SHARE, [0.0, 100.0]),
        Signal::measured("RetractFullSpeed", 48, 16, SPEED, [0.0, 6.4]),
    ],
};

const UNIT: Scale = Scale { factor: 0.00003125, offset: -1.004, unit: words("") };

/// End stops or the bucket's tip.
pub static FOUND_ENDS: Message<4> = Message {
    header: telemetry(
        "ServiceFoundEnds",
        65306,
        [PERIOD_MS, 12],
        "The result of an end-stop search (65535 without one) or of a measure-up: bucket pin to tip, and the sine of the tip's direction \
         in the bucket's frame as the parameters have it (not available without one).",
    ),
    signals: [
        Signal::bits("MinCode", 0, 16),
        Signal::bits("MaxCode", 16, 16),
        Signal::measured("TipLength", 32, 16, LENGTH, [0.0, 6.4]),
        Signal::measured("TipOffsetSin", 48, 16, UNIT, [-1.003, 1.003]),
    ],
};
