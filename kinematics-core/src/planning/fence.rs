//! A fence: half-spaces and balls the whole linkage keeps clear of, and limits of the swing, kept by slowing the approach.
//!
//! Every strip's clearance d to every limit, less a margin, bounds its speed of approach: after the time t until a command acts,
//! decelerating at a, the machine stops within `v²/2a + v·t = d`, so `v ≤ 2d / (t + √(t² + 2d/a))`. A command only shrinks.
//! Where a limit's speed is exceeded, the actuators that approach it are scaled by one factor, those that move along it or away
//! are not; a fixed number of rounds over all limits, then one factor for everything that satisfies whatever is left.
//!
//! The clearances are to be taken where the machine will stand once everything already commanded has arrived: then nothing is
//! still to come, and the command alone decides ([`Fence::limit`]).
//!
//! ```
//! use kinematics_core::planning::clearance::HalfSpace;
//! use kinematics_core::planning::fence::{Fence, Limits, Stopping, SwingRange};
//! use kinematics_core::planning::outline::{Outline, OutlineShape};
//! use kinematics_core::rates::CylinderRates;
//! use kinematics_core::world::BasePlacement;
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let geometry = PinGeometry::EXACT_MINI;
//! let machine = Machine::<f32>::new(&geometry)?;
//! let outline = Outline::<f32>::new(&geometry, &OutlineShape::of(&geometry))?;
//! let cylinders = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
//! let placed = outline.place(&machine, &machine.cylinders_to_joints(&cylinders)?)?;
//! let [boom, arm, bucket] = machine.moment_arms(&cylinders)?.transmissions()?;
//!
//! // A ceiling 10 cm above the linkage, and no swinging beyond 60° to either side.
//! let base = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
//! let ceiling = |offset| Some(HalfSpace { normal: [0.0, 0.0, 1.0], offset });
//! let mut limits = Limits::NONE;
//! limits.half_spaces[0] = ceiling(5.0);
//! let room = limits.closest(&placed.strips, Rotor::IDENTITY, &base).ok_or("no ceiling")?;
//! limits.half_spaces[0] = ceiling(5.0 - room + 0.1);
//! limits.swing = Some(SwingRange::new(-60.0, 60.0));
//! let stopping = Stopping { deceleration: 1.0, reaction_s: 0.15, margin: 0.02 };
//! let turning = Stopping { deceleration: 0.5, reaction_s: 0.15, margin: 0.01 };
//! // What 10 cm before a limit may go on at: 0.1 = v²/2 + 0.15·v.
//! let v: f32 = stopping.speed(0.1 + 0.02);
//! assert!((v * v / 2.0 + 0.15 * v - 0.1).abs() < 1e-6);
//! let fence = Fence { limits, stopping, turning };
//! let transmissions = [1.0, boom, arm, bucket];
//! let limit = |swing: f32, wanted| {
//!     fence.limit(&placed.strips, Rotor::from_degrees(swing), &base, &transmissions, &wanted, [1.0; 4])
//! };
//!
//! // Raising the boom is slowed before the ceiling; lowering it, and swinging amid the range, are free.
//! let up = limit(0.0, [0.3, 0.2, 0.0, 0.0]);
//! assert!(up.rates[1] < 0.2 && up.rates[1] > 0.0 && up.rates[0] == 0.3, "{up:?}");
//! assert_eq!(limit(0.0, [0.3, -0.2, 0.0, 0.0]).rates, [0.3, -0.2, 0.0, 0.0]);
//! // At the end of the range only the way back is open.
//! assert_eq!(limit(60.0, [0.3, 0.0, 0.0, 0.0]).rates[0], 0.0);
//! assert_eq!(limit(60.0, [-0.3, 0.0, 0.0, 0.0]).rates[0], -0.3);
//! // The strip nearest to the ceiling is this far off it, and the swing this far from its range's end.
//! assert_eq!(limits.closest(&placed.strips, Rotor::IDENTITY, &base), Some(up.closest));
//! assert!(limits.swing_room(Rotor::from_degrees(61.0)).is_some_and(|room| room < 0.0));
//! # Ok(())
//! # }
//! ```

use super::clearance::{Clearance, HalfSpace, Sphere};
use super::outline::{STRIPS, Strip};
use crate::world::BasePlacement;
use crate::{Real, Rotor, Vec2};

/// How many half-spaces a fence holds.
pub const HALF_SPACES: usize = 8;
/// How many balls.
pub const SPHERES: usize = 4;
/// How many bounds one step weighs at most: both ends of every strip to every half-space, every strip to every ball, the swing.
pub const BOUNDS: usize = STRIPS * (2 * HALF_SPACES + SPHERES) + 2;
/// Rounds over all bounds before one factor settles what is left.
const ROUNDS: usize = 4;

