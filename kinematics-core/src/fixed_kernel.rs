//! Pose and cylinder-space Jacobian in fixed point: `Machine::cylinders_to_tip_with_fine_jacobian` for numbers coarser than 2⁻³⁰ next to one.

use crate::chain::PlaneTip;
use crate::fixed::{Fixed, FixedVec};
use crate::fixed_linkage::{FixedFourBar, FixedTriangle};
use crate::triangle::Side;
use crate::{Cylinders, Joints, PinGeometry, Real, Rotor, Vec2};

/// The machine's constants in fixed point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedKernel<T> {
    boom: FixedTriangle<T>,
    arm: FixedTriangle<T>,
    bucket: FixedFourBar<T>,
    /// a2, a3, a4 over their sum, and a step of that in m
    links: [Fixed; 3],
    metres: T,
    a1: T,
}

/// What the kernel finds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<T> {
    pub(crate) joints: Joints<T>,
    pub(crate) plane: PlaneTip<T>,
    /// Boom pin, arm pin, bucket pin → tip, m.
    pub(crate) levers: [Vec2<T>; 3],
    /// dθ/dL, rad/m.
    pub(crate) transmissions: [T; 3],
}

fn rotor<T: Real>(v: FixedVec) -> Rotor<T> {
    Rotor { cos: v.x.to_real(), sin: v.z.to_real() }
}

impl<T: Real> FixedKernel<T> {
    /// The constants; `None` for a number type as fine as fixed point, and for a geometry out of its range: a cylinder shorter than a
    /// quarter of √(2ab) or longer than four of them, a and b its triangle's sides; a rocker pin that can come next to the bucket pin.
    pub(crate) fn new(g: &PinGeometry) -> Option<Self> {
        if !T::COARSER_THAN_FIXED {
            return None;
        }
        let total = g.reach_m();
        let link = |length_m: f64| Fixed::new(length_m / total);
        Some(Self {
            boom: FixedTriangle::new(g.boom.base, g.boom.rod, g.boom_cylinder.side(), 1.0, g.boom.stroke)?,
            arm: FixedTriangle::new(g.arm_base_from_pin(), g.arm.rod, Side::Clockwise, 1.0, g.arm.stroke)?,
            bucket: FixedFourBar::new(g)?,
            links: [link(g.boom_m)?, link(g.arm_m)?, link(g.bucket_m)?],
            metres: T::from_f64(total / f64::from(1u32 << 30)),
            a1: T::from_f64(g.boom_pin_x_m),
        })
    }

    /// Lengths inside their strokes → what follows; `None` at a dead point, where the kernel in T names the cylinder.
    #[inline(always)]
    pub(crate) fn run(&self, cylinders: &Cylinders<T>) -> Option<Found<T>> {
        let (boom, boom_rate) = self.boom.place(cylinders.boom)?;
        let (arm, arm_rate) = self.arm.place(cylinders.arm)?;
        let (bucket, bucket_rate) = self.bucket.place(cylinders.bucket)?;
        let forearm = boom.complex_mul(arm);
        let pitch = forearm.complex_mul(bucket);
        let [a2, a3, a4] = self.links;
        let bucket_lever = pitch.scale(a4);
        let arm_lever = forearm.scale(a3).plus(bucket_lever);
        let boom_lever = boom.scale(a2).plus(arm_lever);
        let levers = [boom_lever, arm_lever, bucket_lever]
            .map(|v| Vec2::new(T::from_i32(v.x.0) * self.metres, T::from_i32(v.z.0) * self.metres));
        let [from_boom_pin, ..] = levers;
        Some(Found {
            joints: Joints { boom: rotor(boom), arm: rotor(arm), bucket: rotor(bucket) },
            plane: PlaneTip { reach: self.a1 + from_boom_pin.x, height: from_boom_pin.z, pitch: rotor(pitch) },
            levers,
            transmissions: [boom_rate, arm_rate, bucket_rate],
        })
    }
}
