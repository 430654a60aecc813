//! The application in this process.

use std::time::Instant;

use firmware::board::Controller;
use firmware::can::address::Addresses;
use firmware::simulated::link::NAME;
use firmware::simulated::{SimulatedBoard, Wires};
use firmware::{Parameters, SelfTest};

use super::{Place, PlaceError, Reply, Timing};

/// The application and the simulated board compiled for the host.
#[derive(Debug)]
pub struct Host {
    board: SimulatedBoard,
    controller: Controller,
}

impl Host {
    /// Builds the application on a healthy board.
    ///
    /// # Errors
    /// Parameters it refuses.
    pub fn new(parameters: &Parameters) -> Result<Self, PlaceError> {
        let refused = |error: &dyn std::fmt::Display| PlaceError::Parameters(error.to_string());
        let mut controller = Controller::new(parameters, Addresses::DEFAULT, &NAME).map_err(|error| refused(&error))?;
        // The simulated board has none of the parts that the self-test tries.
        controller.self_tested(&SelfTest::PASSED);
        let board = SimulatedBoard::new().map_err(|error| refused(&error))?;
        Ok(Self { board, controller })
    }
}

impl Place for Host {
    fn tick(&mut self, wires: &Wires) -> Result<Reply, PlaceError> {
        self.board.connect(wires);
        let inputs = self.controller.read(self.board.parts(), wires.overrun);
        let before = Instant::now();
        let outputs = self.controller.tick(&inputs);
        let wall_ns = before.elapsed().as_nanos().try_into().unwrap_or(u32::MAX);
        self.controller.write(self.board.parts(), &outputs);
        Ok(Reply { outputs, pins: self.board.pins(), timing: Timing::Host { wall_ns } })
    }
}
