//! Commands, program registers and ranges of the ADS8688 (data sheet SBAS582C, Tables 6 and 11 to 15).

/// A channel, 0 to 7; no other value exists, so that no command can name a ninth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Channel(u8);

impl Channel {
    /// All, in the order of a scan.
    pub const ALL: [Self; 8] = [Self(0), Self(1), Self(2), Self(3), Self(4), Self(5), Self(6), Self(7)];

    /// Its number.
    pub const fn number(self) -> u8 {
        self.0
    }
}

/// What of the command register the driver uses (Table 6); executed when chip select rises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Command {
    /// NO_OP: goes on in the chosen mode.
    Continue,
    /// RST: program registers to their defaults.
    Reset,
    /// AUTO_RST: the sequence of enabled channels from its first.
    Sequence,
    /// MAN_Ch_n: one channel.
    Manual(Channel),
}

impl Command {
    /// The first two bytes of its frame.
    pub(super) const fn bytes(self) -> [u8; 2] {
        match self {
            Self::Continue => [0x00, 0x00],
            Self::Reset => [0x85, 0x00],
            Self::Sequence => [0xa0, 0x00],
            Self::Manual(channel) => [0xc0 + 4 * channel.number(), 0x00],
        }
    }
}

/// Addresses of the program registers (Table 11).
pub(super) mod address {
    /// Channels of the automatic sequence, a bit each.
    pub(in crate::board::ads8688) const AUTO_SEQ_EN: u8 = 0x01;
    /// Channels without power, a bit each.
    pub(in crate::board::ads8688) const POWER_DOWN: u8 = 0x02;
    /// Device number and format of SDO (Tables 12 and 13).
    pub(in crate::board::ads8688) const FEATURE_SELECT: u8 = 0x03;
    /// Range of channel 0; the other seven follow.
    pub(in crate::board::ads8688) const RANGE_0: u8 = 0x05;
}

/// The device number a chip puts under every result. 0 is a reset chip's or a line stuck low, 3 a line stuck high.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Device {
    /// The first chip.
    One = 1,
    /// The second chip.
    Two = 2,
}

impl Device {
    /// Its number.
    pub const fn number(self) -> u8 {
        self as u8
    }

    /// Content of the feature register: this number, and results followed by channel, device and range (format 011).
    pub(super) const fn feature_select(self) -> u8 {
        self.number() << 6 | 0b011
    }
}

/// A channel's input range (Table 15); Vref is 4.096 V. Results are straight binary over the range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// ±2.5 · Vref = ±10.24 V, the default after a reset.
    PlusMinus10V24 = 0b000,
    /// ±1.25 · Vref = ±5.12 V.
    PlusMinus5V12 = 0b001,
    /// ±0.625 · Vref = ±2.56 V.
    PlusMinus2V56 = 0b010,
    /// 0 to 2.5 · Vref = 10.24 V.
    To10V24 = 0b101,
    /// 0 to 1.25 · Vref = 5.12 V.
    To5V12 = 0b110,
}

impl Range {
    /// Content of the range register.
    pub const fn code(self) -> u8 {
        self as u8
    }
}
