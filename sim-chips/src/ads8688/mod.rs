//! TI ADS8688, simulated at the bytes of its SPI (data sheet SBAS582C; ADS8688W SBASBC4 for the same tables on line).
//!
//! - Chip select falling samples the channel that the *previous* frame chose; the result leaves SDO from the 16th clock on.
//! - Chip select rising executes the frame's command; fewer than 16 clocks are an aborted frame and change nothing.
//! - Power-up and `RST` leave every program register at its default and no mode: nothing converts before `AUTO_RST` or `MAN_Ch_n`.
//! - A frame that reads or writes a program register ends the mode. The data sheet does not promise that a sequence goes on after
//!   it, so this chip never lets a driver count on it.

mod frame;
mod registers;

use embedded_hal::spi::{Error, ErrorKind, ErrorType, Operation, SpiDevice};

use frame::Frame;
pub use registers::Span;
use registers::{Registers, default_registers};

/// What is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Break {
    /// SDO stays low: shorted, or the chip has no supply and the line a pull-down.
    StuckLow,
    /// SDO stays high: nobody drives it against the pull-up.
    StuckHigh,
    /// The bits on SDO are random.
    Noisy,
    /// The multiplexer stays at this channel.
    StuckChannel(u8),
    /// A range register lost its content: channel and the code it now holds.
    WrongRange(u8, u8),
    /// The bus itself reports an error.
    Bus,
}

/// The bus of a chip broken by [`Break::Bus`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BusFault;

impl Error for BusFault {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Other
    }
}

/// What the next frame will convert.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    /// Nothing: waiting for a command, in standby or powered down.
    Idle,
    /// Enabled channels in ascending order; this one next.
    Auto(u8),
    /// The same channel over and over; 8 is the auxiliary input.
    Manual(u8),
}

/// The chip with what its pins are connected to.
#[derive(Clone, Debug)]
pub struct Ads8688 {
    registers: Registers,
    mode: Mode,
    /// High byte of the command executed in the previous frame.
    last_command: u8,
    /// Volts at the eight inputs and the auxiliary one.
    volts: [f32; 9],
    broken: Option<Break>,
    noise: u32,
    not_understood: u32,
}

impl Default for Ads8688 {
    fn default() -> Self {
        Self::new()
    }
}

impl Ads8688 {
    /// Just powered up, all inputs at 0 V.
    pub const fn new() -> Self {
        Self {
            registers: default_registers(),
            mode: Mode::Idle,
            last_command: 0,
            volts: [0.0; 9],
            broken: None,
            noise: 0x2545_f491,
            not_understood: 0,
        }
    }

    /// Puts a voltage on an input (8: the auxiliary one); false when there is no such input.
    pub fn set_volts(&mut self, channel: u8, volts: f32) -> bool {
        self.volts.get_mut(usize::from(channel)).map(|input| *input = volts).is_some()
    }

    /// Breaks it, or repairs it with `None`; a repaired chip keeps its registers.
    pub fn set_broken(&mut self, broken: Option<Break>) {
        if let Some(Break::WrongRange(channel, code)) = broken {
            self.registers.set_range(channel, code);
        }
        self.broken = broken;
    }

    /// What a dip of its supply does: registers at their defaults, no mode.
    pub fn reset(&mut self) {
        self.registers = default_registers();
        self.mode = Mode::Idle;
        self.last_command = 0;
    }

    /// Frames that were neither a command nor an access to a register the data sheet lists: a correct driver sends none.
    pub fn not_understood(&self) -> u32 {
        self.not_understood
    }

    /// Chip select falls: the sample is taken.
    fn begin(&mut self) -> Frame {
        let channel = match (self.mode, self.broken) {
            (Mode::Idle, _) => return Frame::without_conversion(),
            (_, Some(Break::StuckChannel(channel))) => channel,
            (Mode::Auto(channel) | Mode::Manual(channel), _) => channel,
        };
        let volts = self.volts.get(usize::from(channel)).copied().unwrap_or(0.0);
        Frame::with_conversion(self.registers.conversion(channel, volts))
    }

    /// Eight clocks.
    fn clock(&mut self, frame: &mut Frame, sdi: u8) -> u8 {
        let sdo = frame.clock(sdi, &self.registers, self.last_command);
        match self.broken {
            Some(Break::StuckLow) => 0x00,
            Some(Break::StuckHigh) => 0xff,
            Some(Break::Noisy) => {
                // Xorshift: the same noise in every run.
                self.noise ^= self.noise << 13;
                self.noise ^= self.noise >> 17;
                self.noise ^= self.noise << 5;
                self.noise.to_le_bytes()[0]
            }
            _ => sdo,
        }
    }

    /// Chip select rises: the command is executed.
    fn end(&mut self, frame: &Frame) {
        // A converted channel of a sequence is done, whatever comes next.
        if let Mode::Auto(channel) = self.mode {
            self.mode = Mode::Auto(self.registers.channel_after(channel));
        }
        let Some([high, low]) = frame.command() else { return };
        match [high, low] {
            [0x00, 0x00] => {}
            // STDBY and PWR_DN keep the registers.
            [0x82 | 0x83, 0x00] => self.mode = Mode::Idle,
            [0x85, 0x00] => {
                self.registers = default_registers();
                self.mode = Mode::Idle;
            }
            [0xa0, 0x00] => self.mode = Mode::Auto(self.registers.first_channel()),
            [high @ (0xc0 | 0xc4 | 0xc8 | 0xcc | 0xd0 | 0xd4 | 0xd8 | 0xdc | 0xe0), 0x00] => {
                self.mode = Mode::Manual((high - 0xc0) / 4);
            }
            [high, data] if high < 0x80 => {
                let accepted = match (high & 1 != 0, frame.bytes()) {
                    (true, 3..) => self.registers.write(high >> 1, data),
                    // The write lacks the clocks of its echo.
                    (true, _) => false,
                    (false, _) => self.registers.is_listed(high >> 1),
                };
                self.not_understood += u32::from(!accepted);
                self.mode = Mode::Idle;
            }
            _ => self.not_understood += 1,
        }
        self.last_command = high;
    }
}

impl ErrorType for Ads8688 {
    type Error = BusFault;
}

impl SpiDevice for Ads8688 {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), BusFault> {
        if self.broken == Some(Break::Bus) {
            return Err(BusFault);
        }
        let mut frame = self.begin();
        for operation in operations {
            match operation {
                Operation::Read(read) => read.iter_mut().for_each(|byte| *byte = self.clock(&mut frame, 0)),
                Operation::Write(write) => write.iter().for_each(|&byte| _ = self.clock(&mut frame, byte)),
                Operation::TransferInPlace(bytes) => {
                    bytes.iter_mut().for_each(|byte| *byte = self.clock(&mut frame, *byte));
                }
                Operation::Transfer(read, write) => {
                    for at in 0..core::cmp::max(read.len(), write.len()) {
                        let sdo = self.clock(&mut frame, write.get(at).copied().unwrap_or(0));
                        if let Some(byte) = read.get_mut(at) {
                            *byte = sdo;
                        }
                    }
                }
                Operation::DelayNs(_) => {}
            }
        }
        self.end(&frame);
        Ok(())
    }
}
