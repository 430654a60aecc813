//! `hil flips`: the controller's memory and timer spoilt in the emulator, as a table.

use std::error::Error;
use std::fmt::Write;
use std::process::ExitCode;

use clap::Args;

use super::campaign::{PartArgs, conclude, counted};
use crate::spoilt::{Report, SLIGHT_M, campaign, cases};

/// Arguments of `hil flips`.
#[derive(Debug, Args)]
pub struct FlipsArgs {
    /// Bits to turn, one a run, 1 to 100000
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    seeds: u32,
    /// Seed of all cases
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    part: PartArgs,
}

/// Runs the command; its exit status is 0, 1 it could not write, 2 no image or emulator, or 3 something promised did not hold.
pub fn main(args: &FlipsArgs) -> ExitCode {
    conclude(run(args), table, args.part.json.as_deref(), Report::holds)
}

fn run(args: &FlipsArgs) -> Result<Report, Box<dyn Error>> {
    let mine = args.part.shard.cases(cases(args.seeds)).len() as u64;
    counted("turned bits", mine, (1.0, "runs"), |done| campaign(args.seeds, args.seed, args.part.shard, done))
}

fn table(report: &Report) -> String {
    let Report { seed, runs, rows, watch_instructions, unseen } = report;
    let mut out = format!(
        "{runs} emulated runs, one thing spoilt in each (seed {seed}); slight: within {:.0} mm of where the tip would have been\n  {:<26} {:>5} {:>9} {:>5} \
         {:>8} {:>7} {:>7} {:>10}\n",
        SLIGHT_M * 1e3,
        "spoilt",
        "runs",
        "no effect",
        "off",
        "by [ms]",
        "slight",
        "astray",
        "worst [mm]"
    );
    for row in rows {
        let by = row.off_ms.map_or("–".to_owned(), |ms| ms.to_string());
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "  {:<26} {:>5} {:>9} {:>5} {by:>8} {:>7} {:>7} {:>10.1}",
            row.name, row.runs, row.no_effect, row.off, row.slight, row.astray, row.astray_mm
        );
    }
    if let Some(instructions) = watch_instructions {
        let _ =
            writeln!(out, "the watch over the constants: at most {instructions} instructions a tick once it has begun");
    }
    for row in rows.iter().filter(|row| row.off > 0) {
        let by: Vec<String> = row.off_by.iter().map(|(by, count)| format!("{by} {count}")).collect();
        let _ = writeln!(out, "{}: off by {}", row.name, by.join(", "));
    }
    for run in unseen {
        let _ = writeln!(out, "astray unseen: case {} in {}, {:.1} mm", run.case, run.scenario, run.astray_mm);
    }
    out
}
