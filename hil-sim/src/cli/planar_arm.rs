//! `hil run` of a scenario of the kind `planar_arm`.

use std::path::Path;

use super::print;
use crate::planar_arm::run::{Summary, cases};
use crate::planar_arm::{PlanarArm, is_planar_arm};
use crate::report::{planar_arm_table, write_planar_arm};

/// What `hil run` was asked for beside the scenario.
#[derive(Debug)]
pub(super) struct Wanted<'a> {
    /// Whether an option was given that needs a machine, and which.
    pub(super) foreign: Option<&'static str>,
    /// Folder of the report, if not the usual one.
    pub(super) report: Option<&'a Path>,
    /// Where the JSON goes.
    pub(super) json: Option<&'a Path>,
}

/// Exit status and message of a failure.
pub(super) type Failed = (u8, String);

/// Runs `file` if it is of this kind; `None` where it is not, or cannot be read.
pub(super) fn run(file: &Path, wanted: &Wanted<'_>) -> Option<Result<(), Failed>> {
    let text = std::fs::read_to_string(file).ok().filter(|text| is_planar_arm(text))?;
    Some(run_text(&text, file, wanted))
}

fn run_text(text: &str, file: &Path, wanted: &Wanted<'_>) -> Result<(), Failed> {
    let bad_input = |what: String| (2, format!("{}: {what}", file.display()));
    if let Some(option) = wanted.foreign {
        return Err(bad_input(format!(
            "`{option}` needs a scenario with a machine; a `planar_arm` is a plan, run on the host"
        )));
    }
    let scenario = PlanarArm::from_toml(text).map_err(bad_input)?;
    let cases = cases(&scenario).map_err(|error| bad_input(error.to_string()))?;
    let summary = Summary::of(&scenario, &cases);
    let folder = wanted.report.map_or_else(|| Path::new("report").join(&scenario.name), Path::to_owned);
    let unwritable = |path: &Path| {
        let path = path.display().to_string();
        move |error: std::io::Error| (1, format!("cannot write {path}: {error}"))
    };
    write_planar_arm(&scenario, &cases, &summary, &folder).map_err(unwritable(&folder))?;
    let table = planar_arm_table(&summary, &folder);
    let to_stdout = wanted.json == Some(Path::new("-"));
    // With JSON on standard output nothing else may stand there.
    if to_stdout {
        eprint!("{table}");
    } else {
        print(&table).map_err(unwritable(Path::new("standard output")))?;
    }
    let Some(file) = wanted.json else { return Ok(()) };
    let json = serde_json::to_string_pretty(&summary).map_err(std::io::Error::from).map(|text| text + "\n");
    json.and_then(|text| if to_stdout { print(&text) } else { std::fs::write(file, text) }).map_err(unwritable(file))
}
