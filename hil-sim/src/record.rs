//! The parameter record as a file: made from a scenario or a machine, shown, compared, approved.
//!
//! The file holds the very bytes the controller keeps in flash (`firmware::store::copy`).

pub(crate) mod buckets;
mod view;

use std::path::{Path, PathBuf};

use firmware::Ecu;
use firmware::store::{CopyFault, Name, Sealed, StoredRecord};

use crate::machine_file::MachineFile;
use crate::scenario::Scenario;

pub use view::{Difference, differences, json, table};

/// Why a record cannot be made or read; every message names the file and the field.
#[derive(Debug, thiserror::Error)]
pub enum RecordFileError {
    /// A scenario or machine file at fault, or a name nobody knows.
    #[error("{0}")]
    Source(String),
    /// The record itself.
    #[error("{}: {what}", file.display())]
    Record {
        /// The file.
        file: PathBuf,
        /// Field and range.
        what: String,
    },
    /// The file cannot be read or written.
    #[error("cannot {verb} {}: {source}", file.display())]
    File {
        /// "read" or "write".
        verb: &'static str,
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

/// A record of a scenario's machine with its own bucket, `standard`, and those of a bucket file behind it.
///
/// # Errors
/// A fault named by file and field; with which bucket, where that matters.
pub fn make(source: &str, bucket_file: Option<&Path>) -> Result<Sealed, RecordFileError> {
    let (file, scenario) = scenario(source)?;
    let invalid = |file: &Path, what: String| RecordFileError::Record { file: file.to_owned(), what };
    let machine = Name::new(&scenario.machine.name)
        .ok_or_else(|| invalid(&file, "`machine`: its `name` must be 1 to 16 printable ASCII characters".to_owned()))?;
    let own = buckets::standard(&scenario.parameters.geometry);
    let buckets = buckets::all(own, bucket_file)?;
    let record = StoredRecord { machine, parameters: scenario.parameters, buckets, mounted: 0 };
    let named = bucket_file.unwrap_or(&file);
    let sealed = Sealed::new(&record).map_err(|fault| invalid(named, fault.to_string()))?;
    // The dig must be within reach with every bucket, or the controller would refuse to start with it.
    for (index, _) in record.buckets.iter().enumerate().filter(|(_, bucket)| bucket.is_some()) {
        let parameters = record.parameters_for(index).map_err(|error| invalid(named, error.to_string()))?;
        Ecu::new(&parameters).map_err(|error| invalid(named, format!("with `buckets[{index}]`: {error}")))?;
    }
    Ok(sealed)
}

/// The record in a file.
///
/// # Errors
/// A file that cannot be read, or what is wrong with its bytes.
pub fn read(file: &Path) -> Result<Sealed, RecordFileError> {
    let bytes =
        std::fs::read(file).map_err(|source| RecordFileError::File { verb: "read", file: file.into(), source })?;
    let bad = |fault: CopyFault| RecordFileError::Record { file: file.into(), what: fault.to_string() };
    let sealed = Sealed::from_bytes(&bytes).map_err(bad)?;
    if sealed.as_bytes().len() == bytes.len() {
        Ok(sealed)
    } else {
        Err(RecordFileError::Record { file: file.into(), what: "more bytes than the record has".to_owned() })
    }
}

/// Writes a record to a file.
///
/// # Errors
/// A file that cannot be written.
pub fn write(file: &Path, sealed: &Sealed) -> Result<(), RecordFileError> {
    std::fs::write(file, sealed.as_bytes()).map_err(|source| RecordFileError::File {
        verb: "write",
        file: file.into(),
        source,
    })
}

/// The scenario that is meant: its file, or the only one without events of a machine.
fn scenario(source: &str) -> Result<(PathBuf, Scenario), RecordFileError> {
    let file = PathBuf::from(source);
    let machine = MachineFile::load(source);
    let Ok(machine) = machine else {
        if file.is_file() {
            let scenario = Scenario::load(&file).map_err(|error| RecordFileError::Source(error.to_string()))?;
            return Ok((file, scenario));
        }
        let why = machine.err().map(|error| error.to_string()).unwrap_or_default();
        return Err(RecordFileError::Source(format!("{source} is neither a scenario's file nor a machine: {why}")));
    };
    let mut found = scenarios_of(&machine);
    match (found.pop(), found.is_empty()) {
        (Some(only), true) => Ok(only),
        (None, _) => Err(RecordFileError::Source(format!(
            "no scenario uses the machine `{}`: its valves and limits are not known; write one (docs/scenarios.md)",
            machine.name
        ))),
        (Some(last), false) => {
            let files: Vec<String> = found.iter().chain([&last]).map(|(file, _)| file.display().to_string()).collect();
            Err(RecordFileError::Source(format!(
                "the machine `{}` has several: name one of {}",
                machine.name,
                files.join(", ")
            )))
        }
    }
}

/// A scenario of this source, for a command that needs only the machine's valves and coils: a file, or the first of a machine.
///
/// # Errors
/// Neither, or a machine without a scenario.
pub fn any_scenario(source: &str) -> Result<Scenario, RecordFileError> {
    let machine = MachineFile::load(source).ok();
    match machine.and_then(|machine| scenarios_of(&machine).into_iter().next()) {
        Some((_, scenario)) => Ok(scenario),
        None => scenario(source).map(|(_, scenario)| scenario),
    }
}

/// Scenarios without events of this very machine, in `scenarios/` here or else in the workspace, by name.
fn scenarios_of(machine: &MachineFile) -> Vec<(PathBuf, Scenario)> {
    let folders = [PathBuf::from("scenarios"), Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")];
    let entries = folders.iter().find_map(|folder| folder.read_dir().ok());
    let mut files: Vec<PathBuf> = entries.into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let loaded = files.into_iter().filter_map(|file| Some((file.clone(), Scenario::load(&file).ok()?)));
    loaded.filter(|(_, scenario)| scenario.machine == *machine && scenario.events.is_empty()).collect()
}
