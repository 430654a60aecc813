//! The controller's memory and its timer spoilt in the emulator: every run turns one bit, or loses interrupts, in the middle of the work, and
//! is compared with the run in which nothing happened.
//!
//! The image `spoilt-emulated` has the board's own last resort, its watch over the constants, and a watchdog of 50 ms.

mod place;
mod tally;
mod trial;

use rayon::prelude::*;

use crate::place::Image;
use crate::shard::Shard;

pub use tally::{Report, Row, Unseen};
pub use trial::SLIGHT_M;

/// Scenarios in which the bits are turned.
pub const SCENARIOS: [&str; 4] = ["dig", "level-zx200", "fence-zx200", "levers-zx200"];

/// Runs the campaign's part: `seeds` flips, and in every scenario the timer lost once and for ever; `done` is called after each run. The same cases give the same
/// results in any split.
///
/// # Errors
/// No image, no emulator, or a scenario that does not run.
pub fn campaign(seeds: u32, seed: u64, shard: Shard, done: impl Fn() + Sync) -> Result<Report, String> {
    let image = Image::build("spoilt-emulated").map_err(|error| error.to_string())?;
    let stages = trial::stages()?;
    let found: Vec<_> = shard
        .cases(cases(seeds))
        .into_par_iter()
        .map(|index| {
            let found = trial::run(&stages, &image, seed, index)?;
            done();
            Ok(found)
        })
        .collect::<Result<_, String>>()?;
    Ok(Report::of(seed, &found))
}

/// Cases of a campaign.
pub fn cases(seeds: u32) -> u64 {
    u64::from(seeds) + 2 * SCENARIOS.len() as u64
}
