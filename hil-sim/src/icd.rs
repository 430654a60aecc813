//! `docs/icd.md` and `docs/excavator.dbc`, written from the tables that the firmware encodes and decodes by, and `docs/ecu.svg`, the block
//! diagram of the reference ECU.

mod dbc;
mod diagram;
mod numbers;
mod page;

pub use dbc::dbc;
pub use diagram::{PINS, diagram};
pub use page::page;

/// Where the files stand, from the repository's root, and what they must hold.
pub fn files() -> [(&'static str, String); 3] {
    [("docs/icd.md", page()), ("docs/excavator.dbc", dbc()), ("docs/ecu.svg", diagram())]
}
