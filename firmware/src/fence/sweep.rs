//! The limits weighed in turn: a tick to place the linkage, then a limit a tick. Meanwhile what the sweep before has kept near is followed
//! to first order; a wish larger than the one it was weighed with waits for the next.

use kinematics_core::planning::fence::{Fence, LIMITS, Nearby, Scene};
use kinematics_core::planning::outline::{Outline, PlacedOutline, Strip};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Machine, Rotor};

use super::parameters::{FenceParameters, Guards};
use crate::TICK_S;
use crate::io::limited;
use crate::parameters::{ParameterError, ValveDirection};

/// Where the machine will be once everything commanded has arrived.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ahead {
    pub(super) lengths: Cylinders<f32>,
    pub(super) swing: Rotor<f32>,
    /// dθ1 by its actuator's travel.
    pub(super) per_swing: f32,
}

/// What is near, by the last complete sweep, and the sweep under way.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    outline: Outline<f32>,
    fence: Fence<f32>,
    guards: Guards,
    near: Nearby<f32>,
    near_ahead: Ahead,
    near_wish: [f32; 4],
    /// The limit that is next; none: the linkage is to be placed.
    next: Option<usize>,
    placed: Option<PlacedOutline<f32>>,
    scene: Scene<f32>,
    found: Nearby<f32>,
    ahead: Ahead,
}

impl Sweep {
    pub(super) fn new(
        p: &FenceParameters,
        geometry: &kinematics_core::PinGeometry,
        valves: &[[ValveDirection; 2]; 4],
    ) -> Result<Self, ParameterError> {
        let fence = p.fence();
        let limits = fence.limits.half_spaces.iter().flatten().count() + fence.limits.spheres.iter().flatten().count();
        // A tick places, one weighs the swing's range and hands over; what a sweep found serves until the next has ended.
        let age_s = 2.0 * (limits as f32 + 2.0) * TICK_S;
        let fastest = |[extend, retract]: &[ValveDirection; 2]| {
            if extend.full_speed > retract.full_speed { extend.full_speed } else { retract.full_speed }
        };
        let base = BasePlacement::level(Rotor::IDENTITY, [0.0, 0.0, p.boom_pin_height_m as f32]);
        let nowhere = Cylinders { boom: 0.0, arm: 0.0, bucket: 0.0 };
        let ahead = Ahead { lengths: nowhere, swing: Rotor::IDENTITY, per_swing: 1.0 };
        let zero = [0.0; 4];
        // The way of each actuator at full speed in that time, m or rad.
        let spare = valves.each_ref().map(|valve| fastest(valve) * age_s);
        Ok(Self {
            outline: Outline::new(geometry, &p.outline)?,
            fence,
            guards: p.guards,
            near: Nearby::none(),
            near_ahead: ahead,
            near_wish: zero,
            next: None,
            placed: None,
            scene: Scene { swing: Rotor::IDENTITY, base, transmissions: zero, wish: zero, spare },
            found: Nearby::none(),
            ahead,
        })
    }

    pub(super) fn reset(&mut self) {
        self.near.clear();
        self.near_wish = [0.0; 4];
        self.next = None;
    }

    /// One tick's share of the work; `None` where the linkage ahead does not close.
    pub(super) fn step(&mut self, machine: &Machine<f32>, ahead: &Ahead, wanted: [f32; 4]) -> Option<()> {
        match self.next {
            None => self.place(machine, ahead, wanted),
            Some(number) => {
                self.weigh_from(number);
                Some(())
            }
        }
    }

    fn place(&mut self, machine: &Machine<f32>, ahead: &Ahead, wish: [f32; 4]) -> Option<()> {
        let lengths = &ahead.lengths;
        self.placed = Some(self.outline.place(machine, &machine.cylinders_to_joints(lengths).ok()?).ok()?);
        let [boom, arm, bucket] = machine.moment_arms(lengths).ok()?.transmissions().ok()?;
        let transmissions = [ahead.per_swing, boom, arm, bucket];
        self.scene = Scene { swing: ahead.swing, transmissions, wish, ..self.scene };
        self.ahead = *ahead;
        self.found.clear();
        self.next = Some(0);
        Some(())
    }

    /// Weighs the first limit from this number on; after the last, what was found is what is near.
    fn weigh_from(&mut self, number: usize) {
        let tip;
        let strips: &[Strip<f32>] = match (&self.placed, self.guards) {
            (Some(placed), Guards::Linkage) => &placed.strips,
            (Some(placed), Guards::Tip) => {
                tip = [placed.tip()];
                &tip
            }
            (None, _) => &[],
        };
        let mut weighed = number;
        while weighed < LIMITS && !self.fence.weigh(weighed, strips, &self.scene, &mut self.found) {
            weighed += 1;
        }
        if weighed + 1 < LIMITS {
            self.next = Some(weighed + 1);
        } else {
            (self.near, self.near_ahead, self.near_wish) = (self.found, self.ahead, self.scene.wish);
            self.next = None;
        }
    }

    /// What is let through, and the smallest clearance of the last sweep.
    pub(super) fn limit(&self, ahead: &Ahead, wanted: [f32; 4], receding: &[f32; 4]) -> ([f32; 4], f32) {
        let mut weighed = wanted;
        for (wanted, wish) in weighed.iter_mut().zip(self.near_wish) {
            *wanted = if wish > 0.0 { limited(*wanted, 0.0, wish) } else { limited(*wanted, wish, 0.0) };
        }
        let moved = self.near_ahead.until(ahead);
        (self.fence.limit(&self.near, &weighed, receding, &moved), self.near.closest)
    }
}

impl Ahead {
    /// How far the actuators have moved from here to there.
    fn until(&self, there: &Self) -> [f32; 4] {
        let (from, to) = (&self.lengths, &there.lengths);
        // In two sweeps the swing turns by hundredths of a radian: its sine is the angle to 1e-5.
        let turned = (there.swing * self.swing.inverse()).sin / self.per_swing;
        [turned, to.boom - from.boom, to.arm - from.arm, to.bucket - from.bucket]
    }
}
