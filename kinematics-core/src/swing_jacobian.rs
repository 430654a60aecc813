//! The Jacobian of all four joints in the base frame, swing included, at tip or wrist: Koivo 1994 (30), (31).
//!
//! ```
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
//! use kinematics_core::rates::JointRates;
//! use kinematics_core::swing_jacobian::{BaseWrench, MachineRates};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
//! let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
//! let swing = Rotor::from_degrees(40.0);
//! let jacobian = machine.chain().swing_jacobian(&joints, swing);
//! let rates = MachineRates { swing: 0.2, joints: JointRates { boom: 0.1, arm: -0.2, bucket: 0.3 } };
//! let twist = jacobian.twist(&rates);
//! let back = jacobian.rates(&twist)?;
//! assert!((back.swing - 0.2).abs() < 1e-14 && (back.joints.arm + 0.2).abs() < 1e-14);
//! // Koivo's matrix as printed, and its fourth row as the angular velocity it is said to be.
//! assert_eq!(jacobian.matrix()[3], [0.0, 1.0, 1.0, 1.0]);
//! assert_eq!(jacobian.matrix_with_omega_y()[3], [0.0, -swing.cos, -swing.cos, -swing.cos]);
//! // What the tip exerts sideways the swing must hold, at the tip's reach.
//! let ahead = machine.chain().swing_jacobian(&joints, Rotor::IDENTITY);
//! let (swing_torque, _) = ahead.torques(&BaseWrench { x: 0.0, y: 1000.0, z: 0.0, moment: 0.0 });
//! let reach = machine.chain().tip(&joints).reach;
//! assert!((swing_torque - 1000.0 * reach).abs() < 1e-9);
//! // Swinging at 0.2 rad/s alone pulls the tip inwards.
//! let still = JointRates { boom: 0.0, arm: 0.0, bucket: 0.0 };
//! let bias = ahead.bias(&MachineRates { swing: 0.2, joints: still });
//! assert!((bias.x + 0.04 * reach).abs() < 1e-15);
//! # Ok(())
//! # }
//! ```

use crate::chain::{Chain, Joints};
use crate::forces::{JointTorques, Wrench};
use crate::jacobian::{PlanarJacobian, Twist};
use crate::rates::JointRates;
use crate::{Real, Rotor, Singular, Vec2};

/// Rates of all four joints, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MachineRates<T> {
    /// θ̇1.
    pub swing: T,
    /// θ̇2, θ̇3, θ̇4.
    pub joints: JointRates<T>,
}

/// How a point of the bucket moves in the base frame: m/s and rad/s; or its acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseTwist<T> {
    /// Forward at zero swing.
    pub x: T,
    /// To the left.
    pub y: T,
    /// Upwards.
    pub z: T,
    /// φ̇ = θ̇2 + θ̇3 + θ̇4, in the swung plane.
    pub pitch: T,
}

/// A force in the base frame and a moment about the joints' axes, exerted by a point of the bucket: N and N·m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseWrench<T> {
    /// Forward at zero swing.
    pub x: T,
    /// To the left.
    pub y: T,
    /// Upwards.
    pub z: T,
    /// As φ.
    pub moment: T,
}

/// Koivo 1994 (31), kept as the swing and the plane it turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingJacobian<T> {
    swing: Rotor<T>,
    /// The point's reach, m: a14 in (31).
    reach: T,
    plane: PlanarJacobian<T>,
}

/// A reach below this stands on the swing axis, m.
pub const SMALLEST_REACH_M: f64 = 1e-6;

impl<T: Real> Chain<T> {
    /// The four-joint Jacobian at the tip (N in Koivo 1994).
    #[inline]
    pub fn swing_jacobian(&self, joints: &Joints<T>, swing: Rotor<T>) -> SwingJacobian<T> {
        SwingJacobian { swing, reach: self.tip(joints).reach, plane: self.jacobian(joints) }
    }

    /// The four-joint Jacobian at the wrist (D in Koivo 1994).
    ///
    /// ```
    /// use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
    /// let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
    /// let matrix = machine.chain().swing_wrist_jacobian(&joints, Rotor::IDENTITY).matrix();
    /// // The bucket joint does not move its own pin.
    /// assert_eq!(matrix.map(|row| row[3].abs()), [0.0, 0.0, 0.0, 1.0]);
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    pub fn swing_wrist_jacobian(&self, joints: &Joints<T>, swing: Rotor<T>) -> SwingJacobian<T> {
        SwingJacobian { swing, reach: self.wrist(joints).x, plane: self.wrist_jacobian(joints) }
    }
}

