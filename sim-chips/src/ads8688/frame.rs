//! One frame, from chip select's falling to its rising edge.

use super::registers::Registers;

/// Clocks so far, and what leaves SDO.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    bytes: usize,
    command: [u8; 2],
    /// The 25 bits from the 16th clock on (Table 13), at the top of the word.
    stream: u32,
}

impl Frame {
    pub(super) fn without_conversion() -> Self {
        Self::with_conversion(0)
    }

    /// A frame that sends these 25 bits.
    pub(super) fn with_conversion(bits: u32) -> Self {
        Self { bytes: 0, command: [0; 2], stream: bits << 7 }
    }

    /// Eight clocks: SDO is low for the first sixteen, while the command comes in.
    pub(super) fn clock(&mut self, sdi: u8, registers: &Registers, last_command: u8) -> u8 {
        let at = self.bytes;
        self.bytes += 1;
        if let Some(byte) = self.command.get_mut(at) {
            *byte = sdi;
            return 0;
        }
        if at == 2 {
            self.answer(registers, last_command);
        }
        let [sdo, ..] = self.stream.to_be_bytes();
        self.stream <<= 8;
        sdo
    }

    /// After sixteen clocks the chip knows whether a register was meant: its content or the written data replaces the result.
    fn answer(&mut self, registers: &Registers, last_command: u8) {
        let [high, data] = self.command;
        if high == 0 || high >= 0x80 {
            return;
        }
        let byte = match (high >> 1, high & 1 != 0) {
            (_, true) => data,
            (0x3f, false) => last_command,
            (address, false) => registers.read(address),
        };
        self.stream = u32::from(byte) << 24;
    }

    /// The command, when at least sixteen clocks came.
    pub(super) fn command(&self) -> Option<[u8; 2]> {
        (self.bytes >= 2).then_some(self.command)
    }

    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }
}
