//! Simulated machine and hardware for the excavator controller.
//!
//! - [`machine_file`] — a machine's geometry from TOML;
//! - [`machine_report`] — what an engineer asks of a machine as a whole;
//! - [`scenario`] — what to simulate: machine, dig, operator, plant, events;
//! - [`travel`] — the dig against the travel limits, before anything moves;
//! - [`plant`] — the simulated machine;
//! - [`place`] — where the application runs: this process, or the emulated ECU;
//! - [`run`] — all of it together, tick by tick;
//! - [`fence`] — random operators before random fences;
//! - [`report`] — what a run looks like;
//! - [`labels`] — the figure of `docs/kinematics.md`;
//! - [`cli`] — the `hil` command.

pub mod cli;
pub mod fence;
pub mod labels;
pub mod machine_file;
pub mod machine_report;
pub mod place;
pub mod plant;
pub mod report;
pub mod run;
pub mod scenario;
mod toml_text;
pub mod travel;
