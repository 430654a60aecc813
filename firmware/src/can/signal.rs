//! A signal's place in a payload and its meaning, as J1939-71 writes them: little-endian, linear, with codes that mean "error" and
//! "not available".

/// A word of the tables, for the pages and data bases that a host writes from them.
#[cfg(not(target_os = "none"))]
pub type Word = &'static str;

/// A word of the tables: an image for a board holds none of them.
#[cfg(target_os = "none")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Word;

/// The words of the tables.
#[cfg(not(target_os = "none"))]
pub(crate) const fn words(text: &'static str) -> Word {
    text
}

/// The words of the tables.
#[cfg(target_os = "none")]
pub(crate) const fn words(_: &'static str) -> Word {
    Word
}

/// A signal's states by their codes.
pub(crate) const fn states<const N: usize>(states: [(u32, &'static str); N]) -> [(u32, Word); N] {
    let mut named = [(0, words("")); N];
    let mut i = 0;
    while i < N {
        let (code, name) = states[i];
        named[i] = (code, words(name));
        i += 1;
    }
    named
}

/// What the codes of a signal mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A linear number of 8, 16 or 24 bits: codes to FAₕ… count, FEₕ… is an error, FFₕ… not available, others reserved.
    Measured,
    /// Named states; the highest code is "not available", the one below "error", other codes without a name reserved.
    States(&'static [(u32, Word)]),
    /// Every code counts.
    Bits,
}

/// From code to number: `value = factor · code + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Unit a code.
    pub factor: f32,
    /// Value of code 0.
    pub offset: f32,
    /// Unit, as in a DBC file.
    pub unit: Word,
}

/// One signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Signal {
    /// In CamelCase, unique in its message.
    pub name: Word,
    /// Lowest bit: 0 is the lowest of byte 1, 8 of byte 2.
    pub start: u8,
    /// Bits, at most 32.
    pub length: u8,
    /// Meaning of the codes.
    pub kind: Kind,
    /// Scale.
    pub scale: Scale,
    /// Lowest and highest value sent or accepted.
    pub range: [f32; 2],
}

/// Why a code is no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unusable {
    /// The sender has no such value.
    NotAvailable,
    /// The sender's source of it is faulty.
    Error,
    /// A reserved code, or a value outside the signal's range.
    OutOfRange,
}

const UNSCALED: Scale = Scale { factor: 1.0, offset: 0.0, unit: words("") };

impl Signal {
    /// A number.
    pub const fn measured(name: &'static str, start: u8, length: u8, scale: Scale, range: [f32; 2]) -> Self {
        assert!(length == 8 || length == 16 || length == 24, "a number has 8, 16 or 24 bits");
        Self { name: words(name), start, length, kind: Kind::Measured, scale, range }
    }

    /// Named states.
    pub const fn states(name: &'static str, start: u8, length: u8, states: &'static [(u32, Word)]) -> Self {
        let highest = ((1_u64 << length) - 1) as f32;
        Self { name: words(name), start, length, kind: Kind::States(states), scale: UNSCALED, range: [0.0, highest] }
    }

    /// Plain bits.
    pub const fn bits(name: &'static str, start: u8, length: u8) -> Self {
        let highest = ((1_u64 << length) - 1) as f32;
        Self { name: words(name), start, length, kind: Kind::Bits, scale: UNSCALED, range: [0.0, highest] }
    }

    /// The highest code.
    pub const fn not_available(&self) -> u32 {
        ((1_u64 << self.length) - 1) as u32
    }

    /// The code sent for a value that is at fault.
    pub const fn error(&self) -> u32 {
        match self.kind {
            Kind::Measured => 0xfe << (self.length - 8),
            Kind::States(_) | Kind::Bits => self.not_available() - 1,
        }
    }

    /// This signal's code in a payload.
    #[inline]
    pub const fn code_in(&self, payload: u64) -> u32 {
        (payload >> self.start) as u32 & self.not_available()
    }

    /// The payload with this signal's code; bits of the code that do not fit are dropped.
    #[inline]
    pub const fn put(&self, payload: u64, code: u32) -> u64 {
        let mask = self.not_available();
        payload & !((mask as u64) << self.start) | ((code & mask) as u64) << self.start
    }

    /// The nearest code to a value; a value outside the range, NaN included, becomes [`Signal::error`].
    pub fn code(&self, value: f32) -> u32 {
        let [low, high] = self.range;
        // Written so that NaN fails.
        if !(value >= low && value <= high) {
            return self.error();
        }
        let exact = (value - self.scale.offset) / self.scale.factor;
        let whole = exact as u32;
        // Adding 0.5 first would round twice above 2²³.
        if exact - whole as f32 >= 0.5 { whole + 1 } else { whole }
    }

    /// The value of a code.
    ///
    /// # Errors
    /// The code says that there is no value, or is reserved, or the value lies outside the range.
    pub fn value(&self, code: u32) -> Result<f32, Unusable> {
        match self.kind {
            Kind::Bits => return Ok(code as f32),
            Kind::States(states) => {
                return match code {
                    _ if code == self.not_available() => Err(Unusable::NotAvailable),
                    _ if code == self.error() => Err(Unusable::Error),
                    _ if states.iter().any(|&(state, _)| state == code) => Ok(code as f32),
                    _ => Err(Unusable::OutOfRange),
                };
            }
            Kind::Measured => {}
        }
        match code >> (self.length - 8) {
            0..=0xfa => {
                let value = code as f32 * self.scale.factor + self.scale.offset;
                let [low, high] = self.range;
                // The code nearest to an end belongs to the range, though rounding may put its value beyond.
                let near = 0.5 * self.scale.factor;
                if value >= low - near && value <= high + near { Ok(value) } else { Err(Unusable::OutOfRange) }
            }
            0xfe => Err(Unusable::Error),
            0xff => Err(Unusable::NotAvailable),
            _ => Err(Unusable::OutOfRange),
        }
    }
}
