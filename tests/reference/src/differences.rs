//! Derivatives of the oracle by central differences, in about 100 bits: what every closed-form rate is measured against.
//!
//! Steps are powers of two and lengths multiples of [`GRID_M`], so that length ± step is exact. At the pose nearest to a dead point
//! (frankel's boom, 0.1 mm short of it) a first difference is good to 1e-13, a second one to 1e-10.

use kinematics_core::Rotor;

use crate::oracle::{Oracle, Placed};
use crate::wide::{Point, Wide};

/// Lengths to be differentiated at are multiples of this, m.
pub const GRID_M: f64 = 1.0 / (1u64 << 40) as f64;
/// Step of first differences, m or rad.
pub const STEP: f64 = 1.0 / (1u64 << 33) as f64;
/// Step of second differences, m or rad.
pub const SECOND_STEP: f64 = 1.0 / (1u64 << 30) as f64;

/// The nearest length differences can be taken at.
pub fn on_grid(length_m: f64) -> f64 {
    (length_m / GRID_M).round() * GRID_M
}

fn wide(x: f64) -> Wide {
    Wide::from_f64(x)
}

/// A point in space.
pub type Space = [Wide; 3];

/// (last − first)/2h
pub fn first(first: Wide, last: Wide, h: f64) -> f64 {
    ((last - first) / wide(2.0 * h)).to_f64()
}

/// (first − 2·middle + last)/h²
pub fn second(points: [Wide; 3], h: f64) -> f64 {
    let [first, middle, last] = points;
    (((last - middle) - (middle - first)) / (wide(h) * wide(h))).to_f64()
}

/// The unit vector at a small angle, by its series.
pub fn turn(angle: f64) -> Point {
    assert!(angle.abs() < 1e-6, "{angle}");
    let x = wide(angle);
    let square = x * x;
    let one = wide(1.0);
    Point { x: one - square / wide(2.0) * (one - square / wide(12.0)), z: x * (one - square / wide(6.0)) }
}

/// A rotor as a wide unit vector in exactly its direction.
pub fn unit(rotor: Rotor<f64>) -> Point {
    Point::new(rotor.cos, rotor.sin).unit()
}

/// The joint one cylinder moves: unit vector at θ, by boom, arm, bucket.
pub fn joint(oracle: &Oracle, which: usize, length_m: f64) -> Point {
    match which {
        0 => oracle.boom(length_m),
        1 => oracle.arm(length_m),
        _ => oracle.bucket(length_m),
    }
}

/// dL/dθ and d²L/dθ² of one cylinder, from dθ/dL and d²θ/dL².
pub fn moment(oracle: &Oracle, which: usize, length_m: f64) -> [f64; 2] {
    let at = |h: f64| joint(oracle, which, length_m + h);
    // Vector products of unit vectors: the sines of angles so small that they are the angles.
    let rate = first(wide(0.0), at(-STEP).cross(at(STEP)), STEP);
    let middle = at(0.0);
    let [back, ahead] = [at(-SECOND_STEP).cross(middle), middle.cross(at(SECOND_STEP))];
    let slope = ((ahead - back) / (wide(SECOND_STEP) * wide(SECOND_STEP))).to_f64();
    [1.0 / rate, -slope / (rate * rate * rate)]
}

/// Rows reach, height, pitch of the derivative of tip and pitch between two placings 2h apart.
fn rows(before: &Placed, after: &Placed, h: f64) -> [f64; 3] {
    [
        first(before.tip.x, after.tip.x, h),
        first(before.tip.z, after.tip.z, h),
        first(wide(0.0), before.pitch.cross(after.pitch), h),
    ]
}

fn transposed(columns: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| columns.map(|column| column[row]))
}

/// d(reach, height, φ)/dθ at joints of exactly these directions.
pub fn joint_jacobian(oracle: &Oracle, joints: [Point; 3]) -> [[f64; 3]; 3] {
    transposed([0, 1, 2].map(|which| {
        let [before, after] = [-STEP, STEP].map(|angle| {
            let mut moved = joints;
            moved[which] = moved[which].turned(turn(angle));
            oracle.place(moved)
        });
        rows(&before, &after, STEP)
    }))
}

/// d(reach, height, φ)/dL.
pub fn cylinder_jacobian(oracle: &Oracle, lengths: [f64; 3]) -> [[f64; 3]; 3] {
    let joints = [0, 1, 2].map(|which| joint(oracle, which, lengths[which]));
    transposed([0, 1, 2].map(|which| {
        let [before, after] = [-STEP, STEP].map(|h| {
            let mut moved = joints;
            moved[which] = joint(oracle, which, lengths[which] + h);
            oracle.place(moved)
        });
        rows(&before, &after, STEP)
    }))
}

/// Tip acceleration (reach, height, φ) at constant joint rates.
pub fn joint_bias(oracle: &Oracle, joints: [Point; 3], rates: [f64; 3]) -> [f64; 3] {
    accelerations(
        [-1.0, 0.0, 1.0]
            .map(|sign| oracle.place([0, 1, 2].map(|i| joints[i].turned(turn(sign * rates[i] * SECOND_STEP))))),
    )
}

/// Tip acceleration (reach, height, φ) at constant cylinder rates; these must be small multiples of 1/64 m/s.
pub fn cylinder_bias(oracle: &Oracle, lengths: [f64; 3], rates: [f64; 3]) -> [f64; 3] {
    accelerations(
        [-1.0, 0.0, 1.0].map(|sign| oracle.forward([0, 1, 2].map(|i| lengths[i] + sign * rates[i] * SECOND_STEP))),
    )
}

fn accelerations(placed: [Placed; 3]) -> [f64; 3] {
    let [before, middle, after] = placed;
    let turned = [wide(0.0) - before.pitch.cross(middle.pitch), wide(0.0), middle.pitch.cross(after.pitch)];
    [
        second([before.tip.x, middle.tip.x, after.tip.x], SECOND_STEP),
        second([before.tip.z, middle.tip.z, after.tip.z], SECOND_STEP),
        second(turned, SECOND_STEP),
    ]
}

/// The tip in space, swung: (x, y, z).
pub fn swung(placed: &Placed, swing: Point) -> Space {
    [placed.tip.x * swing.x, placed.tip.x * swing.z, placed.tip.z]
}
