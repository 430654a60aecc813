//! `docs/icd.md` and `docs/excavator.dbc`, written from the tables that the firmware encodes and decodes by.

mod dbc;
mod numbers;
mod page;

pub use dbc::dbc;
pub use page::page;

/// Where the files stand, from the repository's root, and what they must hold.
pub fn files() -> [(&'static str, String); 2] {
    [("docs/icd.md", page()), ("docs/excavator.dbc", dbc())]
}
