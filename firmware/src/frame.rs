//! [`Inputs`] and [`Outputs`] as bytes, little-endian, fixed size: for the link to the harness and for the output hash.

use crate::fault::{Fault, State};
use crate::io::{Inputs, Outputs, Request, Speeds};
use kinematics_core::{Cylinders, Joints, PlaneTip, Pose, Rotor};

/// Bytes of [`Inputs`].
pub const INPUT_BYTES: usize = 21;
/// Bytes of [`Outputs`].
pub const OUTPUT_BYTES: usize = 4 + 1 + 1 + 1 + 12 + 4 * (2 + 6 + 4 + 2) + 4 + 12 + 16 + 4 + 16 + 32 + 16;

/// Why bytes are not a frame: the field, and what it held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameError {
    /// Name of the field.
    pub field: &'static str,
    /// The byte found there.
    pub value: u8,
}

impl core::fmt::Display for FrameError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "`{}` holds {}, which names nothing", self.field, self.value)
    }
}

impl core::error::Error for FrameError {}

/// Appends to a byte buffer of exactly the right size; a test fills it to the last byte.
struct Writer<'a> {
    rest: core::slice::IterMut<'a, u8>,
}

impl Writer<'_> {
    fn bytes<const N: usize>(&mut self, bytes: [u8; N]) {
        for byte in bytes {
            if let Some(slot) = self.rest.next() {
                *slot = byte;
            }
        }
    }

    fn float(&mut self, x: f32) {
        self.bytes(x.to_bits().to_le_bytes());
    }

    fn rotor(&mut self, r: Rotor<f32>) {
        self.float(r.cos);
        self.float(r.sin);
    }

    fn cylinders(&mut self, c: Cylinders<f32>) {
        self.float(c.boom);
        self.float(c.arm);
        self.float(c.bucket);
    }
}

/// Takes from a byte buffer; past its end it reads zeros, which the fixed sizes rule out.
struct Reader<'a> {
    rest: core::slice::Iter<'a, u8>,
}

impl Reader<'_> {
    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        [(); N].map(|()| self.rest.next().copied().unwrap_or(0))
    }

    fn byte(&mut self) -> u8 {
        let [byte] = self.bytes();
        byte
    }

    fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.bytes())
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.bytes())
    }

    fn float(&mut self) -> f32 {
        f32::from_bits(self.u32())
    }

    fn rotor(&mut self) -> Rotor<f32> {
        Rotor { cos: self.float(), sin: self.float() }
    }

    fn cylinders(&mut self) -> Cylinders<f32> {
        Cylinders { boom: self.float(), arm: self.float(), bucket: self.float() }
    }
}

impl Inputs {
    /// As bytes.
    pub fn to_bytes(&self) -> [u8; INPUT_BYTES] {
        let mut bytes = [0; INPUT_BYTES];
        let mut w = Writer { rest: bytes.iter_mut() };
        for code in self.codes {
            w.bytes(code.to_le_bytes());
        }
        w.bytes(self.supply_code.to_le_bytes());
        let request = match self.request {
            Request::Neutral => 0,
            Request::Dig => 1,
            Request::Levers => 2,
            Request::Reach => 3,
            Request::Move => 4,
        };
        let [sensors_sound, coils_sound] = self.converters_sound;
        let flags = [self.enable, self.emergency_stop, self.overrun, sensors_sound, coils_sound, self.cut_off_closed];
        let switches = flags.into_iter().rev().fold(0, |byte, flag| byte << 1 | u8::from(flag));
        w.bytes([self.command_counter, request, switches]);
        for lever in self.levers {
            w.bytes(lever.to_le_bytes());
        }
        bytes
    }

