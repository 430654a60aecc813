//! `docs/fault-table.md` and its figure: what the fault campaign measured of every fault.

mod drawing;
mod page;

use crate::faults::Report;

pub use drawing::drawing;
pub use page::page;

/// Runs of every fault in every situation that the page is made of.
pub const SEEDS: u32 = 12;
/// Seed of all its cases.
pub const SEED: u64 = 1;
/// The machine it speaks of: the one with a 20 t class's hydraulics.
pub const MACHINE: &str = "zx200";

/// Where the files stand, from the repository's root, and what they must hold.
pub fn files(report: &Report) -> [(&'static str, String); 2] {
    [("docs/fault-table.svg", drawing(report)), ("docs/fault-table.md", page(report))]
}
