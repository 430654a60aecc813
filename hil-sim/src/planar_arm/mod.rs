//! Scenarios of the kind `planar_arm`: Park 2008's four-link arm to a point, round a point obstacle.
//!
//! - [`file`](mod@file) — the scenario from TOML;
//! - [`run`] — the three runs of the paper, and their summary.

pub mod file;
pub mod run;

pub use file::PlanarArm;

/// The `kind` of these scenarios.
pub const KIND: &str = "planar_arm";

/// Whether this text is such a scenario. What is no TOML at all is not.
pub fn is_planar_arm(text: &str) -> bool {
    let table = text.trim_start_matches('\u{feff}').parse::<toml::Table>();
    table.is_ok_and(|table| table.get("kind").and_then(toml::Value::as_str) == Some(KIND))
}
