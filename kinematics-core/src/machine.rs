//! The whole machine: cylinders ↔ joints ↔ tip, with stroke and assembly checks.

use crate::chain::{Chain, Joints, PlaneTip};
use crate::fixed_kernel::FixedKernel;
use crate::four_bar::{FourBar, Gap};
use crate::geometry::{GeometryError, PinGeometry};
use crate::sector::Sector;
use crate::stroke::StrokeCheck;
use crate::swing::SwingCylinder;
use crate::triangle::{Side, Triangle};
use crate::{Cylinder, PoseError, Real, Rotor};

/// Lengths of the three cylinders in the plane, between their pins, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinders<T> {
    /// Boom cylinder.
    pub boom: T,
    /// Arm cylinder.
    pub arm: T,
    /// Bucket cylinder.
    pub bucket: T,
}

/// A pose: joints, the tip in the plane, and the tip swung into the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// θ1.
    pub swing: Rotor<T>,
    /// θ2, θ3, θ4.
    pub joints: Joints<T>,
    /// Reach, height, pitch in the plane.
    pub plane: PlaneTip<T>,
    /// Tip in the base frame, m: x forward at zero swing.
    pub x: T,
    /// y to the left.
    pub y: T,
}

impl<T: Real> Pose<T> {
    /// Tip height above the boom pin in the base frame, m.
    #[inline(always)]
    pub fn z(&self) -> T {
        self.plane.height
    }
}

/// All maps of one machine, their constants computed once in f64.
///
/// ```
/// use kinematics_core::{Cylinder, Cylinders, Machine, PinGeometry, PoseError, Rotor};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
/// // All cylinders in: the ends of the joints' travel that eXactMPC publishes, −27.14°, −29.24° and 44.91°.
/// let shortest = Cylinders { boom: 0.905, arm: 1.046, bucket: 0.840 };
/// let joints = machine.cylinders_to_joints(&shortest)?;
/// let degrees = [joints.boom, joints.arm, joints.bucket].map(|joint| joint.angle().to_degrees());
/// for (found, published) in degrees.into_iter().zip([-27.14, -29.24, 44.91]) {
///     assert!((found - published).abs() < 0.01, "{found}");
/// }
/// assert!((machine.joints_to_cylinders(&joints)?.bucket - 0.840).abs() < 1e-14);
///
/// // 5 mm shorter the linkage still closes, but no cylinder goes there.
/// let shorter = Cylinders { boom: 0.900, ..shortest };
/// let out = |e| matches!(e, PoseError::OutOfStroke { cylinder: Cylinder::Boom, by } if by < -0.0049);
/// assert!(machine.check_strokes(&shorter).is_err_and(out));
/// let lower = machine.cylinders_to_joints_any_stroke(&shorter)?;
/// assert!(lower.boom.sin < joints.boom.sin);
/// assert!(machine.joints_to_cylinders(&lower).is_err_and(out));
/// assert!((machine.joints_to_cylinders_any_stroke(&lower)?.boom - 0.900).abs() < 1e-14);
///
/// // The tip, swung to the left, and back to the joints.
/// let left = Rotor::from_turns(0.25);
/// let pose = machine.cylinders_to_tip(&shortest, left)?;
/// assert_eq!((pose.x, pose.y, pose.z()), (0.0, pose.plane.reach, pose.plane.height));
/// assert_eq!(machine.joints_to_tip(&joints, left), pose);
/// assert_eq!(machine.chain().tip(&joints), pose.plane);
/// assert!((machine.tip_to_joints(&pose.plane)?.arm.sin - joints.arm.sin).abs() < 1e-14);
/// // Without checks: the same numbers, and no word of what is out of reach.
/// assert_eq!(machine.cylinders_to_tip_unchecked(&shortest, left), pose);
/// assert!(machine.cylinders_to_tip_unchecked(&Cylinders { boom: 2.0, ..shortest }, left).z().is_nan());
/// # Ok(())
/// # }
/// ```
// In this order: what poses need stands first, within the reach of the ECU's short offsets.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Machine<T> {
    pub(crate) boom: Triangle<T>,
    pub(crate) arm: Triangle<T>,
    pub(crate) bucket: FourBar<T>,
    pub(crate) chain: Chain<T>,
    strokes: [StrokeCheck<T>; 3],
    /// Joint angles of boom, arm, bucket over their strokes, tolerance included.
    sectors: [Sector<T>; 3],
    swing: Option<SwingCylinder<T>>,
    /// For [`Machine::cylinders_to_tip_with_fine_jacobian`], where it can have one.
    pub(crate) fixed: Option<FixedKernel<T>>,
}

pub(crate) fn open<T>(cylinder: Cylinder) -> impl Fn(T) -> PoseError<T> {
    move |by| PoseError::NoAssembly { cylinder, by }
}

