//! The application in this process.

use std::time::Instant;

use firmware::{Ecu, Inputs, Parameters, SelfTest};

use super::{Place, PlaceError, Reply, Timing};

/// The application compiled for the host.
#[derive(Clone, Debug)]
pub struct Host {
    ecu: Ecu,
}

impl Host {
    /// Builds the application.
    ///
    /// # Errors
    /// Parameters it refuses.
    pub fn new(parameters: &Parameters) -> Result<Self, PlaceError> {
        let mut ecu = Ecu::new(parameters).map_err(|error| PlaceError::Parameters(error.to_string()))?;
        ecu.self_tested(&SelfTest::PASSED);
        Ok(Self { ecu })
    }
}

impl Place for Host {
    fn tick(&mut self, inputs: &Inputs) -> Result<Reply, PlaceError> {
        let before = Instant::now();
        let outputs = self.ecu.tick(inputs);
        let wall_ns = before.elapsed().as_nanos().try_into().unwrap_or(u32::MAX);
        Ok(Reply { outputs, timing: Timing::Host { wall_ns } })
    }
}
