//! What a fence keeps clear of: half-spaces, balls and a range of the swing.
//!
//! ```
//! use kinematics_core::planning::clearance::HalfSpace;
//! use kinematics_core::planning::limits::{Limits, SwingRange};
//! use kinematics_core::planning::outline::{Outline, OutlineShape};
//! use kinematics_core::world::BasePlacement;
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let geometry = PinGeometry::EXACT_MINI;
//! let machine = Machine::<f32>::new(&geometry)?;
//! let outline = Outline::<f32>::new(&geometry, &OutlineShape::of(&geometry))?;
//! let placed = outline.place(&machine, &machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?)?;
//! // No swinging beyond 60° to either side, and nothing above 5 m.
//! let mut limits = Limits::NONE;
//! limits.swing = Some(SwingRange::new(-60.0, 60.0));
//! limits.half_spaces[0] = Some(HalfSpace { normal: [0.0, 0.0, 1.0], offset: 5.0 });
//! let level = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
//! let room = limits.closest(&placed.strips, Rotor::IDENTITY, &level).ok_or("no ceiling")?;
//! assert!(room > 0.0 && room < 5.0);
//! assert!(limits.swing_room(Rotor::from_degrees(61.0)).is_some_and(|room| room < 0.0));
//! # Ok(())
//! # }
//! ```

use super::clearance::{HalfSpace, Sphere};
use super::outline::Strip;
use crate::world::BasePlacement;
use crate::{Real, Rotor, Vec2};

/// How many half-spaces a fence holds.
pub const HALF_SPACES: usize = 8;
/// How many balls.
pub const SPHERES: usize = 4;

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
    pub(super) fn distances(&self, swing: Rotor<T>) -> [T; 2] {
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
