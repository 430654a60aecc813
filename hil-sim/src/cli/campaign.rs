//! What commands of many runs have in common: their part of the runs, the progress, the exit status.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;

use clap::Args;
use serde::Serialize;

use super::print_with_json;
use super::progress::Progress;
use crate::shard::Shard;

/// Which part of the runs, and where the outcome goes.
#[derive(Debug, Args)]
pub(super) struct PartArgs {
    /// Only every n-th case, the i-th first: 0/1 is all
    #[arg(long, default_value = "0/1", value_name = "I/N", value_parser = shard)]
    pub(super) shard: Shard,
    /// Write the outcome as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    pub(super) json: Option<PathBuf>,
}

/// `--shard I/N`.
fn shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    match parts {
        Some((index, of)) if index < of => Ok(Shard { index, of }),
        _ => Err("it must be I/N with I below N, such as 0/4".to_owned()),
    }
}

/// Does work of so many steps, of which `per_unit` make one `unit`; it calls what it is given after each.
pub(super) fn counted<T>(
    what: &str,
    steps: u64,
    (per_unit, unit): (f64, &'static str),
    work: impl FnOnce(&(dyn Fn() + Sync)) -> Result<T, String>,
) -> Result<T, Box<dyn Error>> {
    let progress = Mutex::new(Progress::new(what, steps, per_unit, unit));
    let done = work(&|| {
        // A poisoned lock only means that another run has panicked: it will tell.
        if let Ok(mut progress) = progress.lock() {
            progress.step();
        }
    })?;
    if let Ok(progress) = progress.into_inner() {
        progress.finish();
    }
    Ok(done)
}

/// Prints the outcome; exit status 0, 1 it could not be written, 2 there is none, or 3 it is not `good`.
pub(super) fn conclude<R: Serialize>(
    outcome: Result<R, Box<dyn Error>>,
    table: impl FnOnce(&R) -> String,
    json: Option<&Path>,
    good: impl FnOnce(&R) -> bool,
) -> ExitCode {
    let report = match outcome {
        Ok(report) => report,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::from(2);
        }
    };
    if let Err(error) = print_with_json(&table(&report), &report, json) {
        eprintln!("error: {error}");
        return ExitCode::from(1);
    }
    ExitCode::from(if good(&report) { 0 } else { 3 })
}