    /// From bytes.
    ///
    /// # Errors
    /// A request or switch byte that names nothing.
    pub fn from_bytes(bytes: &[u8; INPUT_BYTES]) -> Result<Self, FrameError> {
        let mut r = Reader { rest: bytes.iter() };
        let codes = [(); 4].map(|()| r.u16());
        let supply_code = r.u16();
        let command_counter = r.byte();
        let request = match r.byte() {
            0 => Request::Neutral,
            1 => Request::Dig,
            2 => Request::Levers,
            3 => Request::Reach,
            4 => Request::Move,
            value => return Err(FrameError { field: "request", value }),
        };
        let switches = r.byte();
        if switches > 63 {
            return Err(FrameError { field: "switches", value: switches });
        }
        Ok(Self {
            codes,
            supply_code,
            command_counter,
            request,
            levers: [(); 4].map(|()| i16::from_le_bytes(r.bytes())),
            enable: switches & 1 != 0,
            emergency_stop: switches & 2 != 0,
            overrun: switches & 4 != 0,
            converters_sound: [switches & 8 != 0, switches & 16 != 0],
            cut_off_closed: switches & 32 != 0,
        })
    }
}

impl Outputs {
    /// As bytes: the raw bits of every value.
    pub fn to_bytes(&self) -> [u8; OUTPUT_BYTES] {
        let mut bytes = [0; OUTPUT_BYTES];
        let mut w = Writer { rest: bytes.iter_mut() };
        w.bytes(self.tick.to_le_bytes());
        let flags = u8::from(self.cut_off_closed) | u8::from(self.pose_valid) << 1 | u8::from(self.late) << 2;
        w.bytes([self.state.code(), self.fault.map_or(0, Fault::code), flags]);
        w.cylinders(self.lengths);
        let pose = self.pose;
        for rotor in [pose.swing, pose.joints.boom, pose.joints.arm, pose.joints.bucket] {
            w.rotor(rotor);
        }
        for x in [pose.x, pose.y, pose.plane.reach, pose.plane.height] {
            w.float(x);
        }
        w.rotor(pose.plane.pitch);
        w.bytes(self.dig_tick.to_le_bytes());
        w.cylinders(self.reference);
        for speed in self.asked.to_array() {
            w.float(speed);
        }
        w.float(self.clearance_m);
        for speed in self.speeds.to_array() {
            w.float(speed);
        }
        for current in self.currents.into_iter().flatten() {
            w.float(current);
        }
        for duty in self.duties.into_iter().flatten() {
            w.bytes(duty.to_le_bytes());
        }
        bytes
    }

    /// From bytes.
    ///
    /// # Errors
    /// A state, fault or flag byte that names nothing.
    pub fn from_bytes(bytes: &[u8; OUTPUT_BYTES]) -> Result<Self, FrameError> {
        let mut r = Reader { rest: bytes.iter() };
        let tick = r.u32();
        let code = r.byte();
        let state = State::from_code(code).ok_or(FrameError { field: "state", value: code })?;
        let fault = match r.byte() {
            0 => None,
            value => Some(Fault::from_code(value).ok_or(FrameError { field: "fault", value })?),
        };
        let flags = r.byte();
        if flags > 7 {
            return Err(FrameError { field: "flags", value: flags });
        }
        let lengths = r.cylinders();
        let swing = r.rotor();
        let joints = Joints { boom: r.rotor(), arm: r.rotor(), bucket: r.rotor() };
        let (x, y) = (r.float(), r.float());
        let plane = PlaneTip { reach: r.float(), height: r.float(), pitch: r.rotor() };
        Ok(Self {
            tick,
            state,
            fault,
            cut_off_closed: flags & 1 != 0,
            pose_valid: flags & 2 != 0,
            late: flags & 4 != 0,
            lengths,
            pose: Pose { swing, joints, plane, x, y },
            dig_tick: r.u32(),
            reference: r.cylinders(),
            asked: Speeds::from_array([(); 4].map(|()| r.float())),
            clearance_m: r.float(),
            speeds: Speeds::from_array([(); 4].map(|()| r.float())),
            currents: [(); 4].map(|()| [r.float(), r.float()]),
            duties: [(); 4].map(|()| [r.u16(), r.u16()]),
        })
    }
}
