//! `hil icd`, `hil supervisor`, `hil fault-table` and `hil safety`: write pages made from the firmware's tables, the fault campaign and the
//! tests' names, or check that they are up to date.

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::campaign::counted;
use crate::faults::{campaign, cases};
use crate::machine_file::MachineFile;
use crate::shard::Shard;
use crate::{fault_table, icd, safety_page, supervisor_page};

/// Arguments of `hil icd`, `hil supervisor`, `hil fault-table` and `hil safety`.
#[derive(Debug, Args)]
pub struct IcdArgs {
    /// Write nothing; fail when a file is not what would be written
    #[arg(long)]
    check: bool,
    /// The repository's root
    #[arg(long, value_name = "FOLDER", default_value = ".")]
    root: PathBuf,
}

/// Runs `hil icd`; its exit status is 0, 1 when a file is out of date, 2 when one cannot be read or written.
pub fn main(args: &IcdArgs) -> ExitCode {
    write_or_check(args, &icd::files(), "icd")
}

/// Runs `hil supervisor`, with the same exit status.
pub fn supervisor(args: &IcdArgs) -> ExitCode {
    write_or_check(args, &supervisor_page::files(), "supervisor")
}

/// Runs `hil fault-table`, with the same exit status; 2 too when the machine cannot be simulated.
pub fn fault_table(args: &IcdArgs) -> ExitCode {
    let report = MachineFile::load(fault_table::MACHINE).map_err(Into::into).and_then(|machine| {
        let steps = cases(fault_table::SEEDS);
        counted(&machine.name, steps, (1.0, "runs"), |done| {
            campaign(&machine, fault_table::SEEDS, fault_table::SEED, Shard::WHOLE, done)
        })
    });
    match report {
        Ok(report) => write_or_check(args, &fault_table::files(&report), "fault-table"),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Runs `hil safety`, with the same exit status; 1 too when a requirement's test is not there.
pub fn safety(args: &IcdArgs) -> ExitCode {
    match safety_page::files(&args.root) {
        Ok(files) => write_or_check(args, &files, "safety"),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write_or_check(args: &IcdArgs, files: &[(&'static str, String)], command: &str) -> ExitCode {
    let mut stale = false;
    for (name, text) in files {
        let path = args.root.join(name);
        if args.check {
            match fs::read_to_string(&path) {
                Ok(found) if found == *text => println!("{name}: up to date"),
                Ok(_) => {
                    eprintln!("{name}: out of date; run cargo hil {command}");
                    stale = true;
                }
                Err(error) => return failed("read", &path, &error),
            }
        } else if let Err(error) = fs::write(&path, text) {
            return failed("write", &path, &error);
        } else {
            println!("{name}: written");
        }
    }
    if stale { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

fn failed(what: &str, path: &std::path::Path, error: &std::io::Error) -> ExitCode {
    eprintln!("error: cannot {what} {}: {error}", path.display());
    ExitCode::from(2)
}
