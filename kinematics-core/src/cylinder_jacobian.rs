//! Cylinder rates ↔ tip twist in one step, which is what a valve loop needs; and pose and Jacobian by one kernel.

use crate::chain::PlaneTip;
use crate::fixed_kernel::Found;
use crate::forces::{CylinderForces, Wrench};
use crate::jacobian::{PlanarJacobian, Twist};
use crate::machine::{bucket_open, open};
use crate::rates::{CylinderRates, MomentArms};
use crate::{Cylinder, Cylinders, Joints, Machine, Pose, PoseError, Real, Rotor, Singular, Vec2};

/// The Jacobian from cylinder lengths to the tip in the plane: rows by columns boom, arm, bucket cylinder.
///
/// ```
/// use kinematics_core::forces::Wrench;
/// use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
/// use kinematics_core::jacobian::Twist;
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI)?;
/// let cylinders = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
/// let (pose, jacobian) = machine.cylinders_to_tip_with_jacobian(&cylinders, Rotor::IDENTITY)?;
/// // Draw the tip inwards at 0.5 m/s, level and without turning the bucket.
/// let wanted = Twist { reach: -0.5, height: 0.0, pitch: 0.0 };
/// let rates = jacobian.cylinder_rates(&wanted)?;
/// let got = jacobian.twist(&rates);
/// assert!((got.reach + 0.5).abs() < 1e-6 && got.height.abs() < 1e-6 && got.pitch.abs() < 1e-6);
/// // The same from joint space.
/// let joint_space = machine.chain().jacobian(&pose.joints);
/// let again = joint_space.per_cylinder(&machine.moment_arms(&cylinders)?)?;
/// assert!((again.reach[0] - jacobian.reach[0]).abs() < 1e-5);
/// // Pushing down with 1 kN: what the cylinders do is what the tip does, and from their forces the push is found again.
/// let push = Wrench { reach: 0.0, height: -1000.0, moment: 0.0 };
/// let forces = jacobian.cylinder_forces(&push);
/// let power = forces.boom * rates.boom + forces.arm * rates.arm + forces.bucket * rates.bucket;
/// assert!((power - push.height * got.height).abs() < 1e-2);
/// assert!((jacobian.wrench(&forces)?.height + 1000.0).abs() < 1e-2);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderJacobian<T> {
    /// d(reach)/dL, m/m.
    pub reach: [T; 3],
    /// d(height)/dL, m/m.
    pub height: [T; 3],
    /// dφ/dL, rad/m: each joint's transmission dθ/dL.
    pub pitch: [T; 3],
}

impl<T: Real> CylinderJacobian<T> {
    #[inline(always)]
    fn new(levers: [Vec2<T>; 3], transmissions: [T; 3]) -> Self {
        let [boom, arm, bucket] = levers;
        let [b, a, k] = transmissions;
        Self {
            reach: [-(boom.z * b), -(arm.z * a), -(bucket.z * k)],
            height: [boom.x * b, arm.x * a, bucket.x * k],
            pitch: transmissions,
        }
    }

    /// Cylinder rates → twist of the tip.
    #[inline(always)]
    pub fn twist(&self, cylinders: &CylinderRates<T>) -> Twist<T> {
        let row =
            |[boom, arm, bucket]: [T; 3]| boom * cylinders.boom + (arm * cylinders.arm + bucket * cylinders.bucket);
        Twist { reach: row(self.reach), height: row(self.height), pitch: row(self.pitch) }
    }

    /// Twist of the tip → cylinder rates.
    ///
    /// # Errors
    /// [`Singular::ArmStretched`].
    #[inline]
    pub fn cylinder_rates(&self, twist: &Twist<T>) -> Result<CylinderRates<T>, Singular> {
        let (arms, jacobian) = self.factors();
        Ok(arms.cylinder_rates(&jacobian.joint_rates(twist)?))
    }

    /// The force the tip exerts → the cylinders' forces that hold it: f = Jᵀ·F, N. No pose is singular this way.
    #[inline(always)]
    pub fn cylinder_forces(&self, tip: &Wrench<T>) -> CylinderForces<T> {
        let column = |reach: T, height: T, pitch: T| reach * tip.reach + (height * tip.height + pitch * tip.moment);
        let ([rb, ra, rk], [hb, ha, hk], [pb, pa, pk]) = (self.reach, self.height, self.pitch);
        CylinderForces { boom: column(rb, hb, pb), arm: column(ra, ha, pa), bucket: column(rk, hk, pk) }
    }

    /// The cylinders' forces → the force and moment the tip exerts.
    ///
    /// # Errors
    /// [`Singular::ArmStretched`].
    #[inline]
    pub fn wrench(&self, cylinders: &CylinderForces<T>) -> Result<Wrench<T>, Singular> {
        let (arms, jacobian) = self.factors();
        jacobian.wrench(&arms.joint_torques(cylinders))
    }

    /// Moment arms, and the joint-space Jacobian without them.
    #[inline(always)]
    fn factors(&self) -> (MomentArms<T>, PlanarJacobian<T>) {
        let [boom, arm, bucket] = self.pitch.map(|transmission| T::ONE / transmission);
        let ([rb, ra, rk], [hb, ha, hk]) = (self.reach, self.height);
        let lever = |reach: T, height: T, by: T| Vec2::new(height * by, -(reach * by));
        let levers = [lever(rb, hb, boom), lever(ra, ha, arm), lever(rk, hk, bucket)];
        (MomentArms { boom, arm, bucket }, PlanarJacobian::from_levers(levers))
    }
}

