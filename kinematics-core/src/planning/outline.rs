//! The whole linkage as rounded strips: boom with its knee, arm, cylinders, rocker and coupler, bucket with its back and teeth.
//!
//! A strip is a line between two pins in the plane, widened sideways, with a ball of one radius at each of its points. Its ends
//! may belong to two bodies (a cylinder's do); every end carries its velocity by each joint's rate.
//!
//! ```
//! use kinematics_core::planning::outline::{Outline, OutlineShape, PARTS, Part, PlacedOutline};
//! use kinematics_core::{Cylinders, Machine, PinGeometry};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let geometry = PinGeometry::EXACT_MINI;
//! // Sizes not measured follow from the machine's: its 44 cm wide bucket from 3.7 m of reach.
//! let shape = OutlineShape::of(&geometry);
//! assert!((shape.bucket_half_width_m - 0.22).abs() < 1e-3);
//! let machine = Machine::<f64>::new(&geometry)?;
//! let outline = Outline::<f64>::new(&geometry, &shape)?;
//! let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
//! let placed = outline.place(&machine, &joints)?;
//! // Or into one that is there.
//! let mut there = PlacedOutline::nowhere();
//! outline.place_into(&machine, &joints, &mut there)?;
//! assert_eq!(there, placed);
//! // Or in two halves.
//! let mut there = PlacedOutline::nowhere();
//! outline.place_beams(&joints, &mut there);
//! outline.place_bucket(&machine, &joints, &mut there)?;
//! assert_eq!(there, placed);
//! // The last strip ends at the teeth.
//! assert_eq!(PARTS.last(), Some(&Part::Bucket));
//! let [.., back_to_teeth] = &placed.strips;
//! let tip = machine.chain().tip(&joints);
//! assert!((back_to_teeth.ends[1].at.x - tip.reach).abs() < 1e-14);
//! assert_eq!(placed.tip().ends[0], back_to_teeth.ends[1]);
//! // Turning the boom moves the teeth at right angles to the line from its pin.
//! let per_boom = back_to_teeth.ends[1].per_joint[0];
//! assert!((per_boom.z - (tip.reach - geometry.boom_pin_x_m)).abs() < 1e-14);
//! // A bucket without width is no bucket.
//! let flat = OutlineShape { bucket_half_width_m: 0.0, ..shape };
//! let error = Outline::<f32>::new(&geometry, &flat).expect_err("no width");
//! assert_eq!(error.to_string(), "`outline.bucket_half_width_m` is a length and must be above 0, not 0");
//! # Ok(())
//! # }
//! ```

use crate::geometry::{GeometryError, PinGeometry};
use crate::machine::bucket_open;
use crate::validate::Checks;
use crate::{Joints, Machine, PoseError, Real, Rotor, Vec2};

/// How many strips make the linkage.
pub const STRIPS: usize = 13;

/// What a strip is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Boom: boom pin, knee, arm pin.
    Boom,
    /// Arm: rear eye D, arm pin, bucket pin.
    Arm,
    /// Boom cylinder A–B.
    BoomCylinder,
    /// Arm cylinder C–D.
    ArmCylinder,
    /// Bucket cylinder E–J.
    BucketCylinder,
    /// Rocker I–J.
    Rocker,
    /// Coupler J–K.
    Coupler,
    /// Bucket: bucket pin, coupler pin, back, teeth.
    Bucket,
}

/// Which part each strip of [`PlacedOutline::strips`] belongs to.
pub const PARTS: [Part; STRIPS] = [
    Part::Boom,
    Part::Boom,
    Part::Arm,
    Part::Arm,
    Part::Arm,
    Part::BoomCylinder,
    Part::ArmCylinder,
    Part::BucketCylinder,
    Part::Rocker,
    Part::Coupler,
    Part::Bucket,
    Part::Bucket,
    Part::Bucket,
];

/// Which ends of a strip no strip before it has, with its size: the ends a half-space is to be weighed against.
pub(super) const OWN_ENDS: [[bool; 2]; STRIPS] = [
    [true, true],
    [false, true],
    [true, true],
    [false, true],
    [false, false],
    [true, true],
    [true, true],
    [true, true],
    [true, true],
    [false, true],
    [true, true],
    [false, true],
    [false, true],
];

