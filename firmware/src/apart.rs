//! Reading the parameter record in pieces.

use serde::{Deserialize, Deserializer};

/// Reads one part of the record in a function of its own, for `#[serde(deserialize_with)]`. Read in one piece, the record is taken apart
/// into hundreds of values and put together again, which takes several times the flash and the stack.
///
/// # Errors
/// As the part's own.
#[inline(never)]
pub(crate) fn apart<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<T, D::Error> {
    T::deserialize(from)
}
