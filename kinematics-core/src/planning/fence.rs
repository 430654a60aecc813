//! A fence: half-spaces and balls the whole linkage keeps clear of, and limits of the swing, kept by slowing the approach.
//!
//! Every strip's clearance d to every limit, less a margin, bounds its speed of approach: after the time t until a command acts,
//! decelerating at a, the machine stops within `v²/2a + v·t = d`, so `v ≤ 2d / (t + √(t² + 2d/a))`. A command only shrinks.
//! Where a limit's speed is exceeded, the actuators that approach it are scaled by one factor, those that move along it or away
//! are not; a fixed number of rounds over all limits, then one factor for everything that satisfies whatever is left.
//!
//! The clearances are to be taken where the machine will stand once everything already commanded has arrived: then nothing is
//! still to come, and the command alone decides.
//!
//! Weighing every strip against every limit is most of the work and may be spread over several control periods:
//! [`Fence::weigh`] takes one limit at a time and keeps the few approaches that matter ([`Nearby`]), which [`Fence::limit`] then
//! follows to first order as the machine moves on.
//!
//! ```
//! use kinematics_core::planning::clearance::HalfSpace;
//! use kinematics_core::planning::fence::{Fence, Nearby, Reaches, Scene, Stopping};
//! use kinematics_core::planning::limits::{Limits, SwingRange};
//! use kinematics_core::planning::outline::{Outline, OutlineShape};
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
//! let limit = |swing: f32, wanted, moved| {
//!     let scene = Scene {
//!         swing: Rotor::from_degrees(swing), base, transmissions: [1.0, boom, arm, bucket], wish: wanted, spare: [0.0; 4],
//!     };
//!     let mut nearby = Nearby::none();
//!     fence.weigh_all(&placed.strips, &scene, &mut nearby);
//!     (fence.limit(&nearby, &wanted, &[1.0; 4], &moved), nearby.closest)
//! };
//!
//! // Raising the boom is slowed before the ceiling; lowering it, and swinging amid the range, are free.
//! let (up, closest) = limit(0.0, [0.3, 0.2, 0.0, 0.0], [0.0; 4]);
//! assert!(up[1] < 0.2 && up[1] > 0.0 && up[0] == 0.3, "{up:?}");
//! assert_eq!(limit(0.0, [0.3, -0.2, 0.0, 0.0], [0.0; 4]).0, [0.3, -0.2, 0.0, 0.0]);
//! // A boom cylinder that has moved a millimetre further since then may go on slower.
//! assert!(limit(0.0, [0.0, 0.2, 0.0, 0.0], [0.0, 0.001, 0.0, 0.0]).0[1] < up[1]);
//! // At the end of the range only the way back is open.
//! assert_eq!(limit(60.0, [0.3, 0.0, 0.0, 0.0], [0.0; 4]).0[0], 0.0);
//! assert_eq!(limit(60.0, [-0.3, 0.0, 0.0, 0.0], [0.0; 4]).0[0], -0.3);
//! // The strip nearest to the ceiling is this far off it.
//! assert_eq!(limits.closest(&placed.strips, Rotor::IDENTITY, &base), Some(closest));
//! // Limits may be weighed one at a time, by their number.
//! let scene = Scene {
//!     swing: Rotor::IDENTITY, base, transmissions: [1.0, boom, arm, bucket], wish: [0.3, 0.2, 0.0, 0.0], spare: [0.0; 4],
//! };
//! let mut nearby = Nearby::none();
//! let mut reaches = Reaches::none();
//! fence.reaches_of(&placed.strips, 0..13, &scene, &mut reaches);
//! assert_eq!(reaches, fence.reaches(&placed.strips, &scene));
//! assert_eq!(fence.weigh(0, (&placed.strips, &reaches), (0, 1), &scene, &mut nearby), Some(1));
//! assert_eq!(fence.weigh(0, (&placed.strips, &reaches), (1, 1000), &scene, &mut nearby), Some(13));
//! assert_eq!(fence.weigh(1, (&placed.strips, &reaches), (0, 1000), &scene, &mut nearby), None);
//! assert_eq!(nearby.closest, closest);
//! // The next sweep begins with nothing near.
//! nearby.clear();
//! assert_eq!(nearby.closest, Nearby::none().closest);
//! # Ok(())
//! # }
//! ```

use core::ops::Range;

use super::limits::{HALF_SPACES, Limits, SPHERES};
use super::nearby::{Approach, NEARBY};
use super::outline::{OWN_ENDS, STRIPS, Strip};
use crate::world::BasePlacement;
use crate::{Real, Rotor};

