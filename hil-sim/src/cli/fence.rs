//! `hil fence`: random operators before random fences, in one table.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;

use clap::Args;
use serde::Serialize;

use super::print;
use super::progress::Progress;
use crate::fence::{Kind, Tally, campaign};
use crate::machine_file::MachineFile;

/// Arguments of `hil fence`.
#[derive(Debug, Args)]
pub struct FenceArgs {
    /// Random runs under each kind of fence, 1 to 1000000
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    runs: u32,
    /// A machine's name, or the path of a machine file
    #[arg(long, default_value = "zx200")]
    machine: String,
    /// Seed of poses, fences and operators
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the table as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// What stands in the JSON.
#[derive(Debug, Serialize)]
struct Report<'a> {
    machine: &'a str,
    seed: u64,
    fences: [Tally; 3],
}

/// Runs the command; its exit status is 0, 1 it could not write, 2 bad input, or 3 the whole-linkage fence was violated.
pub fn main(args: &FenceArgs) -> ExitCode {
    let (machine, fences) = match tallies(args) {
        Ok(done) => done,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::from(2);
        }
    };
    if let Err(error) = write(args, &machine, fences) {
        eprintln!("error: {error}");
        return ExitCode::from(1);
    }
    let violated = fences.iter().any(|tally| tally.fence == Kind::Linkage && tally.violated > 0);
    ExitCode::from(if violated { 3 } else { 0 })
}

type AnyError = Box<dyn std::error::Error>;

fn tallies(args: &FenceArgs) -> Result<(String, [Tally; 3]), AnyError> {
    let machine = MachineFile::load(&args.machine)?;
    let progress = Mutex::new((0, Progress::new(&machine.name, args.runs.into(), 1.0, "random runs")));
    let fences = campaign(&machine, args.runs, args.seed, || {
        // A poisoned lock only means that another run has panicked: it will tell.
        if let Ok(mut progress) = progress.lock() {
            progress.0 += 1;
            let done = progress.0;
            progress.1.at(done, args.runs);
        }
    })?;
    if let Ok((_, progress)) = progress.into_inner() {
        progress.finish();
    }
    Ok((machine.name, fences))
}

fn write(args: &FenceArgs, machine: &str, fences: [Tally; 3]) -> Result<(), AnyError> {
    let table = table(machine, args.seed, &fences);
    let to_stdout = args.json.as_deref() == Some(Path::new("-"));
    if to_stdout {
        eprint!("{table}");
    } else {
        print(&table)?;
    }
    if let Some(file) = &args.json {
        let text = serde_json::to_string_pretty(&Report { machine, seed: args.seed, fences })? + "\n";
        if to_stdout { print(&text)? } else { std::fs::write(file, text)? }
    }
    Ok(())
}

fn table(machine: &str, seed: u64, fences: &[Tally; 3]) -> String {
    let [first, ..] = fences;
    let mut out = format!("{machine}: {} random runs under each fence, simulated (seed {seed})\n", first.runs);
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "  {:<16} {:>9} {:>13} {:>13} {:>14} {:>12}",
        "fence", "violated", "deepest [mm]", "closest [mm]", "swing end [°]", "let through"
    );
    for tally in fences {
        let name = match tally.fence {
            Kind::Linkage => "whole linkage",
            Kind::Tip => "tip only",
            Kind::None => "none",
        };
        let _ = writeln!(
            out,
            "  {name:<16} {:>9} {:>13.1} {:>13.1} {:>14.2} {:>10.1} %",
            tally.violated,
            tally.deepest_mm,
            tally.closest_mm,
            tally.swing_closest_deg,
            tally.let_through * 1e2
        );
        if tally.faults > 0 {
            let _ = writeln!(out, "  {:<16} {} runs ended by a fault", "", tally.faults);
        }
    }
    out
}
