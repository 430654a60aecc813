//! What joints a geometry's cylinders set, in f64: for constants, and compiled once for all of them.

use crate::error::Cylinder;
use crate::four_bar::FourBar;
use crate::triangle::{Side, Triangle};
use crate::{PinGeometry, Rotor};

/// The linkages of a geometry, validated or not.
pub(crate) struct Linkages {
    boom: Triangle<f64>,
    arm: Triangle<f64>,
    bucket: FourBar<f64>,
    swing: Option<Triangle<f64>>,
}

impl Linkages {
    #[inline(never)]
    pub(crate) fn new(g: &PinGeometry) -> Self {
        let triangle = |base, rod, side| Triangle::new(base, rod, side, 1.0);
        Self {
            boom: triangle(g.boom.base, g.boom.rod, g.boom_cylinder.side()),
            arm: triangle(g.arm_base_from_pin(), g.arm.rod, Side::Clockwise),
            bucket: g.four_bar(),
            swing: g.swing.as_ref().map(|swing| triangle(swing.base, swing.rod, Side::CounterClockwise)),
        }
    }

    /// Cylinder length (m) → its joint's rotor; `None` where the linkage does not close.
    #[inline(never)]
    pub(crate) fn rotor(&self, cylinder: Cylinder, length: f64) -> Option<Rotor<f64>> {
        let triangle = match cylinder {
            Cylinder::Boom => &self.boom,
            Cylinder::Arm => &self.arm,
            Cylinder::Bucket => return self.bucket.rotor(length).ok(),
            Cylinder::Swing => self.swing.as_ref()?,
        };
        triangle.rotor(length).ok()
    }

    /// The bucket's own.
    pub(crate) fn bucket(&self) -> &FourBar<f64> {
        &self.bucket
    }
}
