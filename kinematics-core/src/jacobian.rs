//! Joint rates ↔ tip twist in the boom's plane, and torques ↔ tip force by the transpose: Hareesha 2015 (9)–(12), (21).
//!
//! ```
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Vec2};
//! use kinematics_core::rates::JointRates;
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
//! let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
//! let jacobian = machine.chain().jacobian(&joints);
//! let rates = JointRates { boom: 0.1, arm: -0.2, bucket: 0.3 };
//! let twist = jacobian.twist(&rates);
//! let back = jacobian.joint_rates(&twist)?;
//! assert!((back.arm + 0.2).abs() < 1e-14);
//! // The same as a matrix; its first two rows are Hareesha's.
//! let [reach, _height, pitch] = jacobian.matrix();
//! assert!((reach[0] * 0.1 - reach[1] * 0.2 + reach[2] * 0.3 - twist.reach).abs() < 1e-15);
//! assert_eq!(jacobian.matrix_2x3()[0], reach);
//! assert_eq!(pitch, [1.0, 1.0, 1.0]);
//! // Each column is a lever turned by 90°; the determinant is a2·a3·sin θ3.
//! let [from_boom_pin, ..] = jacobian.levers();
//! assert_eq!(reach[0], -from_boom_pin.z);
//! let [_, a2, a3, _] = machine.chain().lengths();
//! assert_eq!(jacobian.determinant(), a2 * a3 * joints.arm.sin);
//! // Of the wrist the bucket joint moves nothing.
//! assert_eq!(machine.chain().wrist_jacobian(&joints).matrix_2x3()[1][2], 0.0);
//! // Any point of the bucket: the tip is the one 0.567 m from its pin.
//! assert_eq!(machine.chain().jacobian_at(&joints, Vec2::new(0.567, 0.0)), jacobian);
//! # Ok(())
//! # }
//! ```

use crate::chain::{Chain, Joints};
use crate::rates::JointRates;
use crate::{Real, Singular, Vec2};

/// How a point of the bucket moves in the plane: m/s and rad/s; or its acceleration, m/s² and rad/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<T> {
    /// Along the reach, away from the swing axis.
    pub reach: T,
    /// Upwards.
    pub height: T,
    /// φ̇ = θ̇2 + θ̇3 + θ̇4.
    pub pitch: T,
}

/// The Jacobian of a point of the bucket in the boom's plane, kept as its links: column i is the lever from joint pin to
/// point, turned by 90°.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarJacobian<T> {
    /// Boom pin → arm pin, arm pin → bucket pin, bucket pin → point, in the base frame's directions, m.
    links: [Vec2<T>; 3],
    /// sin θ3: zero where boom and arm are in line.
    knee: T,
    /// a2·a3·sin θ3, m².
    determinant: T,
}

/// |sin θ3| below this is taken for a stretched or folded arm: in f32 what is left is rounding.
pub const SMALLEST_KNEE_SINE: f64 = 1e-6;

impl<T: Real> Chain<T> {
    /// The Jacobian of the tip: Hareesha 2015 (10)–(12) with Koivo's labels.
    #[inline(always)]
    pub fn jacobian(&self, joints: &Joints<T>) -> PlanarJacobian<T> {
        let [.., a4] = self.lengths();
        self.jacobian_at(joints, Vec2::new(a4, T::ZERO))
    }

    /// The Jacobian of the wrist (bucket pin): the bucket joint changes its pitch alone.
    #[inline(always)]
    pub fn wrist_jacobian(&self, joints: &Joints<T>) -> PlanarJacobian<T> {
        self.jacobian_at(joints, Vec2::new(T::ZERO, T::ZERO))
    }

    /// The Jacobian of any `point` of the bucket, given in the bucket's frame (from the bucket pin, x towards the tip), m.
    #[inline(always)]
    pub fn jacobian_at(&self, joints: &Joints<T>, point: Vec2<T>) -> PlanarJacobian<T> {
        let [_, a2, a3, _] = self.lengths();
        let arm = joints.boom * joints.arm;
        let pitch = arm * joints.bucket;
        PlanarJacobian {
            links: [joints.boom.to_vec().scale(a2), arm.to_vec().scale(a3), pitch.rotate(point)],
            knee: joints.arm.sin,
            determinant: a2 * a3 * joints.arm.sin,
        }
    }
}

impl<T: Real> PlanarJacobian<T> {
    /// From boom pin, arm pin and bucket pin to the point, m.
    #[inline(always)]
    pub fn levers(&self) -> [Vec2<T>; 3] {
        let [boom, arm, bucket] = self.links;
        let arm = arm + bucket;
        [boom + arm, arm, bucket]
    }

