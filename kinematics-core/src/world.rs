//! Base ↔ world: Koivo 1994 (6), (7) for any heading, with chassis roll and pitch.

use crate::{Real, Rotor};

/// Where the base frame stands in the world: first roll about x, then pitch about y, then heading about z.
///
/// ```
/// use kinematics_core::Rotor;
/// use kinematics_core::world::BasePlacement;
/// // Facing the world's y: 3 m ahead and 1 m up of the base.
/// let quarter = Rotor::from_turns(0.25);
/// let level = BasePlacement::level(quarter, [10.0, 20.0, 0.5]);
/// assert_eq!(level.to_world([3.0, 0.0, 1.0]), [10.0, 23.0, 1.5]);
/// assert_eq!(level.to_base([10.0, 23.0, 1.5]), [3.0, 0.0, 1.0]);
/// // On its nose, ahead is down; on its right side, up is to the right.
/// let pitched = BasePlacement { heading: Rotor::IDENTITY, pitch: quarter, ..level };
/// assert_eq!(pitched.to_world([3.0, 0.0, 0.0]), [10.0, 20.0, -2.5]);
/// let rolled = BasePlacement { heading: Rotor::IDENTITY, roll: quarter, ..level };
/// assert_eq!(rolled.to_world([0.0, 0.0, 3.0]), [10.0, 17.0, 0.5]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BasePlacement<T> {
    /// Heading about the world's z, counter-clockwise. Koivo 1994 (6) is a heading of +90°.
    pub heading: Rotor<T>,
    /// Chassis pitch about y, positive nose down (right-handed about y).
    pub pitch: Rotor<T>,
    /// Chassis roll about x, positive to the right.
    pub roll: Rotor<T>,
    /// The base frame's origin in the world, m.
    pub origin: [T; 3],
}

impl<T: Real> BasePlacement<T> {
    /// Level ground at `origin` with a heading: Koivo 1994 (6).
    pub fn level(heading: Rotor<T>, origin: [T; 3]) -> Self {
        Self { heading, pitch: Rotor::IDENTITY, roll: Rotor::IDENTITY, origin }
    }

    /// A point in the base frame → world, m: Koivo 1994 (7).
    pub fn to_world(&self, point: [T; 3]) -> [T; 3] {
        let [x, y, z] = point;
        let (y, z) = turn(self.roll, y, z);
        let (z, x) = turn(self.pitch, z, x);
        let (x, y) = turn(self.heading, x, y);
        let [x0, y0, z0] = self.origin;
        [x0 + x, y0 + y, z0 + z]
    }

    /// A world point → base frame, m.
    pub fn to_base(&self, point: [T; 3]) -> [T; 3] {
        let [x0, y0, z0] = self.origin;
        let [x, y, z] = [point[0] - x0, point[1] - y0, point[2] - z0];
        let (x, y) = turn(self.heading.inverse(), x, y);
        let (z, x) = turn(self.pitch.inverse(), z, x);
        let (y, z) = turn(self.roll.inverse(), y, z);
        [x, y, z]
    }
}

fn turn<T: Real>(by: Rotor<T>, first: T, second: T) -> (T, T) {
    let v = by.rotate(crate::Vec2::new(first, second));
    (v.x, v.z)
}
