//! The chain's levers in fixed point.

use crate::fixed::{Fixed, FixedVec, Wide};
use crate::{Real, Vec2};

/// a1…a4 over a2 + a3 + a4, and a step of that in m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedChain<T> {
    boom_pin: Fixed,
    links: [Fixed; 3],
    metres: T,
}

/// Boom pin, arm pin, bucket pin → the point, and the point's reach from the swing axis; m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Levers<T> {
    pub(crate) levers: [Vec2<T>; 3],
    pub(crate) reach: T,
}

impl<T: Real> FixedChain<T> {
    /// `None` for a number type as fine as fixed point, and where a1 is twice the others' sum or more.
    pub(crate) fn new([a1, a2, a3, a4]: [f64; 4]) -> Option<Self> {
        if !T::COARSER_THAN_FIXED {
            return None;
        }
        let total = a2 + a3 + a4;
        let part = |length_m: f64| Fixed::new(length_m / total);
        Some(Self {
            boom_pin: part(a1)?,
            links: [part(a2)?, part(a3)?, part(a4)?],
            metres: T::from_f64(total / f64::from(1u32 << 30)),
        })
    }

    /// The chain up to the bucket pin.
    #[inline(always)]
    pub(crate) fn to_wrist(self) -> Self {
        let [a2, a3, _] = self.links;
        Self { links: [a2, a3, Fixed(0)], ..self }
    }

    /// Directions of boom, arm and bucket → the levers; each sum is rounded once.
    #[inline(always)]
    pub(crate) fn levers(&self, [boom, arm, bucket]: [FixedVec; 3]) -> Levers<T> {
        let [a2, a3, a4] = self.links;
        let sums = |boom: Fixed, arm: Fixed, bucket: Fixed| -> [Wide; 3] {
            let bucket = bucket.times(a4);
            let arm = arm.times(a3).plus(bucket);
            [boom.times(a2).plus(arm), arm, bucket]
        };
        let [bx, ax, kx] = sums(boom.x, arm.x, bucket.x).map(Wide::narrow);
        let [bz, az, kz] = sums(boom.z, arm.z, bucket.z).map(Wide::narrow);
        let metres = |x: Fixed| T::from_i32(x.0) * self.metres;
        Levers {
            levers: [(bx, bz), (ax, az), (kx, kz)].map(|(x, z)| Vec2::new(metres(x), metres(z))),
            reach: metres(self.boom_pin.plus(bx)),
        }
    }
}