impl<T: Real> PlanarJacobian<T> {
    /// This Jacobian per cylinder length in place of joint angle: each column divided by its moment arm.
    ///
    /// # Errors
    /// [`Singular::DeadPoint`].
    #[inline(always)]
    pub fn per_cylinder(&self, arms: &MomentArms<T>) -> Result<CylinderJacobian<T>, Singular> {
        Ok(CylinderJacobian::new(self.levers(), arms.transmissions()?))
    }
}

impl<T: Real> Machine<T> {
    /// Cylinders and swing → the pose of [`Machine::cylinders_to_tip`] and the cylinder-space Jacobian, their work shared.
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`], [`PoseError::NoAssembly`].
    #[inline(always)]
    pub fn cylinders_to_tip_with_jacobian(
        &self,
        cylinders: &Cylinders<T>,
        swing: Rotor<T>,
    ) -> Result<(Pose<T>, CylinderJacobian<T>), PoseError<T>> {
        self.check_strokes(cylinders)?;
        let boom = self.boom.closed(cylinders.boom).map_err(open(Cylinder::Boom))?;
        let arm = self.arm.closed(cylinders.arm).map_err(open(Cylinder::Arm))?;
        let bucket = self.bucket.place(cylinders.bucket).map_err(bucket_open)?;
        let joints = Joints { boom: boom.rotor(), arm: arm.rotor(), bucket: bucket.rotor };
        let transmissions = [
            self.boom.turned(cylinders.boom) / boom.root,
            self.arm.turned(cylinders.arm) / arm.root,
            self.bucket.transmission(&bucket, cylinders.bucket),
        ];
        // The sums of `Chain::tip`, in its order: the pose has the same bits.
        let [a1, a2, a3, a4] = self.chain.lengths();
        let forearm = joints.boom * joints.arm;
        let pitch = forearm * joints.bucket;
        let bucket_lever = Vec2::new(a4 * pitch.cos, a4 * pitch.sin);
        let arm_lever = Vec2::new(a3 * forearm.cos, a3 * forearm.sin) + bucket_lever;
        let boom_lever = Vec2::new(a2 * joints.boom.cos, a2 * joints.boom.sin) + arm_lever;
        let plane = PlaneTip { reach: a1 + boom_lever.x, height: boom_lever.z, pitch };
        let pose = Pose { swing, joints, plane, x: plane.reach * swing.cos, y: plane.reach * swing.sin };
        Ok((pose, CylinderJacobian::new([boom_lever, arm_lever, bucket_lever], transmissions)))
    }

    /// [`Machine::cylinders_to_tip_with_jacobian`] to 2e-6 of a row's largest entry in f32 too, where levers nearly vanish and next to
    /// dead points included: in 32-bit fixed point, rounded to T at the end, at about twice the cost (`docs/cost.md`).
    ///
    /// Its pose is nearer to the exact one than that of [`Machine::cylinders_to_tip`] and may differ from it in the last bits. In f64
    /// the quick kernel is finer than fixed point and answers here too, bit for bit. So it does for a geometry out of fixed point's range: a
    /// cylinder shorter than a quarter of √(2ab) or longer than four of them, a and b its triangle's sides; a rocker pin that can come
    /// next to the bucket pin; a boom pin twice a2 + a3 + a4 from the swing axis or more.
    ///
    /// ```
    /// # use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// // Arm and bucket about level with the tip: of d(reach)/dL little is left, and f32 alone keeps 4e-6 of it.
    /// let (boom, arm, bucket) = (1.115_f32, 1.055_f32, 1.2598_f32);
    /// let lengths = Cylinders { boom, arm, bucket };
    /// let (_, fine) = Machine::<f32>::new(&PinGeometry::EXACT_MINI)?
    ///     .cylinders_to_tip_with_fine_jacobian(&lengths, Rotor::IDENTITY)?;
    /// let [boom, arm, bucket] = [boom, arm, bucket].map(f64::from);
    /// let (_, exact) = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?
    ///     .cylinders_to_tip_with_fine_jacobian(&Cylinders { boom, arm, bucket }, Rotor::IDENTITY)?;
    /// let largest = exact.reach.iter().fold(0.0, |l: f64, x| if x.abs() > l { x.abs() } else { l });
    /// for (fine, exact) in fine.reach.into_iter().zip(exact.reach) {
    ///     assert!((f64::from(fine) - exact).abs() < 2e-6 * largest);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`Machine::cylinders_to_tip_with_jacobian`].
    #[inline]
    pub fn cylinders_to_tip_with_fine_jacobian(
        &self,
        cylinders: &Cylinders<T>,
        swing: Rotor<T>,
    ) -> Result<(Pose<T>, CylinderJacobian<T>), PoseError<T>> {
        self.check_strokes(cylinders)?;
        let found = self.fixed.as_ref().and_then(|kernel| kernel.run(cylinders));
        let Some(Found { joints, plane, levers, transmissions, .. }) = found else {
            return self.cylinders_to_tip_with_jacobian(cylinders, swing);
        };
        let pose = Pose { swing, joints, plane, x: plane.reach * swing.cos, y: plane.reach * swing.sin };
        Ok((pose, CylinderJacobian::new(levers, transmissions)))
    }
}
