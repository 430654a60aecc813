//! `hil pose`: any one description of a pose in, all three out.

mod angle;
pub mod description;
mod failure;
mod messages;
mod progress;
pub mod rates;
pub mod report;
pub mod rows;
pub mod solver;

use std::ffi::OsString;
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::process::ExitCode;

use clap::{ArgGroup, Args, ValueEnum};
use kinematics_core::Real;
use serde::Serialize;

use crate::machine_file::MachineFile;
use description::Description;
pub use failure::{Failure, Kind};
use solver::Solver;

/// A number the maps compute with and the command prints, shortest round-trip of its own type.
pub trait Number: Real + Display + Serialize {}

impl Number for f32 {}
impl Number for f64 {}

/// The number type of the computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    /// What the ECU computes
    F32,
    /// For research
    F64,
}

/// Options of `hil pose`.
#[derive(Debug, Args)]
#[command(group(ArgGroup::new("input").required(true).multiple(false)))]
pub struct PoseArgs {
    /// Machine: a name in machines/ or the path of a machine file
    #[arg(long, value_name = "NAME|FILE")]
    machine: String,

    /// Cylinder lengths between pins [m]
    #[arg(long, value_name = "B,A,K", group = "input", allow_hyphen_values = true, value_parser = description::triple)]
    cylinders: Option<[f64; 3]>,

    /// Joint angles θ2, θ3, θ4 [degrees]
    #[arg(long, value_name = "B,A,K", group = "input", allow_hyphen_values = true, value_parser = description::triple)]
    joints: Option<[f64; 3]>,

    /// Bucket tip: signed reach and height in the boom's plane [m], from the swing axis at boom-pin height; pitch [degrees]
    #[arg(long, value_name = "X,Z,PITCH", group = "input", allow_hyphen_values = true, value_parser = description::triple)]
    tip: Option<[f64; 3]>,

    /// Many poses, one a row; `-` reads standard input. The header names the input: boom_m,arm_m,bucket_m or
    /// boom_deg,arm_deg,bucket_deg or x_m,z_m,pitch_deg, with or without swing_deg
    #[arg(long, value_name = "FILE|-", group = "input")]
    csv: Option<String>,

    /// Swing angle [degrees], positive to the left [default: 0]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = description::number)]
    swing: Option<f64>,

    /// Number type of the computation
    #[arg(long, value_enum, default_value = "f32")]
    precision: Precision,

    /// Print JSON (with --csv: no message for people on standard error)
    #[arg(long, value_name = "-", num_args = 0..=1, default_missing_value = "-", value_parser = ["-"])]
    json: Option<String>,

    /// Moment arms, Jacobians of joints and cylinders, condition number, velocity and force ellipse too
    #[arg(long, conflicts_with = "csv")]
    rates: bool,

    /// Outside the stroke too, with `within_stroke` false
    #[arg(long)]
    allow_outside: bool,
}

/// Runs the command; 0, or 2 with the error as JSON on standard output.
pub fn main(args: &PoseArgs) -> ExitCode {
    let outcome = match args.precision {
        Precision::F32 => run::<f32>(args),
        Precision::F64 => run::<f64>(args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => fail(&failure, args.json.is_some()),
    }
}

/// An error of the command line's form, reported like every other error of a pose.
pub fn usage_error(error: &clap::Error, arguments: &[OsString]) -> ExitCode {
    let rendered = error.render().to_string();
    // The first paragraph says what is wrong; usage and tips follow it.
    let first = rendered.split("\n\n").next().unwrap_or_default();
    let message = first.split_whitespace().collect::<Vec<_>>().join(" ");
    let message = message.strip_prefix("error: ").unwrap_or(&message);
    let json = arguments.iter().any(|a| a == "--json" || a == "--json=-");
    fail(&Failure::invalid_input(message.to_owned()), json)
}

fn fail(failure: &Failure, json: bool) -> ExitCode {
    if !json {
        eprintln!("error: {}", failure.message);
    }
    // Nothing is left to tell if nobody reads standard output any more.
    let _ = writeln!(io::stdout(), "{}", failure.to_json());
    ExitCode::from(2)
}

fn run<T: Number>(args: &PoseArgs) -> Result<(), Failure> {
    let machine = MachineFile::load(&args.machine).map_err(|e| Failure::invalid_input(e.to_string()))?;
    let solver = Solver::<T>::new(&machine.geometry)
        .map_err(|e| Failure::invalid_input(format!("{}: {e}", args.machine)))?
        .allowing_outside(args.allow_outside)
        .with_rates(args.rates);
    let swing_deg = args.swing;
    let description = match (args.cylinders, args.joints, args.tip, &args.csv) {
        (Some(lengths), ..) => Description::Cylinders(lengths),
        (_, Some(angles), ..) => Description::Joints(angles),
        (_, _, Some(tip), _) => Description::Tip(tip),
        (.., Some(source)) => return table_of_rows(&solver, source, swing_deg),
        // The group makes one of them present.
        (None, None, None, None) => return Err(Failure::invalid_input("no pose is given".into())),
    };
    let report = solver.pose(&description, swing_deg.unwrap_or(0.0))?;
    let text = if args.json.is_some() { report.to_json() } else { report.to_table(&machine.name) };
    written(writeln!(io::stdout(), "{}", text.trim_end()))
}

fn table_of_rows<T: Number>(solver: &Solver<T>, source: &str, swing_deg: Option<f64>) -> Result<(), Failure> {
    let input: Box<dyn BufRead> = if source == "-" {
        Box::new(io::stdin().lock())
    } else {
        let file = File::open(source).map_err(|e| Failure::invalid_input(format!("{source}: {e}")))?;
        Box::new(BufReader::with_capacity(1 << 16, file))
    };
    rows::convert(solver, swing_deg, input, BufWriter::new(io::stdout().lock()))
}

/// A reader who has seen enough (`| head`) is no error.
fn written(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::invalid_input(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}
