//! Program registers (Table 11) and what they do to a conversion.

/// Reference, V.
const VREF: f32 = 4.096;

/// The volts of codes 0 and 65536 of a range (Table 15 and Table 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Volts at code 0.
    pub low_v: f32,
    /// Volts from code 0 to 65536.
    pub width_v: f32,
}

impl Span {
    const AUX: Self = Self { low_v: 0.0, width_v: VREF };

    /// Of a range register's content; codes the data sheet does not list act as the default.
    pub const fn of(range: u8) -> Self {
        let (low, width) = match range & 7 {
            0b001 => (-1.25, 2.5),
            0b010 => (-0.625, 1.25),
            0b101 => (0.0, 2.5),
            0b110 => (0.0, 1.25),
            _ => (-2.5, 5.0),
        };
        Self { low_v: low * VREF, width_v: width * VREF }
    }

    /// The code of a voltage: straight binary, saturating at both ends.
    pub fn code(&self, volts: f32) -> u16 {
        // The cast saturates.
        ((volts - self.low_v) / self.width_v * 65536.0 + 0.5) as u16
    }

    /// The voltage that reads as `code`.
    pub fn volts(&self, code: u16) -> f32 {
        self.low_v + f32::from(code) * (self.width_v / 65536.0)
    }
}

const AUTO_SEQ_EN: usize = 0x01;
const POWER_DOWN: usize = 0x02;
const FEATURE: usize = 0x03;
const FIRST_RANGE: usize = 0x05;
const LAST_RANGE: usize = 0x0c;

/// 01h to 0Ch. The ADS8688 has no alarms; their registers are the ADS8688A's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Registers {
    content: [u8; LAST_RANGE + 1],
}

/// After power-up or RST: all channels enabled and powered, device 0, bare results, ±2.5 · Vref everywhere.
pub(super) const fn default_registers() -> Registers {
    let mut content = [0; LAST_RANGE + 1];
    content[AUTO_SEQ_EN] = 0xff;
    Registers { content }
}

impl Registers {
    fn get(&self, address: usize) -> u8 {
        self.content.get(address).copied().unwrap_or(0)
    }

    /// Whether the data sheet lists this address.
    pub(super) fn is_listed(&self, address: u8) -> bool {
        matches!(address, 0x01..=0x03 | 0x05..=0x0c | 0x3f)
    }

    pub(super) fn read(&self, address: u8) -> u8 {
        if self.is_listed(address) { self.get(usize::from(address)) } else { 0 }
    }

    /// False for an address that cannot be written. Bits that must be 0 stay 0.
    pub(super) fn write(&mut self, address: u8, data: u8) -> bool {
        let mask = match address {
            0x01 | 0x02 => 0xff,
            0x03 => 0b1100_0111,
            0x05..=0x0c => 0b0111,
            _ => return false,
        };
        self.content.get_mut(usize::from(address)).map(|register| *register = data & mask).is_some()
    }

    pub(super) fn set_range(&mut self, channel: u8, code: u8) {
        if channel < 8 {
            self.write(channel + FIRST_RANGE as u8, code);
        }
    }

    fn enabled(&self, channel: u8) -> bool {
        self.get(AUTO_SEQ_EN) & (1 << channel) != 0
    }

    /// Where a sequence begins.
    pub(super) fn first_channel(&self) -> u8 {
        (0..8).find(|&channel| self.enabled(channel)).unwrap_or(0)
    }

    /// Where it goes on, back to the first after the last.
    pub(super) fn channel_after(&self, channel: u8) -> u8 {
        (channel + 1..8).find(|&next| self.enabled(next)).unwrap_or(self.first_channel())
    }

    /// The 25 bits of a conversion (Table 13): result, channel, device, range, as many of them as the format asks for.
    pub(super) fn conversion(&self, channel: u8, volts: f32) -> u32 {
        let range = if channel < 8 { self.get(FIRST_RANGE + usize::from(channel)) } else { 0 };
        let span = if channel < 8 { Span::of(range) } else { Span::AUX };
        let powered = channel >= 8 || self.get(POWER_DOWN) & (1 << channel) == 0;
        let code = if powered { span.code(volts) } else { 0 };
        let feature = self.get(FEATURE);
        let all = u32::from(code) << 9 | u32::from(channel) << 5 | u32::from(feature >> 6) << 3 | u32::from(range & 7);
        let sent = match feature & 7 {
            0b001 => !0x1f,
            0b010 => !0x07,
            0b011 => !0,
            _ => !0x1ff,
        };
        all & sent
    }
}
