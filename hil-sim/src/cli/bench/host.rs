//! Instruction counts on the host, by callgrind: two runs of a map that differ in their number, less what counting costs.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use super::AnyError;
use crate::cli::progress::Progress;

/// Runs of a map: the first count warms up, the second is longer by as many calls as are measured.
const RUNS: [u64; 2] = [640, 1280];

/// Instructions per call of every map of the bench program, or `None` without valgrind.
pub(super) fn maps(peers: bool) -> Result<Option<BTreeMap<String, u64>>, AnyError> {
    if Command::new("valgrind").arg("--version").stdout(Stdio::null()).status().is_err() {
        return Ok(None);
    }
    let program = build(peers)?;
    let list = Command::new(&program).arg("list").output()?;
    let names: Vec<String> = String::from_utf8(list.stdout)?.lines().map(str::to_owned).collect();
    let mut progress = Progress::new("callgrind", names.len() as u64, 1.0, "maps");
    let mut counts = BTreeMap::new();
    for (i, name) in names.iter().enumerate() {
        let [fewer, more] = [collected(&program, name, RUNS[0])?, collected(&program, name, RUNS[1])?];
        counts.insert(name.clone(), more.saturating_sub(fewer) / (RUNS[1] - RUNS[0]));
        progress.at(i as u32 + 1, names.len() as u32);
    }
    progress.finish();
    let counting = counts.remove("nothing").ok_or("the bench program has no map `nothing`")?;
    for count in counts.values_mut() {
        *count = count.saturating_sub(counting);
    }
    Ok(Some(counts))
}

/// Builds the bench program; gives its path.
fn build(peers: bool) -> Result<PathBuf, AnyError> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let mut command = Command::new(cargo);
    command
        .args(["build", "--release", "--package", "bench", "--bin", "host-maps"])
        .args(["--message-format", "json-render-diagnostics"])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .stderr(Stdio::inherit());
    if peers {
        command.args(["--features", "peers"]);
    }
    let output = command.output()?;
    let messages = String::from_utf8(output.stdout)?;
    let mut executables = messages.lines().filter_map(|line| {
        let message: Value = serde_json::from_str(line).ok()?;
        Some(PathBuf::from(message["executable"].as_str()?))
    });
    match executables.next_back() {
        Some(path) if output.status.success() => Ok(path),
        _ => Err("building the bench program failed (see above)".into()),
    }
}

/// What callgrind counts for so many calls of a map, the program's start included.
fn collected(program: &Path, map: &str, calls: u64) -> Result<u64, AnyError> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([map, &calls.to_string()])
        .output()?;
    let said = String::from_utf8_lossy(&output.stderr);
    let count = said.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok());
    count.ok_or_else(|| format!("callgrind counted nothing for `{map}`:\n{said}").into())
}
