//! Frames of the ADS8688: what goes out, and what a correct answer looks like.

use super::registers::{Channel, Command, Device, Range};
use super::{AdcError, Codes};

/// Bytes of a conversion's frame: 16 clocks for the command, 25 bits of answer (Table 13), 7 clocks past the end.
pub(super) const CONVERSION_BYTES: usize = 6;
/// Bytes of a register's frame: address and data, and the register's content.
pub(super) const REGISTER_BYTES: usize = 3;

/// A frame that gives this command.
pub(super) fn conversion(command: Command) -> [u8; CONVERSION_BYTES] {
    let [high, low] = command.bytes();
    [high, low, 0, 0, 0, 0]
}

/// A frame that writes a program register.
pub(super) fn write(address: u8, data: u8) -> [u8; REGISTER_BYTES] {
    [address << 1 | 1, data, 0]
}

/// A frame that reads a program register.
pub(super) fn read(address: u8) -> [u8; REGISTER_BYTES] {
    [address << 1, 0, 0]
}

/// Whether every byte of an answer is the same all-low or all-high line.
pub(super) fn is_stuck<'a>(mut bytes: impl Iterator<Item = &'a u8> + Clone) -> bool {
    bytes.clone().all(|&byte| byte == 0x00) || bytes.all(|&byte| byte == 0xff)
}

/// The result in the answer of a frame, when everything around it is this channel's.
///
/// # Errors
/// [`AdcError::Garbled`], [`AdcError::WrongDevice`], [`AdcError::WrongChannel`], [`AdcError::WrongRange`], in this order.
pub(super) fn result(
    answer: &[u8; CONVERSION_BYTES],
    device: Device,
    channel: Channel,
    range: Range,
) -> Result<u16, AdcError> {
    let &[silent_high, silent_low, high, low, tag, last] = answer;
    let channel_number = channel.number();
    // SDO is low while the command goes out, and again after the 25th bit.
    if silent_high != 0 || silent_low != 0 || last & 0x7f != 0 {
        return Err(AdcError::Garbled { channel: channel_number });
    }
    let (found_channel, found_device, found_range) = (tag >> 4, tag >> 2 & 3, (tag & 3) << 1 | last >> 7);
    if found_device != device.number() {
        return Err(AdcError::WrongDevice { expected: device.number(), found: found_device });
    }
    if found_channel != channel_number {
        return Err(AdcError::WrongChannel { expected: channel_number, found: found_channel });
    }
    if found_range != range.code() {
        return Err(AdcError::WrongRange { channel: channel_number });
    }
    Ok(u16::from_be_bytes([high, low]))
}

/// The results of a scan's eight frames.
///
/// # Errors
/// The first frame's that is not as it must be.
pub(super) fn results(
    answers: &[[u8; CONVERSION_BYTES]; 8],
    device: Device,
    ranges: &[Range; 8],
) -> Result<Codes, AdcError> {
    let mut codes = [0; 8];
    for (((code, answer), channel), range) in codes.iter_mut().zip(answers).zip(Channel::ALL).zip(ranges) {
        *code = result(answer, device, channel, *range)?;
    }
    Ok(codes)
}
