//! Telemetry. While the pose is invalid its signals carry their error codes, never an old pose.

use crate::can::message::{Header, Message, Rate, Sender};
use crate::can::protect::{COUNTER, CRC};
use crate::can::receive::Validity;
use crate::can::signal::{Scale, Signal, Word, states, words};
use crate::fault::{Fault, State};

pub(super) const fn telemetry(name: &'static str, pgn: u32, every: [u16; 2], about: &'static str) -> Header {
    let [ms, phase_ms] = every;
    let rate = Rate::Every { ms, phase_ms };
    Header {
        name: words(name),
        about: words(about),
        pgn,
        priority: 6,
        sender: Sender::Controller,
        rate,
        bytes: 8,
        protected: false,
    }
}

/// The supervisor's states by their codes.
pub const STATES: [(u32, Word); State::ALL.len()] = {
    let mut named = [(0, words("")); State::ALL.len()];
    let mut i = 0;
    while i < named.len() {
        let state = State::ALL[i];
        named[i] = (state.code() as u32, words(state.name()));
        i += 1;
    }
    named
};

const CUT_OFF: [(u32, Word); 2] = states([(0, "open"), (1, "closed")]);
const POSE: [(u32, Word); 2] = states([(0, "invalid"), (1, "valid")]);

const FAULT_COUNT: usize = Fault::ALL.len() + 1;

/// The faults by their codes, 0 for none.
pub const FAULTS: [(u32, Word); FAULT_COUNT] = {
    let mut named = [(0, words("none")); FAULT_COUNT];
    let mut i = 1;
    while i < FAULT_COUNT {
        let fault = Fault::ALL[i - 1];
        named[i] = (fault.code() as u32, words(fault.name()));
        i += 1;
    }
    named
};

/// The state, protected: a display must not show an old one.
pub static STATE: Message<7> = Message {
    header: Header {
        protected: true,
        priority: 4,
        ..telemetry("ControllerState", 65296, [20, 0], "Supervisor, cut-off and ticks.")
    },
    signals: [
        Signal::states("State", 0, 4, &STATES),
        Signal::states("CutOff", 4, 2, &CUT_OFF),
        Signal::states("Pose", 6, 2, &POSE),
        Signal::states("LatchedFault", 8, 8, &FAULTS),
        Signal::bits("Tick", 16, 32),
        COUNTER,
        CRC,
    ],
};

const LENGTH: Scale = Scale { factor: 0.0001, offset: 0.0, unit: words("m") };

/// Measured cylinder lengths.
pub static LENGTHS: Message<3> = Message {
    header: telemetry("CylinderLengths", 65297, [10, 1], "Measured lengths, pin to pin."),
    signals: [
        Signal::measured("Boom", 0, 16, LENGTH, [0.0, 6.4]),
        Signal::measured("Arm", 16, 16, LENGTH, [0.0, 6.4]),
        Signal::measured("Bucket", 32, 16, LENGTH, [0.0, 6.4]),
    ],
};

const POSITION: Scale = Scale { factor: 0.001, offset: -32.0, unit: words("m") };

/// The bucket tip.
pub static TIP: Message<3> = Message {
    header: telemetry("TipPosition", 65298, [20, 2], "Bucket tip in the base frame: x forward, y left, z up."),
    signals: [
        Signal::measured("X", 0, 16, POSITION, [-32.0, 32.0]),
        Signal::measured("Y", 16, 16, POSITION, [-32.0, 32.0]),
        Signal::measured("Z", 32, 16, POSITION, [-32.0, 32.0]),
    ],
};

/// Cosine or sine; some room beyond ±1 for rounding.
const UNIT: Scale = Scale { factor: 0.00003125, offset: -1.004, unit: words("") };

const fn rotor(cosine: &'static str, sine: &'static str, start: u8) -> [Signal; 2] {
    [
        Signal::measured(cosine, start, 16, UNIT, [-1.003, 1.003]),
        Signal::measured(sine, start + 16, 16, UNIT, [-1.003, 1.003]),
    ]
}

const fn rotors(first: [&'static str; 2], second: [&'static str; 2]) -> [Signal; 4] {
    let [a, b] = rotor(first[0], first[1], 0);
    let [c, d] = rotor(second[0], second[1], 32);
    [a, b, c, d]
}

/// Swing angle and bucket pitch.
pub static SWING_AND_PITCH: Message<4> = Message {
    header: telemetry(
        "SwingAndPitch",
        65299,
        [20, 3],
        "Swing angle and bucket pitch (boom + arm + bucket angle) as cosine and sine; angle = atan2(sine, cosine).",
    ),
    signals: rotors(["SwingCos", "SwingSin"], ["PitchCos", "PitchSin"]),
};

/// Joint angles of boom and arm.
pub static BOOM_AND_ARM: Message<4> = Message {
    header: telemetry(
        "BoomAndArm",
        65300,
        [20, 4],
        "Boom angle above the horizontal, arm angle relative to the boom, as cosine and sine.",
    ),
    signals: rotors(["BoomCos", "BoomSin"], ["ArmCos", "ArmSin"]),
};

const CURRENT: Scale = Scale { factor: 0.0001, offset: 0.0, unit: words("A") };

const fn currents(names: [&'static str; 4]) -> [Signal; 4] {
    let [a, b, c, d] = names;
    let range = [0.0, 6.4];
    [
        Signal::measured(a, 0, 16, CURRENT, range),
        Signal::measured(b, 16, 16, CURRENT, range),
        Signal::measured(c, 32, 16, CURRENT, range),
        Signal::measured(d, 48, 16, CURRENT, range),
    ]
}

/// Coil currents.
pub static SWING_AND_BOOM_CURRENTS: Message<4> = Message {
    header: telemetry("SwingAndBoomCurrents", 65301, [20, 5], "Commanded coil currents of swing and boom."),
    signals: currents(["SwingExtend", "SwingRetract", "BoomExtend", "BoomRetract"]),
};

/// Coil currents.
pub static ARM_AND_BUCKET_CURRENTS: Message<4> = Message {
    header: telemetry("ArmAndBucketCurrents", 65302, [20, 6], "Commanded coil currents of arm and bucket."),
    signals: currents(["ArmExtend", "ArmRetract", "BucketExtend", "BucketRetract"]),
};

const fn reception(name: &'static str, start: u8) -> Signal {
    Signal::states(name, start, 4, &Validity::NAMES)
}

/// What the controller thinks of each received message.
pub static RECEPTION: Message<11> = Message {
    header: telemetry("Reception", 65303, [100, 7], "Validity of each received message."),
    signals: [
        reception("SwingCommand", 0),
        reception("BoomCommand", 4),
        reception("ArmCommand", 8),
        reception("BucketCommand", 12),
        reception("TipVelocity", 16),
        reception("ModeCommand", 20),
        reception("SlopeSensor2", 24),
        reception("BoomPressures", 28),
        reception("ArmPressures", 32),
        reception("BucketPressures", 36),
        reception("ServiceCommand", 40),
    ],
};