/// How a motion can be stopped: in m and m/s, or rad and rad/s for the swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopping<T> {
    /// a, m/s².
    pub deceleration: T,
    /// t, before which a command may not act, s.
    pub reaction_s: T,
    /// What is kept of every distance, m.
    pub margin: T,
}

impl<T: Real> Stopping<T> {
    /// The fastest approach at this distance: the root of v²/2a + v·t = distance − margin, 0 within the margin.
    #[inline]
    pub fn speed(&self, distance: T) -> T {
        let room = distance - self.margin;
        if room > T::ZERO {
            let (t, twice) = (self.reaction_s, room + room);
            twice / (t + (t * t + twice / self.deceleration).sqrt())
        } else {
            T::ZERO
        }
    }
}

/// Where the swing may be: from `right` (clockwise) to `left` of straight ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingRange<T> {
    /// Its middle.
    middle: Rotor<T>,
    /// Half of it.
    half: Rotor<T>,
}

/// The chord 2·sin(angle/2) of an angle within ±180°, which is below the angle, with its sign.
fn chord<T: Real>(angle: Rotor<T>) -> T {
    let length = Vec2::new(angle.cos - T::ONE, angle.sin).norm();
    if angle.sin < T::ZERO { -length } else { length }
}

impl<T: Real> SwingRange<T> {
    /// From `right_deg` to `left_deg`, less than a turn apart.
    pub fn new(right_deg: T, left_deg: T) -> Self {
        let half = T::from_f64(0.5);
        Self {
            middle: Rotor::from_degrees((right_deg + left_deg) * half),
            half: Rotor::from_degrees((left_deg - right_deg) * half),
        }
    }

    /// At most how far the right and the left end are, rad; negative beyond them. Next to an end it is exact, far off the chord.
    fn distances(&self, swing: Rotor<T>) -> [T; 2] {
        let from_middle = swing * self.middle.inverse();
        let inverse = from_middle.inverse();
        // The end on this side by its own chord; the other is farther off than half the range.
        let half = chord(self.half);
        if from_middle.sin < T::ZERO {
            [chord(from_middle * self.half), half]
        } else {
            [half, chord(inverse * self.half)]
        }
    }
}

/// What a fence keeps clear of, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<T> {
    /// Planes: ceiling, floor, walls.
    pub half_spaces: [Option<HalfSpace<T>>; HALF_SPACES],
    /// Points and balls.
    pub spheres: [Option<Sphere<T>>; SPHERES],
    /// The swing's range.
    pub swing: Option<SwingRange<T>>,
}

impl<T: Real> Limits<T> {
    /// The smallest clearance of these strips to any half-space or ball, m; `None` without any.
    pub fn closest(&self, strips: &[Strip<T>], swing: Rotor<T>, base: &BasePlacement<T>) -> Option<T> {
        let spaces = self.half_spaces.iter().flatten().flat_map(|space| {
            let seen = space.seen(base, swing);
            strips.iter().flat_map(move |strip| strip.to_half_space(&seen)).map(|end| end.distance)
        });
        let balls = self.spheres.iter().flatten().flat_map(|ball| {
            let seen = ball.seen(base, swing);
            strips.iter().map(move |strip| strip.to_sphere(&seen).distance)
        });
        spaces.chain(balls).reduce(|a, b| if b < a { b } else { a })
    }

    /// How far the swing is from the nearer end of its range, rad, negative beyond; `None` without a range.
    pub fn swing_room(&self, swing: Rotor<T>) -> Option<T> {
        let [right, left] = self.swing.as_ref()?.distances(swing);
        Some(if left < right { left } else { right })
    }
}

impl<T> Limits<T> {
    /// Nothing.
    pub const NONE: Self =
        Self { half_spaces: [const { None }; HALF_SPACES], spheres: [const { None }; SPHERES], swing: None };
}

/// A fence with its ways of stopping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fence<T> {
    /// What it keeps clear of.
    pub limits: Limits<T>,
    /// How every point of the linkage stops.
    pub stopping: Stopping<T>,
    /// How the swing stops before the ends of its range, rad.
    pub turning: Stopping<T>,
}

/// What a fence lets through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LetThrough<T> {
    /// The actuators' rates: each between 0 and what was wanted.
    pub rates: [T; 4],
    /// The smallest clearance to any half-space or ball, m; the largest number there is without any.
    pub closest: T,
}

/// One bound that what is wanted may exceed: each actuator's share of the approach, and the fastest allowed.
#[derive(Clone, Copy, Debug)]
struct Bound<T> {
    shares: [T; 4],
    fastest: T,
}

