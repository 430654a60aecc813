//! `hil faults`: the fault campaign as a table.

use std::error::Error;
use std::fmt::Write;
use std::process::ExitCode;

use clap::Args;

use super::campaign::{PartArgs, conclude, counted};
use crate::faults::{Report, Spread, campaign, cases};
use crate::machine_file::MachineFile;

/// Arguments of `hil faults`.
#[derive(Debug, Args)]
pub struct FaultsArgs {
    /// Runs of every fault in every situation, 1 to 100000
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    seeds: u32,
    /// A machine's name, or the path of a machine file
    #[arg(long, default_value = "zx200")]
    machine: String,
    /// Seed of all cases
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    part: PartArgs,
}

/// Runs the command; its exit status is 0, 1 it could not write, 2 bad input, or 3 a bound did not hold or a healthy run tripped.
pub fn main(args: &FaultsArgs) -> ExitCode {
    conclude(run(args), table, args.part.json.as_deref(), Report::holds)
}

fn run(args: &FaultsArgs) -> Result<Report, Box<dyn Error>> {
    let machine = MachineFile::load(&args.machine)?;
    let mine = args.part.shard.cases(cases(args.seeds)).len() as u64;
    counted(&machine.name, mine, (1.0, "runs"), |done| campaign(&machine, args.seeds, args.seed, args.part.shard, done))
}

fn table(report: &Report) -> String {
    let Report { machine, seed, runs, healthy, false_trips, .. } = report;
    let mut out = format!(
        "{machine}: {runs} simulated runs, {healthy} of them healthy; {false_trips} false trips (seed {seed})\n  {:<22} {:>5} {:>5} {:>6} {:>7} \
         {:>6} {:>6} {:>6} {:>7} {:>6} {:>6} {:>7}  bound\n",
        "fault", "seen", "not", "never", "wait", "p50", "p99", "max", "[ms] |", "p50", "p99", "max [mm]"
    );
    let spread = |spread: Option<Spread>| match spread {
        Some(Spread { p50, p99, max }) => [p50, p99, max].map(|x| format!("{x:.0}")),
        None => ["–"; 3].map(str::to_owned),
    };
    for row in &report.faults {
        let wait = row.observable_ms.map_or("–".to_owned(), |ms| format!("{ms:.0}"));
        let [d50, d99, d] = spread(row.detect_ms);
        let [t50, t99, t] = spread(row.tip_travel_mm);
        let bound = match (row.bound_ms, row.bound_held) {
            (Some(ms), Some(true)) => format!("{ms:.0} ms, held"),
            (Some(ms), _) => format!("{ms:.0} ms, NOT HELD"),
            (None, _) => "none".to_owned(),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "  {:<22} {:>5} {:>5} {:>6} {wait:>7} {d50:>6} {d99:>6} {d:>6}      | {t50:>6} {t99:>6} {t:>7}   {bound}",
            row.name, row.detected, row.undetected, row.never_observable
        );
    }
    for (named, situation) in &report.false_trips_named {
        let _ = writeln!(out, "  false trip: {named}, {situation:?}");
    }
    out.push_str("not promised to be seen, or only so late:\n");
    for row in report.faults.iter().filter(|row| row.reason.is_some()) {
        let _ = writeln!(out, "  {}: {}", row.name, row.reason.unwrap_or_default());
    }
    out
}
