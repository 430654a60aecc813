//! Sentences about a pose that cannot be: which cylinder, its length, its stroke.

use kinematics_core::geometry::{PinGeometry, Stroke};
use kinematics_core::{Cylinder, Cylinders, Joints, Rotor};

use super::angle;
use super::{Failure, Kind};

/// A number for people, to a nanometre.
fn short(x: f64) -> String {
    if x.abs() < 1e6 { ((x * 1e9).round() / 1e9).to_string() } else { format!("{x:e}") }
}

fn failure(kind: Kind, message: String) -> Failure {
    Failure { kind, message }
}

pub(super) fn stroke(geometry: &PinGeometry, cylinder: Cylinder) -> Stroke {
    match cylinder {
        Cylinder::Boom => geometry.boom.stroke,
        Cylinder::Arm => geometry.arm.stroke,
        // The maps in the plane never speak of the swing cylinder.
        Cylinder::Bucket | Cylinder::Swing => geometry.bucket.stroke,
    }
}

fn limits(geometry: &PinGeometry, cylinder: Cylinder) -> String {
    let Stroke { min_m, max_m } = stroke(geometry, cylinder);
    format!("its stroke is {} to {} m", short(min_m), short(max_m))
}

/// The length of one cylinder.
pub(super) fn length<T: Copy>(cylinders: &Cylinders<T>, cylinder: Cylinder) -> T {
    match cylinder {
        Cylinder::Boom => cylinders.boom,
        Cylinder::Arm => cylinders.arm,
        Cylinder::Bucket | Cylinder::Swing => cylinders.bucket,
    }
}

/// The joint one cylinder moves.
pub(super) fn joint<T: Copy>(joints: &Joints<T>, cylinder: Cylinder) -> Rotor<T> {
    match cylinder {
        Cylinder::Boom => joints.boom,
        Cylinder::Arm => joints.arm,
        Cylinder::Bucket | Cylinder::Swing => joints.bucket,
    }
}

pub(super) fn out_of_stroke(geometry: &PinGeometry, cylinder: Cylinder, length_m: f64) -> Failure {
    let Stroke { min_m, max_m } = stroke(geometry, cylinder);
    let by = if length_m > max_m {
        format!("{} m above its maximum", short(length_m - max_m))
    } else {
        format!("{} m below its minimum", short(min_m - length_m))
    };
    let limits = limits(geometry, cylinder);
    let message = format!("{cylinder} cylinder: a length of {} m is {by}; {limits}", short(length_m));
    failure(Kind::OutOfStroke, message)
}

/// A length with which the linkage does not close.
pub(super) fn open(geometry: &PinGeometry, cylinder: Cylinder, length_m: f64, by: f64) -> Failure {
    let limits = limits(geometry, cylinder);
    let (length_m, by) = (short(length_m), short(by));
    let message =
        format!("{cylinder} cylinder: with a length of {length_m} m its linkage misses closing by {by} m; {limits}");
    failure(Kind::NoAssembly, message)
}

/// A joint angle that no length gives: the linkage does not close there, or the angle lies beyond its dead point.
pub(super) fn no_length(geometry: &PinGeometry, cylinder: Cylinder, joint: Rotor<f64>, by: f64) -> Failure {
    let limits = limits(geometry, cylinder);
    let (degrees, by) = (short(angle::degrees(joint)), short(by));
    let message = format!(
        "{cylinder} cylinder: no length puts the {cylinder} at {degrees}°: its linkage would not close, or be beyond its dead point, by {by} m; {limits}"
    );
    failure(Kind::NoAssembly, message)
}

/// A tip whose bucket pin boom and arm do not reach.
pub(super) fn unreachable(geometry: &PinGeometry, tip: [f64; 3], by: f64) -> Failure {
    let [x, z, pitch] = tip;
    let bucket = angle::rotor(pitch);
    let distance =
        libm::hypot(x - geometry.boom_pin_x_m - geometry.bucket_m * bucket.cos, z - geometry.bucket_m * bucket.sin);
    let (inner, outer) = ((geometry.boom_m - geometry.arm_m).abs(), geometry.boom_m + geometry.arm_m);
    let side = if by > 0.0 {
        format!("{} m too far", short((distance - outer).max(0.0)))
    } else {
        format!("{} m too near", short((inner - distance).max(0.0)))
    };
    let message = format!(
        "the bucket pin would be {} m from the boom pin, {side}; boom and arm reach {} to {} m",
        short(distance),
        short(inner),
        short(outer)
    );
    failure(Kind::Unreachable, message)
}