impl<T: Real> SwingJacobian<T> {
    /// Koivo 1994 (31) as printed: rows v_ox, v_oy, v_oz [m/rad] and, fourth, the pitch rate; columns θ1…θ4.
    pub fn matrix(&self) -> [[T; 4]; 4] {
        let Rotor { cos, sin } = self.swing;
        let [[r2, r3, r4], [h2, h3, h4]] = self.plane.matrix_2x3();
        let (zero, one) = (T::ZERO, T::ONE);
        [
            [-(sin * self.reach), cos * r2, cos * r3, cos * r4],
            [cos * self.reach, sin * r2, sin * r3, sin * r4],
            [zero, h2, h3, h4],
            [zero, one, one, one],
        ]
    }

    /// As [`SwingJacobian::matrix`], its fourth row ω_oy as (30) names it: the joints turn about (s1, −c1, 0), so the angular
    /// velocity about the base frame's y is (0, −c1, −c1, −c1)·θ̇.
    pub fn matrix_with_omega_y(&self) -> [[T; 4]; 4] {
        let [x, y, z, _] = self.matrix();
        let about_y = -self.swing.cos;
        [x, y, z, [T::ZERO, about_y, about_y, about_y]]
    }

    /// The angular velocity of the bucket in the base frame, (s1·φ̇, −c1·φ̇, θ̇1), rad/s.
    ///
    /// ```
    /// # use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
    /// # use kinematics_core::{rates::JointRates, swing_jacobian::MachineRates};
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// # let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
    /// # let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
    /// let jacobian = machine.chain().swing_jacobian(&joints, Rotor::IDENTITY);
    /// let rates = MachineRates { swing: 0.5, joints: JointRates { boom: 1.0, arm: 0.0, bucket: 0.0 } };
    /// // Raising the boom straight ahead turns it about −y.
    /// assert_eq!(jacobian.angular_velocity(&rates), [0.0, -1.0, 0.5]);
    /// # Ok(())
    /// # }
    /// ```
    pub fn angular_velocity(&self, rates: &MachineRates<T>) -> [T; 3] {
        let JointRates { boom, arm, bucket } = rates.joints;
        let pitch = boom + arm + bucket;
        [self.swing.sin * pitch, -(self.swing.cos * pitch), rates.swing]
    }

    /// Joint rates → the point's twist: Koivo 1994 (30).
    #[inline]
    pub fn twist(&self, rates: &MachineRates<T>) -> BaseTwist<T> {
        let Twist { reach, height, pitch } = self.plane.twist(&rates.joints);
        self.swung(reach, self.reach * rates.swing, height, pitch)
    }

    /// The point's twist → joint rates: the inverse of Koivo 1994 (30).
    ///
    /// # Errors
    /// [`Singular::TipOnSwingAxis`], [`Singular::ArmStretched`].
    #[inline]
    pub fn rates(&self, twist: &BaseTwist<T>) -> Result<MachineRates<T>, Singular> {
        let smallest = T::from_f64(SMALLEST_REACH_M);
        if !(self.reach > smallest || self.reach < -smallest) {
            return Err(Singular::TipOnSwingAxis);
        }
        let along = self.swing.inverse().rotate(Vec2::new(twist.x, twist.y));
        let plane = Twist { reach: along.x, height: twist.z, pitch: twist.pitch };
        Ok(MachineRates { swing: along.z / self.reach, joints: self.plane.joint_rates(&plane)? })
    }

    /// J̇·θ̇: the point's acceleration while no joint accelerates, with the swing's centripetal and Coriolis parts.
    #[inline]
    pub fn bias(&self, rates: &MachineRates<T>) -> BaseTwist<T> {
        let velocity = self.plane.twist(&rates.joints).reach;
        let bias = self.plane.bias(&rates.joints);
        let inwards = self.reach * rates.swing * rates.swing;
        self.swung(bias.reach - inwards, (velocity + velocity) * rates.swing, bias.height, T::ZERO)
    }

    /// The force the point exerts → the torques that hold it, the swing's first: Hareesha 2015 (21) for four joints.
    #[inline]
    pub fn torques(&self, tip: &BaseWrench<T>) -> (T, JointTorques<T>) {
        let along = self.swing.inverse().rotate(Vec2::new(tip.x, tip.y));
        let plane = Wrench { reach: along.x, height: tip.z, moment: tip.moment };
        (self.reach * along.z, self.plane.joint_torques(&plane))
    }

    /// This reach in place of its own sum.
    #[inline(always)]
    pub(crate) fn with_reach(self, reach: T) -> Self {
        Self { reach, ..self }
    }

    #[inline(always)]
    fn swung(&self, reach: T, left: T, z: T, pitch: T) -> BaseTwist<T> {
        let Vec2 { x, z: y } = self.swing.rotate(Vec2::new(reach, left));
        BaseTwist { x, y, z, pitch }
    }
}