/// Thicknesses, widths and the two points the pins do not give, m. A radius is half the thickness in the plane; a half-width
/// is how far the part stands out sideways (the radius, where that is more).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutlineShape {
    /// The boom's knee, in the boom frame.
    pub boom_knee: Vec2<f64>,
    /// The farthest of the bucket's back from the line coupler pin → teeth, in the bucket frame.
    pub bucket_back: Vec2<f64>,
    /// Boom.
    pub boom_radius_m: f64,
    /// Boom.
    pub boom_half_width_m: f64,
    /// Arm.
    pub arm_radius_m: f64,
    /// Arm.
    pub arm_half_width_m: f64,
    /// All three cylinders.
    pub cylinder_radius_m: f64,
    /// Boom cylinders, often two beside the boom.
    pub boom_cylinder_half_width_m: f64,
    /// Rocker and coupler.
    pub link_radius_m: f64,
    /// Rocker and coupler.
    pub link_half_width_m: f64,
    /// The bucket's plates and teeth.
    pub bucket_radius_m: f64,
    /// Bucket.
    pub bucket_half_width_m: f64,
}

impl OutlineShape {
    /// The defaults for a machine: knee half-way between the boom's two cylinder pins B and C, the bucket's back at (0.6, 0.45)
    /// of its length, everything else a fraction of the reach, taken from 20 t excavators (10 m: boom 0.6 m thick, bucket
    /// 1.2 m wide).
    pub fn of(geometry: &PinGeometry) -> Self {
        let reach = geometry.reach_m();
        Self {
            boom_knee: (geometry.boom.rod + geometry.arm.base).scale(0.5),
            bucket_back: Vec2::new(0.6, 0.45).scale(geometry.bucket_m),
            boom_radius_m: 0.03 * reach,
            boom_half_width_m: 0.03 * reach,
            arm_radius_m: 0.022 * reach,
            arm_half_width_m: 0.022 * reach,
            cylinder_radius_m: 0.01 * reach,
            boom_cylinder_half_width_m: 0.045 * reach,
            link_radius_m: 0.01 * reach,
            link_half_width_m: 0.03 * reach,
            bucket_radius_m: 0.003 * reach,
            bucket_half_width_m: 0.06 * reach,
        }
    }

    /// Coordinates lie within ±1000 m, radii and half-widths above 0; or the first that does not.
    fn checked(&self) -> Result<(), GeometryError> {
        let mut checks = Checks(Ok(()));
        checks.finite("outline.boom_knee_x_m", self.boom_knee.x);
        checks.finite("outline.boom_knee_z_m", self.boom_knee.z);
        checks.finite("outline.bucket_back_x_m", self.bucket_back.x);
        checks.finite("outline.bucket_back_z_m", self.bucket_back.z);
        checks.positive("outline.boom_radius_m", self.boom_radius_m);
        checks.positive("outline.boom_half_width_m", self.boom_half_width_m);
        checks.positive("outline.arm_radius_m", self.arm_radius_m);
        checks.positive("outline.arm_half_width_m", self.arm_half_width_m);
        checks.positive("outline.cylinder_radius_m", self.cylinder_radius_m);
        checks.positive("outline.boom_cylinder_half_width_m", self.boom_cylinder_half_width_m);
        checks.positive("outline.link_radius_m", self.link_radius_m);
        checks.positive("outline.link_half_width_m", self.link_half_width_m);
        checks.positive("outline.bucket_radius_m", self.bucket_radius_m);
        checks.positive("outline.bucket_half_width_m", self.bucket_half_width_m);
        checks.0
    }
}

/// A point of the linkage in the plane (reach from the swing axis, height above the boom pin) and its derivative by θ2, θ3, θ4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingPoint<T> {
    /// Where it is, m.
    pub at: Vec2<T>,
    /// By boom, arm, bucket, m/rad.
    pub per_joint: [Vec2<T>; 3],
}

/// A rounded, laterally widened segment of the placed linkage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip<T> {
    /// Its ends in the plane.
    pub ends: [MovingPoint<T>; 2],
    /// Radius of the ball at each of its points, m.
    pub radius: T,
    /// How far those points lie to either side of the plane, m.
    pub lateral: T,
}

/// The linkage at one set of joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedOutline<T> {
    /// Its strips; [`PARTS`] tells of what.
    pub strips: [Strip<T>; STRIPS],
}

impl<T: Real> PlacedOutline<T> {
    /// Every strip a point in the origin: of no machine yet.
    pub fn nowhere() -> Self {
        let zero = Vec2::new(T::ZERO, T::ZERO);
        let end = MovingPoint { at: zero, per_joint: [zero; 3] };
        Self { strips: [Strip { ends: [end, end], radius: T::ZERO, lateral: T::ZERO }; STRIPS] }
    }

    /// The teeth alone, as one point: what a fence would guard that knows the tip only.
    pub fn tip(&self) -> Strip<T> {
        let [.., last] = &self.strips;
        let [_, teeth] = last.ends;
        Strip { ends: [teeth, teeth], radius: T::ZERO, lateral: T::ZERO }
    }
}

