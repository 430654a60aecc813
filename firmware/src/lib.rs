//! The excavator's control application: sensor codes in, coil currents out, a thousand times a second.
//!
//! [`Ecu::tick`] is all of it: deterministic, without clock, I/O or allocation, infallible once built. It is one straight
//! pipeline; each stage has a configuration built once from [`Parameters`] and a small state, and hands on one value:
//!
//! ```text
//! Inputs → sensing → diagnosis → pose → motion → fence → valve → Outputs
//!              the supervisor watches every stage and alone opens the gate between fence and valve
//! ```
//!
//! The images (package `images`) and the desktop harness are thin callers of it.
#![no_std]
#![forbid(unsafe_code)]

pub mod board;
mod bytes;
pub mod calibration;
pub mod can;
pub mod command;
pub mod constants;
pub mod diagnosis;
pub mod dig;
mod ecu;
pub mod fault;
pub mod fence;
mod fitted;
pub mod frame;
mod freeze_frame;
pub mod grade;
pub mod io;
pub mod law;
pub mod motion;
pub mod moves;
mod near;
pub mod parameters;
pub mod path;
pub mod pose;
pub mod sensing;
pub mod service;
#[cfg(feature = "simulated")]
pub mod simulated;
pub mod store;
pub mod supervisor;
pub mod travel;
pub mod trouble;
pub mod valve;

pub use command::Intent;
pub use ecu::Ecu;
pub use fault::{Fault, State};
pub use fitted::Fitted;
pub use freeze_frame::FreezeFrame;
pub use io::{Inputs, Outputs, Request};
pub use parameters::{ParameterError, Parameters};
pub use supervisor::SelfTest;

/// The control period, s.
pub const TICK_S: f32 = 0.001;

/// The control period, s; rounded to f32 it is [`TICK_S`].
const TICK: f64 = 0.001;

/// Ticks a second.
pub const TICKS_PER_S: u32 = 1000;
