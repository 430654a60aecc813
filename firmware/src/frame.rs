//! [`Outputs`] as bytes, little-endian, fixed size: for the link to the harness and for the output hash.

use crate::bytes::{Reader, Writer};
use crate::fault::{Fault, State};
use crate::io::{Outputs, Speeds};
use kinematics_core::{Joints, PlaneTip, Pose};

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

impl Outputs {
    /// As bytes: the raw bits of every value.
    pub fn to_bytes(&self) -> [u8; OUTPUT_BYTES] {
        let mut bytes = [0; OUTPUT_BYTES];
        let mut w = Writer::new(&mut bytes);
        w.bytes(self.tick.to_le_bytes());
        w.bytes([self.state.code(), self.fault.map_or(0, Fault::code)]);
        w.flags([self.cut_off_closed, self.pose_valid, self.late]);
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
        let mut r = Reader::new(bytes);
        let tick = r.u32();
        let code = r.byte();
        let state = State::from_code(code).ok_or(FrameError { field: "state", value: code })?;
        let fault = match r.byte() {
            0 => None,
            value => Some(Fault::from_code(value).ok_or(FrameError { field: "fault", value })?),
        };
        let [cut_off_closed, pose_valid, late] = r.flags().map_err(|value| FrameError { field: "flags", value })?;
        let lengths = r.cylinders();
        let swing = r.rotor();
        let joints = Joints { boom: r.rotor(), arm: r.rotor(), bucket: r.rotor() };
        let (x, y) = (r.float(), r.float());
        let plane = PlaneTip { reach: r.float(), height: r.float(), pitch: r.rotor() };
        Ok(Self {
            tick,
            state,
            fault,
            late,
            cut_off_closed,
            pose_valid,
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
