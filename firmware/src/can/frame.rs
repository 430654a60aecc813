//! A CAN frame as J1939 uses it: a 29-bit identifier and up to eight data bytes.

use embedded_can::{ExtendedId, Frame, Id};

/// A data frame with an extended identifier. J1939 has no other: standard and remote frames do not become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CanFrame {
    id: ExtendedId,
    len: u8,
    data: [u8; 8],
}

impl CanFrame {
    /// All eight bytes, little-endian: byte 1 is the lowest.
    pub const fn of_payload(id: ExtendedId, payload: u64) -> Self {
        Self { id, len: 8, data: payload.to_le_bytes() }
    }

    /// From any HAL's frame; `None` for what J1939 does not use.
    pub fn of_frame(frame: &impl Frame) -> Option<Self> {
        if frame.is_remote_frame() { None } else { Self::new(frame.id(), frame.data()) }
    }

    /// The 29-bit identifier.
    pub const fn extended_id(&self) -> ExtendedId {
        self.id
    }

    /// The payload, byte 1 lowest; `None` unless all eight bytes are there.
    pub const fn payload(&self) -> Option<u64> {
        if self.len == 8 { Some(u64::from_le_bytes(self.data)) } else { None }
    }

    /// The first three bytes as a number, byte 1 lowest (a requested PGN); `None` when there are fewer.
    pub const fn first_three(&self) -> Option<u32> {
        let [a, b, c, ..] = self.data;
        if self.len >= 3 { Some(u32::from_le_bytes([a, b, c, 0])) } else { None }
    }
}

impl Frame for CanFrame {
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        let Id::Extended(id) = id.into() else { return None };
        let len = u8::try_from(data.len()).ok().filter(|&len| len <= 8)?;
        let mut frame = Self { id, len, data: [0; 8] };
        for (slot, &byte) in frame.data.iter_mut().zip(data) {
            *slot = byte;
        }
        Some(frame)
    }

    fn new_remote(_: impl Into<Id>, _: usize) -> Option<Self> {
        None
    }

    fn is_extended(&self) -> bool {
        true
    }

    fn is_remote_frame(&self) -> bool {
        false
    }

    fn id(&self) -> Id {
        Id::Extended(self.id)
    }

    fn dlc(&self) -> usize {
        self.len.into()
    }

    fn data(&self) -> &[u8] {
        self.data.get(..self.len.into()).unwrap_or(&self.data)
    }
}
