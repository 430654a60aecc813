//! Moment arms and transmission of each joint over its cylinder's stroke.

use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinders, Machine, PinGeometry, PoseError};
use serde::Serialize;

use super::grid;

/// Points along a stroke.
const POINTS: usize = 201;

/// One point of a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Lever {
    /// Cylinder length, m.
    pub length_m: f64,
    /// Joint angle, degrees.
    pub joint_deg: f64,
    /// dL/dθ, m/rad: the moment arm with its sign.
    pub moment_arm_m: f64,
    /// dθ/dL, rad/m.
    pub transmission_rad_per_m: f64,
}

/// One cylinder over its stroke.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Levers {
    /// `boom`, `arm` or `bucket`.
    pub cylinder: &'static str,
    /// Along the stroke, evenly.
    pub points: Vec<Lever>,
    /// Smallest size of the moment arm, m.
    pub smallest_m: f64,
    /// Largest size, m.
    pub largest_m: f64,
}

/// All three cylinders; the others rest in mid-stroke.
///
/// # Errors
/// A pose the map refuses, which validation rules out.
pub fn levers(geometry: &PinGeometry, machine: &Machine<f64>) -> Result<[Levers; 3], PoseError<f64>> {
    let strokes = [geometry.boom.stroke, geometry.arm.stroke, geometry.bucket.stroke];
    let middle = |stroke: Stroke| 0.5 * (stroke.min_m + stroke.max_m);
    let one = |which: usize, cylinder: &'static str| {
        let points = grid(strokes[which], POINTS).map(|length_m| {
            let mut all = strokes.map(middle);
            all[which] = length_m;
            let [boom, arm, bucket] = all;
            let lengths = Cylinders { boom, arm, bucket };
            let joints = machine.cylinders_to_joints(&lengths)?;
            let arms = machine.moment_arms(&lengths)?;
            let joint = [joints.boom, joints.arm, joints.bucket][which];
            let moment_arm_m = [arms.boom, arms.arm, arms.bucket][which];
            Ok(Lever {
                length_m,
                joint_deg: joint.angle().to_degrees(),
                moment_arm_m,
                transmission_rad_per_m: 1.0 / moment_arm_m,
            })
        });
        let points = points.collect::<Result<Vec<_>, _>>()?;
        let sizes = || points.iter().map(|p| p.moment_arm_m.abs());
        Ok(Levers {
            cylinder,
            smallest_m: sizes().fold(f64::INFINITY, |a, b| if b < a { b } else { a }),
            largest_m: sizes().fold(0.0, |a, b| if b > a { b } else { a }),
            points,
        })
    };
    Ok([one(0, "boom")?, one(1, "arm")?, one(2, "bucket")?])
}
