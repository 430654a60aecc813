//! How far a strip of the linkage is from a half-space or a sphere, and how fast it comes nearer.
//!
//! Everything is seen in the frame that turns with the swing: x is the reach, y sideways to the left, z the height above the
//! boom pin. An obstacle is fixed in the world and mapped there ([`HalfSpace::seen`], [`Sphere::seen`]); the swing's rate then
//! moves a point at (x, y) with (−y, x) a radian. With n the unit vector from the linkage's nearest point towards the obstacle,
//! the speed of approach is `n·J·q̇`, and the row `n·J` is minus the derivative of the distance: the nearest point's own
//! sliding does not count, since n stands at right angles to the strip or the point is its end (envelope theorem; Faverjon and
//! Tournassoud 1987 for the "velocity damper" built on it).
//!
//! A strip is the product of a segment in the plane and an interval across it, so its nearest point to a centre is found in
//! closed form: each factor's by itself (Ericson, *Real-Time Collision Detection*, 2005, §5.1.2).
//!
//! ```
//! use kinematics_core::planning::clearance::{HalfSpace, Sphere};
//! use kinematics_core::planning::outline::{Outline, OutlineShape};
//! use kinematics_core::world::BasePlacement;
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let geometry = PinGeometry::EXACT_MINI;
//! let machine = Machine::<f64>::new(&geometry)?;
//! let outline = Outline::<f64>::new(&geometry, &OutlineShape::of(&geometry))?;
//! let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
//! let placed = outline.place(&machine, &joints)?;
//!
//! // The machine looks along the world's y, its boom pin 0.8 m above the ground; a wall stands at y = 4 m.
//! let base = BasePlacement::level(Rotor::from_turns(0.25), [0.0, 0.0, 0.8]);
//! let swing = Rotor::from_degrees(10.0);
//! let wall = HalfSpace { normal: [0.0, 1.0, 0.0], offset: 4.0 }.seen(&base, swing);
//! let (distance, nearest) = placed.strips.iter().flat_map(|strip| strip.to_half_space(&wall))
//!     .map(|end| (end.distance, end))
//!     .reduce(|a, b| if b.0 < a.0 { b } else { a }).ok_or("no strip")?;
//! assert!(distance > 0.0 && distance < 4.0);
//! // Extending the arm (θ3 up) brings it nearer.
//! assert!(nearest.approach[2] > 0.0);
//!
//! // A pole's top, as a ball of 10 cm beside the bucket's tip.
//! let tip = machine.joints_to_tip(&joints, swing);
//! let [x, y, z] = base.to_world([tip.x, tip.y, tip.z()]);
//! let ball = Sphere { centre: [x, y, z + 0.5], radius: 0.1 }.seen(&base, swing);
//! let [.., teeth] = &placed.strips;
//! let clearance = teeth.to_sphere(&ball);
//! assert!(clearance.distance < 0.4);
//! // Swinging at the same rates in (swing, boom, arm, bucket) closes the distance by this many metres a second.
//! assert!(clearance.approach_speed(&[0.0, 0.1, 0.0, 0.0]) > 0.0);
//! # Ok(())
//! # }
//! ```

use super::outline::{MovingPoint, Strip, unswing};
use crate::world::BasePlacement;
use crate::{Real, Rotor, Vec2};

/// What lies on the allowed side of a plane: points p with `normal·p ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace<T> {
    /// Unit vector out of the allowed side, towards what is forbidden.
    pub normal: [T; 3],
    /// Of the plane along the normal, m.
    pub offset: T,
}

/// A forbidden ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere<T> {
    /// Its centre, m.
    pub centre: [T; 3],
    /// Its radius, m.
    pub radius: T,
}

/// A distance with its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance<T> {
    /// Between the surfaces, m; negative inside.
    pub distance: T,
    /// The point of the strip whose ball is nearest, in the frame that turns with the swing, m.
    pub nearest: [T; 3],
    /// Speed of approach by the rates of swing, boom, arm, bucket, m/rad: minus the derivative of the distance.
    pub approach: [T; 4],
}

impl<T: Real> Clearance<T> {
    /// Speed towards the obstacle at these rates of swing, boom, arm and bucket (rad/s), m/s.
    #[inline(always)]
    pub fn approach_speed(&self, rates: &[T; 4]) -> T {
        let [a, b, c, d] = self.approach;
        let [swing, boom, arm, bucket] = *rates;
        a * swing + b * boom + (c * arm + d * bucket)
    }
}

impl<T: Real> HalfSpace<T> {
    /// This half-space of the world in the frame that turns with the swing.
    pub fn seen(&self, base: &BasePlacement<T>, swing: Rotor<T>) -> Self {
        let at_origin = BasePlacement { origin: [T::ZERO; 3], ..*base };
        let offset = self.offset - dot(self.normal, base.origin);
        Self { normal: unswing(swing, at_origin.to_base(self.normal)), offset }
    }
}

