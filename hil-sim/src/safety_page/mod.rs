//! `docs/safety.md`: what is promised, the tests that show it, and what is not detected.

mod page;
mod requirements;
mod tests_found;

use std::path::Path;

pub use page::page;
pub use requirements::{REQUIREMENTS, Requirement};
pub use tests_found::{Test, all, of_source};

/// Where the file stands, from the repository's root, and what it must hold.
///
/// # Errors
/// A source that cannot be read, or a requirement without a test or with one that is not there.
pub fn files(root: &Path) -> Result<[(&'static str, String); 1], String> {
    Ok([("docs/safety.md", page(REQUIREMENTS, &all(root)?)?)])
}
