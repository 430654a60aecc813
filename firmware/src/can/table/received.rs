//! What the operator and the sensors send.

use crate::can::message::{Header, Message, Rate, Sender};
use crate::can::protect::{COUNTER, CRC};
use crate::can::signal::{Scale, Signal, Word, states, words};

/// Without a new message for so long a received value is stale, ms.
pub const TIMEOUT_MS: u16 = 100;

/// Period of the operator's and the pressure sensors' messages, ms.
pub const PERIOD_MS: u16 = 20;

const fn command(name: &'static str, pgn: u32, about: &'static str) -> Header {
    let rate = Rate::Every { ms: PERIOD_MS, phase_ms: 0 };
    Header {
        name: words(name),
        about: words(about),
        pgn,
        priority: 3,
        sender: Sender::Operator,
        rate,
        bytes: 8,
        protected: true,
    }
}

/// States of a valve command: the lower codes of ISO 11783-7's auxiliary valve command (SPN 1920 and its like).
pub const VALVE_STATES: [(u32, Word); 4] = states([(0, "blocked"), (1, "extend"), (2, "retract"), (3, "floating")]);

const PERCENT: Scale = Scale { factor: 0.4, offset: 0.0, unit: words("%") };

/// Bits as in ISO 11783-7's PGN 65073 and its like, whose reserved bytes 7 and 8 are used here: hence PGNs of our own.
const fn valve(name: &'static str, pgn: u32, about: &'static str) -> Message<4> {
    let flow = Signal::measured("Flow", 0, 8, PERCENT, [0.0, 100.0]);
    let state = Signal::states("State", 16, 4, &VALVE_STATES);
    Message { header: command(name, pgn, about), signals: [flow, state, COUNTER, CRC] }
}

/// Swing; extending turns it counter-clockwise seen from above.
pub static SWING_COMMAND: Message<4> =
    valve("SwingCommand", 65280, "Flow to the swing; extend turns counter-clockwise seen from above.");
/// Boom.
pub static BOOM_COMMAND: Message<4> = valve("BoomCommand", 65281, "Flow to the boom cylinder.");
/// Arm.
pub static ARM_COMMAND: Message<4> = valve("ArmCommand", 65282, "Flow to the arm cylinder.");
/// Bucket.
pub static BUCKET_COMMAND: Message<4> = valve("BucketCommand", 65283, "Flow to the bucket cylinder.");

const SPEED: Scale = Scale { factor: 0.001, offset: -32.0, unit: words("m/s") };
const TURN: Scale = Scale { factor: 0.001, offset: -32.0, unit: words("rad/s") };

/// Velocity of the bucket tip in the swing plane.
pub static TIP_VELOCITY: Message<5> = Message {
    header: command(
        "TipVelocity",
        65284,
        "Velocity of the bucket tip in the swing plane: x outward, z up, pitch rate counter-clockwise with x to the right.",
    ),
    signals: [
        Signal::measured("VelocityX", 0, 16, SPEED, [-3.0, 3.0]),
        Signal::measured("VelocityZ", 16, 16, SPEED, [-3.0, 3.0]),
        Signal::measured("PitchRate", 32, 16, TURN, [-2.0, 2.0]),
        COUNTER,
        CRC,
    ],
};

/// Names of the modes.
pub const MODES: [(u32, Word); 9] = states([
    (0, "neutral"),
    (1, "levers"),
    (2, "tip_velocity"),
    (3, "dig"),
    (4, "reach"),
    (5, "move"),
    (6, "hold"),
    (7, "grade"),
    (8, "path"),
]);

/// What the operator wants done.
pub static MODE: Message<3> = Message {
    header: command("ModeCommand", 65285, "What the operator wants done."),
    signals: [Signal::states("Mode", 0, 4, &MODES), COUNTER, CRC],
};

/// Names of the service tasks.
pub const TASKS: [(u32, Word); 8] = states([
    (0, "none"),
    (1, "mount_bucket"),
    (2, "valve_search"),
    (3, "end_stops"),
    (4, "touch"),
    (5, "measure_up"),
    (6, "jog"),
    (7, "keep"),
]);

