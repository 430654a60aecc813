//! The reference: every pin placed in the base frame by intersecting circles, in about 100 bits.
//!
//! None of kinematics-core's formulas is used: no law of cosines in product form, no constant rotors, no quotients. Which of two
//! intersections is meant is said by a side, as in a drawing: the boom's rod eye counter-clockwise of its cylinder's base
//! (clockwise where the cylinder stands above), the arm's clockwise, the common pin J clockwise of the bucket
//! cylinder's base seen from the rocker pivot, the coupler pin clockwise of J seen from the bucket pin, the knee above the wrist line.

use kinematics_core::geometry::{BoomCylinder, PinGeometry};
use kinematics_core::{Rotor, Vec2};

use crate::wide::{Point, Wide};

fn point(v: Vec2<f64>) -> Point {
    Point::new(v.x, v.z)
}

/// A machine's pins in wide numbers, and the maps on them. The letters are those of `kinematics_core::geometry`.
#[derive(Clone, Copy, Debug)]
pub struct Oracle {
    above: bool,
    links: [Wide; 4],
    a: Point,
    b: Point,
    c: Point,
    d: Point,
    e: Point,
    i: Point,
    h: Point,
    rocker: Wide,
    coupler: Wide,
}

/// Joint directions and the tip from the boom pin's base frame.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// Unit vectors at θ2, θ3, θ4.
    pub joints: [Point; 3],
    /// Tip: x from the swing axis, z from the boom pin, m.
    pub tip: Point,
    /// Unit vector at φ.
    pub pitch: Point,
}

/// The point at `near_radius` from `near` and `far_radius` from `far`, counter-clockwise of `far` seen from `near` or
/// clockwise of it.
pub fn intersection(near: Point, near_radius: Wide, far: Point, far_radius: Wide, counter_clockwise: bool) -> Point {
    let line = far - near;
    let distance = line.norm();
    let two = Wide::from_f64(2.0);
    let along = (near_radius * near_radius - far_radius * far_radius + distance * distance) / (two * distance);
    let across = (near_radius * near_radius - along * along).sqrt();
    let unit = line.scale(Wide::from_f64(1.0) / distance);
    let left = Point { x: -unit.z, z: unit.x };
    let foot = near + unit.scale(along);
    if counter_clockwise { foot + left.scale(across) } else { foot - left.scale(across) }
}

const ORIGIN: Point = Point::new(0.0, 0.0);

impl Oracle {
    /// The oracle of a machine.
    pub fn new(g: &PinGeometry) -> Self {
        Self {
            above: g.boom_cylinder == BoomCylinder::Above,
            links: [g.boom_pin_x_m, g.boom_m, g.arm_m, g.bucket_m].map(Wide::from_f64),
            a: point(g.boom.base),
            b: point(g.boom.rod),
            c: point(g.arm.base),
            d: point(g.arm.rod),
            e: point(g.bucket.base),
            i: point(g.bucket.rocker_pivot),
            h: point(g.bucket.coupler_pin),
            rocker: Wide::from_f64(g.bucket.rocker_m),
            coupler: Wide::from_f64(g.bucket.coupler_m),
        }
    }

    fn arm_pin(&self) -> Point {
        Point { x: self.links[1], z: Wide::from_f64(0.0) }
    }

    fn bucket_pin(&self) -> Point {
        Point { x: self.links[2], z: Wide::from_f64(0.0) }
    }

    /// Boom cylinder length (m) → unit vector at θ2.
    pub fn boom(&self, length: f64) -> Point {
        let rod_eye = intersection(ORIGIN, self.b.norm(), self.a, Wide::from_f64(length), !self.above);
        rod_eye.turned_back(self.b).unit()
    }

    /// Arm cylinder length (m) → unit vector at θ3.
    pub fn arm(&self, length: f64) -> Point {
        let rod_eye = intersection(self.arm_pin(), self.d.norm(), self.c, Wide::from_f64(length), false);
        (rod_eye - self.arm_pin()).turned_back(self.d).unit()
    }

