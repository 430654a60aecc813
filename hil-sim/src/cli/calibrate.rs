//! `hil calibrate`: every valve of a machine searched by command, as a table, JSON and a page.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use firmware::io::SPOOLS;

use super::print_with_json;
use super::progress::Progress;
use crate::record::any_scenario;
use crate::report::write_calibration;
use crate::service::calibrate::{Calibration, search, with_random_valves};

/// Arguments of `hil calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateArgs {
    /// A machine's name or file, or a scenario's file
    #[arg(long, value_name = "MACHINE", default_value = "zx200")]
    machine: String,
    /// Seed of the random valves and of the sensors' noise
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder of the page
    #[arg(long, value_name = "DIR", default_value = "report/calibration")]
    report: PathBuf,
    /// Write the figures as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// Runs the command; its exit status is 0, 1 when a valve was not found as promised, or 2 for bad input or a file that cannot be written.
pub fn main(args: &CalibrateArgs) -> ExitCode {
    match calibrate(args) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn calibrate(args: &CalibrateArgs) -> Result<bool, Box<dyn Error>> {
    let scenario = with_random_valves(&any_scenario(&args.machine)?, args.seed);
    let mut progress = Progress::new("calibrate", SPOOLS.len() as u64, 1.0, "valves");
    let mut searches = Vec::new();
    for spool in 0..SPOOLS.len() {
        searches.push(search(&scenario, spool, args.seed)?);
        progress.step();
    }
    progress.finish();
    let calibration = Calibration { machine: scenario.machine.name.clone(), seed: args.seed, searches };
    let page = args.report.join("calibration.html");
    write_calibration(&calibration, &args.report)
        .map_err(|error| format!("cannot write {}: {error}", args.report.display()))?;
    let table = calibration.to_table() + &format!("page: {}\n", page.display());
    print_with_json(&table, &calibration, args.json.as_deref())?;
    Ok(calibration.kept_promise())
}
