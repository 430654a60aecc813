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

/// The whole tick, over every tick of the dig scenario.
pub(super) fn tick() -> Result<Row, AnyError> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/dig.toml");
    let scenario = Scenario::load(&file)?;
    let image = Image::build("ecu-emulated")?;
    let mut progress = Progress::new("tick", (scenario.duration_s * 1e3) as u64, 1e3, "s");
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
        return Err("the dig scenario has no ticks".into());
    };
    Ok(Row { name: "tick".to_owned(), median, max })
}
