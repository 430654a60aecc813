//! The fault campaign: every fault in every situation, thousands of runs; what is seen, how soon, and how far the tip still goes.

mod kind;
mod record;
mod situation;
mod spoil;
mod tally;
mod trial;

use rayon::prelude::*;

use crate::machine_file::MachineFile;
use crate::shard::Shard;

pub use kind::{Bus, Cause, ELSEWHERE, KINDS, Kind, Sensor};
pub use situation::Situation;
pub(crate) use situation::working as working_scenario;
pub use tally::{Report, Row, Spread};

/// Cases of a campaign: every fault, and nothing wrong, in every situation, `seeds` times.
pub fn cases(seeds: u32) -> u64 {
    (KINDS.len() as u64 + 1) * Situation::ALL.len() as u64 * u64::from(seeds)
}

/// Runs the campaign's part; `done` is called after each run. The same cases give the same results in any split.
///
/// # Errors
/// The machine cannot be simulated.
pub fn campaign(
    machine: &MachineFile,
    seeds: u32,
    seed: u64,
    shard: Shard,
    done: impl Fn() + Sync,
) -> Result<Report, String> {
    let mine = shard.cases(cases(seeds));
    let found: Vec<_> = mine
        .into_par_iter()
        .map(|index| {
            let found = trial::run(machine, seed, index)?;
            done();
            Ok(found)
        })
        .collect::<Result<_, String>>()?;
    Ok(Report::of(&machine.name, seed, &found))
}