impl<T: Real> Bound<T> {
    /// The approaching and the receding shares, scaled.
    fn parts(&self, scales: &[T; 4]) -> (T, T) {
        let (mut towards, mut away) = (T::ZERO, T::ZERO);
        for (&share, &scale) in self.shares.iter().zip(scales) {
            if share > T::ZERO {
                towards = towards + share * scale;
            } else {
                away = away + share * scale;
            }
        }
        (towards, away)
    }
}

/// The bounds of one step, and the smallest clearance seen.
struct Bounds<T> {
    bounds: [Bound<T>; BOUNDS],
    used: usize,
    closest: T,
    /// The part of each actuator's wanted rate that counts where it recedes, 0 to 1.
    counts: [T; 4],
}

impl<T: Real> Bounds<T> {
    /// Keeps a bound that matters: what is wanted could exceed it if nothing moved away.
    fn keep(&mut self, shares: [T; 4], fastest: T) {
        let mut bound = Bound { shares, fastest };
        for (share, counts) in bound.shares.iter_mut().zip(self.counts) {
            if *share < T::ZERO {
                *share = *share * counts;
            }
        }
        if bound.parts(&[T::ONE; 4]).0 > fastest
            && let Some(slot) = self.bounds.get_mut(self.used)
        {
            *slot = bound;
            self.used += 1;
        }
    }

    fn weigh(&mut self, clearance: &Clearance<T>, stopping: &Stopping<T>, joint_rates: &[T; 4]) {
        self.closest = if clearance.distance < self.closest { clearance.distance } else { self.closest };
        let [a, b, c, d] = clearance.approach;
        let [swing, boom, arm, bucket] = *joint_rates;
        self.keep([a * swing, b * boom, c * arm, d * bucket], stopping.speed(clearance.distance));
    }

    fn iter(&self) -> impl Iterator<Item = &Bound<T>> {
        self.bounds.iter().take(self.used)
    }

    /// Every actuator's factor.
    fn scales(&self) -> [T; 4] {
        let mut scales = [T::ONE; 4];
        for _ in 0..ROUNDS {
            for bound in self.iter() {
                let (towards, away) = bound.parts(&scales);
                if towards + away > bound.fastest {
                    // towards > fastest − away ≥ 0
                    let factor = (bound.fastest - away) / towards;
                    for (scale, &share) in scales.iter_mut().zip(&bound.shares) {
                        if share > T::ZERO {
                            *scale = *scale * factor;
                        }
                    }
                }
            }
        }
        let mut common = T::ONE;
        for bound in self.iter() {
            let (towards, away) = bound.parts(&scales);
            let approach = towards + away;
            if approach * common > bound.fastest {
                common = bound.fastest / approach;
            }
        }
        scales.map(|scale| scale * common)
    }
}

impl<T: Real> Fence<T> {
    /// What is let through of the wanted rates of swing, boom, arm, bucket: of actuators, `transmissions` being dθ/dL of each (1
    /// for a joint's own rate). `strips` and `swing` tell where the machine will stand once what is commanded has arrived; `receding`,
    /// which part (0 to 1) of its wanted rate each actuator has reached: only that much makes up for another's approach.
    pub fn limit(
        &self,
        strips: &[Strip<T>],
        swing: Rotor<T>,
        base: &BasePlacement<T>,
        transmissions: &[T; 4],
        wanted: &[T; 4],
        receding: [T; 4],
    ) -> LetThrough<T> {
        let [w1, w2, w3, w4] = *wanted;
        let [t1, t2, t3, t4] = *transmissions;
        let rates = [w1 * t1, w2 * t2, w3 * t3, w4 * t4];
        let unused = Bound { shares: [T::ZERO; 4], fastest: T::ZERO };
        let mut bounds =
            Bounds { bounds: [unused; BOUNDS], used: 0, closest: T::from_f64(f64::from(f32::MAX)), counts: receding };
        for space in self.limits.half_spaces.iter().flatten() {
            let seen = space.seen(base, swing);
            for strip in strips {
                for end in strip.to_half_space(&seen) {
                    bounds.weigh(&end, &self.stopping, &rates);
                }
            }
        }
        for ball in self.limits.spheres.iter().flatten() {
            let seen = ball.seen(base, swing);
            for strip in strips {
                bounds.weigh(&strip.to_sphere(&seen), &self.stopping, &rates);
            }
        }
        if let Some(range) = &self.limits.swing {
            let [right, left] = range.distances(swing);
            let [turning, ..] = rates;
            bounds.keep([-turning, T::ZERO, T::ZERO, T::ZERO], self.turning.speed(right));
            bounds.keep([turning, T::ZERO, T::ZERO, T::ZERO], self.turning.speed(left));
        }
        let [s1, s2, s3, s4] = bounds.scales();
        LetThrough { rates: [w1 * s1, w2 * s2, w3 * s3, w4 * s4], closest: bounds.closest }
    }
}
