//! A few capsules that enclose the linkage, and how far spheres anywhere in space are from them.
//!
//! Boom, arm and bucket lie in one vertical plane that turns with the swing: the nearest point of a segment in that plane to a
//! sphere's centre is the nearest to the centre's shadow on the plane, and the distance adds the lateral offset by Pythagoras.

use crate::geometry::{GeometryError, PinGeometry};
use crate::{Real, Rotor, Vec2};

/// A sphere to keep away from, in the base frame (z above the boom pin), m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sphere<T> {
    /// Centre, forward at zero swing.
    pub x: T,
    /// Centre, to the left.
    pub y: T,
    /// Centre, above the boom pin.
    pub z: T,
    /// Radius.
    pub radius: T,
}

/// What there is around the pins, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flesh {
    /// Half the height and width of boom, arm and cylinders.
    pub beam_m: f64,
    /// Half the width of the bucket.
    pub bucket_m: f64,
}

impl Flesh {
    /// Of a machine of this reach, m: beams of a twentieth, a bucket of a tenth of it.
    ///
    /// ```
    /// use kinematics_core::planning::hull::Flesh;
    /// assert_eq!(Flesh::of_reach(10.0), Flesh { beam_m: 0.25, bucket_m: 0.5 });
    /// ```
    pub fn of_reach(reach_m: f64) -> Self {
        Self { beam_m: 0.025 * reach_m, bucket_m: 0.05 * reach_m }
    }
}

/// Which joints move a segment's end: those up to its link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Link {
    Body,
    Boom,
    Arm,
    Bucket,
}

/// So many segments.
pub const SEGMENTS: usize = 6;

/// The segments' ends: boom in two parts about its knee, boom cylinder, arm cylinder, arm, bucket.
const ENDS: [(Link, Link); SEGMENTS] = [
    (Link::Boom, Link::Boom),
    (Link::Boom, Link::Boom),
    (Link::Body, Link::Boom),
    (Link::Boom, Link::Arm),
    (Link::Arm, Link::Arm),
    (Link::Bucket, Link::Bucket),
];

/// The hull: six segments, each with a radius. Every pin lies inside by at least the flesh, over all of the stroke.
///
/// ```
/// use kinematics_core::planning::hull::{Flesh, Hull, Sphere};
/// use kinematics_core::{PinGeometry, Rotor};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let hull = Hull::<f64>::new(&PinGeometry::EXACT_MINI, Flesh { beam_m: 0.1, bucket_m: 0.2 })?;
/// let joints = [0.0, 30.0, -90.0, -30.0].map(Rotor::from_degrees);
/// // A ball to the left of the boom: swinging left closes in on it, and the other joints do not.
/// let ball = Sphere { x: 1.0, y: 1.5, z: 0.8, radius: 0.3 };
/// let near = hull.place(&joints).nearest(&ball);
/// assert!(near.distance > 0.5 && near.distance < 1.2);
/// assert!(near.row[0] < -0.8);
/// // It is the nearest of six segments.
/// let placed = hull.place(&joints);
/// assert!(placed.near(&ball).iter().all(|segment| segment.distance >= near.distance));
/// assert_eq!(placed.capsules().count(), 6);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hull<T> {
    a1: T,
    a2: T,
    a3: T,
    knee: Vec2<T>,
    boom_base: Vec2<T>,
    boom_rod: Vec2<T>,
    arm_base: Vec2<T>,
    arm_rod: Vec2<T>,
    arm_end: Vec2<T>,
    bucket_start: Vec2<T>,
    bucket_m: T,
    radii: [T; SEGMENTS],
}

/// The hull at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed<T> {
    a1: T,
    swing: Rotor<T>,
    arm_pin: Vec2<T>,
    bucket_pin: Vec2<T>,
    segments: [[Vec2<T>; 2]; SEGMENTS],
    radii: [T; SEGMENTS],
}

/// The nearest place of the hull to a sphere: Park 2008's critical point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near<T> {
    /// Between hull and sphere, m; negative inside.
    pub distance: T,
    /// ∂distance/∂(θ1, θ2, θ3, θ4), m/rad: Park's obstacle Jacobian along the line of centres.
    pub row: [T; 4],
}

/// `clamp` would link a panic for limits in the wrong order.
fn limited(x: f64, low: f64, high: f64) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

fn to_segment(point: Vec2<f64>, from: Vec2<f64>, to: Vec2<f64>) -> f64 {
    let along = to - from;
    let share = limited((point - from).dot(along) / along.norm_squared(), 0.0, 1.0);
    (point - from - along.scale(share)).norm()
}

fn farthest(points: &[Vec2<f64>], distance: impl Fn(Vec2<f64>) -> f64) -> f64 {
    points.iter().fold(0.0, |far, &point| if distance(point) > far { distance(point) } else { far })
}

