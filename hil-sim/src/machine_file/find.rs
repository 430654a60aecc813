//! From a name or a path to a file: `machines/` of the current directory first, then the workspace's.

use std::path::{Path, PathBuf};

use super::MachineFileError;

/// Folders in which a bare name is looked up, in this order.
fn folders() -> [PathBuf; 2] {
    [PathBuf::from("machines"), Path::new(env!("CARGO_MANIFEST_DIR")).join("../machines")]
}

/// The file that `name_or_path` means.
pub(super) fn find(name_or_path: &str) -> Result<PathBuf, MachineFileError> {
    let path = PathBuf::from(name_or_path);
    let bare = path.components().count() == 1 && path.file_name().is_some_and(|name| name == name_or_path);
    if bare && path.extension().is_none_or(|extension| extension != "toml") {
        let file_name = format!("{name_or_path}.toml");
        if let Some(file) = folders().iter().map(|folder| folder.join(&file_name)).find(|file| file.is_file()) {
            return Ok(file);
        }
    }
    // A path that exists is read (and a folder fails there); a path that looks like one gets the system's message.
    if path.is_file() || (!name_or_path.is_empty() && !bare) || path.extension().is_some_and(|e| e == "toml") {
        return Ok(path);
    }
    Err(MachineFileError::Unknown { name: name_or_path.to_owned(), available: available() })
}

/// Names of the machines in the folders, sorted, each once.
fn available() -> Vec<String> {
    let mut names: Vec<String> = folders()
        .iter()
        .filter_map(|folder| folder.read_dir().ok())
        .flat_map(|entries| entries.filter_map(Result::ok))
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .filter_map(|path| path.file_stem().and_then(|stem| stem.to_str()).map(str::to_owned))
        .collect();
    names.sort();
    names.dedup();
    names
}
