//! `hil params`: makes, shows, compares and approves parameter records.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::print;
use crate::record::{self, RecordFileError};

/// Arguments of `hil params`.
#[derive(Debug, Args)]
pub struct ParamsArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Make a record, not yet approved, of a scenario's file, or of a machine that one scenario without events uses
    Make {
        /// A scenario's file, or a machine's name or file
        source: String,
        /// Where to write the record
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        /// More buckets: a TOML file of [[bucket]] tables
        #[arg(long, value_name = "FILE")]
        buckets: Option<PathBuf>,
    },
    /// Show every field of a record
    Show {
        /// The record
        file: PathBuf,
        /// Write it as JSON to a file, or to standard output with `-`
        #[arg(long, value_name = "FILE|-")]
        json: Option<PathBuf>,
    },
    /// List the fields in which two records differ; exit status 1 if there are any
    Compare {
        /// The first record
        first: PathBuf,
        /// The second record
        second: PathBuf,
    },
    /// Sign a record off: without it the controller neither stores nor runs it
    Approve {
        /// The record
        file: PathBuf,
    },
}

/// Runs the command; its exit status is 0 done, 1 it could not write or records differ, or 2 bad input.
pub fn main(args: &ParamsArgs) -> ExitCode {
    match run(&args.what) {
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(if matches!(error, RecordFileError::File { verb: "write", .. }) { 1 } else { 2 })
        }
    }
}

fn run(what: &What) -> Result<u8, RecordFileError> {
    match what {
        What::Make { source, output, buckets } => {
            let sealed = record::make(source, buckets.as_deref())?;
            record::write(output, &sealed)?;
            let size = sealed.as_bytes().len();
            out(&format!("{}: {size} bytes, not approved\n", output.display()))?;
            Ok(0)
        }
        What::Show { file, json } => {
            let sealed = record::read(file)?;
            let Some(to) = json else {
                out(&record::table(&sealed))?;
                return Ok(0);
            };
            let text = format!("{:#}\n", record::json(&sealed));
            if to == Path::new("-") {
                out(&text)?;
            } else {
                std::fs::write(to, text).map_err(|source| unwritable(to, source))?;
            }
            Ok(0)
        }
        What::Compare { first, second } => {
            let differences = record::differences(&record::read(first)?, &record::read(second)?);
            for difference in &differences {
                let value = |value: &Option<String>| value.clone().unwrap_or_else(|| "none".to_owned());
                let (first, second) = (value(&difference.first), value(&difference.second));
                out(&format!("  {:<52} {first} → {second}\n", difference.field))?;
            }
            if differences.is_empty() {
                out("the records are the same\n")?;
            }
            Ok(u8::from(!differences.is_empty()))
        }
        What::Approve { file } => {
            let mut sealed = record::read(file)?;
            sealed.approve();
            record::write(file, &sealed)?;
            out(&format!("{}: approved\n", file.display()))?;
            Ok(0)
        }
    }
}

fn out(text: &str) -> Result<(), RecordFileError> {
    print(text).map_err(|source| unwritable(Path::new("standard output"), source))
}

fn unwritable(file: &Path, source: std::io::Error) -> RecordFileError {
    RecordFileError::File { verb: "write", file: file.into(), source }
}
