//! Two copies in flash.

use core::fmt;

use embedded_storage::nor_flash::{NorFlash, NorFlashError, NorFlashErrorKind};

use super::copy::{COPY_BYTES, CopyFault, HEADER_BYTES, Header, Sealed, decode};
use super::record::StoredRecord;
use crate::board::{Board, Disabled};

/// The flash does not fit the store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlashFit {
    /// It must be two sectors, no more and no fewer.
    TwoSectors,
    /// A sector must hold a copy.
    SectorTooSmall,
    /// It programs more bytes at once than a header has.
    WriteSize,
}

/// No record to work with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoadError {
    /// The flash itself failed.
    Flash(NorFlashErrorKind),
    /// Neither copy is good: what is wrong with each.
    BothBad([CopyFault; 2]),
    /// The newest copy is spoilt and the other is an older record, which may be of another bucket or calibration.
    OnlyOlder(CopyFault),
    /// The record is valid but nobody signed it off.
    NotApproved,
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flash(kind) => write!(f, "flash: {kind}"),
            Self::BothBad([first, second]) => write!(f, "first copy: {first}; second copy: {second}"),
            Self::OnlyOlder(fault) => write!(f, "newest copy: {fault}; the other is older"),
            Self::NotApproved => f.write_str("the parameters are not approved"),
        }
    }
}

impl core::error::Error for LoadError {}

/// Why a record was not written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WriteError {
    /// The flash itself failed.
    Flash(NorFlashErrorKind),
    /// Nobody signed it off. Nothing was touched.
    NotApproved,
    /// The sector does not read as it was written; the other was not touched after it.
    Verify {
        /// The sector, 0 or 1.
        sector: u32,
    },
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flash(kind) => write!(f, "flash: {kind}"),
            Self::NotApproved => f.write_str("the parameters are not approved"),
            Self::Verify { sector } => write!(f, "sector {sector} does not read as it was written"),
        }
    }
}

impl core::error::Error for WriteError {}

/// The record found, and how its two copies are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loaded {
    /// The record, valid and approved.
    pub record: StoredRecord,
    /// Its sequence number.
    pub sequence: u32,
    /// The other copy; if it is not the same, writing the record again mends it.
    pub other: OtherCopy,
}

/// The copy that was not loaded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OtherCopy {
    /// The same record.
    Same,
    /// An older record: a write was cut between the two sectors.
    Older,
    /// No good.
    Bad(CopyFault),
}

/// The store in its two sectors.
#[derive(Clone, Debug)]
pub struct Store<F> {
    flash: F,
}

impl<F: NorFlash> Store<F> {
    /// A store over a flash, or the window of one, of exactly two sectors.
    ///
    /// # Errors
    /// What does not fit.
    pub fn new(flash: F) -> Result<Self, FlashFit> {
        if flash.capacity() != 2 * F::ERASE_SIZE {
            Err(FlashFit::TwoSectors)
        } else if COPY_BYTES > F::ERASE_SIZE {
            Err(FlashFit::SectorTooSmall)
        } else if !HEADER_BYTES.is_multiple_of(F::WRITE_SIZE) || !HEADER_BYTES.is_multiple_of(F::READ_SIZE) {
            Err(FlashFit::WriteSize)
        } else {
            Ok(Self { flash })
        }
    }

    /// The flash, for a board that must reach it (a simulated one cuts its power there).
    pub fn flash(&mut self) -> &mut F {
        &mut self.flash
    }

    fn read(&mut self, sector: u32) -> Result<[u8; COPY_BYTES], NorFlashErrorKind> {
        let mut bytes = [0; COPY_BYTES];
        self.flash.read(sector * F::ERASE_SIZE as u32, &mut bytes).map_err(|error| error.kind())?;
        Ok(bytes)
    }

