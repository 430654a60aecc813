//! The tip's acceleration while no cylinder accelerates, in one step from lengths.

use crate::fixed_kernel::Found;
use crate::jacobian::{PlanarJacobian, Twist};
use crate::rates::{CylinderRates, JointRates};
use crate::{Cylinders, Machine, PoseError, Real, Rotor};

impl<T: Real> Machine<T> {
    /// The tip's acceleration at constant cylinder rates, J̇·L̇ of the cylinder-space Jacobian (m/s², rad/s²), to 2e-6 of its largest
    /// term in f32 too: in 32-bit fixed point, rounded to T at the end.
    ///
    /// With [`crate::rates::Moments`] at hand the same comes by way of the joints (their accelerations at none of the cylinders', then
    /// [`PlanarJacobian::bias`] and [`PlanarJacobian::twist`]); that leaves up to 5e-6 in f32. In f64, and out of fixed
    /// point's range ([`Machine::cylinders_to_tip_with_fine_jacobian`]), this function goes that way itself.
    ///
    /// ```
    /// # use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
    /// # use kinematics_core::rates::CylinderRates;
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI)?;
    /// let rates = CylinderRates { boom: 0.1, arm: -0.2, bucket: 0.3 };
    /// let at = |s: f64| Cylinders { boom: 1.1 + 0.1 * s, arm: 1.3 - 0.2 * s, bucket: 1.0 + 0.3 * s };
    /// let found = machine.cylinder_bias(&at(0.0), &rates)?;
    /// // What the tip's velocity changes by in 2 ms.
    /// let velocity = |s: f64| machine.cylinders_to_tip_with_jacobian(&at(s), Rotor::IDENTITY).map(|(_, j)| j.twist(&rates));
    /// let (before, after) = (velocity(-1e-3)?, velocity(1e-3)?);
    /// assert!((found.reach - (after.reach - before.reach) / 2e-3).abs() < 1e-5);
    /// assert!((found.pitch - (after.pitch - before.pitch) / 2e-3).abs() < 1e-5);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`], [`PoseError::NoAssembly`].
    #[inline]
    pub fn cylinder_bias(&self, cylinders: &Cylinders<T>, rates: &CylinderRates<T>) -> Result<Twist<T>, PoseError<T>> {
        self.check_strokes(cylinders)?;
        if let Some(Found { levers, transmissions, bends, .. }) = self.fixed.as_ref().and_then(|k| k.run(cylinders)) {
            return Ok(bias(&PlanarJacobian::from_levers(levers), transmissions, bends, rates));
        }
        let (pose, jacobian) = self.cylinders_to_tip_with_jacobian(cylinders, Rotor::IDENTITY)?;
        let moments = self.moments(cylinders)?;
        let [boom, arm, bucket] = jacobian.pitch;
        // d²θ/dL² = −(d²L/dθ²)·(dθ/dL)³
        let bend = |slope: T, transmission: T| -(slope * transmission * (transmission * transmission));
        let bends = [bend(moments.boom.slope, boom), bend(moments.arm.slope, arm), bend(moments.bucket.slope, bucket)];
        Ok(bias(&self.chain.jacobian(&pose.joints), jacobian.pitch, bends, rates))
    }
}

/// Centripetal along the links, and the levers' joints accelerated by (d²θ/dL²)·L̇².
#[inline(always)]
fn bias<T: Real>(jacobian: &PlanarJacobian<T>, rate: [T; 3], bend: [T; 3], of: &CylinderRates<T>) -> Twist<T> {
    let ([tb, ta, tk], [bb, ba, bk]) = (rate, bend);
    let speeds = JointRates { boom: tb * of.boom, arm: ta * of.arm, bucket: tk * of.bucket };
    let accelerations =
        JointRates { boom: bb * of.boom * of.boom, arm: ba * of.arm * of.arm, bucket: bk * of.bucket * of.bucket };
    let (direct, through) = (jacobian.bias(&speeds), jacobian.twist(&accelerations));
    Twist { reach: direct.reach + through.reach, height: direct.height + through.height, pitch: through.pitch }
}
