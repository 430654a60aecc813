//! Helpers of the cross-crate tests. What tests of `kinematics-core` alone need stands in the package `reference` and is handed on.
//!
//! - [`boards`]: a board of plain values, and a record to store;
//! - [`browser`]: a page in headless Chromium, with a probe in it;
//! - [`handled`]: bytes from outside, for the fuzz targets and the test of their corpus;
//! - [`healthy`]: healthy actuators with noise and delay, for the diagnosis;
//! - [`can`]: the controller's node on a bench bus;
//! - [`obedient`]: a controller on a machine that does at once what it is told;
//! - [`plant`]: plants of the shipped machines, levers as currents, motions timed;
//! - [`ways`]: how far a run was from its lines;
//! - [`rig`]: a controller on a bench, its inputs set by hand;
//! - [`on_oil`]: a controller on the hydraulic plant, led by hand;
//! - [`promises`]: the text scan that keeps `unsafe`, trigonometry and host-dependent float functions out of the loop.

pub use reference::{
    differences, golden, jacobians, machines, measure, obstacle_kit, oracle, papers, rates, stated, sweep, wide,
};

pub mod boards;
pub mod browser;
pub mod can;
pub mod handled;
pub mod healthy;
pub mod obedient;
pub mod on_oil;
pub mod plant;
pub mod promises;
pub mod rig;
pub mod ways;
