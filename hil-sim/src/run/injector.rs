//! What goes wrong in a run beyond its scenario's events.

use firmware::simulated::{Pins, Wires};

use crate::plant::Plant;

/// Spoils a run, tick by tick.
pub trait Injector {
    /// Changes what the board is about to read at `time_s`.
    fn wires(&mut self, time_s: f64, wires: &mut Wires);

    /// Changes the machine that is about to be driven by these pins.
    fn plant(&mut self, time_s: f64, plant: &mut Plant, pins: &Pins);
}

/// Nothing goes wrong.
#[derive(Clone, Copy, Debug)]
pub struct Healthy;

impl Injector for Healthy {
    fn wires(&mut self, _: f64, _: &mut Wires) {}

    fn plant(&mut self, _: f64, _: &mut Plant, _: &Pins) {}
}
