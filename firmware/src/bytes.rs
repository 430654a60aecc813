//! Values as bytes, little-endian, in buffers of fixed size.

use kinematics_core::{Cylinders, Rotor};

/// Appends to a byte buffer of exactly the right size; a test fills each to the last byte.
pub(crate) struct Writer<'a> {
    rest: core::slice::IterMut<'a, u8>,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(bytes: &'a mut [u8]) -> Self {
        Self { rest: bytes.iter_mut() }
    }

    pub(crate) fn bytes<const N: usize>(&mut self, bytes: [u8; N]) {
        for byte in bytes {
            if let Some(slot) = self.rest.next() {
                *slot = byte;
            }
        }
    }

    pub(crate) fn float(&mut self, x: f32) {
        self.bytes(x.to_bits().to_le_bytes());
    }

    pub(crate) fn rotor(&mut self, r: Rotor<f32>) {
        self.float(r.cos);
        self.float(r.sin);
    }

    // Inlined: compiled for the smallest size, three calls of one function would go through a register.
    #[inline(always)]
    pub(crate) fn cylinders(&mut self, c: Cylinders<f32>) {
        self.float(c.boom);
        self.float(c.arm);
        self.float(c.bucket);
    }

    /// Up to eight flags in a byte, the first lowest.
    pub(crate) fn flags<const N: usize>(&mut self, flags: [bool; N]) {
        self.bytes([flags.into_iter().rev().fold(0, |byte, flag| byte << 1 | u8::from(flag))]);
    }
}

/// Takes from a byte buffer; past its end it reads zeros, which the fixed sizes rule out.
pub(crate) struct Reader<'a> {
    rest: core::slice::Iter<'a, u8>,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes.iter() }
    }

    pub(crate) fn bytes<const N: usize>(&mut self) -> [u8; N] {
        [(); N].map(|()| self.rest.next().copied().unwrap_or(0))
    }

    pub(crate) fn byte(&mut self) -> u8 {
        let [byte] = self.bytes();
        byte
    }

    pub(crate) fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.bytes())
    }

    pub(crate) fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.bytes())
    }

    pub(crate) fn float(&mut self) -> f32 {
        f32::from_bits(self.u32())
    }

    pub(crate) fn rotor(&mut self) -> Rotor<f32> {
        Rotor { cos: self.float(), sin: self.float() }
    }

    pub(crate) fn cylinders(&mut self) -> Cylinders<f32> {
        Cylinders { boom: self.float(), arm: self.float(), bucket: self.float() }
    }

    /// The flags of [`Writer::flags`], or the byte when a bit beyond them is set.
    pub(crate) fn flags<const N: usize>(&mut self) -> Result<[bool; N], u8> {
        let byte = self.byte();
        let mut rest = byte;
        let flags = [(); N].map(|()| {
            let flag = rest & 1 != 0;
            rest >>= 1;
            flag
        });
        if rest == 0 { Ok(flags) } else { Err(byte) }
    }
}