pub use super::nearby::Nearby;

/// How many limits [`Fence::weigh`] takes one by one: half-spaces, then balls, then the swing's range.
pub const LIMITS: usize = HALF_SPACES + SPHERES + 1;
/// What an end costs that is near, against one that is far off: it is kept with its derivative.
pub const NEAR: usize = 5;
/// Rounds over all approaches before one factor settles what is left.
const ROUNDS: usize = 2;

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
        self.speed_within(distance - self.margin)
    }

    /// The same of the distance less the margin.
    #[inline]
    fn speed_within(&self, room: T) -> T {
        if room > T::ZERO {
            let (t, twice) = (self.reaction_s, room + room);
            twice / (t + (t * t + twice / self.deceleration).sqrt())
        } else {
            T::ZERO
        }
    }

    /// 1/2a.
    #[inline]
    fn per_square(&self) -> T {
        T::ONE / (self.deceleration + self.deceleration)
    }
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

/// Where limits are weighed: where the machine will stand once what is commanded has arrived, and what may be wanted there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene<T> {
    /// The swing.
    pub swing: Rotor<T>,
    /// The machine in the world.
    pub base: BasePlacement<T>,
    /// dθ/dL of swing, boom, arm, bucket (1 for a joint's own rate).
    pub transmissions: [T; 4],
    /// The rates wanted of the actuators, or what bounds them, by sign and size. Approaches that only others could make are
    /// not kept.
    pub wish: [T; 4],
    /// How far each actuator may have moved, either way, when the result is used for the last time, m or rad.
    pub spare: [T; 4],
}

/// How far each strip can come with a scene's wish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaches<T> {
    /// Until the result is used for the last time, m; the same and what the strip needs to stop from its fastest, with the margin.
    of_strips: [[T; 2]; STRIPS],
}

impl<T: Real> Reaches<T> {
    /// None has one yet.
    pub fn none() -> Self {
        Self { of_strips: [[T::ZERO; 2]; STRIPS] }
    }
}

/// What is wanted that exceeds a bound: each actuator's share of the approach; what recedes, negative and as far as it has been
/// reached; and the fastest allowed.
#[derive(Clone, Copy, Debug)]
struct Bound<T> {
    towards: [T; 4],
    away: [T; 4],
    fastest: T,
}

#[inline(always)]
fn sum<T: Real>([a, b, c, d]: [T; 4]) -> T {
    (a + b) + (c + d)
}

/// Products of both, one by one.
#[inline(always)]
fn times<T: Real>([a, b, c, d]: [T; 4], [w, x, y, z]: [T; 4]) -> [T; 4] {
    [a * w, b * x, c * y, d * z]
}

impl<T: Real> Fence<T> {
    /// How far these strips can come with the scene's wish: farther off, no limit matters to them.
    pub fn reaches(&self, strips: &[Strip<T>], scene: &Scene<T>) -> Reaches<T> {
        let mut reaches = Reaches::none();
        self.reaches_of(strips, 0..STRIPS, scene, &mut reaches);
        reaches
    }

    /// [`Fence::reaches`] of a part of the strips; the others' stay as they are.
    pub fn reaches_of(&self, strips: &[Strip<T>], part: Range<usize>, scene: &Scene<T>, reaches: &mut Reaches<T>) {
        let magnitude = |x: T| if x < T::ZERO { -x } else { x };
        let (wish, spare) = (times(scene.wish, scene.transmissions), times(scene.spare, scene.transmissions));
        let (wish, spare) = (wish.map(magnitude), spare.map(magnitude));
        let per_square = self.stopping.per_square();
        let strips = reaches.of_strips.iter_mut().zip(strips).take(part.end).skip(part.start);
        for (reach, strip) in strips {
            let (mut fastest, mut longest) = (T::ZERO, T::ZERO);
            for end in &strip.ends {
                let [b, a, k] = end.per_joint.map(|v| v.norm_squared().sqrt());
                let levers = [magnitude(end.at.x) + strip.lateral, b, a, k];
                let (speed, way) = (sum(times(levers, wish)), sum(times(levers, spare)));
                fastest = if speed > fastest { speed } else { fastest };
                longest = if way > longest { way } else { longest };
            }
            let stops = fastest * (self.stopping.reaction_s + fastest * per_square);
            *reach = [longest, stops + longest + self.stopping.margin];
        }
    }