/// Radius and lateral half-width of a strip's points.
#[derive(Clone, Copy, Debug)]
struct Size<T> {
    radius: T,
    lateral: T,
}

impl<T: Real> Size<T> {
    fn new(radius_m: f64, half_width_m: f64) -> Self {
        let lateral = if half_width_m > radius_m { half_width_m - radius_m } else { 0.0 };
        Self { radius: T::from_f64(radius_m), lateral: T::from_f64(lateral) }
    }

    fn strip(self, from: MovingPoint<T>, to: MovingPoint<T>) -> Strip<T> {
        Strip { ends: [from, to], radius: self.radius, lateral: self.lateral }
    }
}

/// The linkage's points in their bodies' frames, and sizes.
#[derive(Clone, Copy, Debug)]
pub struct Outline<T> {
    boom_pin: Vec2<T>,
    /// A, from the boom pin.
    boom_base: Vec2<T>,
    /// Knee, arm pin, B, C in the boom frame.
    on_boom: [Vec2<T>; 4],
    /// D, bucket pin, E, I in the arm frame.
    on_arm: [Vec2<T>; 4],
    /// K, back, teeth in the bucket frame.
    on_bucket: [Vec2<T>; 3],
    boom: Size<T>,
    arm: Size<T>,
    boom_cylinder: Size<T>,
    cylinder: Size<T>,
    link: Size<T>,
    bucket: Size<T>,
}

/// v turned left by 90°: the velocity of a point at v from its axis, at 1 rad/s.
fn left<T: Real>(v: Vec2<T>) -> Vec2<T> {
    Vec2::new(-v.z, v.x)
}

impl<T: Real> Outline<T> {
    /// The outline of a machine's pins with the shape's sizes.
    ///
    /// # Errors
    /// The first problem of the shape, by its field: coordinates must lie within ±1000 m, sizes above 0.
    /// The geometry's own are [`Machine::new`]'s to find.
    pub fn new(geometry: &PinGeometry, shape: &OutlineShape) -> Result<Self, GeometryError> {
        shape.checked()?;
        let (g, s) = (geometry, shape);
        let round = |v: Vec2<f64>| Vec2::new(T::from_f64(v.x), T::from_f64(v.z));
        let along = |x: f64| Vec2::new(x, 0.0);
        Ok(Self {
            boom_pin: round(along(g.boom_pin_x_m)),
            boom_base: round(g.boom.base),
            on_boom: [s.boom_knee, along(g.boom_m), g.boom.rod, g.arm.base].map(round),
            on_arm: [g.arm.rod, along(g.arm_m), g.bucket.base, g.bucket.rocker_pivot].map(round),
            on_bucket: [g.bucket.coupler_pin, s.bucket_back, along(g.bucket_m)].map(round),
            boom: Size::new(s.boom_radius_m, s.boom_half_width_m),
            arm: Size::new(s.arm_radius_m, s.arm_half_width_m),
            boom_cylinder: Size::new(s.cylinder_radius_m, s.boom_cylinder_half_width_m),
            cylinder: Size::new(s.cylinder_radius_m, s.cylinder_radius_m),
            link: Size::new(s.link_radius_m, s.link_half_width_m),
            bucket: Size::new(s.bucket_radius_m, s.bucket_half_width_m),
        })
    }

    /// Every strip where the joints put it, in the swing's plane.
    ///
    /// # Errors
    /// [`PoseError::NoAssembly`] where the bucket's four-bar does not close.
    pub fn place(&self, machine: &Machine<T>, joints: &Joints<T>) -> Result<PlacedOutline<T>, PoseError<T>> {
        let mut placed = PlacedOutline::nowhere();
        self.place_into(machine, joints, &mut placed)?;
        Ok(placed)
    }

    /// [`Outline::place`] into an outline that is there: copying one costs as much as placing it.
    ///
    /// # Errors
    /// As there.
    pub fn place_into(
        &self,
        machine: &Machine<T>,
        joints: &Joints<T>,
        placed: &mut PlacedOutline<T>,
    ) -> Result<(), PoseError<T>> {
        self.place_beams(joints, placed);
        self.place_bucket(machine, joints, placed)
    }

