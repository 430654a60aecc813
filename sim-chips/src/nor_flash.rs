//! NOR flash: erased by sectors to FFh, programmed by words that only clear bits, without power from a moment on.

use embedded_storage::nor_flash::{
    ErrorType, NorFlash as Flash, NorFlashError, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};

/// Why an access failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlashFault {
    /// Not aligned, or out of bounds.
    Access(NorFlashErrorKind),
    /// The power went during the access, or had gone before.
    PowerCut,
}

impl NorFlashError for FlashFault {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::Access(kind) => *kind,
            Self::PowerCut => NorFlashErrorKind::Other,
        }
    }
}

/// Two sectors of `SECTOR` bytes, programmed by words of four, as an STM32F405 does at 2.7 to 3.6 V (RM0090, table "Program/erase
/// parallelism").
#[derive(Clone, Debug)]
pub struct NorFlash<const SECTOR: usize> {
    sectors: [[u8; SECTOR]; 2],
    /// Bytes that can still be changed before the power goes; erasing a sector changes every byte of it.
    power: Option<usize>,
    /// Bytes changed so far.
    changed: usize,
    /// A cell that reads 0 whatever is written: its place.
    dead_cell: Option<usize>,
}

impl<const SECTOR: usize> Default for NorFlash<SECTOR> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const SECTOR: usize> NorFlash<SECTOR> {
    /// Erased.
    pub const fn new() -> Self {
        Self { sectors: [[0xff; SECTOR]; 2], power: None, changed: 0, dead_cell: None }
    }

    /// Cuts the power after this many more bytes have been erased or programmed.
    pub fn cut_power_after(&mut self, bytes: usize) {
        self.power = Some(bytes);
    }

    /// Power comes back; what was half done stays half done.
    pub fn restore_power(&mut self) {
        self.power = None;
    }

    /// Bytes erased or programmed since it was made.
    pub fn changed(&self) -> usize {
        self.changed
    }

    /// Lets a cell decay: flips bits of the byte at this place.
    pub fn flip(&mut self, at: usize, bits: u8) {
        if let Some(byte) = self.sectors.as_flattened_mut().get_mut(at) {
            *byte ^= bits;
        }
    }

    /// From now on the byte at this place can no longer be erased: it reads 0.
    pub fn wear_out(&mut self, at: usize) {
        self.dead_cell = Some(at);
        if let Some(byte) = self.sectors.as_flattened_mut().get_mut(at) {
            *byte = 0;
        }
    }

    /// One byte changes, if there is power for it; the byte on which it goes is left half changed.
    fn change(&mut self, at: usize, change: impl Fn(u8) -> u8) -> Result<(), FlashFault> {
        let cut = match &mut self.power {
            Some(0) => return Err(FlashFault::PowerCut),
            Some(left) => {
                *left -= 1;
                *left == 0
            }
            None => false,
        };
        self.changed += 1;
        if let Some(byte) = self.sectors.as_flattened_mut().get_mut(at) {
            let done = change(*byte);
            // Every other bit arrives where it should.
            *byte = if cut { (*byte & 0x55) | (done & 0xaa) } else { done };
            if self.dead_cell == Some(at) {
                *byte = 0;
            }
        }
        if cut { Err(FlashFault::PowerCut) } else { Ok(()) }
    }
}

impl<const SECTOR: usize> ErrorType for NorFlash<SECTOR> {
    type Error = FlashFault;
}

impl<const SECTOR: usize> ReadNorFlash for NorFlash<SECTOR> {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashFault> {
        check_read(self, offset, bytes.len()).map_err(FlashFault::Access)?;
        let from = self.sectors.as_flattened().get(offset as usize..).unwrap_or(&[]);
        for (byte, cell) in bytes.iter_mut().zip(from) {
            *byte = *cell;
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        2 * SECTOR
    }
}

impl<const SECTOR: usize> Flash for NorFlash<SECTOR> {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = SECTOR;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashFault> {
        check_erase(self, from, to).map_err(FlashFault::Access)?;
        let (from, to) = (from as usize, to as usize);
        // A cut leaves a sector of garbage: some cells changed, from one end or from the other, the rest as they were.
        let short = self.power.filter(|&left| left <= to - from);
        for step in 0..to - from {
            let (at, garbage) = match short {
                None => (from + step, 0xff),
                Some(left) if left % 2 == 0 => (to - 1 - step, (step as u8).wrapping_mul(167) ^ (left as u8)),
                Some(left) => (from + step, (step as u8).wrapping_mul(167) ^ (left as u8)),
            };
            self.change(at, |old| old | garbage)?;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashFault> {
        check_write(self, offset, bytes.len()).map_err(FlashFault::Access)?;
        for (at, &byte) in (offset as usize..).zip(bytes) {
            self.change(at, |old| old & byte)?;
        }
        Ok(())
    }
}
