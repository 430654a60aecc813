//! The four-joint Jacobian with its reach summed in fixed point: for f32 where the tip comes close to the swing axis.
//!
//! The rotors given are taken for exact directions. What an f32 rotor itself was rounded by is not in these functions' power
//! (`docs/accuracy.md`, "Rates").

use crate::chain::{Chain, Joints};
use crate::fixed::FixedVec;
use crate::fixed_chain::FixedChain;
use crate::swing_jacobian::SwingJacobian;
use crate::{Real, Rotor};

impl<T: Real> Chain<T> {
    /// [`Chain::swing_jacobian`] to 2e-6 of each row's largest entry in f32 too, down to rows of 1/500 of a2 + a3 + a4 a radian, below
    /// which the error is that of the row of 1/500: the reach is summed in 32-bit fixed point.
    ///
    /// For a tip (or wrist) that comes closer to the swing axis than a fifth of a2 + a3 + a4, and a row at right angles to the swing, in
    /// which nothing else is left. Farther out [`Chain::swing_jacobian`] is as good and cheaper (`docs/cost.md`). In f64, and with a boom pin
    /// twice a2 + a3 + a4 from the swing axis or more, both are one.
    ///
    /// ```
    /// # use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI)?;
    /// let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 })?;
    /// let (tip, wrist) = (
    ///     machine.chain().fine_swing_jacobian(&joints, Rotor::IDENTITY).matrix(),
    ///     machine.chain().fine_swing_wrist_jacobian(&joints, Rotor::IDENTITY).matrix(),
    /// );
    /// // Swinging moves the tip to the left, by its reach; the bucket joint does not move its own pin.
    /// assert!((tip[1][0] - machine.chain().tip(&joints).reach).abs() < 1e-6);
    /// assert_eq!(wrist.map(|row| row[3].abs()), [0.0, 0.0, 0.0, 1.0]);
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    pub fn fine_swing_jacobian(&self, joints: &Joints<T>, swing: Rotor<T>) -> SwingJacobian<T> {
        let quick = self.swing_jacobian(joints, swing);
        self.fixed.as_ref().map_or(quick, |chain| quick.with_reach(reach(chain, joints)))
    }

    /// [`Chain::swing_wrist_jacobian`], likewise.
    #[inline]
    pub fn fine_swing_wrist_jacobian(&self, joints: &Joints<T>, swing: Rotor<T>) -> SwingJacobian<T> {
        let quick = self.swing_wrist_jacobian(joints, swing);
        self.fixed.as_ref().map_or(quick, |chain| quick.with_reach(reach(&chain.to_wrist(), joints)))
    }
}

#[inline(always)]
fn reach<T: Real>(chain: &FixedChain<T>, joints: &Joints<T>) -> T {
    let boom = FixedVec::direction(joints.boom);
    let forearm = boom.complex_mul(FixedVec::direction(joints.arm));
    chain.levers([boom, forearm, forearm.complex_mul(FixedVec::direction(joints.bucket))]).reach
}