    /// Weighs one limit, 0 ≤ number < [`LIMITS`], and keeps what the scene's wish could bring too near, from this strip on until so
    /// much `work` is done: 1 for an end that is far off, [`NEAR`] for one that is not. `reaches` are those of the same strips and scene.
    /// The strip to go on from, their number when all are weighed; `None` where this number has no limit.
    pub fn weigh(
        &self,
        number: usize,
        (strips, reaches): (&[Strip<T>], &Reaches<T>),
        (from, work): (usize, usize),
        scene: &Scene<T>,
        nearby: &mut Nearby<T>,
    ) -> Option<usize> {
        // The teeth alone are one strip.
        let own_ends = if strips.len() < STRIPS { &[[false, true]; STRIPS] } else { &OWN_ENDS };
        let (mut next, mut done) = (from, 0);
        if let Some(Some(space)) = self.limits.half_spaces.get(number) {
            let mut weighing = Weighing::new(&self.stopping, scene, nearby);
            let seen = space.seen(&scene.base, scene.swing);
            while done < work
                && let (Some(strip), Some(reach), Some(own)) =
                    (strips.get(next), reaches.of_strips.get(next), own_ends.get(next))
            {
                let side = strip.side(&seen);
                for (end, &own) in strip.ends.iter().zip(own) {
                    if own {
                        let distance = side.distance(end);
                        done += 1;
                        if weighing.matters(distance, reach) {
                            weighing.keep(distance, &side.approach(end), reach);
                            done += NEAR - 1;
                        }
                    }
                }
                next += 1;
            }
            return Some(next);
        }
        let ball = number.checked_sub(HALF_SPACES).and_then(|number| self.limits.spheres.get(number));
        if let Some(Some(ball)) = ball {
            let mut weighing = Weighing::new(&self.stopping, scene, nearby);
            let seen = ball.seen(&scene.base, scene.swing);
            while done < work
                && let (Some(strip), Some(reach)) = (strips.get(next), reaches.of_strips.get(next))
            {
                let facing = strip.facing(&seen);
                done += 1;
                if weighing.matters(facing.distance, reach) {
                    weighing.keep(facing.distance, &facing.approach(strip), reach);
                    done += NEAR - 1;
                }
                next += 1;
            }
            return Some(next);
        }
        match &self.limits.swing {
            Some(range) if number + 1 == LIMITS => {
                let [per_swing, ..] = scene.transmissions;
                nearby.turning = Some((range.distances(scene.swing), per_swing));
                Some(strips.len())
            }
            _ => None,
        }
    }

    /// Weighs all limits.
    pub fn weigh_all(&self, strips: &[Strip<T>], scene: &Scene<T>, nearby: &mut Nearby<T>) {
        let reaches = self.reaches(strips, scene);
        for number in 0..LIMITS {
            self.weigh(number, (strips, &reaches), (0, usize::MAX), scene, nearby);
        }
    }

    /// What is let through of the wanted rates of swing, boom, arm, bucket: each between 0 and what was wanted. `moved` is how far
    /// the actuators are from where `nearby` was weighed; `receding`, which part (0 to 1) of its wanted rate each actuator has reached: only
    /// that much makes up for another's approach.
    pub fn limit(&self, nearby: &Nearby<T>, wanted: &[T; 4], receding: &[T; 4], moved: &[T; 4]) -> [T; 4] {
        let rates = self.turning_limited(nearby, wanted, moved);
        let mut exceeded = Exceeded {
            bounds: [Bound { towards: [T::ZERO; 4], away: [T::ZERO; 4], fastest: T::ZERO }; NEARBY + 1],
            count: 0,
        };
        for approach in nearby.kept() {
            let room = approach.room - sum(times(approach.by, *moved));
            exceeded.test(&self.stopping, times(approach.by, rates), room, receding);
        }
        if let Some(rest) = nearby.rest() {
            let room = rest.room - sum(rest.at_most(moved));
            exceeded.test(&self.stopping, rest.at_most(&rates), room, receding);
        }
        if exceeded.count == 0 { rates } else { times(exceeded.scales(), rates) }
    }

    /// The wanted rates, the swing's kept within its range.
    fn turning_limited(&self, nearby: &Nearby<T>, wanted: &[T; 4], moved: &[T; 4]) -> [T; 4] {
        let [wanted, boom, arm, bucket] = *wanted;
        let mut swing = wanted;
        if let Some(([right, left], per_swing)) = nearby.turning {
            let [moved, ..] = *moved;
            let (turning, turned) = (wanted * per_swing, moved * per_swing);
            let (distance, rate) =
                if turning > T::ZERO { (left - turned, turning) } else { (right + turned, -turning) };
            let fastest = self.turning.speed(distance);
            if rate > fastest {
                swing = wanted * (fastest / rate);
            }
        }
        [swing, boom, arm, bucket]
    }
}