    /// The first half of [`Outline::place_into`]: boom, arm, and the cylinders of both.
    pub fn place_beams(&self, joints: &Joints<T>, placed: &mut PlacedOutline<T>) {
        let frames = Frames::new(self, joints);
        let [knee, _, b, c] = self.on_boom.map(|v| frames.on_boom(v));
        let [d, ..] = self.on_arm.map(|v| frames.on_arm(v));
        let Frames { arm_pin, bucket_pin, .. } = frames;
        let [lower, upper, behind, before, whole, boom_cylinder, arm_cylinder, ..] = &mut placed.strips;
        *lower = self.boom.strip(fixed(self.boom_pin), knee);
        *upper = self.boom.strip(knee, arm_pin);
        *behind = self.arm.strip(arm_pin, d);
        *before = self.arm.strip(d, bucket_pin);
        *whole = self.arm.strip(arm_pin, bucket_pin);
        *boom_cylinder = self.boom_cylinder.strip(fixed(self.boom_pin + self.boom_base), b);
        *arm_cylinder = self.cylinder.strip(c, d);
    }

    /// The second half: the bucket, its linkage and its cylinder.
    ///
    /// # Errors
    /// [`PoseError::NoAssembly`] where the bucket's four-bar does not close.
    pub fn place_bucket(
        &self,
        machine: &Machine<T>,
        joints: &Joints<T>,
        placed: &mut PlacedOutline<T>,
    ) -> Result<(), PoseError<T>> {
        let frames = Frames::new(self, joints);
        let Frames { arm, arm_pin, bucket_pin, .. } = frames;
        let [_, _, e, i] = self.on_arm.map(|v| frames.on_arm(v));
        let common = machine.bucket.common_pin(joints.bucket).map_err(bucket_open)?;
        let [_, bucket_pin_on_arm, ..] = self.on_arm;
        let turned = arm.rotate(bucket_pin_on_arm + common.from_bucket_pin);
        let j = frames.arm_turned(turned, arm.rotate(common.per_bucket));
        let bucket = arm * joints.bucket;
        let [k, back, teeth] = self.on_bucket.map(|v| {
            let turned = bucket.rotate(v);
            let at = bucket_pin.at + turned;
            MovingPoint { at, per_joint: [left(at - self.boom_pin), left(at - arm_pin.at), left(turned)] }
        });
        let [.., bucket_cylinder, rocker, coupler, front, rear, edge] = &mut placed.strips;
        *bucket_cylinder = self.cylinder.strip(e, j);
        *rocker = self.link.strip(i, j);
        *coupler = self.link.strip(j, k);
        *front = self.bucket.strip(bucket_pin, k);
        *rear = self.bucket.strip(k, back);
        *edge = self.bucket.strip(back, teeth);
        Ok(())
    }
}

fn fixed<T: Real>(at: Vec2<T>) -> MovingPoint<T> {
    MovingPoint { at, per_joint: [Vec2::new(T::ZERO, T::ZERO); 3] }
}

/// Boom and arm at the joints, with the pins at their ends.
#[derive(Clone, Copy, Debug)]
struct Frames<T> {
    boom_pin: Vec2<T>,
    boom: Rotor<T>,
    arm: Rotor<T>,
    arm_pin: MovingPoint<T>,
    bucket_pin: MovingPoint<T>,
}

impl<T: Real> Frames<T> {
    #[inline(always)]
    fn new(outline: &Outline<T>, joints: &Joints<T>) -> Self {
        let (boom_pin, boom, arm) = (outline.boom_pin, joints.boom, joints.boom * joints.arm);
        let nowhere = fixed(boom_pin);
        let mut frames = Self { boom_pin, boom, arm, arm_pin: nowhere, bucket_pin: nowhere };
        let ([_, arm_pin, ..], [_, bucket_pin, ..]) = (outline.on_boom, outline.on_arm);
        frames.arm_pin = frames.on_boom(arm_pin);
        frames.bucket_pin = frames.on_arm(bucket_pin);
        frames
    }

    #[inline(always)]
    fn on_boom(&self, v: Vec2<T>) -> MovingPoint<T> {
        let zero = Vec2::new(T::ZERO, T::ZERO);
        let from_boom_pin = self.boom.rotate(v);
        MovingPoint { at: self.boom_pin + from_boom_pin, per_joint: [left(from_boom_pin), zero, zero] }
    }

    #[inline(always)]
    fn on_arm(&self, v: Vec2<T>) -> MovingPoint<T> {
        self.arm_turned(self.arm.rotate(v), Vec2::new(T::ZERO, T::ZERO))
    }

    #[inline(always)]
    fn arm_turned(&self, turned: Vec2<T>, per_bucket: Vec2<T>) -> MovingPoint<T> {
        let at = self.arm_pin.at + turned;
        MovingPoint { at, per_joint: [left(at - self.boom_pin), left(turned), per_bucket] }
    }
}

/// Seen in the frame that turns with the swing.
pub(super) fn unswing<T: Real>(swing: Rotor<T>, [x, y, z]: [T; 3]) -> [T; 3] {
    let v = swing.inverse().rotate(Vec2::new(x, y));
    [v.x, v.z, z]
}
