//! What a run leaves: a row a tick, the machine from inside, faults, stops, the hash of all outputs.

use std::time::Duration;

use firmware::{Fault, Outputs};
use kinematics_core::{Cylinders, Joints, Rotor};

use super::inside::{GroundSeen, Inside};
use crate::place::Timing;

/// One tick.
#[derive(Clone, Debug)]
pub struct Row {
    /// s
    pub time_s: f64,
    /// The plant's true lengths, m.
    pub lengths: Cylinders<f64>,
    /// The plant's true swing θ1.
    pub swing: Option<Rotor<f64>>,
    /// The plant's true tip: reach and height in the boom's plane, m.
    pub tip: Option<[f64; 2]>,
    /// The plant's true joints.
    pub joints: Option<Joints<f64>>,
    /// Where the dig wants the tip at this moment, m; `None` when not digging.
    pub reference: Option<[f64; 2]>,
    /// The controller's outputs.
    pub outputs: Outputs,
}

impl Row {
    /// |reference − true tip|, m; `None` when not digging.
    pub fn tip_error_m(&self) -> Option<f64> {
        let ([x, z], [wanted_x, wanted_z]) = (self.tip?, self.reference?);
        Some(libm::hypot(wanted_x - x, wanted_z - z))
    }
}

/// A fault as it was latched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaultSeen {
    /// Which.
    pub fault: Fault,
    /// When, s.
    pub at_s: f64,
}

/// A cylinder that began to press against a travel stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopHit {
    /// Which.
    pub cylinder: &'static str,
    /// When, s.
    pub at_s: f64,
}

/// Everything of one run.
#[derive(Clone, Debug)]
pub struct Log {
    /// A row a tick.
    pub rows: Vec<Row>,
    /// A measurement a tick.
    pub timing: Vec<Timing>,
    /// The machine from inside, every few ticks.
    pub inside: Vec<Inside>,
    /// The ground; empty of a plant without any.
    pub ground: GroundSeen,
    /// Every fault latched.
    pub faults: Vec<FaultSeen>,
    /// Every stop hit.
    pub stop_hits: Vec<StopHit>,
    /// CRC-64/XZ of every byte of every tick's outputs.
    pub output_hash: u64,
    /// Wall clock of all ticks together.
    pub wall: Duration,
    held: Vec<&'static str>,
}

impl Log {
    pub(super) fn with_capacity(ticks: usize) -> Self {
        Self {
            rows: Vec::with_capacity(ticks),
            timing: Vec::with_capacity(ticks),
            inside: Vec::new(),
            ground: GroundSeen::default(),
            faults: Vec::new(),
            stop_hits: Vec::new(),
            output_hash: 0,
            wall: Duration::ZERO,
            held: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, row: Row, timing: Timing) {
        let before = self.rows.last().and_then(|row| row.outputs.fault);
        if let Some(fault) = row.outputs.fault.filter(|_| row.outputs.fault != before) {
            self.faults.push(FaultSeen { fault, at_s: row.time_s });
        }
        self.rows.push(row);
        self.timing.push(timing);
    }

    /// Notes which cylinders a stop holds back now.
    pub(super) fn stops(&mut self, at_s: f64, held: &[&'static str]) {
        for &cylinder in held {
            if !self.held.contains(&cylinder) {
                self.stop_hits.push(StopHit { cylinder, at_s });
            }
        }
        self.held = held.to_vec();
    }

    pub(super) fn finish(&mut self, output_hash: u64, wall: Duration) {
        (self.output_hash, self.wall) = (output_hash, wall);
    }

    /// The dig was followed to its end.
    pub fn dig_completed(&self, dig_duration_s: f64) -> bool {
        let last = self.rows.iter().map(|row| row.outputs.dig_tick).max().unwrap_or(0);
        // A dig that ends between two ticks ends at the nearer one.
        f64::from(last) > dig_duration_s * f64::from(firmware::TICKS_PER_S) - 1.0
    }
}