impl<T: Real> Bound<T> {
    /// The speed of approach and, negative, of what recedes, with these factors of the actuators.
    #[inline(always)]
    fn speeds(&self, scales: &[T; 4]) -> (T, T) {
        (sum(times(self.towards, *scales)), sum(times(self.away, *scales)))
    }
}

/// The bounds that are exceeded.
struct Exceeded<T> {
    bounds: [Bound<T>; NEARBY + 1],
    count: usize,
}

impl<T: Real> Exceeded<T> {
    /// Notes shares of an approach that are too fast for the room, m.
    #[inline(always)]
    fn test(&mut self, stopping: &Stopping<T>, shares: [T; 4], room: T, receding: &[T; 4]) {
        let towards = shares.map(positive);
        let speed = sum(towards);
        if speed * (stopping.reaction_s + speed * stopping.per_square()) > room
            && let Some(slot) = self.bounds.get_mut(self.count)
        {
            let away = |share: T, towards: T, reached: T| (share - towards) * reached;
            let ([a, b, c, d], [ta, tb, tc, td], [ra, rb, rc, rd]) = (shares, towards, *receding);
            *slot = Bound {
                towards,
                away: [away(a, ta, ra), away(b, tb, rb), away(c, tc, rc), away(d, td, rd)],
                fastest: stopping.speed_within(room),
            };
            self.count += 1;
        }
    }

    /// Every actuator's factor, so that all bounds are kept.
    #[inline(always)]
    fn scales(&self) -> [T; 4] {
        let bounds = self.bounds.get(..self.count).unwrap_or(&self.bounds);
        let mut scales = [T::ONE; 4];
        for _ in 0..ROUNDS {
            let mut kept = true;
            for bound in bounds {
                // Summed by itself, so that no rounding lifts it above 0.
                let (towards, away) = bound.speeds(&scales);
                if towards + away > bound.fastest {
                    // towards > fastest − away ≥ 0
                    let factor = (bound.fastest - away) / towards;
                    for (scale, share) in scales.iter_mut().zip(bound.towards) {
                        *scale = if share > T::ZERO { *scale * factor } else { *scale };
                    }
                    kept = false;
                }
            }
            if kept {
                return scales;
            }
        }
        let mut common = T::ONE;
        for bound in bounds {
            let (towards, away) = bound.speeds(&scales);
            let approach = towards + away;
            if approach * common > bound.fastest {
                common = bound.fastest / approach;
            }
        }
        scales.map(|scale| scale * common)
    }
}

#[inline(always)]
fn positive<T: Real>(x: T) -> T {
    if x > T::ZERO { x } else { T::ZERO }
}

/// One limit's clearances on their way to what is kept.
struct Weighing<'a, T> {
    nearby: &'a mut Nearby<T>,
    transmissions: [T; 4],
    wish: [T; 4],
    margin: T,
    reaction_s: T,
    per_square: T,
}

impl<'a, T: Real> Weighing<'a, T> {
    fn new(stopping: &Stopping<T>, scene: &Scene<T>, nearby: &'a mut Nearby<T>) -> Self {
        let transmissions = scene.transmissions;
        let (margin, reaction_s, per_square) = (stopping.margin, stopping.reaction_s, stopping.per_square());
        Self { nearby, transmissions, wish: scene.wish, margin, reaction_s, per_square }
    }

    /// Notes a distance; whether it is within the strip's reach.
    #[inline(always)]
    fn matters(&mut self, distance: T, [_, reach]: &[T; 2]) -> bool {
        self.nearby.closest = if distance < self.nearby.closest { distance } else { self.nearby.closest };
        distance < *reach
    }

    /// Keeps an approach by the joints' rates that the wish could make too fast before the strip has gone its way.
    #[inline(always)]
    fn keep(&mut self, distance: T, approach: &[T; 4], [way, _]: &[T; 2]) {
        let by = times(*approach, self.transmissions);
        let towards = sum(times(by, self.wish).map(positive));
        let room = distance - self.margin;
        let demand = towards * (self.reaction_s + towards * self.per_square) + *way - room;
        if demand > T::ZERO {
            self.nearby.keep(&Approach { by, room, demand });
        }
    }
}