impl<T: Real> Sphere<T> {
    /// This ball of the world in the frame that turns with the swing.
    pub fn seen(&self, base: &BasePlacement<T>, swing: Rotor<T>) -> Self {
        Self { centre: unswing(swing, base.to_base(self.centre)), radius: self.radius }
    }
}

fn dot<T: Real>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> T {
    a * x + b * y + c * z
}

/// n·J of a point at `y` beside the plane.
#[inline(always)]
fn approach<T: Real>(point: &MovingPoint<T>, y: T, [nx, ny, nz]: [T; 3]) -> [T; 4] {
    let [boom, arm, bucket] = point.per_joint.map(|v| nx * v.x + nz * v.z);
    [ny * point.at.x - nx * y, boom, arm, bucket]
}

impl<T: Real> Strip<T> {
    /// Clearance of both ends, each on its nearer side, to a half-space seen in this frame: the strip's is the smaller. Every
    /// point between them is bounded by both, in distance and in speed.
    #[inline]
    pub fn to_half_space(&self, space: &HalfSpace<T>) -> [Clearance<T>; 2] {
        let side = self.side(space);
        self.ends.map(|end| Clearance {
            distance: side.distance(&end),
            nearest: [end.at.x, side.y, end.at.z],
            approach: side.approach(&end),
        })
    }

    /// The side of the strip nearer to a half-space seen in this frame.
    #[inline(always)]
    pub(super) fn side(&self, space: &HalfSpace<T>) -> Side<T> {
        let [_, ny, _] = space.normal;
        let y = if ny < T::ZERO { -self.lateral } else { self.lateral };
        Side { normal: space.normal, y, room: space.offset - self.radius - ny * y }
    }

    /// Clearance to a ball seen in this frame. With its centre on the strip itself the direction is taken sideways.
    #[inline]
    pub fn to_sphere(&self, sphere: &Sphere<T>) -> Clearance<T> {
        self.facing(sphere).clearance(self)
    }

    /// The point of the strip nearest to a ball seen in this frame.
    #[inline(always)]
    pub(super) fn facing(&self, sphere: &Sphere<T>) -> Facing<T> {
        let [cx, cy, cz] = sphere.centre;
        let [from, to] = &self.ends;
        let (along, centre) = (to.at - from.at, Vec2::new(cx, cz) - from.at);
        let square = along.norm_squared();
        // Fraction of the way to the second end; 0 for a strip whose ends coincide.
        let part = if square > T::ZERO { within(along.dot(centre) / square, T::ZERO, T::ONE) } else { T::ZERO };
        let at = from.at.scale(T::ONE - part) + to.at.scale(part);
        let y = within(cy, -self.lateral, self.lateral);
        let between = [cx - at.x, cy - y, cz - at.z];
        let apart = dot(between, between).sqrt();
        Facing { part, at, y, between, apart, distance: apart - sphere.radius - self.radius }
    }
}

/// A side of a strip before a half-space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<T> {
    normal: [T; 3],
    y: T,
    /// The distance of a point in the origin, m.
    room: T,
}

impl<T: Real> Side<T> {
    /// An end's distance, m.
    #[inline(always)]
    pub(super) fn distance(&self, end: &MovingPoint<T>) -> T {
        let [nx, _, nz] = self.normal;
        self.room - (nx * end.at.x + nz * end.at.z)
    }

    /// How fast an end comes nearer.
    #[inline(always)]
    pub(super) fn approach(&self, end: &MovingPoint<T>) -> [T; 4] {
        approach(end, self.y, self.normal)
    }
}

/// The point of a strip nearest to a ball.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facing<T> {
    part: T,
    at: Vec2<T>,
    y: T,
    between: [T; 3],
    apart: T,
    /// Between the surfaces, m.
    pub(super) distance: T,
}

impl<T: Real> Facing<T> {
    #[inline(always)]
    fn clearance(&self, strip: &Strip<T>) -> Clearance<T> {
        let nearest = [self.at.x, self.y, self.at.z];
        Clearance { distance: self.distance, nearest, approach: self.approach(strip) }
    }

    /// How fast it comes nearer.
    #[inline(always)]
    pub(super) fn approach(&self, strip: &Strip<T>) -> [T; 4] {
        let [dx, dy, dz] = self.between;
        let apart = self.apart;
        let normal = if apart > T::ZERO { [dx / apart, dy / apart, dz / apart] } else { [T::ZERO, T::ONE, T::ZERO] };
        let [from, to] = &strip.ends;
        let (part, rest) = (self.part, T::ONE - self.part);
        let mix = |a: Vec2<T>, b: Vec2<T>| a.scale(rest) + b.scale(part);
        let [b0, a0, k0] = from.per_joint;
        let [b1, a1, k1] = to.per_joint;
        let point = MovingPoint { at: self.at, per_joint: [mix(b0, b1), mix(a0, a1), mix(k0, k1)] };
        approach(&point, self.y, normal)
    }
}

#[inline(always)]
fn within<T: Real>(x: T, low: T, high: T) -> T {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}
