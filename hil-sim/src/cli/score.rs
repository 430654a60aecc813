//! `hil score`: the motion on plants that no tuning has seen.

use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::campaign::{PartArgs, conclude, counted};
use crate::machine_file::MachineFile;
use crate::score::{LAW, OnPlant, Plants, Report, Row, Setting, runs, score};

/// Arguments of `hil score`.
#[derive(Debug, Args)]
pub struct ScoreArgs {
    /// Plants drawn, 1 to 10000
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    seeds: u32,
    /// A machine with `[hydraulics]` and the reach of the 20 t class, which the tasks are laid out for: its name, or the path of its file
    #[arg(long, default_value = "zx200")]
    machine: String,
    /// Draw the plants to tune on instead of those kept for the score
    #[arg(long)]
    tuning: bool,
    /// Tables `[motion]` and `[law]` of a scenario to try instead of the product's
    #[arg(long, value_name = "FILE")]
    law: Option<PathBuf>,
    /// Without the controllers it is compared with
    #[arg(long)]
    alone: bool,
    #[command(flatten)]
    part: PartArgs,
}

/// Runs the command; its exit status is 0, 1 it could not write, or 2 bad input.
pub fn main(args: &ScoreArgs) -> ExitCode {
    conclude(run(args), table, args.part.json.as_deref(), |_| true)
}

fn run(args: &ScoreArgs) -> Result<Report, Box<dyn Error>> {
    let machine = MachineFile::load(&args.machine)?;
    let law = match &args.law {
        Some(file) => std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?,
        None => LAW.to_owned(),
    };
    let plants = if args.tuning { Plants::Tuning } else { Plants::HeldOut };
    let setting = Setting { seeds: args.seeds, plants, law, alone: args.alone };
    let mine = args.part.shard.cases(runs(&setting)).len() as u64;
    counted(&machine.name, mine, (1.0, "runs"), |done| score(&machine, &setting, args.part.shard, done))
}

fn table(report: &Report) -> String {
    let mut out = format!(
        "{}: {} drawn plants {}, simulated; distances of the true tip from the path [mm], RMS/max where two stand\n  \
         {:<13} {:>5} {:>6} {:>6} {:>6} | {:>9} {:>9} {:>12} {:>11} | {:>7} {:>6}\n",
        report.machine,
        report.seeds,
        report.plants.described(),
        "task",
        "m/s",
        "RMS",
        "p95",
        "max",
        "open loop",
        "P alone",
        "uncalibrated",
        "half flow",
        "done",
        "still"
    );
    let mm = |m: Option<f64>| m.map_or("–".to_owned(), |m| format!("{:.1}", m * 1e3));
    let both =
        |rms: Option<f64>, max: Option<f64>| rms.map_or("–".to_owned(), |_| format!("{}/{}", mm(rms), mm(max)));
    for row in &report.tasks {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "  {:<13} {:>5} {:>6.1} {:>6.1} {:>6.1} | {:>9} {:>9} {:>12} {:>11} | {:>4}/{:<2} {:>3}/{:<2}",
            row.name,
            row.speed_mps,
            row.rmse_m * 1e3,
            row.p95_m * 1e3,
            row.max_m * 1e3,
            mm(row.open_loop_rmse_m),
            mm(row.proportional_rmse_m),
            both(row.uncalibrated_rmse_m, row.uncalibrated_max_m),
            both(row.half_flow_rmse_m, row.half_flow_max_m),
            row.completed,
            row.plants,
            row.still_at_rest,
            row.plants
        );
    }
    for row in &report.tasks {
        for plant in &row.by_plant {
            notes(&mut out, row, plant);
        }
    }
    out
}

/// A line for each run of a plant that did not come to the end of its path.
fn notes(out: &mut String, row: &Row, on: &OnPlant) {
    let mut note = |what: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  {} at {} m/s on plant {}: {what}", row.name, row.speed_mps, on.plant);
    };
    match on.fault.zip(on.fault_at_s) {
        Some((fault, at_s)) => note(format!("fault {fault} at {at_s:.2} s")),
        None if !on.completed() => note(format!("ended {:.0} mm from the path's end", on.to_end_m * 1e3)),
        None => {}
    }
    if let Some((fault, at_s)) = on.half_flow_fault.zip(on.half_flow_fault_at_s) {
        note(format!("with half the flow: fault {fault} at {at_s:.2} s"));
    }
}