    /// The newest record: of the sequence number of the newest intact header, from either sector.
    ///
    /// # Errors
    /// [`LoadError`]; every fault is named.
    // Not inlined: both copies lie on the stack while it runs.
    #[inline(never)]
    pub fn load(&mut self) -> Result<Loaded, LoadError> {
        let copies = [self.read(0).map_err(LoadError::Flash)?, self.read(1).map_err(LoadError::Flash)?];
        let swapped = second_is_newer(&copies);
        let [newest, other] = if swapped { [&copies[1], &copies[0]] } else { [&copies[0], &copies[1]] };
        // By reference, as the records are: moved about, the stack may hold each several times.
        let (first, second) = (decode(newest), decode(other));
        let (decoded, other) = match (&first, &second) {
            (Ok(newest), Ok(other)) if newest.sequence == other.sequence => (newest, OtherCopy::Same),
            (Ok(newest), Ok(_)) => (newest, OtherCopy::Older),
            (Ok(newest), Err(fault)) => (newest, OtherCopy::Bad(*fault)),
            // Data were complete and checked before a header was programmed: a whole header over spoilt data has decayed, and
            // what it headed was newer than what is left.
            (Err(fault), Ok(other)) if sequence(newest).is_some_and(|newest| newest != other.sequence) => {
                return Err(LoadError::OnlyOlder(*fault));
            }
            (Err(fault), Ok(other)) => (other, OtherCopy::Bad(*fault)),
            (&Err(newest_fault), &Err(other_fault)) => {
                let in_order = if swapped { [other_fault, newest_fault] } else { [newest_fault, other_fault] };
                return Err(LoadError::BothBad(in_order));
            }
        };
        if !decoded.approved {
            return Err(LoadError::NotApproved);
        }
        Ok(Loaded { record: decoded.record, sequence: decoded.sequence, other })
    }

    /// Writes an approved record into both sectors, one after the other, and gives its sequence number. The sector that holds the
    /// newest good record comes second, and only when the first reads as written.
    ///
    /// Each sector: erase, data, a look whether they are there, header. On an STM32F405 the flash behind this must wait in RAM and
    /// feed the watchdog there, because nothing else runs while it erases.
    ///
    /// # Errors
    /// [`WriteError`]; one sector still holds the old record or the new one.
    pub fn write<B: Board>(&mut self, mut permit: Disabled<'_, B>, record: &Sealed) -> Result<u32, WriteError> {
        if !record.is_approved() {
            return Err(WriteError::NotApproved);
        }
        let copies = [self.read(0).map_err(WriteError::Flash)?, self.read(1).map_err(WriteError::Flash)?];
        let newest = if second_is_newer(&copies) { sequence(&copies[1]) } else { sequence(&copies[0]) };
        let next = newest.unwrap_or(0).wrapping_add(1);
        let record = record.with_sequence(next);
        let keep_second = match copies.each_ref().map(|bytes| decode(bytes).is_ok()) {
            [true, true] => second_is_newer(&copies),
            [_, second] => second,
        };
        for sector in if keep_second { [0, 1] } else { [1, 0] } {
            permit.feed_watchdog();
            self.write_sector(sector, &record)?;
        }
        permit.feed_watchdog();
        Ok(next)
    }

    fn write_sector(&mut self, sector: u32, record: &Sealed) -> Result<(), WriteError> {
        let flash = |error: F::Error| WriteError::Flash(error.kind());
        let from = sector * F::ERASE_SIZE as u32;
        let (header, data) = record.parts();
        self.flash.erase(from, from + F::ERASE_SIZE as u32).map_err(flash)?;
        self.flash.write(from + HEADER_BYTES as u32, data).map_err(flash)?;
        // No header over data that did not take: it would outrank the other sector.
        let taken = self.read(sector).map_err(WriteError::Flash)?;
        if taken.get(HEADER_BYTES..HEADER_BYTES + data.len()) != Some(data) {
            return Err(WriteError::Verify { sector });
        }
        self.flash.write(from, header).map_err(flash)?;
        match Sealed::from_bytes(&self.read(sector).map_err(WriteError::Flash)?) {
            Ok(read) if read == *record => Ok(()),
            _ => Err(WriteError::Verify { sector }),
        }
    }
}

/// The sequence number of an intact header.
fn sequence(copy: &[u8; COPY_BYTES]) -> Option<u32> {
    Header::read(copy).ok().map(|header| header.sequence)
}

/// By the sequence numbers of intact headers; they wrap.
fn second_is_newer([first, second]: &[[u8; COPY_BYTES]; 2]) -> bool {
    match (sequence(first), sequence(second)) {
        (Some(first), Some(second)) => (second.wrapping_sub(first) as i32) > 0,
        (None, Some(_)) => true,
        (_, None) => false,
    }
}
