//! Helpers of the cross-crate tests.
//!
//! - [`machines`]: the four reference machines' pins as numbers;
//! - [`boards`]: a board of plain values, and a record to store;
//! - [`browser`]: a page in headless Chromium, with a probe in it;
//! - [`golden`]: the golden values, read from `tests/data`;
//! - [`wide`] and [`oracle`]: the reference the maps are measured against, in double-double arithmetic, by circles;
//! - [`differences`]: derivatives of the oracle by central differences;
//! - [`sweep`], [`measure`], [`stated`]: lengths over whole strokes, the worst error found, what `docs/accuracy.md` states;
//! - [`handled`]: bytes from outside, for the fuzz targets and the test of their corpus;
//! - [`healthy`]: healthy actuators with noise and delay, for the diagnosis;
//! - [`jacobians`]: Jacobians with known singular values;
//! - [`papers`]: the papers' formulas as printed, for the tests of their errata;
//! - [`can`]: the controller's node on a bench bus;
//! - [`plant`]: plants of the shipped machines, levers as currents, motions timed;
//! - [`ways`]: how far a run was from its lines;
//! - [`rig`]: a controller on a bench, its inputs set by hand;
//! - [`promises`]: the text scan that keeps `unsafe`, trigonometry and host-dependent float functions out of the loop.

pub mod boards;
pub mod browser;
pub mod can;
pub mod differences;
pub mod golden;
pub mod handled;
pub mod healthy;
pub mod jacobians;
pub mod machines;
pub mod measure;
pub mod oracle;
pub mod papers;
pub mod plant;
pub mod promises;
pub mod rates;
pub mod rig;
pub mod stated;
pub mod sweep;
pub mod ways;
pub mod wide;