pub(crate) fn bucket_open<T>(gap: Gap<T>) -> PoseError<T> {
    PoseError::NoAssembly { cylinder: Cylinder::Bucket, by: gap.0 }
}

/// a1…a4
fn links(g: &PinGeometry) -> [f64; 4] {
    [g.boom_pin_x_m, g.boom_m, g.arm_m, g.bucket_m]
}

impl<T: Real> Machine<T> {
    /// Validates the geometry and derives the constants.
    ///
    /// # Errors
    /// The first problem of the geometry, named by its field.
    pub fn new(geometry: &PinGeometry) -> Result<Self, GeometryError> {
        let quick = Self::without_fine_maps(geometry)?;
        Ok(Self { chain: Chain::new(links(geometry)), fixed: FixedKernel::new(geometry), ..quick })
    }

    /// [`Machine::new`] without the constants of the maps in fixed point, which take code to derive that a controller has no use for.
    /// [`Machine::cylinders_to_tip_with_fine_jacobian`], [`Machine::cylinder_bias`] and [`Chain::fine_swing_jacobian`] then answer as for a
    /// geometry out of fixed point's range; every other map is the same, bit for bit.
    ///
    /// ```
    /// # use kinematics_core::{Cylinders, Machine, PinGeometry};
    /// let [all, quick] = [Machine::<f32>::new, Machine::<f32>::without_fine_maps].map(|new| new(&PinGeometry::EXACT_MINI).unwrap());
    /// let lengths = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
    /// assert_eq!(quick.cylinders_to_joints(&lengths), all.cylinders_to_joints(&lengths));
    /// ```
    ///
    /// # Errors
    /// As [`Machine::new`].
    pub fn without_fine_maps(geometry: &PinGeometry) -> Result<Self, GeometryError> {
        geometry.validate()?;
        let g = geometry;
        Ok(Self {
            boom: Triangle::new(g.boom.base, g.boom.rod, g.boom_cylinder.side(), 1.0),
            arm: Triangle::new(g.arm_base_from_pin(), g.arm.rod, Side::Clockwise, 1.0),
            bucket: g.four_bar(),
            chain: Chain::without_fine_maps(links(g)),
            strokes: [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(StrokeCheck::new),
            sectors: g.sectors()?,
            swing: g.swing.as_ref().map(SwingCylinder::from_pins),
            fixed: None,
        })
    }

    /// The link chain, for maps between joints and tip alone.
    pub fn chain(&self) -> &Chain<T> {
        &self.chain
    }

    /// The swing cylinder, where the machine has one.
    pub fn swing_cylinder(&self) -> Option<&SwingCylinder<T>> {
        self.swing.as_ref()
    }

    /// Whether every length lies within its stroke.
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`] for the first that does not, in the order boom, arm, bucket.
    #[inline(always)]
    pub fn check_strokes(&self, cylinders: &Cylinders<T>) -> Result<(), PoseError<T>> {
        let [boom, arm, bucket] = &self.strokes;
        if boom.contains(cylinders.boom) && arm.contains(cylinders.arm) && bucket.contains(cylinders.bucket) {
            Ok(())
        } else {
            Err(self.first_out_of_stroke(cylinders))
        }
    }

    /// Which it was: looked up only when one is, so that the checks cost nothing but their comparisons.
    #[cold]
    #[inline(never)]
    fn first_out_of_stroke(&self, cylinders: &Cylinders<T>) -> PoseError<T> {
        let [boom, arm, bucket] = &self.strokes;
        if !boom.contains(cylinders.boom) {
            boom.excess(Cylinder::Boom, cylinders.boom)
        } else if !arm.contains(cylinders.arm) {
            arm.excess(Cylinder::Arm, cylinders.arm)
        } else {
            bucket.excess(Cylinder::Bucket, cylinders.bucket)
        }
    }

    /// Cylinders → joints where the linkages close, inside the stroke or not: Koivo 1994 (11), (13), (15)–(18),
    /// Frankel 2003 `cyl_to_joint`.
    ///
    /// # Errors
    /// [`PoseError::NoAssembly`] where they do not.
    #[inline(always)]
    pub fn cylinders_to_joints_any_stroke(&self, cylinders: &Cylinders<T>) -> Result<Joints<T>, PoseError<T>> {
        Ok(Joints {
            boom: self.boom.rotor(cylinders.boom).map_err(open(Cylinder::Boom))?,
            arm: self.arm.rotor(cylinders.arm).map_err(open(Cylinder::Arm))?,
            bucket: self.bucket.rotor(cylinders.bucket).map_err(bucket_open)?,
        })
    }

    /// Cylinders → joints, strokes checked first.
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`], [`PoseError::NoAssembly`].
    #[inline(always)]
    pub fn cylinders_to_joints(&self, cylinders: &Cylinders<T>) -> Result<Joints<T>, PoseError<T>> {
        self.check_strokes(cylinders)?;
        self.cylinders_to_joints_any_stroke(cylinders)
    }

