//! Instruction counts on the emulated Cortex-M4F.

use std::path::Path;

use super::{AnyError, Row};
use crate::cli::progress::Progress;
use crate::place::{Emulator, Image, Timing};
use crate::run::Run;
use crate::scenario::Scenario;

/// The maps, each alone, from the bench image.
pub(super) fn maps() -> Result<Vec<Row>, AnyError> {
    let printed = Emulator::start(&Image::build("bench-emulated")?)?.printed()?;
    // Lines with # are for the tests.
    printed
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| {
            let mut words = line.split_whitespace();
            let row = (words.next(), words.next().map(str::parse), words.next().map(str::parse));
            match row {
                (Some(name), Some(Ok(median)), Some(Ok(max))) => Ok(Row { name: name.to_owned(), median, max }),
                _ => Err(format!("the bench image printed `{line}`, which is no row").into()),
            }
        })
        .collect()
}

/// The scenarios whose ticks are counted, and their rows' names: one of each kind of motion, and a fence.
pub(super) const TICKS: [(&str, &str); 4] = [
    ("tick", "dig"),
    ("tick_move", "move-least-effort"),
    ("tick_reach", "obstacle-over"),
    ("tick_fence", "fence-zx200"),
];

/// The whole tick, over every tick of a scenario.
pub(super) fn tick((row, scenario): (&str, &str)) -> Result<Row, AnyError> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenarios/{scenario}.toml"));
    let scenario = Scenario::load(&file)?;
    let image = Image::build("ecu-emulated")?;
    let mut progress = Progress::new(row, (scenario.duration_s * 1e3) as u64, 1e3, "s");
    let mut emulator = Emulator::with_parameters(&image, &scenario.parameters)?;
    let log = Run::new(&scenario, 1)?.complete(&mut emulator, |done, all| progress.at(done, all))?;
    progress.finish();
    emulator.finish()?;
    let mut counts: Vec<u32> = log
        .timing
        .iter()
        .filter_map(|timing| match *timing {
            Timing::Emulator { instructions, .. } => Some(instructions),
            Timing::Host { .. } => None,
        })
        .collect();
    counts.sort_unstable();
    let (Some(&max), Some(&median)) = (counts.last(), counts.get(counts.len() / 2)) else {
        return Err(format!("{row}: the scenario has no ticks").into());
    };
    Ok(Row { name: row.to_owned(), median, max })
}
