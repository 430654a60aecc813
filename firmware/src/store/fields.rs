//! Values as the bytes of a record, field after field: the format that serde and postcard give the same structures, in a third of their
//! machine code. Tests hold the two together.
//!
//! Numbers are little-endian; a `u16` is 7 bits a byte, the lowest first, the highest bit set but in the last; an `Option` begins with 0 or
//! 1, an enum with its variant's number, written as a `u16` is.

/// Takes values from bytes. Past the end, and from bytes that are no value, it takes zeros and remembers that.
pub(super) struct Source<'a> {
    rest: &'a [u8],
    sound: bool,
}

/// Appends values to a buffer, and remembers when there is no more room.
pub(super) struct Sink<'a> {
    room: &'a mut [u8],
    used: usize,
    sound: bool,
}

/// What a record is made of.
pub(super) trait Field {
    /// Takes one.
    fn read(from: &mut Source) -> Self;

    /// Appends it.
    fn write(&self, to: &mut Sink);
}

impl<'a> Source<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, sound: true }
    }

    /// What is left; `None` when something taken was no value.
    pub(super) fn rest(&self) -> Option<&'a [u8]> {
        if self.sound { Some(self.rest) } else { None }
    }

    #[inline(never)]
    fn byte(&mut self) -> u8 {
        let Some((byte, rest)) = self.rest.split_first() else { return self.spoilt() };
        self.rest = rest;
        *byte
    }

    #[inline(never)]
    fn word(&mut self) -> u32 {
        let Some((bytes, rest)) = self.rest.split_first_chunk() else { return self.spoilt().into() };
        self.rest = rest;
        u32::from_le_bytes(*bytes)
    }

    /// A number of at most so many bits, seven a byte.
    #[inline(never)]
    fn sevens(&mut self, bits: u32) -> u32 {
        let (mut value, mut place) = (0, 0);
        while place < bits {
            let byte = u32::from(self.byte());
            // What the bits left have no room for is no number, nor is one that goes on after them.
            if (byte & 0x7f) >> core::cmp::min(bits - place, 7) != 0 {
                break;
            }
            value |= (byte & 0x7f) << place;
            if byte & 0x80 == 0 {
                return value;
            }
            place += 7;
        }
        self.spoilt().into()
    }

    /// An enum's variant, of those below `count`.
    pub(super) fn variant(&mut self, count: u32) -> u32 {
        let variant = self.sevens(u32::BITS);
        if variant < count { variant } else { self.spoilt().into() }
    }

    fn spoilt(&mut self) -> u8 {
        (self.rest, self.sound) = (&[], false);
        0
    }
}

impl<'a> Sink<'a> {
    pub(super) fn new(room: &'a mut [u8]) -> Self {
        Self { room, used: 0, sound: true }
    }

    /// Bytes written; `None` when there was no room for all.
    pub(super) fn length(&self) -> Option<usize> {
        if self.sound { Some(self.used) } else { None }
    }

    #[inline(never)]
    fn byte(&mut self, byte: u8) {
        match self.room.get_mut(self.used) {
            Some(slot) => (*slot, self.used) = (byte, self.used + 1),
            None => self.sound = false,
        }
    }

    #[inline(never)]
    fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.byte(byte);
        }
    }

    #[inline(never)]
    fn sevens(&mut self, mut value: u32) {
        while value > 0x7f {
            self.byte(value as u8 | 0x80);
            value >>= 7;
        }
        self.byte(value as u8);
    }

    /// An enum's variant.
    pub(super) fn variant(&mut self, variant: u32) {
        self.sevens(variant);
    }
}

impl Field for u8 {
    fn read(from: &mut Source) -> Self {
        from.byte()
    }

    fn write(&self, to: &mut Sink) {
        to.byte(*self);
    }
}

impl Field for u16 {
    fn read(from: &mut Source) -> Self {
        from.sevens(u16::BITS) as u16
    }

    fn write(&self, to: &mut Sink) {
        to.sevens((*self).into());
    }
}

impl Field for f32 {
    #[inline(never)]
    fn read(from: &mut Source) -> Self {
        f32::from_bits(from.word())
    }

    #[inline(never)]
    fn write(&self, to: &mut Sink) {
        to.word(self.to_bits());
    }
}

impl Field for f64 {
    #[inline(never)]
    fn read(from: &mut Source) -> Self {
        let low = from.word();
        f64::from_bits(u64::from(from.word()) << 32 | u64::from(low))
    }

    #[inline(never)]
    fn write(&self, to: &mut Sink) {
        to.word(self.to_bits() as u32);
        to.word((self.to_bits() >> 32) as u32);
    }
}

impl<T: Field> Field for Option<T> {
    #[inline(never)]
    fn read(from: &mut Source) -> Self {
        match from.byte() {
            0 => None,
            1 => Some(T::read(from)),
            _ => {
                from.spoilt();
                None
            }
        }
    }

    #[inline(never)]
    fn write(&self, to: &mut Sink) {
        to.byte(self.is_some().into());
        if let Some(value) = self {
            value.write(to);
        }
    }
}

impl<T: Field, const N: usize> Field for [T; N] {
    #[inline(never)]
    fn read(from: &mut Source) -> Self {
        core::array::from_fn(|_| T::read(from))
    }

    #[inline(never)]
    fn write(&self, to: &mut Sink) {
        for value in self {
            value.write(to);
        }
    }
}

/// States a structure's fields in their order; the compiler insists on every one.
macro_rules! fields {
    ($type:ty: $($field:ident),+) => {
        impl Field for $type {
            #[inline(never)]
            fn read(from: &mut Source) -> Self {
                Self { $($field: Field::read(from)),+ }
            }

            #[inline(never)]
            fn write(&self, to: &mut Sink) {
                let Self { $($field),+ } = self;
                $($field.write(to);)+
            }
        }
    };
}
pub(super) use fields;

/// States the two variants of an enum without fields, in their order.
macro_rules! either {
    ($type:ty: $first:ident, $second:ident) => {
        impl Field for $type {
            fn read(from: &mut Source) -> Self {
                if from.variant(2) == 0 { Self::$first } else { Self::$second }
            }

            fn write(&self, to: &mut Sink) {
                to.variant(match self {
                    Self::$first => 0,
                    Self::$second => 1,
                });
            }
        }
    };
}
pub(super) use either;