    /// Rows reach, height [m/rad], pitch [rad/rad]; columns θ2, θ3, θ4.
    #[inline(always)]
    pub fn matrix(&self) -> [[T; 3]; 3] {
        let [reach, height] = self.matrix_2x3();
        [reach, height, [T::ONE; 3]]
    }

    /// Hareesha 2015 (12): rows reach, height [m/rad].
    #[inline(always)]
    pub fn matrix_2x3(&self) -> [[T; 3]; 2] {
        let levers = self.levers();
        [levers.map(|l| -l.z), levers.map(|l| l.x)]
    }

    /// The determinant of [`PlanarJacobian::matrix`], a2·a3·sin θ3, m²: zero where boom and arm are in line.
    #[inline(always)]
    pub fn determinant(&self) -> T {
        self.determinant
    }

    /// Joint rates → twist of the point: Hareesha 2015 (9), and the pitch rate.
    #[inline(always)]
    pub fn twist(&self, joints: &JointRates<T>) -> Twist<T> {
        let [boom, arm, bucket] = self.links;
        let forearm = joints.boom + joints.arm;
        let pitch = forearm + joints.bucket;
        let v = boom.scale(joints.boom) + arm.scale(forearm) + bucket.scale(pitch);
        Twist { reach: -v.z, height: v.x, pitch }
    }

    /// Twist of the point → joint rates, the pitch rate given: Hareesha 2015 (13) for the square Jacobian.
    ///
    /// # Errors
    /// [`Singular::ArmStretched`].
    #[inline(always)]
    pub fn joint_rates(&self, twist: &Twist<T>) -> Result<JointRates<T>, Singular> {
        self.check()?;
        let [boom, arm, bucket] = self.links;
        // The wrist's velocity, v = θ̇2·i·boom + (θ̇2 + θ̇3)·i·arm.
        let wrist = Vec2::new(twist.reach + twist.pitch * bucket.z, twist.height - twist.pitch * bucket.x);
        let reciprocal = T::ONE / self.determinant;
        let boom_rate = wrist.dot(arm) * reciprocal;
        let forearm = -(wrist.dot(boom) * reciprocal);
        Ok(JointRates { boom: boom_rate, arm: forearm - boom_rate, bucket: twist.pitch - forearm })
    }

    /// J̇·θ̇: the point's acceleration while no joint accelerates, m/s²; centripetal along each link.
    ///
    /// ```
    /// use kinematics_core::{Cylinders, Machine, PinGeometry};
    /// use kinematics_core::rates::JointRates;
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
    /// let pose = machine.joints_to_tip(
    ///     &machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?,
    ///     kinematics_core::Rotor::IDENTITY,
    /// );
    /// let jacobian = machine.chain().jacobian(&pose.joints);
    /// // The boom alone turns at 2 rad/s: 4 m/s² a metre, towards the boom pin.
    /// let bias = jacobian.bias(&JointRates { boom: 2.0, arm: 0.0, bucket: 0.0 });
    /// assert!((bias.height + 4.0 * pose.plane.height).abs() < 1e-14);
    /// # Ok(())
    /// # }
    /// ```
    #[inline(always)]
    pub fn bias(&self, joints: &JointRates<T>) -> Twist<T> {
        let [boom, arm, bucket] = self.links;
        let forearm = joints.boom + joints.arm;
        let pitch = forearm + joints.bucket;
        let inwards =
            boom.scale(joints.boom * joints.boom) + arm.scale(forearm * forearm) + bucket.scale(pitch * pitch);
        Twist { reach: -inwards.x, height: -inwards.z, pitch: T::ZERO }
    }

    /// From the levers alone, where no joint rotor is at hand.
    #[inline(always)]
    pub(crate) fn from_levers([boom, arm, bucket]: [Vec2<T>; 3]) -> Self {
        let (first, second) = (boom - arm, arm - bucket);
        let determinant = first.cross(second);
        let knee = determinant / (first.norm_squared() * second.norm_squared()).sqrt();
        Self { links: [first, second, bucket], knee, determinant }
    }

    /// Whether the 3 × 3 Jacobian has an inverse.
    #[inline(always)]
    pub(crate) fn check(&self) -> Result<(), Singular> {
        let smallest = T::from_f64(SMALLEST_KNEE_SINE);
        if self.knee > smallest || self.knee < -smallest { Ok(()) } else { Err(Singular::ArmStretched) }
    }

    #[inline(always)]
    pub(crate) fn links(&self) -> [Vec2<T>; 3] {
        self.links
    }
}