/// Places of the bucket cylinder at which its rod's pin is looked up.
const LOOKS: i32 = 16;

/// The common pin J of rod, rocker and coupler in the arm frame at a cylinder length; validated geometry closes there.
fn rocker_pin(g: &PinGeometry, length: f64) -> Vec2<f64> {
    let (to_base, r) = (g.bucket.base - g.bucket.rocker_pivot, g.bucket.rocker_m);
    let side = to_base.norm();
    let cos = limited((side * side + r * r - length * length) / (2.0 * side * r), -1.0, 1.0);
    let turn = Vec2::new(cos, -Real::sqrt(1.0 - cos * cos));
    g.bucket.rocker_pivot + turn.complex_mul(to_base).scale(r / side)
}

impl<T: Real> Hull<T> {
    /// The hull of a validated geometry with so much flesh around its pins.
    ///
    /// # Errors
    /// The geometry's first problem.
    pub fn new(geometry: &PinGeometry, flesh: Flesh) -> Result<Self, GeometryError> {
        let g = geometry;
        g.validate()?;
        let origin = Vec2::new(0.0, 0.0);
        let (arm_pin, bucket_pin) = (Vec2::new(g.boom_m, 0.0), Vec2::new(g.arm_m, 0.0));
        // The boom bends between the lugs of its two cylinders.
        let knee = (g.boom.rod + g.arm.base).scale(0.5);
        let beam = farthest(&[g.boom.rod, g.arm.base], |p| {
            let (first, second) = (to_segment(p, origin, knee), to_segment(p, knee, arm_pin));
            if first < second { first } else { second }
        });
        // The arm's segment runs from its cylinder's lug to half-way between bucket pin and the rocker's mean place.
        let RockerPins { pins, mean } = RockerPins::of(g);
        let arm_end = (bucket_pin + mean).scale(0.5);
        let near_arm = |p| to_segment(p, g.arm.rod, arm_end);
        let pins_far = farthest(&pins, near_arm);
        let fixed_far = farthest(&[origin, bucket_pin, g.bucket.base, g.bucket.rocker_pivot], near_arm);
        let arm = if pins_far > fixed_far { pins_far } else { fixed_far };
        let bucket_start = g.bucket.coupler_pin.scale(0.5);
        let tip = Vec2::new(g.bucket_m, 0.0);
        let bucket = farthest(&[origin, g.bucket.coupler_pin], |p| to_segment(p, bucket_start, tip));
        let bucket_flesh = if flesh.bucket_m > flesh.beam_m { flesh.bucket_m } else { flesh.beam_m };
        let b = flesh.beam_m;
        let round = |v: Vec2<f64>| Vec2::new(T::from_f64(v.x), T::from_f64(v.z));
        Ok(Self {
            a1: T::from_f64(g.boom_pin_x_m),
            a2: T::from_f64(g.boom_m),
            a3: T::from_f64(g.arm_m),
            knee: round(knee),
            boom_base: round(g.boom.base),
            boom_rod: round(g.boom.rod),
            arm_base: round(g.arm.base),
            arm_rod: round(g.arm.rod),
            arm_end: round(arm_end),
            bucket_start: round(bucket_start),
            bucket_m: T::from_f64(g.bucket_m),
            radii: [beam + b, beam + b, b, b, arm + b, bucket + bucket_flesh].map(T::from_f64),
        })
    }

    /// The thickest radius, m.
    pub(crate) fn thickest_m(&self) -> T {
        self.radii.into_iter().fold(T::ZERO, |most, r| if r > most { r } else { most })
    }

    /// The hull at the joints swing, boom, arm, bucket.
    #[inline(always)]
    pub fn place(&self, joints: &[Rotor<T>; 4]) -> Placed<T> {
        let [swing, boom, arm, bucket] = *joints;
        let arm = boom * arm;
        let bucket = arm * bucket;
        let zero = Vec2::new(T::ZERO, T::ZERO);
        let arm_pin = boom.to_vec().scale(self.a2);
        let bucket_pin = arm_pin + arm.to_vec().scale(self.a3);
        let knee = boom.rotate(self.knee);
        Placed {
            a1: self.a1,
            swing,
            arm_pin,
            bucket_pin,
            segments: [
                [zero, knee],
                [knee, arm_pin],
                [self.boom_base, boom.rotate(self.boom_rod)],
                [boom.rotate(self.arm_base), arm_pin + arm.rotate(self.arm_rod)],
                [arm_pin + arm.rotate(self.arm_rod), arm_pin + arm.rotate(self.arm_end)],
                [bucket_pin + bucket.rotate(self.bucket_start), bucket_pin + bucket.to_vec().scale(self.bucket_m)],
            ],
            radii: self.radii,
        }
    }
}

