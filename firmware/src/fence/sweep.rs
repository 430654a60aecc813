//! The limits weighed in turn: a tick to place the linkage, one to tell how far it can come, then
//! a part of its strips against a limit a tick. Meanwhile what the sweep before has kept near is followed
//! to first order; a wish larger than the one it was weighed with waits for the next.

use kinematics_core::planning::fence::{Fence, LIMITS, Nearby, Reaches, Scene};
use kinematics_core::planning::outline::{Outline, PlacedOutline, STRIPS, Strip};
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

/// A tick's share of a sweep.
#[derive(Clone, Copy, Debug)]
enum Next {
    /// Place the linkage.
    Place,
    /// Tell how far its strips can come.
    Reach,
    /// Weigh this part of the strips against the first limit from this number on.
    Weigh(usize, usize),
}

/// Strips that are weighed in a tick, and in how many ticks all are.
const PART: usize = 5;
const PARTS: usize = STRIPS.div_ceil(PART);

/// What is near, by the last complete sweep, and the sweep under way.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    outline: Outline<f32>,
    fence: Fence<f32>,
    guards: Guards,
    near: Nearby<f32>,
    near_ahead: Ahead,
    near_wish: [f32; 4],
    next: Next,
    placed: Option<PlacedOutline<f32>>,
    reaches: Reaches<f32>,
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
        // A tick places, one tells the reaches, one weighs the swing's range and hands over; what a sweep found serves until the next has ended.
        let age_s = 2.0 * ((limits * PARTS) as f32 + 3.0) * TICK_S;
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
            next: Next::Place,
            placed: None,
            reaches: Reaches::none(),
            scene: Scene { swing: Rotor::IDENTITY, base, transmissions: zero, wish: zero, spare },
            found: Nearby::none(),
            ahead,
        })
    }

    pub(super) fn reset(&mut self) {
        self.near.clear();
        self.near_wish = [0.0; 4];
        self.next = Next::Place;
    }

    /// One tick's share of the work; `None` where the linkage ahead does not close.
    pub(super) fn step(&mut self, machine: &Machine<f32>, ahead: &Ahead, wanted: [f32; 4]) -> Option<()> {
        match self.next {
            Next::Place => return self.place(machine, ahead, wanted),
            Next::Reach => {
                let mut tip = None;
                self.reaches = self.fence.reaches(guarded(&self.placed, self.guards, &mut tip), &self.scene);
                self.next = Next::Weigh(0, 0);
            }
            Next::Weigh(number, part) => self.weigh_from(number, part),
        }
        Some(())
    }

    fn place(&mut self, machine: &Machine<f32>, ahead: &Ahead, wish: [f32; 4]) -> Option<()> {
        let lengths = &ahead.lengths;
        self.placed = Some(self.outline.place(machine, &machine.cylinders_to_joints(lengths).ok()?).ok()?);
        let [boom, arm, bucket] = machine.moment_arms(lengths).ok()?.transmissions().ok()?;
        let transmissions = [ahead.per_swing, boom, arm, bucket];
        self.scene = Scene { swing: ahead.swing, transmissions, wish, ..self.scene };
        self.ahead = *ahead;
        self.found.clear();
        self.next = Next::Reach;
        Some(())
    }

    /// Weighs a part of the strips against the first limit from this number on; after the last, what was found is what is near.
    fn weigh_from(&mut self, number: usize, part: usize) {
        let mut tip = None;
        let strips = (guarded(&self.placed, self.guards, &mut tip), &self.reaches);
        let from = part * PART;
        let mut weighed = number;
        while weighed < LIMITS && !self.fence.weigh(weighed, strips, from..from + PART, &self.scene, &mut self.found) {
            weighed += 1;
        }
        self.next = if weighed + 1 >= LIMITS {
            (self.near, self.near_ahead, self.near_wish) = (self.found, self.ahead, self.scene.wish);
            Next::Place
        } else if part + 1 < PARTS {
            Next::Weigh(weighed, part + 1)
        } else {
            Next::Weigh(weighed + 1, 0)
        };
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

/// The strips that are guarded; `tip` is room for the teeth's.
fn guarded<'a>(
    placed: &'a Option<PlacedOutline<f32>>,
    guards: Guards,
    tip: &'a mut Option<Strip<f32>>,
) -> &'a [Strip<f32>] {
    match (placed, guards) {
        (Some(placed), Guards::Linkage) => &placed.strips,
        (Some(placed), Guards::Tip) => core::slice::from_ref(tip.insert(placed.tip())),
        (None, _) => &[],
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
