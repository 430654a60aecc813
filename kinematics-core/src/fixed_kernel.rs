//! Pose and cylinder-space Jacobian in fixed point: `Machine::cylinders_to_tip_with_fine_jacobian` for numbers coarser than 2⁻³⁰ next to one.

use crate::chain::PlaneTip;
use crate::fixed::FixedVec;
use crate::fixed_chain::{FixedChain, Levers};
use crate::fixed_linkage::{FixedFourBar, FixedTriangle};
use crate::triangle::Side;
use crate::{Cylinders, Joints, PinGeometry, Real, Rotor, Vec2};

/// The machine's constants in fixed point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedKernel<T> {
    boom: FixedTriangle<T>,
    arm: FixedTriangle<T>,
    bucket: FixedFourBar<T>,
    chain: FixedChain<T>,
}

/// What the kernel finds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<T> {
    pub(crate) joints: Joints<T>,
    pub(crate) plane: PlaneTip<T>,
    /// Boom pin, arm pin, bucket pin → tip, m.
    pub(crate) levers: [Vec2<T>; 3],
    /// dθ/dL, rad/m, and d²θ/dL², rad/m².
    pub(crate) transmissions: [T; 3],
    pub(crate) bends: [T; 3],
}

fn rotor<T: Real>(v: FixedVec) -> Rotor<T> {
    Rotor { cos: v.x.to_real(), sin: v.z.to_real() }
}

impl<T: Real> FixedKernel<T> {
    /// The constants; `None` for a number type as fine as fixed point, and for a geometry out of its range: a cylinder shorter than a
    /// quarter of √(2ab) or longer than four of them, a and b its triangle's sides; a rocker pin that can come next to the bucket pin; a
    /// boom pin twice a2 + a3 + a4 from the swing axis or more.
    pub(crate) fn new(g: &PinGeometry) -> Option<Self> {
        if !T::COARSER_THAN_FIXED {
            return None;
        }
        Some(Self {
            boom: FixedTriangle::new(g.boom.base, g.boom.rod, g.boom_cylinder.side(), 1.0, g.boom.stroke)?,
            arm: FixedTriangle::new(g.arm_base_from_pin(), g.arm.rod, Side::Clockwise, 1.0, g.arm.stroke)?,
            bucket: FixedFourBar::new(g)?,
            chain: FixedChain::new([g.boom_pin_x_m, g.boom_m, g.arm_m, g.bucket_m])?,
        })
    }

    /// Lengths inside their strokes → what follows; `None` at a dead point, where the kernel in T names the cylinder.
    #[inline(always)]
    pub(crate) fn run(&self, cylinders: &Cylinders<T>) -> Option<Found<T>> {
        let boom = self.boom.place(cylinders.boom)?;
        let arm = self.arm.place(cylinders.arm)?;
        let bucket = self.bucket.place(cylinders.bucket)?;
        let forearm = boom.vector.complex_mul(arm.vector);
        let pitch = forearm.complex_mul(bucket.rotor);
        let Levers { levers, reach } = self.chain.levers([boom.vector, forearm, pitch]);
        let [from_boom_pin, ..] = levers;
        Some(Found {
            joints: Joints { boom: rotor(boom.vector), arm: rotor(arm.vector), bucket: rotor(bucket.rotor) },
            plane: PlaneTip { reach, height: from_boom_pin.z, pitch: rotor(pitch) },
            levers,
            transmissions: [boom.rate, arm.rate, bucket.rate],
            bends: [self.boom.bend(&boom, cylinders.boom), self.arm.bend(&arm, cylinders.arm), bucket.bend],
        })
    }
}
