//! Which tests the repository has, by reading its sources.

use std::fs;
use std::path::{Path, PathBuf};

/// A test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Test {
    /// Where it stands, from the repository's root, with `/`.
    pub file: String,
    /// Its function's name.
    pub name: String,
    /// It runs with `cargo xtask test` alone: it needs the ARM target and the emulator.
    pub emulated: bool,
}

/// Where tests stand.
const FOLDERS: [&str; 6] =
    ["tests/tests", "hil-sim/tests", "hil-sim/src", "firmware/src", "kinematics-core/src", "sim-chips/src"];

/// Every test of the repository at `root`, in the order of files.
///
/// # Errors
/// A folder or file that cannot be read, by name.
pub fn all(root: &Path) -> Result<Vec<Test>, String> {
    let mut files = Vec::new();
    for folder in FOLDERS {
        rust_files(&root.join(folder), &mut files)?;
    }
    files.sort();
    let mut tests = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).map_err(|error| format!("cannot read {}: {error}", file.display()))?;
        let parts = file.strip_prefix(root).unwrap_or(&file).components();
        let name = parts.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/");
        tests.extend(of_source(&name, &text));
    }
    Ok(tests)
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) -> Result<(), String> {
    let failed = |error| format!("cannot read {}: {error}", folder.display());
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            rust_files(&path, found)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    Ok(())
}

/// The tests of one file: a line `#[test]`, other attributes, then the function.
pub fn of_source(file: &str, text: &str) -> Vec<Test> {
    let mut tests = Vec::new();
    let (mut is_test, mut emulated) = (false, false);
    for line in text.lines().map(str::trim_start) {
        let after_fn = line.strip_prefix("pub ").unwrap_or(line).strip_prefix("fn ");
        if line.starts_with("#[") {
            is_test |= line.starts_with("#[test]");
            emulated |= line.starts_with("#[ignore");
        } else if let Some(rest) = after_fn {
            if is_test {
                let name = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                tests.push(Test { file: file.to_owned(), name, emulated });
            }
            (is_test, emulated) = (false, false);
        } else if !line.starts_with("//") {
            // Something else between attributes and function: they belong to it.
            (is_test, emulated) = (false, false);
        }
    }
    tests
}
