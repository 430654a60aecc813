//! Driver of the TI ADS8688, 8 channels of 16 bit, over embedded-hal's `SpiDevice` (SPI mode 1, at most 17 MHz).
//!
//! A frame's result is of the channel chosen by the frame before (data sheet SBAS582C, "Data Acquisition Example"). The driver
//! asks the chip to put channel, device and range under every result (SDO format 011, Table 13), so that a chip that was reset,
//! lost a range or answers for its neighbour shows in the very scan, not at the next look at its registers.
//!
//! [`Ads8688::scan`] is always the same ten frames, [`SCAN_BYTES`] bytes:
//!
//! ```text
//! read of one program register | AUTO_RST | NO_OP → channel 0 | NO_OP → channel 1 | … | NO_OP → channel 7
//! ```
//! What it cannot see: a flipped bit of a result itself. Results are for the sensing stage to doubt.

mod frame;
mod registers;

use core::fmt;

use embedded_hal::spi::{Error, ErrorKind, SpiDevice};

use frame::{CONVERSION_BYTES, REGISTER_BYTES};
use registers::Command;
use registers::address::{AUTO_SEQ_EN, FEATURE_SELECT, POWER_DOWN, RANGE_0};
pub use registers::{Channel, Device, Range};

/// One scan's results, channel by channel.
pub type Codes = [u16; 8];

/// Bytes a scan moves in each direction, whatever it finds.
pub const SCAN_BYTES: usize = REGISTER_BYTES + 9 * CONVERSION_BYTES;

/// Scans after which every configured register has been read back.
pub const CHECK_SCANS: usize = 11;

/// What is wrong with a chip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdcError {
    /// The bus itself failed.
    Bus(ErrorKind),
    /// The line never moved: no chip, no supply, or a short.
    NoAnswer,
    /// Bits where the chip sends none: disturbed lines.
    Garbled {
        /// The channel of the frame.
        channel: u8,
    },
    /// The result is of another device; of device 0 after a reset.
    WrongDevice {
        /// The device number configured.
        expected: u8,
        /// The one under the result.
        found: u8,
    },
    /// The result is of another channel: the sequence slipped.
    WrongChannel {
        /// The channel whose turn it was.
        expected: u8,
        /// The one under the result.
        found: u8,
    },
    /// A channel converts in a range that was not configured.
    WrongRange {
        /// The channel.
        channel: u8,
    },
    /// A program register does not hold what was written.
    Configuration {
        /// Its address.
        register: u8,
        /// What was written.
        wrote: u8,
        /// What it holds.
        read: u8,
    },
}

impl fmt::Display for AdcError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(kind) => write!(f, "SPI: {kind}"),
            Self::NoAnswer => f.write_str("no answer"),
            Self::Garbled { channel } => write!(f, "garbled answer for channel {channel}"),
            Self::WrongDevice { expected, found: 0 } => write!(f, "device {expected} was reset"),
            Self::WrongDevice { expected, found } => write!(f, "device {found} answers for device {expected}"),
            Self::WrongChannel { expected, found } => write!(f, "channel {found} in channel {expected}'s turn"),
            Self::WrongRange { channel } => write!(f, "channel {channel} converts in a wrong range"),
            Self::Configuration { register, wrote, read } => {
                write!(f, "register {register:#04x} holds {read:#04x} instead of {wrote:#04x}")
            }
        }
    }
}

impl core::error::Error for AdcError {}

/// A chip on its bus.
#[derive(Clone, Debug)]
pub struct Ads8688<SPI> {
    spi: SPI,
    device: Device,
    ranges: [Range; 8],
    /// Which entry of the configuration the next scan reads back.
    next_check: usize,
}

impl<SPI: SpiDevice> Ads8688<SPI> {
    /// A chip that has yet to be configured.
    pub const fn new(spi: SPI, device: Device, ranges: [Range; 8]) -> Self {
        Self { spi, device, ranges, next_check: 0 }
    }

    /// The bus, for a board that must reach it (a simulated one sets its volts there).
    pub fn bus(&mut self) -> &mut SPI {
        &mut self.spi
    }

