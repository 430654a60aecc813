//! Found values into the store: only with the board disabled. The command for it is the engineer's sign-off; a calibration by itself
//! writes nothing.

use core::fmt;

use embedded_storage::nor_flash::NorFlash;

use super::found::Found;
use crate::board::Disabled;
use crate::store::{CopyFault, LoadError, RecordError, Sealed, Store, StoredRecord, WriteError};

/// Why nothing was kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KeepError {
    /// The store has no record to put them into.
    Load(LoadError),
    /// With the found values the record would not be valid.
    Record(RecordError),
    /// It does not fit a copy.
    Copy(CopyFault),
    /// The store did not take it.
    Store(WriteError),
}

impl fmt::Display for KeepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Load(error) => error.fmt(f),
            Self::Record(error) => error.fmt(f),
            Self::Copy(error) => error.fmt(f),
            Self::Store(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for KeepError {}

/// Puts the found values into the store's record, signs it off and writes it; gives its sequence number. `bucket` is the one they were found
/// with. The controller works with it from its next start.
///
/// # Errors
/// [`KeepError`]; whatever it is, the store still has the record before or the new one.
#[inline(never)]
pub fn keep<S: NorFlash>(
    found: &Found,
    bucket: usize,
    store: &mut Store<S>,
    permit: &Disabled,
) -> Result<u32, KeepError> {
    let record = store.load().map_err(KeepError::Load)?.record;
    let record = found.in_record(&record, bucket).map_err(KeepError::Record)?;
    write(&record, store, permit)
}

/// Signed off and written.
#[inline(never)]
pub(super) fn write<S: NorFlash>(
    record: &StoredRecord,
    store: &mut Store<S>,
    permit: &Disabled,
) -> Result<u32, KeepError> {
    let mut sealed = Sealed::new(record).map_err(KeepError::Copy)?;
    sealed.approve();
    store.write(permit, &sealed).map_err(KeepError::Store)
}
