//! The two parameter sectors of the chip's own flash, behind embedded-storage's traits.
//!
//! The core stands still when it fetches from a flash that erases or programs. So the waiting is done by code in RAM, with interrupts off,
//! and it feeds the watchdog. [`firmware::store::Store`] lets nobody write who has not proved the outputs off.

use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};
use stm32f4xx_hal::pac::{FLASH, IWDG};

/// First byte of sector 2 (`memory.x`).
const START: usize = 0x0800_8000;
const SECTOR_BYTES: usize = 16 * 1024;
const FIRST_SECTOR: u32 = 2;
const SECTORS: usize = 2;

const KEYS: [u32; 2] = [0x4567_0123, 0xCDEF_89AB];
/// Bits of FLASH_CR (RM0090, 3.9.5): programming, sector erase, words of 32 bits, start, lock.
const PG: u32 = 1;
const SER: u32 = 1 << 1;
const PSIZE_32: u32 = 0b10 << 8;
const STRT: u32 = 1 << 16;
const LOCK: u32 = 1 << 31;
/// Bits of FLASH_SR: busy, and everything that can go wrong.
const BSY: u32 = 1 << 16;
const ERRORS: u32 = 0b1111 << 4 | 1 << 1;
const FEED: u32 = 0xAAAA;

/// The sectors; there is one of it, as there is one flash controller.
pub(crate) struct ParameterFlash(FLASH);

/// What the controller or the bounds say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FlashError(NorFlashErrorKind);

impl NorFlashError for FlashError {
    fn kind(&self) -> NorFlashErrorKind {
        self.0
    }
}

impl From<NorFlashErrorKind> for FlashError {
    fn from(kind: NorFlashErrorKind) -> Self {
        Self(kind)
    }
}

impl ParameterFlash {
    pub(crate) fn new(flash: FLASH) -> Self {
        Self(flash)
    }

    /// One operation under an unlocked controller: sets `control`, then stores `word` if there is one, and waits in RAM.
    fn operate(&mut self, control: u32, store: Option<(usize, u32)>) -> Result<(), FlashError> {
        for key in KEYS {
            // SAFETY: the unlock sequence of RM0090, 3.6.1.
            self.0.keyr().write(|w| unsafe { w.bits(key) });
        }
        // SAFETY: the registers of this controller and of the watchdog; interrupts are off, so nothing else fetches from flash.
        let status = cortex_m::interrupt::free(|_| unsafe {
            wait_in_ram(
                self.0.cr().as_ptr(),
                self.0.sr().as_ptr(),
                (*IWDG::ptr()).kr().as_ptr().cast(),
                control,
                store.map_or((core::ptr::null_mut(), 0), |(at, word)| (at as *mut u32, word)),
            )
        });
        if status & ERRORS == 0 { Ok(()) } else { Err(NorFlashErrorKind::Other.into()) }
    }
}

/// Clears old errors, starts the operation, waits for its end, locks. In RAM: cortex-m-rt copies `.data` there.
///
/// # Safety
/// Pointers to FLASH_CR, FLASH_SR and IWDG_KR; a store target null or inside the parameter sectors; interrupts off.
#[unsafe(link_section = ".data.wait_in_ram")]
#[inline(never)]
unsafe fn wait_in_ram(cr: *mut u32, sr: *mut u32, dog: *mut u32, control: u32, store: (*mut u32, u32)) -> u32 {
    // SAFETY: as the caller promises.
    unsafe {
        sr.write_volatile(ERRORS);
        cr.write_volatile(control);
        if store.0.is_null() {
            cr.write_volatile(control | STRT);
        } else {
            store.0.write_volatile(store.1);
        }
        let mut status = sr.read_volatile();
        while status & BSY != 0 {
            dog.write_volatile(FEED);
            status = sr.read_volatile();
        }
        cr.write_volatile(LOCK);
        status
    }
}

impl ErrorType for ParameterFlash {
    type Error = FlashError;
}

impl ReadNorFlash for ParameterFlash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        check_read(self, offset, bytes.len())?;
        for (i, byte) in bytes.iter_mut().enumerate() {
            // SAFETY: inside the two sectors, checked above.
            *byte = unsafe { ((START + offset as usize + i) as *const u8).read_volatile() };
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        SECTORS * SECTOR_BYTES
    }
}

impl NorFlash for ParameterFlash {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = SECTOR_BYTES;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        check_erase(self, from, to)?;
        let sector = |offset: u32| offset / SECTOR_BYTES as u32;
        (sector(from)..sector(to)).try_for_each(|s| self.operate(SER | PSIZE_32 | (FIRST_SECTOR + s) << 3, None))
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        check_write(self, offset, bytes.len())?;
        for (i, word) in bytes.chunks_exact(4).enumerate() {
            let &[a, b, c, d] = word else { return Err(NorFlashErrorKind::NotAligned.into()) };
            let at = START + offset as usize + 4 * i;
            self.operate(PG | PSIZE_32, Some((at, u32::from_le_bytes([a, b, c, d]))))?;
        }
        Ok(())
    }
}