    /// Resets the chip and writes its configuration; each register is checked twice, by its echo and by reading it back.
    ///
    /// # Errors
    /// [`AdcError::Bus`], [`AdcError::NoAnswer`], [`AdcError::Configuration`].
    pub fn configure(&mut self) -> Result<(), AdcError> {
        self.transfer(&frame::conversion(Command::Reset))?;
        self.next_check = 0;
        let configuration = self.configuration();
        let mut answers = [[[0; REGISTER_BYTES]; 2]; CHECK_SCANS];
        for (answer, (register, wrote)) in answers.iter_mut().zip(configuration) {
            *answer = [self.transfer(&frame::write(register, wrote))?, self.transfer(&frame::read(register))?];
        }
        if frame::is_stuck(answers.iter().flatten().flatten()) {
            return Err(AdcError::NoAnswer);
        }
        for (answer, written) in answers.iter().zip(configuration) {
            for answer in answer {
                check(answer, written)?;
            }
        }
        Ok(())
    }

    /// All eight channels, and a look at one register. After [`CHECK_SCANS`] scans every register has been looked at.
    ///
    /// # Errors
    /// What is wrong, the most telling first: bus, no answer, a result that is not what it must be, a register's content.
    pub fn scan(&mut self) -> Result<Codes, AdcError> {
        let configuration = self.configuration();
        let checked = configuration.get(self.next_check).copied().unwrap_or((AUTO_SEQ_EN, 0xff));
        self.next_check = (self.next_check + 1) % CHECK_SCANS;
        let register = self.transfer(&frame::read(checked.0))?;
        // The sequence starts anew in every scan: it cannot slip for longer than one. This frame's result is of nothing.
        self.transfer(&frame::conversion(Command::Sequence))?;
        let mut answers = [[0; CONVERSION_BYTES]; 8];
        for answer in &mut answers {
            *answer = self.transfer(&frame::conversion(Command::Continue))?;
        }
        if frame::is_stuck(register.iter().chain(answers.iter().flatten())) {
            return Err(AdcError::NoAnswer);
        }
        let codes = frame::results(&answers, self.device, &self.ranges)?;
        check(&register, checked)?;
        Ok(codes)
    }

    /// One channel by itself, for commissioning: it is chosen in one frame and converted in the next.
    ///
    /// # Errors
    /// As [`Ads8688::scan`], but for the register.
    pub fn convert(&mut self, channel: Channel) -> Result<u16, AdcError> {
        self.transfer(&frame::conversion(Command::Manual(channel)))?;
        let answer = self.transfer(&frame::conversion(Command::Continue))?;
        if frame::is_stuck(answer.iter()) {
            return Err(AdcError::NoAnswer);
        }
        let range = self.ranges.get(usize::from(channel.number())).copied();
        frame::result(&answer, self.device, channel, range.unwrap_or(Range::PlusMinus10V24))
    }

    /// Every register that is not left at its default's mercy, with its content: the order of the checks.
    fn configuration(&self) -> [(u8, u8); CHECK_SCANS] {
        let [a, b, c, d, e, f, g, h] = self.ranges.map(Range::code);
        [
            (FEATURE_SELECT, self.device.feature_select()),
            (AUTO_SEQ_EN, 0xff),
            (POWER_DOWN, 0x00),
            (RANGE_0, a),
            (RANGE_0 + 1, b),
            (RANGE_0 + 2, c),
            (RANGE_0 + 3, d),
            (RANGE_0 + 4, e),
            (RANGE_0 + 5, f),
            (RANGE_0 + 6, g),
            (RANGE_0 + 7, h),
        ]
    }

    /// One frame.
    fn transfer<const N: usize>(&mut self, out: &[u8; N]) -> Result<[u8; N], AdcError> {
        let mut answer = [0; N];
        self.spi.transfer(&mut answer, out).map_err(|error| AdcError::Bus(error.kind()))?;
        Ok(answer)
    }
}

/// A register's frame as it must be: SDO low for 16 clocks, then the content.
fn check(answer: &[u8; REGISTER_BYTES], (register, wrote): (u8, u8)) -> Result<(), AdcError> {
    let &[high, low, read] = answer;
    if high == 0 && low == 0 && read == wrote { Ok(()) } else { Err(AdcError::Configuration { register, wrote, read }) }
}
