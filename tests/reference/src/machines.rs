//! The reference machines' pins as numbers, so that these tests do not depend on the machine files they help to check.

use kinematics_core::geometry::{BoomCylinder, BucketPins, CylinderPins, PinGeometry, Stroke};
use kinematics_core::{GeometryError, Vec2};

/// One inch, m: exact.
pub const INCH_M: f64 = 0.0254;

/// A machine with its name.
pub type Named = (&'static str, PinGeometry);

/// All four machines.
///
/// # Errors
/// Frankel's distances do not form a backhoe.
pub fn all() -> Result<[Named; 4], GeometryError> {
    Ok([
        ("frankel", frankel_distances().to_pins()?),
        ("exact-mini", PinGeometry::EXACT_MINI),
        ("zx120", ZX120),
        ("zx200", ZX200),
    ])
}

const fn stroke(min_m: f64, max_m: f64) -> Stroke {
    Stroke { min_m, max_m }
}

/// Frankel 2003 `dimensions.m` and the travel limits of its figure: the set the bench counts on.
pub use bench::ours::frankel as frankel_distances;

/// Hitachi ZX200 class, 20 t: PWRI OPERA's published simulation scene and URDF.
pub const ZX200: PinGeometry = PinGeometry {
    boom_pin_x_m: 0.22767,
    boom_m: 5.647892,
    arm_m: 2.889418,
    bucket_m: 1.512634,
    boom_cylinder: BoomCylinder::Below,
    boom: CylinderPins {
        base: Vec2::new(0.46145, -0.60251),
        rod: Vec2::new(2.233627, 0.950485),
        stroke: stroke(1.825, 3.084),
    },
    arm: CylinderPins {
        base: Vec2::new(3.416451, 1.147495),
        rod: Vec2::new(-0.801754, 0.346504),
        stroke: stroke(1.808, 3.295),
    },
    bucket: BucketPins {
        base: Vec2::new(0.393535, 0.669092),
        rocker_pivot: Vec2::new(2.452339, 0.044082),
        coupler_pin: Vec2::new(-0.093815, 0.459141),
        rocker_m: 0.578671,
        coupler_m: 0.561098,
        stroke: stroke(1.620, 2.646),
    },
    swing: None,
};

/// Hitachi ZX120 class, 12 t: PWRI OPERA's published simulation scene and URDF. The swing axis is not published; its boom pin
/// is measured from the base origin.
pub const ZX120: PinGeometry = PinGeometry {
    boom_pin_x_m: 0.1543,
    boom_m: 4.565106,
    arm_m: 2.496411,
    bucket_m: 1.236843,
    boom_cylinder: BoomCylinder::Below,
    boom: CylinderPins {
        base: Vec2::new(0.401775, -0.28031),
        rod: Vec2::new(1.699726, 0.987967),
        stroke: stroke(1.519, 2.339),
    },
    arm: CylinderPins {
        base: Vec2::new(2.654863, 1.064184),
        rod: Vec2::new(-0.601210, 0.292789),
        stroke: stroke(1.618, 2.781),
    },
    bucket: BucketPins {
        base: Vec2::new(0.446977, 0.548004),
        rocker_pivot: Vec2::new(2.175773, 0.022329),
        coupler_pin: Vec2::new(-0.098611, 0.350322),
        rocker_m: 0.496379,
        coupler_m: 0.480815,
        stroke: stroke(1.326, 2.201),
    },
    swing: None,
};

/// exact-mini with an arm as long as its boom, the bucket's linkage moved along with the arm's end.
pub fn equal_links() -> PinGeometry {
    let mut g = PinGeometry::EXACT_MINI;
    let longer = g.boom_m - g.arm_m;
    g.arm_m = g.boom_m;
    g.bucket.base.x += longer;
    g.bucket.rocker_pivot.x += longer;
    g
}
