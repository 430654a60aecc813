//! Simulated machine and hardware for the excavator controller.
//!
//! - [`machine_file`] — a machine's geometry from TOML;
//! - [`machine_report`] — what an engineer asks of a machine as a whole;
//! - [`effort`] — least-effort moves against minimum-norm ones;
//! - [`scenario`] — what to simulate: machine, dig, operator, plant, events;
//! - [`travel`] — the dig against the travel limits, before anything moves;
//! - [`plant`] — the simulated machine;
//! - [`elf`] — what a linked image holds, who calls whom in it, and what stack that takes;
//! - [`place`] — where the application runs: this process, or the emulated ECU;
//! - [`planar_arm`] — scenarios of a planar arm round an obstacle, without a machine;
//! - [`run`] — all of it together, tick by tick;
//! - [`record`] — the controller's parameter record as a file;
//! - [`faults`] — the fault campaign: what is seen, how soon, and how far the tip still goes;
//! - [`fence`] — random operators before random fences;
//! - [`report`] — what a run looks like;
//! - [`score`] — the motion on plants that no tuning has seen;
//! - [`scenes`] — obstacle avoidance in thousands of random scenes;
//! - [`icd`] — the page and the DBC file of the CAN bus;
//! - [`supervisor_page`] — the supervisor drawn, and the page of faults;
//! - [`coil_trial`] — the coil current loop on simulated solenoids: steps, dither, sweeps, faults;
//! - [`plant_trial`] — strokes of the hydraulic plant at full lever;
//! - [`labels`] — the figure of `docs/kinematics.md`;
//! - [`cli`] — the `hil` command.

pub mod cli;
pub mod coil_trial;
pub mod effort;
pub mod elf;
pub mod faults;
pub mod fence;
pub mod icd;
pub mod labels;
pub mod machine_file;
pub mod machine_report;
pub mod place;
pub mod planar_arm;
pub mod plant;
pub mod plant_trial;
pub mod record;
pub mod report;
pub mod run;
pub mod scenario;
pub mod scenes;
pub mod score;
pub mod supervisor_page;
mod toml_text;
pub mod travel;
