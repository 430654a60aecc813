//! The limits weighed in turn, in every second tick: one for the joints, one to place the linkage, one for each part of its strips to tell how far
//! they can come, then of a limit what a tick has room for: much that is far off or little that is near. Meanwhile what the sweep before has
//! kept near is followed to first order; a wish larger than the one it was weighed with waits for the next.

use core::ops::Range;

use kinematics_core::planning::fence::{Fence, LIMITS, Nearby, Reaches, Scene};
use kinematics_core::planning::outline::{Outline, PlacedOutline, STRIPS, Strip};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Joints, Machine, Rotor};

use super::held;
use super::parameters::{FenceParameters, Guards};
use crate::TICK_S;
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
    /// The joints and their transmissions.
    Bend,
    /// Place the linkage at these joints.
    Place(Joints<f32>),
    /// Tell how far this part of its strips can come.
    Reach(usize),
    /// Weigh the strips from the second number on against the first limit from the first number on.
    Weigh(usize, usize),
}

/// Strips whose reach is told in a tick, and in how many ticks all are.
const PART: usize = 5;
const PARTS: usize = STRIPS.div_ceil(PART);
/// Work of a tick's weighing: so many ends far off, or a fifth as many that are near.
const WORK: usize = 13;
/// Ticks that weigh a limit with little near it. With much it takes longer, and what was found holds for as far as the actuators could
/// have gone in this time at full speed: not beyond.
const TICKS_PER_LIMIT: usize = 3;

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
    placed: PlacedOutline<f32>,
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
        // A tick bends, one places, some tell the reaches, one weighs the swing's range and hands over: each second tick. What a sweep
        // found serves until the next has ended.
        let age_s = 2.0 * ((limits * TICKS_PER_LIMIT + PARTS) as f32 + 3.0) * (2.0 * TICK_S);
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
            next: Next::Bend,
            placed: PlacedOutline::nowhere(),
            reaches: Reaches::none(),
            scene: Scene { swing: Rotor::IDENTITY, base, transmissions: zero, wish: zero, spare },
            found: Nearby::none(),
            ahead,
        })
    }

    pub(super) fn reset(&mut self) {
        self.near.clear();
        self.near_wish = [0.0; 4];
        self.next = Next::Bend;
    }

    /// The next tick's share of the work is [`Self::begin`].
    #[inline]
    pub(super) fn begins(&self) -> bool {
        matches!(self.next, Next::Bend)
    }

    /// The first tick's share of a sweep: the joints and their transmissions; `None` where the linkage ahead does not close.
    #[inline]
    pub(super) fn begin(&mut self, machine: &Machine<f32>, ahead: &Ahead, wish: [f32; 4]) -> Option<()> {
        let lengths = &ahead.lengths;
        let joints = machine.cylinders_to_joints(lengths).ok()?;
        let [boom, arm, bucket] = machine.moment_arms(lengths).ok()?.transmissions().ok()?;
        self.scene.swing = ahead.swing;
        self.scene.transmissions = [ahead.per_swing, boom, arm, bucket];
        self.scene.wish = wish;
        self.ahead = *ahead;
        self.found.clear();
        self.next = Next::Place(joints);
        Some(())
    }

    /// The share of any tick after the first; `None` where the bucket's linkage does not close.
    #[inline]
    pub(super) fn go_on(&mut self, machine: &Machine<f32>) -> Option<()> {
        match self.next {
            Next::Bend => {}
            Next::Place(joints) => {
                self.outline.place_into(machine, &joints, &mut self.placed).ok()?;
                self.next = Next::Reach(0);
            }
            Next::Reach(part) => self.reach(part),
            Next::Weigh(number, part) => self.weigh_from(number, part),
        }
        Some(())
    }

    #[inline]
    fn reach(&mut self, part: usize) {
        let mut tip = None;
        let strips = guarded(&self.placed, self.guards, &mut tip);
        self.fence.reaches_of(strips, part_of(part), &self.scene, &mut self.reaches);
        self.next = if part + 1 < PARTS { Next::Reach(part + 1) } else { Next::Weigh(0, 0) };
    }

    /// Weighs strips from this one on against the first limit from this number on; after the last, what was found is what is near.
    #[inline]
    fn weigh_from(&mut self, mut number: usize, strip: usize) {
        let mut tip = None;
        let strips = guarded(&self.placed, self.guards, &mut tip);
        let count = strips.len();
        let next = loop {
            let part = (strip, WORK);
            match self.fence.weigh(number, (strips, &self.reaches), part, &self.scene, &mut self.found) {
                None if number < LIMITS => number += 1,
                next => break next,
            }
        };
        self.next = match next {
            Some(next) if next < count => Next::Weigh(number, next),
            Some(_) if number + 1 < LIMITS => Next::Weigh(number + 1, 0),
            _ => {
                self.near.clone_from(&self.found);
                self.near_ahead = self.ahead;
                self.near_wish = self.scene.wish;
                Next::Bend
            }
        };
    }

    /// What is let through of the wanted speeds, and of any until this is called again.
    #[inline]
    pub(super) fn limit(&self, ahead: &Ahead, wanted: [f32; 4], receding: &[f32; 4]) -> Within {
        let moved = self.near_ahead.until(ahead);
        let too_far = |(&moved, spare): (&f32, f32)| moved > spare || moved < -spare;
        if moved.iter().zip(self.scene.spare).any(too_far) {
            return Within { speeds: [0.0; 4], most: [0.0; 4] };
        }
        let speeds = self.fence.limit(&self.near, &held(wanted, &self.near_wish), receding, &moved);
        let ([swing, ..], [_, boom, arm, bucket]) = (speeds, self.near_wish);
        let most = if self.near.is_clear() { [swing, boom, arm, bucket] } else { speeds };
        Within { speeds, most }
    }

    /// The smallest clearance of the last sweep, m.
    #[inline]
    pub(super) fn closest_m(&self) -> f32 {
        self.near.closest
    }
}

/// What is let through: of what was wanted, and of whatever may be wanted next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Within {
    pub(super) speeds: [f32; 4],
    pub(super) most: [f32; 4],
}

/// The strips of a part, by number.
#[inline]
fn part_of(part: usize) -> Range<usize> {
    part * PART..(part + 1) * PART
}

/// The strips that are guarded; `tip` is room for the teeth's.
#[inline]
fn guarded<'a>(placed: &'a PlacedOutline<f32>, guards: Guards, tip: &'a mut Option<Strip<f32>>) -> &'a [Strip<f32>] {
    match guards {
        Guards::Linkage => &placed.strips,
        Guards::Tip => core::slice::from_ref(tip.insert(placed.tip())),
    }
}

impl Ahead {
    /// How far the actuators have moved from here to there.
    #[inline]
    fn until(&self, there: &Self) -> [f32; 4] {
        let (from, to) = (&self.lengths, &there.lengths);
        // In two sweeps the swing turns by hundredths of a radian: its sine is the angle to 1e-5.
        let turned = (there.swing * self.swing.inverse()).sin / self.per_swing;
        [turned, to.boom - from.boom, to.arm - from.arm, to.bucket - from.bucket]
    }
}
