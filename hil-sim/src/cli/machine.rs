//! `hil machine NAME|FILE`: what an engineer asks of a machine.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::print_with_json;
use super::progress::Progress;
use crate::machine_file::MachineFile;
use crate::machine_report::MachineReport;
use crate::report::write_machine;

/// Arguments of `hil machine`.
#[derive(Debug, Args)]
pub struct MachineArgs {
    /// A machine's name, or the path of a machine file
    machine: String,
    /// Folder of the page [default: report/machine-NAME]
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// The tip accuracy the sensors' resolution is given for, mm
    #[arg(long, value_name = "MM", default_value_t = 10.0)]
    tip_accuracy: f64,
    /// Write the report as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// Runs the command; its exit status is 0, 1 it could not write, or 2 bad input.
pub fn main(args: &MachineArgs) -> ExitCode {
    let report = match report(args) {
        Ok(done) => done,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::from(2);
        }
    };
    match write(args, &report.0, &report.1) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(1)
        }
    }
}

type AnyError = Box<dyn std::error::Error>;

fn report(args: &MachineArgs) -> Result<(MachineFile, MachineReport), AnyError> {
    let wanted_mm = args.tip_accuracy;
    if !(wanted_mm > 0.0 && wanted_mm <= 1000.0) {
        return Err(format!("`--tip-accuracy` is {wanted_mm} but must be above 0 and at most 1000 mm").into());
    }
    let file = MachineFile::load(&args.machine)?;
    let mut progress = Progress::new(&file.name, 41, 1.0, "boom lengths");
    let report = MachineReport::new(&file, wanted_mm * 1e-3, |done, all| progress.at(done, all))?;
    progress.finish();
    Ok((file, report))
}

fn write(args: &MachineArgs, file: &MachineFile, report: &MachineReport) -> Result<(), AnyError> {
    // A machine's name may be anything; the folder is named by plain letters of it.
    let plain: String = report.machine.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let folder = args.report.clone().unwrap_or_else(|| Path::new("report").join(format!("machine-{plain}")));
    write_machine(file, report, &folder).map_err(|error| format!("cannot write {}: {error}", folder.display()))?;
    let table = report.to_table() + &format!("  {:<26} {}\n", "page", folder.join("machine.html").display());
    print_with_json(&table, report, args.json.as_deref())
}
