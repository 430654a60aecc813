//! `hil soak`: hours of nominal work without a trip.

use std::error::Error;
use std::fmt::Write;
use std::process::ExitCode;

use clap::Args;

use super::campaign::{PartArgs, conclude, counted};
use crate::machine_file::MachineFile;
use crate::soak::{Report, runs, soak};

/// Arguments of `hil soak`.
#[derive(Debug, Args)]
pub struct SoakArgs {
    /// Simulated hours, a case a minute, 1 to 10000
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    hours: u32,
    /// A machine's name, or the path of a machine file
    #[arg(long, default_value = "zx200")]
    machine: String,
    /// Seed of operators, payloads and noise
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    part: PartArgs,
}

/// Runs the command; its exit status is 0, 1 it could not write, 2 bad input, or 3 something tripped.
pub fn main(args: &SoakArgs) -> ExitCode {
    conclude(run(args), table, args.part.json.as_deref(), |report| report.trips.is_empty())
}

fn run(args: &SoakArgs) -> Result<Report, Box<dyn Error>> {
    let machine = MachineFile::load(&args.machine)?;
    let minutes = args.part.shard.cases(runs(args.hours));
    let count = minutes.len() as u64;
    counted(&machine.name, count, (60.0, "hours"), |done| soak(&machine, args.seed, minutes, done))
}

fn table(report: &Report) -> String {
    let Report { machine, seed, hours, travel_m, trips } = report;
    let mut out = format!(
        "{machine}: {hours:.1} simulated hours of random levers, {travel_m:.0} m of cylinder travel (seed {seed}): {} trips\n",
        trips.len()
    );
    for trip in trips {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  minute {}: {} at {:.3} s", trip.run, trip.fault, trip.at_s);
    }
    out
}