/// The rocker's pin over the bucket cylinder's stroke.
struct RockerPins {
    pins: [Vec2<f64>; LOOKS as usize + 1],
    mean: Vec2<f64>,
}

impl RockerPins {
    fn of(g: &PinGeometry) -> Self {
        let stroke = g.bucket.stroke;
        let mut pins = [Vec2::new(0.0, 0.0); LOOKS as usize + 1];
        let mut mean = Vec2::new(0.0, 0.0);
        for (i, pin) in pins.iter_mut().enumerate() {
            let share = i as f64 / f64::from(LOOKS);
            *pin = rocker_pin(g, stroke.min_m + share * (stroke.max_m - stroke.min_m));
            mean = mean + pin.scale(1.0 / f64::from(LOOKS + 1));
        }
        Self { pins, mean }
    }
}

impl<T: Real> Placed<T> {
    /// The six segments in the plane, from the boom pin, each with its radius; m.
    pub fn capsules(&self) -> impl Iterator<Item = ([Vec2<T>; 2], T)> + '_ {
        self.segments.iter().copied().zip(self.radii)
    }

    /// The nearest place of each segment to a sphere. Two segments may be equally near: a step that heeds one of them alone closes in
    /// with the other, turn and turn about.
    #[inline(never)]
    pub fn near(&self, sphere: &Sphere<T>) -> [Near<T>; SEGMENTS] {
        self.near_inlined(sphere)
    }

    /// [`Self::near`] of one sphere, in place.
    #[inline(never)]
    pub(super) fn near_into(&self, sphere: &Sphere<T>, near: &mut [Near<T>; SEGMENTS]) {
        self.fill(sphere, near);
    }

    #[inline(always)]
    pub(super) fn near_inlined(&self, sphere: &Sphere<T>) -> [Near<T>; SEGMENTS] {
        let mut near = [Near { distance: T::ZERO, row: [T::ZERO; 4] }; SEGMENTS];
        self.fill(sphere, &mut near);
        near
    }

    #[inline(always)]
    fn fill(&self, sphere: &Sphere<T>, near: &mut [Near<T>; SEGMENTS]) {
        let swing = self.swing;
        // The centre seen from the boom pin, in the frame that turns with the swing.
        let centre = Vec2::new(sphere.x * swing.cos + sphere.y * swing.sin - self.a1, sphere.z);
        let lateral = sphere.y * swing.cos - sphere.x * swing.sin;
        for (((near, segment), &radius), &links) in near.iter_mut().zip(&self.segments).zip(&self.radii).zip(&ENDS) {
            *near = self.near_segment(segment, links, radius + sphere.radius, centre, lateral);
        }
    }

    /// The nearest place to a sphere.
    #[inline]
    pub fn nearest(&self, sphere: &Sphere<T>) -> Near<T> {
        let [first, rest @ ..] = self.near(sphere);
        rest.into_iter().fold(first, |best, near| if near.distance < best.distance { near } else { best })
    }

    #[inline(always)]
    fn near_segment(
        &self,
        &[from, to]: &[Vec2<T>; 2],
        (first, last): (Link, Link),
        radii: T,
        centre: Vec2<T>,
        lateral: T,
    ) -> Near<T> {
        let (along, start) = (to - from, centre - from);
        let wanted = start.dot(along) / (along.norm_squared() + T::from_f64(1e-12));
        let share = if wanted > T::ONE {
            T::ONE
        } else if wanted > T::ZERO {
            wanted
        } else {
            T::ZERO
        };
        let point = from + along.scale(share);
        let apart = point - centre;
        let length = (apart.norm_squared() + lateral * lateral).sqrt_of_magnitude();
        let inverse = T::ONE / (length + T::from_f64(1e-12));
        let normal = apart.scale(inverse);
        let mut planar = [T::ZERO; 3];
        let pivots = [Vec2::new(T::ZERO, T::ZERO), self.arm_pin, self.bucket_pin];
        for ((entry, pivot), link) in planar.iter_mut().zip(pivots).zip([Link::Boom, Link::Arm, Link::Bucket]) {
            // A point turning about a pivot moves at right angles to its lever: n·(ω × l) = ω·(l × n).
            *entry = if first >= link {
                (point - pivot).cross(normal)
            } else if last >= link {
                // Only the far end turns.
                (to - pivot).cross(normal) * share
            } else {
                T::ZERO
            };
        }
        let [boom, arm, bucket] = planar;
        Near { distance: length - radii, row: [-(lateral * inverse) * (point.x + self.a1), boom, arm, bucket] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cylinders, Machine};

    const FLESH: Flesh = Flesh { beam_m: 0.1, bucket_m: 0.15 };

    fn hull() -> Hull<f64> {
        Hull::new(&PinGeometry::EXACT_MINI, FLESH).unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn the_row_is_the_distances_derivative_by_every_joint() {
        let hull = hull();
        for i in 0..400 {
            let f = f64::from(i);
            let degrees =
                [20.0 * (f * 0.7).sin(), 20.0 + 30.0 * (f * 1.3).sin(), -80.0 + 45.0 * (f * 2.1).sin(), -60.0];
            let joints = degrees.map(Rotor::from_degrees);
            let ball =
                Sphere { x: 2.0 + (f * 0.37).sin(), y: (f * 0.53).cos(), z: (f * 0.91).sin() * 1.5, radius: 0.2 };
            let near = hull.place(&joints).nearest(&ball);
            for (joint, slope) in near.row.into_iter().enumerate() {
                let at = |by: f64| {
                    let mut turned = joints;
                    turned[joint] = turned[joint] * Rotor::from_angle(by);
                    hull.place(&turned).nearest(&ball).distance
                };
                let (step, here) = (1e-6, near.distance);
                let (ahead, behind) = ((at(step) - here) / step, (here - at(-step)) / step);
                // Where the nearest segment changes, the slope is one of both sides'.
                assert!((ahead - slope).abs() < 1e-4 || (behind - slope).abs() < 1e-4, "{i} {joint}: {ahead} {slope}");
            }
        }
    }

    #[test]
    fn swinging_away_from_a_sphere_never_closes_in_on_it() {
        let hull = hull();
        let ball = Sphere { x: 2.5, y: 0.0, z: 0.3, radius: 0.3 };
        for degrees in [[50.0, -60.0, -20.0], [10.0, -100.0, 20.0], [-20.0, -40.0, -120.0]] {
            let [boom, arm, bucket] = degrees.map(Rotor::from_degrees);
            let mut last = -1.0;
            for swing in 0..180 {
                let placed = hull.place(&[Rotor::from_degrees(f64::from(swing)), boom, arm, bucket]);
                // The lemma holds where every point lies before the swing axis.
                if placed.capsules().all(|([from, to], _)| from.x >= 0.0 && to.x >= 0.0) {
                    let distance = placed.nearest(&ball).distance;
                    assert!(distance >= last - 1e-12, "{degrees:?} at {swing}");
                    last = distance;
                }
            }
        }
    }

    #[test]
    fn every_pin_lies_in_the_hull_by_at_least_the_flesh() {
        let (hull, g) = (hull(), PinGeometry::EXACT_MINI);
        let machine = Machine::<f64>::new(&g).unwrap_or_else(|e| panic!("{e}"));
        let mut looked_at = 0;
        for i in 0..1000 {
            let share = |n: i32| f64::from(i / n % 10) / 9.0;
            let of = |stroke: crate::geometry::Stroke, n| stroke.min_m + share(n) * (stroke.max_m - stroke.min_m);
            let cylinders =
                Cylinders { boom: of(g.boom.stroke, 1), arm: of(g.arm.stroke, 10), bucket: of(g.bucket.stroke, 100) };
            let joints = machine.cylinders_to_joints(&cylinders).unwrap_or_else(|e| panic!("{e}"));
            let arm = joints.boom * joints.arm;
            let bucket = arm * joints.bucket;
            let arm_pin = joints.boom.to_vec().scale(g.boom_m);
            let bucket_pin = arm_pin + arm.to_vec().scale(g.arm_m);
            let pins = [
                joints.boom.rotate(g.boom.rod),
                joints.boom.rotate(g.arm.base),
                arm_pin,
                arm_pin + arm.rotate(g.arm.rod),
                arm_pin + arm.rotate(g.bucket.base),
                arm_pin + arm.rotate(g.bucket.rocker_pivot),
                arm_pin + arm.rotate(rocker_pin(&g, cylinders.bucket)),
                bucket_pin,
                bucket_pin + bucket.rotate(g.bucket.coupler_pin),
                bucket_pin + bucket.to_vec().scale(g.bucket_m),
            ];
            let placed = hull.place(&[Rotor::IDENTITY, joints.boom, joints.arm, joints.bucket]);
            for pin in pins {
                let near = placed.nearest(&Sphere { x: pin.x, y: 0.0, z: pin.z, radius: FLESH.beam_m });
                // The rocker's pin is looked up at 17 places of its arc.
                assert!(near.distance <= -2.0 * FLESH.beam_m + 2e-3, "{near:?}");
                looked_at += 1;
            }
        }
        assert_eq!(looked_at, 10_000);
        // The coupler really reaches from J to H.
        let h = machine.chain().lengths();
        assert_eq!(h[3], g.bucket_m);
    }
}
