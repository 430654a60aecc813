//! `hil bench`: instruction counts on the emulated Cortex-M4F.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;

use super::progress::Progress;
use crate::place::{Emulator, Image, Timing};
use crate::run::Run;
use crate::scenario::Scenario;

/// Arguments of `hil bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Write the counts as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// One row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Row {
    name: String,
    median: u32,
    max: u32,
}

/// The JSON: the largest count of each row.
#[derive(Debug, Serialize)]
struct Counts {
    emulator: BTreeMap<String, u32>,
    emulator_median: BTreeMap<String, u32>,
}

/// Runs the command; its exit status is 0, or 2 when it cannot measure.
pub fn main(args: &BenchArgs) -> ExitCode {
    match bench(args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

type AnyError = Box<dyn std::error::Error>;

fn bench(args: &BenchArgs) -> Result<(), AnyError> {
    let mut rows = maps()?;
    rows.push(tick()?);
    let mut table = String::from("instructions on the emulated Cortex-M4F     median      max\n");
    for Row { name, median, max } in &rows {
        table += &format!("{name:<40} {median:>9} {max:>8}\n");
    }
    let by_name = |count: fn(&Row) -> u32| rows.iter().map(|row| (row.name.clone(), count(row))).collect();
    let counts = Counts { emulator: by_name(|row| row.max), emulator_median: by_name(|row| row.median) };
    let json = serde_json::to_string_pretty(&counts)? + "\n";
    match args.json.as_deref() {
        Some(file) if file == Path::new("-") => {
            eprint!("{table}");
            std::io::stdout().write_all(json.as_bytes())?;
        }
        Some(file) => {
            print!("{table}");
            std::fs::write(file, json).map_err(|e| format!("cannot write {}: {e}", file.display()))?;
        }
        None => print!("{table}"),
    }
    Ok(())
}

/// The maps, each alone, from the bench image.
fn maps() -> Result<Vec<Row>, AnyError> {
    let printed = Emulator::start(&Image::build("bench-emulated")?)?.printed()?;
    printed
        .lines()
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
fn tick() -> Result<Row, AnyError> {
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
