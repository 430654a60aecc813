//! Parameters in flash: one versioned record, kept twice, that counts only when somebody signed it off.
//!
//! - [`StoredRecord`] — the controller's parameters and the buckets of the machine;
//! - [`copy`] — a record as bytes, in flash and in the file of `cargo hil params` alike: header, checks, approval;
//! - [`Store`] — two copies over embedded-storage's `NorFlash`, written so that a power cut at any byte leaves one.

pub mod copy;
mod fields;
mod flash;
mod layout;
mod record;

pub use copy::{CopyFault, Decoded, Sealed, parameters_from};
pub use flash::{FlashFit, LoadError, Loaded, OtherCopy, Store, WriteError};
pub use record::{Bucket, MAX_BUCKETS, Name, RecordError, StoredRecord};
