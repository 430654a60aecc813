//! `hil coil`: the coil current loop on simulated solenoids, as a table, JSON and a page.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::print_with_json;
use crate::coil_trial::CoilReport;
use crate::report::write_coil;

/// Arguments of `hil coil`.
#[derive(Debug, Args)]
pub struct CoilArgs {
    /// Folder of the page
    #[arg(long, value_name = "DIR", default_value = "report/coil")]
    report: PathBuf,
    /// Write the figures as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// Runs the command; its exit status is 0, 1 when a fault was not called what it is, or 2 when it could not write.
pub fn main(args: &CoilArgs) -> ExitCode {
    match coil(args) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn coil(args: &CoilArgs) -> Result<bool, Box<dyn std::error::Error>> {
    let report = CoilReport::new()?;
    write_coil(&report, &args.report).map_err(|error| format!("cannot write {}: {error}", args.report.display()))?;
    let table = report.to_table() + &format!("page: {}\n", args.report.join("coil.html").display());
    print_with_json(&table, &report, args.json.as_deref())?;
    Ok(report.faults.iter().all(|row| row.right))
}
