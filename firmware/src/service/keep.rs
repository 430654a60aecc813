//! Found values into the store: only with the board disabled. The command for it is the engineer's sign-off; a calibration by itself
//! writes nothing.

use core::fmt;

use embedded_storage::nor_flash::NorFlash;

use super::found::Found;
use crate::board::{Board, Disabled, NotDisabled};
use crate::store::{CopyFault, RecordError, Sealed, Store, StoredRecord, WriteError};

/// Why nothing was kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KeepError {
    /// With the found values the record would not be valid.
    Record(RecordError),
    /// It does not fit a copy.
    Copy(CopyFault),
    /// The board is not disabled.
    NotDisabled(NotDisabled),
    /// The store did not take it.
    Store(WriteError),
}

impl fmt::Display for KeepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Record(error) => error.fmt(f),
            Self::Copy(error) => error.fmt(f),
            Self::NotDisabled(error) => error.fmt(f),
            Self::Store(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for KeepError {}

/// Puts the found values into the record, signs it off and writes it; gives its sequence number. The controller works with it from its
/// next start.
///
/// # Errors
/// [`KeepError`]; whatever it is, the store still has the record before or the new one.
pub fn keep<B: Board, S: NorFlash>(
    found: &Found,
    (record, bucket): (&StoredRecord, usize),
    board: &mut B,
    store: &mut Store<S>,
) -> Result<u32, KeepError> {
    let record = found.in_record(record, bucket).map_err(KeepError::Record)?;
    let mut sealed = Sealed::new(&record).map_err(KeepError::Copy)?;
    sealed.approve();
    let disabled = Disabled::new(board).map_err(KeepError::NotDisabled)?;
    store.write(disabled, &sealed).map_err(KeepError::Store)
}