/// Names of the spools.
pub const SPOOL_NAMES: [(u32, Word); 4] = states([(0, "swing"), (1, "boom"), (2, "arm"), (3, "bucket")]);

/// Signed current of a jog; extending positive.
const JOG_CURRENT: Scale = Scale { factor: 0.0001, offset: -3.0, unit: words("A") };

/// What the service tool wants done.
pub static SERVICE: Message<6> = Message {
    header: Header {
        sender: Sender::ServiceTool,
        ..command(
            "ServiceCommand",
            65286,
            "What the engineer's service tool wants done: mount a bucket, calibrate, jog, keep what was found (docs/calibration.md).",
        )
    },
    signals: [
        Signal::states("Task", 0, 4, &TASKS),
        Signal::states("Spool", 4, 4, &SPOOL_NAMES),
        Signal::bits("Number", 8, 8),
        Signal::measured("JogCurrent", 16, 16, JOG_CURRENT, [-3.0, 3.0]),
        COUNTER,
        CRC,
    ],
};

const SLOPE_ANGLE: Scale = Scale { factor: 1.0 / 32768.0, offset: -250.0, unit: words("deg") };
const COMPENSATION: [(u32, Word); 2] = states([(0, "on"), (1, "off")]);
/// Figure of merit; what its third state means to a receiver is what "error" says.
const MERIT: [(u32, Word); 2] = states([(0, "fully_functional"), (1, "degraded")]);

/// Chassis slope: J1939's own Slope Sensor Information 2, which has neither counter nor checksum.
pub static SLOPE: Message<7> = Message {
    header: Header {
        name: words("SlopeSensor2"),
        about: words(
            "Chassis roll and pitch: J1939-71 Slope Sensor Information 2 (SPN 4976 to 4982), signs of SAE J670: roll positive to the \
                right, pitch positive nose up.",
        ),
        pgn: 61481,
        priority: 3,
        sender: Sender::SlopeSensor,
        rate: Rate::Every { ms: 10, phase_ms: 0 },
        bytes: 8,
        protected: false,
    },
    signals: [
        Signal::measured("Pitch", 0, 24, SLOPE_ANGLE, [-90.0, 90.0]),
        Signal::measured("Roll", 24, 24, SLOPE_ANGLE, [-90.0, 90.0]),
        Signal::states("PitchCompensation", 48, 2, &COMPENSATION),
        Signal::states("PitchMerit", 50, 2, &MERIT),
        Signal::states("RollCompensation", 52, 2, &COMPENSATION),
        Signal::states("RollMerit", 54, 2, &MERIT),
        Signal::measured("Latency", 56, 8, Scale { factor: 0.5, offset: 0.0, unit: words("ms") }, [0.0, 125.0]),
    ],
};

/// Up to 600 bar.
const PRESSURE: Scale = Scale { factor: 1000.0, offset: 0.0, unit: words("Pa") };

const fn pressures(name: &'static str, pgn: u32, about: &'static str) -> Message<4> {
    let header = Header { sender: Sender::PressureSensors, ..command(name, pgn, about) };
    let head = Signal::measured("HeadSide", 0, 16, PRESSURE, [0.0, 60_000_000.0]);
    let rod = Signal::measured("RodSide", 16, 16, PRESSURE, [0.0, 60_000_000.0]);
    Message { header, signals: [head, rod, COUNTER, CRC] }
}

/// Boom cylinder.
pub static BOOM_PRESSURES: Message<4> =
    pressures("BoomPressures", 65288, "Pressures of the boom cylinder, above ambient.");
/// Arm cylinder.
pub static ARM_PRESSURES: Message<4> =
    pressures("ArmPressures", 65289, "Pressures of the arm cylinder, above ambient.");
/// Bucket cylinder.
pub static BUCKET_PRESSURES: Message<4> =
    pressures("BucketPressures", 65290, "Pressures of the bucket cylinder, above ambient.");
