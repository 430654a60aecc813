//! The two places the same application runs in: this process, and the emulated Cortex-M4F.

mod emulator;
mod host;
mod image;
mod one_core;

use firmware::Outputs;
use firmware::simulated::{Pins, Wires};

pub use emulator::Emulator;
pub use host::Host;
pub use image::{Image, ImageError};

/// What a tick gives back.
#[derive(Clone, Copy, Debug)]
pub struct Reply {
    /// The application's outputs.
    pub outputs: Outputs,
    /// What the board put on its pins.
    pub pins: Pins,
    /// What was measured beside them.
    pub timing: Timing,
}

/// How long a tick took, by the place's own measure; never part of the outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// Wall clock of this process, ns: noisy.
    Host {
        /// ns
        wall_ns: u32,
    },
    /// Counted by the emulator.
    Emulator {
        /// Start of the tick in virtual time, ns, wrapping.
        started_ns: u32,
        /// Instructions of `Ecu::tick`.
        instructions: u32,
    },
}

/// Where the application runs.
pub trait Place {
    /// One tick.
    ///
    /// # Errors
    /// The place is lost.
    fn tick(&mut self, wires: &Wires) -> Result<Reply, PlaceError>;
}

/// Why a place cannot run the application.
#[derive(Debug, thiserror::Error)]
pub enum PlaceError {
    /// The application refuses its parameters.
    #[error("the controller refuses its parameters: {0}")]
    Parameters(String),
    /// The image cannot be built.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The emulator cannot be started.
    #[error("cannot start qemu-system-arm ({0}); install it, or run cargo xtask test once, which does")]
    Start(std::io::Error),
    /// The emulator ended or stopped answering.
    #[error("lost the emulator: {why}{said}")]
    Lost {
        /// What happened.
        why: String,
        /// What it printed.
        said: String,
    },
    /// The image's answer is none.
    #[error("the image's answer is none: {0}")]
    Reply(#[from] firmware::simulated::link::ReplyError),
}
