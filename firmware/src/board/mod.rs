//! What stands between the application and a board's pins.
//!
//! - [`Board`] — all the application needs of a board in a tick;
//! - [`Controller`] — the application on any of them, one control period at a time;
//! - [`Parts`] — a board put together from embedded-hal's and embedded-can's traits;
//! - [`Disabled`] — the proof that nothing can move, which writing flash asks for;
//! - [`ads8688`] — the analogue-to-digital converters of the reference ECU;
//! - [`start_up`] — the pins' part of the self-test, before the first tick;
//! - [`signals`] — which signal stands on which of their channels.
//!
//! `docs/porting.md` walks through a new board.

pub mod ads8688;
mod controller;
mod disabled;
mod parts;
pub mod signals;
pub mod start_up;

use core::fmt;

use crate::io::Solenoids;
use ads8688::{AdcError, Codes};

pub use controller::{Controller, ControllerError};
pub use disabled::{Disabled, NotDisabled};
pub use parts::{Parts, Watchdog};

/// The operator's switches as the pins read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Switches {
    /// The enable switch is on.
    pub enable: bool,
    /// The emergency stop is pressed, or its wire is broken.
    pub emergency_stop: bool,
}

/// A pin or an output that does not do as it is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoardError {
    /// A solenoid's PWM output: spool, then 0 extend or 1 retract.
    Solenoid(usize, usize),
    /// The master cut-off's output.
    CutOff,
    /// The cut-off's read-back.
    CutOffReadBack,
    /// The enable switch's input.
    Enable,
    /// The emergency stop's input.
    EmergencyStop,
}

impl fmt::Display for BoardError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Solenoid(spool, solenoid) => {
                let name = crate::io::SPOOLS.get(*spool).copied().unwrap_or("unknown");
                write!(f, "PWM output of solenoid {solenoid} of the {name} spool")
            }
            Self::CutOff => f.write_str("output of the master cut-off"),
            Self::CutOffReadBack => f.write_str("read-back of the master cut-off"),
            Self::Enable => f.write_str("input of the enable switch"),
            Self::EmergencyStop => f.write_str("input of the emergency stop"),
        }
    }
}

impl core::error::Error for BoardError {}

/// Everything the application needs of a board, each tick, in this order: scan, switches, CAN in, tick, outputs, CAN out, watchdog.
pub trait Board {
    /// The CAN controller.
    type Can: embedded_can::nb::Can;

    /// All channels of both converters. One that fails leaves the other's codes good.
    fn scan(&mut self) -> [Result<Codes, AdcError>; 2];

    /// The operator's switches.
    ///
    /// # Errors
    /// An input that cannot be read; the caller takes it for a pressed emergency stop.
    fn switches(&mut self) -> Result<Switches, BoardError>;

    /// Sets the eight duties, 65535 is always on. Every output is set even if one of them fails.
    ///
    /// # Errors
    /// The first output that failed.
    fn drive(&mut self, duties: &[Solenoids<u16>; 4]) -> Result<(), BoardError>;

    /// Closes or opens the master cut-off.
    ///
    /// # Errors
    /// The output failed.
    fn set_cut_off(&mut self, closed: bool) -> Result<(), BoardError>;

    /// What the cut-off's read-back says: it follows the relay, not the output.
    ///
    /// # Errors
    /// The input cannot be read.
    fn cut_off_is_closed(&mut self) -> Result<bool, BoardError>;

    /// The CAN controller, for frames in and out; neither direction may block.
    fn can(&mut self) -> &mut Self::Can;

    /// Restarts the independent watchdog. Called once, at the end of a tick that ran to its end.
    fn feed_watchdog(&mut self);
}