    /// The rocker's common pin J in the arm frame.
    pub fn common_pin(&self, length: f64) -> Point {
        intersection(self.i, self.rocker, self.e, Wide::from_f64(length), false)
    }

    /// Bucket cylinder length (m) → unit vector at θ4.
    pub fn bucket(&self, length: f64) -> Point {
        let coupler_pin = intersection(self.bucket_pin(), self.h.norm(), self.common_pin(length), self.coupler, false);
        (coupler_pin - self.bucket_pin()).turned_back(self.h).unit()
    }

    /// Unit vectors at θ2, θ3, θ4 → the tip.
    pub fn place(&self, joints: [Point; 3]) -> Placed {
        let [boom, arm, bucket] = joints;
        let arm_direction = arm.turned(boom);
        let pitch = bucket.turned(arm_direction);
        let boom_pin = Point { x: self.links[0], z: Wide::from_f64(0.0) };
        let tip =
            boom_pin + boom.scale(self.links[1]) + arm_direction.scale(self.links[2]) + pitch.scale(self.links[3]);
        Placed { joints, tip, pitch }
    }

    /// Cylinder lengths (m) → joints and tip.
    pub fn forward(&self, lengths: [f64; 3]) -> Placed {
        let [boom, arm, bucket] = lengths;
        self.place([self.boom(boom), self.arm(arm), self.bucket(bucket)])
    }

    /// Tip and pitch direction (of any length) → cylinder lengths (m), all pins placed in the base frame at the boom pin.
    pub fn inverse(&self, tip: Point, pitch: Point) -> [Wide; 3] {
        let pitch = pitch.unit();
        let [a1, a2, a3, a4] = self.links;
        let wrist = Point { x: tip.x - a1, z: tip.z } - pitch.scale(a4);
        let knee = intersection(ORIGIN, a2, wrist, a3, true);
        let boom = knee.unit();
        let arm = (wrist - knee).unit();
        let on_boom = |p: Point| p.turned(boom);
        let on_arm = |p: Point| knee + p.turned(arm);
        let coupler_pin = wrist + self.h.turned(pitch);
        let pivot = on_arm(self.i);
        let common = intersection(pivot, self.rocker, coupler_pin, self.coupler, true);
        [(on_boom(self.b) - self.a).norm(), (on_arm(self.d) - on_boom(self.c)).norm(), (common - on_arm(self.e)).norm()]
    }

    /// The five distances between pins that `lengths` and the geometry prescribe, minus what [`Oracle::forward`]'s pins keep, m.
    pub fn residuals(&self, lengths: [f64; 3]) -> [f64; 5] {
        let Placed { joints: [boom, arm, bucket], .. } = self.forward(lengths);
        let [l_boom, l_arm, l_bucket] = lengths.map(Wide::from_f64);
        let arm_direction = arm.turned(boom);
        let knee = self.arm_pin().turned(boom);
        let on_arm = |p: Point| knee + p.turned(arm_direction);
        let common = on_arm(self.common_pin(lengths[2]));
        let coupler_pin = on_arm(self.bucket_pin() + self.h.turned(bucket));
        let misses = [
            (self.b.turned(boom) - self.a).norm() - l_boom,
            (on_arm(self.d) - self.c.turned(boom)).norm() - l_arm,
            (common - on_arm(self.e)).norm() - l_bucket,
            (common - on_arm(self.i)).norm() - self.rocker,
            (common - coupler_pin).norm() - self.coupler,
        ];
        misses.map(Wide::to_f64)
    }
}

/// A rotor of any precision as a wide direction, exactly as its two numbers say.
pub fn direction<T: kinematics_core::Real>(rotor: Rotor<T>) -> Point {
    Point::new(rotor.cos.to_f64(), rotor.sin.to_f64())
}

/// How far two points are apart, m (or, of unit vectors, rad), as f64.
pub fn apart(left: Point, right: Point) -> f64 {
    (left - right).norm().to_f64()
}
