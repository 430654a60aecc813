//! `hil run SCENARIO`: simulate, report, and say how it ended.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::progress::Progress;
use crate::place::{Emulator, Host, Image};
use crate::report;
use crate::run::{EmulatorFigures, Log, Outcome, Run, RunError, Summary};
use crate::scenario::Scenario;
use crate::travel::Violation;

/// Where the application runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum On {
    /// In this process.
    Host,
    /// In the emulated Cortex-M4F.
    Emulator,
}

/// Arguments of `hil run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The scenario's TOML file
    scenario: PathBuf,
    /// Where the application runs
    #[arg(long, value_enum, default_value = "host")]
    on: On,
    /// Seed of the sensors' noise
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder of the report [default: report/NAME]
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Write the summary as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
    /// Draw the dig without running it, travel violations included
    #[arg(long)]
    draw_only: bool,
}

/// Runs the command; its exit status is 0 done, 2 bad input or refused, 3 fault or limit violation.
pub fn main(args: &RunArgs) -> ExitCode {
    match scenario(args) {
        Ok(outcome) => ExitCode::from(outcome.exit_status()),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

type AnyError = Box<dyn std::error::Error>;

fn scenario(args: &RunArgs) -> Result<Outcome, AnyError> {
    let scenario = Scenario::load(&args.scenario)?;
    let on = if args.on == On::Host { "host" } else { "emulator" };
    let folder = args.report.clone().unwrap_or_else(|| Path::new("report").join(&scenario.name));
    if args.draw_only {
        let found = report::draw_only(&scenario, &folder)?;
        let summary = Summary::without_run(&scenario, on, args.seed, found);
        finish(args, &summary, &folder)?;
        return Ok(Outcome::Done);
    }
    let run = match Run::new(&scenario, args.seed) {
        Err(RunError::Refused(found)) => return refuse(args, &scenario, on, found),
        other => other?,
    };
    let (log, emulator) = complete(args.on, run, &scenario)?;
    let summary = Summary::of(&scenario, on, args.seed, &log, emulator);
    report::write(&scenario, &log, &summary, &folder)?;
    finish(args, &summary, &folder)?;
    Ok(summary.outcome())
}

fn refuse(args: &RunArgs, scenario: &Scenario, on: &'static str, found: Vec<Violation>) -> Result<Outcome, AnyError> {
    eprintln!("{}: refused before motion, the dig leaves the travel limits:", scenario.name);
    for violation in &found {
        eprintln!("  {violation}");
    }
    eprintln!("--draw-only draws it all the same.");
    let summary = Summary::without_run(scenario, on, args.seed, found);
    write_json(args, &summary)?;
    Ok(summary.outcome())
}

fn complete(on: On, run: Run<'_>, scenario: &Scenario) -> Result<(Log, Option<EmulatorFigures>), AnyError> {
    let mut progress = Progress::new(&scenario.name, (scenario.duration_s * 1e3) as u64, 1e3, "s");
    let report = |done, all| progress.at(done, all);
    let result = match on {
        On::Host => (run.complete(&mut Host::new(&scenario.parameters)?, report)?, None),
        On::Emulator => {
            let image = Image::build("ecu-emulated")?;
            let mut emulator = Emulator::with_parameters(&image, &scenario.parameters)?;
            let log = run.complete(&mut emulator, report)?;
            let figures = EmulatorFigures::new(&log, &image, emulator.finish()?);
            (log, figures)
        }
    };
    progress.finish();
    Ok(result)
}

/// The table and the JSON.
fn finish(args: &RunArgs, summary: &Summary, folder: &Path) -> Result<(), AnyError> {
    let table = report::table(summary, folder);
    // With JSON on standard output nothing else may stand there.
    if args.json.as_deref() == Some(Path::new("-")) {
        eprint!("{table}");
    } else {
        std::io::stdout().write_all(table.as_bytes())?;
    }
    write_json(args, summary)
}

fn write_json(args: &RunArgs, summary: &Summary) -> Result<(), AnyError> {
    let Some(file) = &args.json else { return Ok(()) };
    let text = serde_json::to_string_pretty(summary)? + "\n";
    if file == Path::new("-") {
        std::io::stdout().write_all(text.as_bytes())?;
    } else {
        std::fs::write(file, text).map_err(|e| format!("cannot write {}: {e}", file.display()))?;
    }
    Ok(())
}
