//! `hil run SCENARIO`: simulate, report, and say how it ended.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::planar_arm;
use super::print;
use super::progress::Progress;
use crate::place::{Emulator, Host, Image, PlaceError};
use crate::report;
use crate::run::{EmulatorFigures, Log, Outcome, Run, RunError, Summary};
use crate::scenario::{Scenario, ScenarioError};
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

/// Runs the command; its exit status is 0 done, 1 it could not run or write, 2 bad input or refused, 3 fault or limit violation.
pub fn main(args: &RunArgs) -> ExitCode {
    match scenario(args) {
        Ok(outcome) => ExitCode::from(outcome.exit_status()),
        Err(Failure { status, error }) => {
            eprintln!("error: {error}");
            ExitCode::from(status)
        }
    }
}

/// Why there is no outcome.
struct Failure {
    status: u8,
    error: Box<dyn std::error::Error>,
}

impl From<ScenarioError> for Failure {
    fn from(error: ScenarioError) -> Self {
        Self { status: 2, error: error.into() }
    }
}

impl From<PlaceError> for Failure {
    fn from(error: PlaceError) -> Self {
        let status = if matches!(error, PlaceError::Parameters(_)) { 2 } else { 1 };
        Self { status, error: error.into() }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Place(error) => error.into(),
            error => Self { status: 2, error: error.into() },
        }
    }
}

/// A file or folder that cannot be written, by its path.
fn unwritable(path: &Path) -> impl Fn(std::io::Error) -> Failure {
    move |error| Failure { status: 1, error: format!("cannot write {}: {error}", path.display()).into() }
}

fn scenario(args: &RunArgs) -> Result<Outcome, Failure> {
    let foreign = if args.on == On::Emulator { Some("--on emulator") } else { args.draw_only.then_some("--draw-only") };
    let wanted = planar_arm::Wanted { foreign, report: args.report.as_deref(), json: args.json.as_deref() };
    if let Some(done) = planar_arm::run(&args.scenario, &wanted) {
        return done.map(|()| Outcome::Done).map_err(|(status, error)| Failure { status, error: error.into() });
    }
    let scenario = Scenario::load(&args.scenario)?;
    let on = if args.on == On::Host { "host" } else { "emulator" };
    let folder = args.report.clone().unwrap_or_else(|| Path::new("report").join(&scenario.name));
    if args.draw_only {
        let dig = scenario.parameters.dig.as_ref().ok_or_else(|| Failure {
            status: 2,
            error: format!("--draw-only draws a dig, and `{}` has none", scenario.name).into(),
        })?;
        let found = report::draw_only(&scenario, dig, &folder).map_err(unwritable(&folder))?;
        let summary = Summary::without_run(&scenario, on, args.seed, found);
        finish(args, &summary, &folder)?;
        return Ok(Outcome::Done);
    }
    let run = match Run::new(&scenario, args.seed) {
        Err(RunError::Refused(found)) => return refuse(args, &scenario, on, found),
        other => other?,
    };
    // Before the run, so that an unusable folder does not cost one.
    std::fs::create_dir_all(&folder).map_err(unwritable(&folder))?;
    let (log, emulator) = complete(args.on, run, &scenario)?;
    let summary = Summary::of(&scenario, on, args.seed, &log, emulator);
    report::write(&scenario, &log, &summary, &folder).map_err(unwritable(&folder))?;
    finish(args, &summary, &folder)?;
    Ok(summary.outcome())
}

fn refuse(args: &RunArgs, scenario: &Scenario, on: &'static str, found: Vec<Violation>) -> Result<Outcome, Failure> {
    eprintln!("{}: refused before motion, the dig leaves the travel limits:", scenario.name);
    for violation in &found {
        eprintln!("  {violation}");
    }
    eprintln!("--draw-only draws it all the same.");
    let summary = Summary::without_run(scenario, on, args.seed, found);
    write_json(args, &summary)?;
    Ok(summary.outcome())
}

fn complete(on: On, run: Run<'_>, scenario: &Scenario) -> Result<(Log, Option<EmulatorFigures>), PlaceError> {
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
fn finish(args: &RunArgs, summary: &Summary, folder: &Path) -> Result<(), Failure> {
    let table = report::table(summary, folder);
    // With JSON on standard output nothing else may stand there.
    if args.json.as_deref() == Some(Path::new("-")) {
        eprint!("{table}");
    } else {
        print(&table).map_err(unwritable(Path::new("standard output")))?;
    }
    write_json(args, summary)
}

fn write_json(args: &RunArgs, summary: &Summary) -> Result<(), Failure> {
    let Some(file) = &args.json else { return Ok(()) };
    let written = serde_json::to_string_pretty(summary).map_err(std::io::Error::from).and_then(|text| {
        let text = text + "\n";
        if file == Path::new("-") { print(&text) } else { std::fs::write(file, text) }
    });
    written.map_err(unwritable(file))
}