    /// Joints → cylinders, inside the stroke or not: Koivo 1994 (10), (12), (14), (29), Frankel 2003 `joint_to_cyl`.
    ///
    /// # Errors
    /// [`PoseError::NoAssembly`] when the bucket's linkage does not close, or a joint angle lies on the far side of a dead
    /// point, which no cylinder length reaches.
    #[inline(always)]
    pub fn joints_to_cylinders_any_stroke(&self, joints: &Joints<T>) -> Result<Cylinders<T>, PoseError<T>> {
        Ok(Cylinders {
            boom: self.boom.length(joints.boom).map_err(open(Cylinder::Boom))?,
            arm: self.arm.length(joints.arm).map_err(open(Cylinder::Arm))?,
            bucket: self.bucket.length(joints.bucket).map_err(bucket_open)?,
        })
    }

    /// Joints → cylinders, strokes and assembly checked.
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`], [`PoseError::NoAssembly`].
    #[inline(always)]
    pub fn joints_to_cylinders(&self, joints: &Joints<T>) -> Result<Cylinders<T>, PoseError<T>> {
        if self.within_sectors(joints) {
            let cylinders = Cylinders {
                boom: self.boom.length_unchecked(joints.boom),
                arm: self.arm.length_unchecked(joints.arm),
                bucket: self.bucket.length_unchecked(joints.bucket),
            };
            // Not a number only for a rotor far from unit length, which may lie in any sector.
            if cylinders.boom + cylinders.arm + cylinders.bucket > T::ZERO {
                return Ok(cylinders);
            }
        }
        self.judge(joints)
    }

    /// Whether every joint lies within its cylinder's stroke.
    #[inline(always)]
    pub(crate) fn within_sectors(&self, joints: &Joints<T>) -> bool {
        let [boom, arm, bucket] = &self.sectors;
        boom.contains(joints.boom) && arm.contains(joints.arm) && bucket.contains(joints.bucket)
    }

    /// The last word on joints outside their sectors: lengths within the tolerance, or the error.
    #[cold]
    #[inline(never)]
    fn judge(&self, joints: &Joints<T>) -> Result<Cylinders<T>, PoseError<T>> {
        let cylinders = self.joints_to_cylinders_any_stroke(joints)?;
        self.check_strokes(&cylinders)?;
        Ok(cylinders)
    }

    /// Joints and swing → the full pose: Koivo 1994 (9).
    #[inline(always)]
    pub fn joints_to_tip(&self, joints: &Joints<T>, swing: Rotor<T>) -> Pose<T> {
        let plane = self.chain.tip(joints);
        Pose { swing, joints: *joints, plane, x: plane.reach * swing.cos, y: plane.reach * swing.sin }
    }

    /// Cylinders and swing → the full pose, strokes and assembly checked.
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`], [`PoseError::NoAssembly`].
    #[inline(always)]
    pub fn cylinders_to_tip(&self, cylinders: &Cylinders<T>, swing: Rotor<T>) -> Result<Pose<T>, PoseError<T>> {
        Ok(self.joints_to_tip(&self.cylinders_to_joints(cylinders)?, swing))
    }

    /// The kernel of [`Machine::cylinders_to_tip`] without checks: not a number where a linkage does not close.
    #[inline(always)]
    pub fn cylinders_to_tip_unchecked(&self, cylinders: &Cylinders<T>, swing: Rotor<T>) -> Pose<T> {
        let boom = self.boom.vector_unchecked(cylinders.boom);
        let arm = self.arm.vector_unchecked(cylinders.arm);
        let joints = Joints {
            boom: Rotor { cos: boom.x, sin: boom.z },
            arm: Rotor { cos: arm.x, sin: arm.z },
            bucket: self.bucket.rotor_unchecked(cylinders.bucket),
        };
        self.joints_to_tip(&joints, swing)
    }

    /// Tip in the plane → joints; Koivo 1994 (23)–(28), Frankel 2003 `Rdisp`.
    ///
    /// # Errors
    /// [`PoseError::Unreachable`].
    #[inline(always)]
    pub fn tip_to_joints(&self, tip: &PlaneTip<T>) -> Result<Joints<T>, PoseError<T>> {
        self.chain.joints(tip)
    }

    /// Tip in the plane → cylinders, strokes checked.
    ///
    /// # Errors
    /// [`PoseError::Unreachable`], [`PoseError::NoAssembly`], [`PoseError::OutOfStroke`].
    #[inline(always)]
    pub fn tip_to_cylinders(&self, tip: &PlaneTip<T>) -> Result<Cylinders<T>, PoseError<T>> {
        self.joints_to_cylinders(&self.chain.joints(tip)?)
    }
}
