//! What is at the board's connectors, as values and as bytes.

use embedded_can::{ExtendedId, Frame};
use sim_chips::ads8688::Break;

use crate::bytes::{Reader, Writer};
use crate::can::CanFrame;
use crate::io::Solenoids;

/// Frames that can arrive in a tick.
pub const FRAMES_IN: usize = 4;
/// Frames that can leave in a tick.
pub const FRAMES_OUT: usize = 3;

/// Bytes of a frame: identifier, length, data.
const FRAME_BYTES: usize = 4 + 1 + 8;
/// Bytes of [`Wires`].
pub const WIRE_BYTES: usize = 2 * 8 * 4 + 2 + 1 + FRAMES_IN * FRAME_BYTES;
/// Bytes of [`Pins`].
pub const PIN_BYTES: usize = 8 * 2 + 1 + FRAMES_OUT * FRAME_BYTES;

/// A length that no frame has: there is none.
const NO_FRAME: u8 = 0xff;

/// What the machine puts to the board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wires {
    /// At the converters' channels, V; see [`crate::board::signals::SIGNALS`].
    pub volts: [[f32; 8]; 2],
    /// What is broken of each converter.
    pub converters: [Option<Break>; 2],
    /// The enable switch is on.
    pub enable: bool,
    /// The emergency-stop chain is closed.
    pub emergency_stop_released: bool,
    /// The master cut-off's own contact is closed.
    pub cut_off_closed: bool,
    /// The tick before did not end in its period.
    pub overrun: bool,
    /// CAN frames that have arrived, the oldest first.
    pub frames: [Option<CanFrame>; FRAMES_IN],
}

/// What the board does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pins {
    /// PWM duties, 65535 is always on, a spool each.
    pub duties: [Solenoids<u16>; 4],
    /// The master cut-off is told to close.
    pub cut_off_closed: bool,
    /// The watchdog was fed.
    pub watchdog_fed: bool,
    /// CAN frames to send.
    pub frames: [Option<CanFrame>; FRAMES_OUT],
}

/// Bytes that are no [`Wires`] or [`Pins`]: the field, and what it held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WireError {
    /// Name of the field.
    pub field: &'static str,
    /// The byte found there.
    pub value: u8,
}

impl core::fmt::Display for WireError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "`{}` holds {}, which means nothing", self.field, self.value)
    }
}

impl core::error::Error for WireError {}

impl Wires {
    /// As bytes.
    pub fn to_bytes(&self) -> [u8; WIRE_BYTES] {
        let mut bytes = [0; WIRE_BYTES];
        let mut w = Writer::new(&mut bytes);
        for &volts in self.volts.iter().flatten() {
            w.float(volts);
        }
        w.bytes(self.converters.map(break_code));
        w.flags([self.enable, self.emergency_stop_released, self.cut_off_closed, self.overrun]);
        self.frames.iter().for_each(|frame| write_frame(&mut w, frame.as_ref()));
        bytes
    }

    /// From bytes.
    ///
    /// # Errors
    /// A byte that means nothing.
    pub fn from_bytes(bytes: &[u8; WIRE_BYTES]) -> Result<Self, WireError> {
        let mut r = Reader::new(bytes);
        let volts = [(); 2].map(|()| [(); 8].map(|()| r.float()));
        let [first, second] = r.bytes();
        let converters = [break_of(first)?, break_of(second)?];
        let [enable, emergency_stop_released, cut_off_closed, overrun] =
            r.flags().map_err(|value| WireError { field: "switches", value })?;
        let mut frames = [None; FRAMES_IN];
        for frame in &mut frames {
            *frame = read_frame(&mut r)?;
        }
        Ok(Self { volts, converters, enable, emergency_stop_released, cut_off_closed, overrun, frames })
    }
}

impl Pins {
    /// As bytes.
    pub fn to_bytes(&self) -> [u8; PIN_BYTES] {
        let mut bytes = [0; PIN_BYTES];
        let mut w = Writer::new(&mut bytes);
        for duty in self.duties.iter().flatten() {
            w.bytes(duty.to_le_bytes());
        }
        w.flags([self.cut_off_closed, self.watchdog_fed]);
        self.frames.iter().for_each(|frame| write_frame(&mut w, frame.as_ref()));
        bytes
    }

    /// From bytes.
    ///
    /// # Errors
    /// A byte that means nothing.
    pub fn from_bytes(bytes: &[u8; PIN_BYTES]) -> Result<Self, WireError> {
        let mut r = Reader::new(bytes);
        let duties = [(); 4].map(|()| [r.u16(), r.u16()]);
        let [cut_off_closed, watchdog_fed] = r.flags().map_err(|value| WireError { field: "outputs", value })?;
        let mut frames = [None; FRAMES_OUT];
        for frame in &mut frames {
            *frame = read_frame(&mut r)?;
        }
        Ok(Self { duties, cut_off_closed, watchdog_fed, frames })
    }
}

fn write_frame(w: &mut Writer<'_>, frame: Option<&CanFrame>) {
    let mut data = [0; 8];
    if let Some(frame) = frame {
        data.iter_mut().zip(frame.data()).for_each(|(byte, &sent)| *byte = sent);
    }
    w.bytes(frame.map_or(0, |frame| frame.extended_id().as_raw()).to_le_bytes());
    w.bytes([frame.map_or(NO_FRAME, |frame| frame.data().len() as u8)]);
    w.bytes(data);
}

fn read_frame(r: &mut Reader<'_>) -> Result<Option<CanFrame>, WireError> {
    let (id, length, data) = (r.u32(), r.byte(), r.bytes::<8>());
    if length == NO_FRAME {
        return Ok(None);
    }
    let wrong = WireError { field: "frame", value: length };
    let data = data.get(..usize::from(length)).ok_or(wrong)?;
    let id = ExtendedId::new(id).ok_or(wrong)?;
    CanFrame::new(id, data).map(Some).ok_or(wrong)
}

const fn break_code(broken: Option<Break>) -> u8 {
    match broken {
        None => 0,
        Some(Break::StuckLow) => 1,
        Some(Break::StuckHigh) => 2,
        Some(Break::Noisy) => 3,
        Some(Break::Bus) => 4,
        Some(Break::StuckChannel(channel)) => 8 + (channel & 7),
        Some(Break::WrongRange(channel, code)) => 64 + (channel & 7) * 8 + (code & 7),
    }
}

fn break_of(value: u8) -> Result<Option<Break>, WireError> {
    Ok(match value {
        0 => None,
        1 => Some(Break::StuckLow),
        2 => Some(Break::StuckHigh),
        3 => Some(Break::Noisy),
        4 => Some(Break::Bus),
        8..16 => Some(Break::StuckChannel(value - 8)),
        64..128 => Some(Break::WrongRange(value >> 3 & 7, value & 7)),
        _ => return Err(WireError { field: "converter", value }),
    })
}
