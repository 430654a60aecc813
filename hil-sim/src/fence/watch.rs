//! The true clearance of the simulated machine, in double precision: nothing of the controller's own is believed.

use firmware::fence::FenceParameters;
use kinematics_core::planning::limits::Limits;
use kinematics_core::planning::outline::{Outline, PlacedOutline};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Machine, Rotor};

use crate::run::{Log, Row};
use crate::scenario::Scenario;

/// Looks at a fence from outside.
#[derive(Clone, Debug)]
pub struct Watch {
    machine: Machine<f64>,
    outline: Outline<f64>,
    limits: Limits<f64>,
    base: BasePlacement<f64>,
}

impl Watch {
    /// Of this fence.
    pub fn new(machine: Machine<f64>, outline: Outline<f64>, fence: &FenceParameters) -> Self {
        let base = BasePlacement::level(Rotor::IDENTITY, [0.0, 0.0, fence.boom_pin_height_m]);
        Self { machine, outline, limits: fence.limits(), base }
    }

    /// Of a scenario's fence; `None` without one.
    pub fn of(scenario: &Scenario) -> Option<Self> {
        let fence = scenario.parameters.fence.as_ref()?;
        let geometry = &scenario.machine.geometry;
        Some(Self::new(Machine::new(geometry).ok()?, Outline::new(geometry, &fence.outline).ok()?, fence))
    }

    /// The linkage where the simulated machine truly has it.
    pub fn placed(&self, row: &Row) -> Option<PlacedOutline<f64>> {
        self.outline.place(&self.machine, row.joints.as_ref()?).ok()
    }

    /// The smallest true clearance of this moment, m, and the swing's room, rad; infinite where there is no such limit, `None` where
    /// the machine has no pose.
    pub fn at(&self, row: &Row) -> Option<(f64, f64)> {
        let (placed, swing) = (self.placed(row)?, row.swing?);
        let closest = self.limits.closest(&placed.strips, swing, &self.base).unwrap_or(f64::INFINITY);
        Some((closest, self.limits.swing_room(swing).unwrap_or(f64::INFINITY)))
    }

    /// The smallest of both over a run.
    pub fn over(&self, log: &Log) -> Option<(f64, f64)> {
        let mut least = (f64::INFINITY, f64::INFINITY);
        for row in &log.rows {
            let (closest, room) = self.at(row)?;
            least = (if closest < least.0 { closest } else { least.0 }, if room < least.1 { room } else { least.1 });
        }
        Some(least)
    }
}
