//! Joints ↔ wrist and tip in the boom's vertical plane: Koivo 1994 (4)–(9), (19)–(28), Frankel 2003 `Jdisp`, `Rdisp`.
//!
//! The plane is swung by θ1 about the swing axis; reach and height are measured in it, in the base frame whose origin
//! lies on the swing axis at boom-pin height. Reach is signed: the tip may stand behind the axis.

use crate::fixed_chain::FixedChain;
use crate::{PoseError, Real, Rotor, Vec2};

/// Joint rotations in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints<T> {
    /// θ2, elevation of the boom line.
    pub boom: Rotor<T>,
    /// θ3, arm relative to the boom; negative when curled.
    pub arm: Rotor<T>,
    /// θ4, bucket relative to the arm.
    pub bucket: Rotor<T>,
}

impl<T: Real> Joints<T> {
    /// The bucket's pitch φ = θ2 + θ3 + θ4.
    #[inline(always)]
    pub fn pitch(&self) -> Rotor<T> {
        self.boom * self.arm * self.bucket
    }
}

/// The bucket tip (N in Koivo 1994) in the plane, with the bucket's pitch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneTip<T> {
    /// Signed distance from the swing axis, m.
    pub reach: T,
    /// Height above the boom pin, m.
    pub height: T,
    /// φ = θ2 + θ3 + θ4: direction from bucket pin to tip.
    pub pitch: Rotor<T>,
}

/// The nearest to the boom pin that the wrist may come, m. It matters only where boom and arm are equally long: nearer,
/// the boom's direction is a quotient of vanishing numbers.
const NEAREST_WRIST_M: f64 = 1e-6;

/// The link lengths a1…a4 and what follows from them.
///
/// ```
/// use kinematics_core::chain::Chain;
/// use kinematics_core::{Joints, PlaneTip, Rotor, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// // The boom straight up, the arm level, the bucket straight down.
/// let chain = Chain::<f64>::new([0.5, 2.0, 1.0, 0.5]);
/// assert_eq!(chain.lengths()[1], 2.0);
/// let quarter = Rotor::from_turns(0.25);
/// let joints = Joints { boom: quarter, arm: quarter.inverse(), bucket: quarter.inverse() };
/// let tip = chain.tip(&joints);
/// assert_eq!(tip, PlaneTip { reach: 1.5, height: 1.5, pitch: joints.pitch() });
/// assert_eq!(chain.wrist(&joints), Vec2::new(1.5, 2.0));
/// // And back, from the tip or from the bucket's pin.
/// for back in [chain.joints(&tip)?, chain.joints_from_wrist(Vec2::new(1.5, 2.0), tip.pitch)?] {
///     assert!((back.boom.sin - 1.0).abs() < 1e-15 && (back.arm.sin + 1.0).abs() < 1e-15);
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Chain<T> {
    a1: T,
    a2: T,
    a3: T,
    a4: T,
    /// (a2 + a3)² and (a2 − a3)²
    outer_square: T,
    inner_square: T,
    /// a2² − a3², 1/2a2, 1/a3
    balance: T,
    half_over_a2: T,
    one_over_a3: T,
    /// a2² + a3² and 1/2·a2·a3
    sum_of_squares: T,
    half_over_a2_a3: T,
    /// For [`Chain::fine_jacobian`] and its like, where they can have one.
    pub(crate) fixed: Option<FixedChain<T>>,
}

impl<T: Real> Chain<T> {
    /// The chain of a1 (swing axis to boom pin), a2 boom, a3 arm, a4 bucket; metres, a2…a4 positive.
    pub fn new(a: [f64; 4]) -> Self {
        Self { fixed: FixedChain::new(a), ..Self::without_fine_maps(a) }
    }

    /// As [`Machine::without_fine_maps`](crate::Machine::without_fine_maps).
    pub(crate) fn without_fine_maps([a1, a2, a3, a4]: [f64; 4]) -> Self {
        Self {
            a1: T::from_f64(a1),
            a2: T::from_f64(a2),
            a3: T::from_f64(a3),
            a4: T::from_f64(a4),
            outer_square: T::from_f64((a2 + a3) * (a2 + a3)),
            inner_square: T::from_f64((a2 - a3) * (a2 - a3)),
            balance: T::from_f64(a2 * a2 - a3 * a3),
            half_over_a2: T::from_f64(0.5 / a2),
            one_over_a3: T::from_f64(1.0 / a3),
            sum_of_squares: T::from_f64(a2 * a2 + a3 * a3),
            half_over_a2_a3: T::from_f64(0.5 / (a2 * a3)),
            fixed: None,
        }
    }

    /// a1…a4, m.
    pub fn lengths(&self) -> [T; 4] {
        [self.a1, self.a2, self.a3, self.a4]
    }

    /// Joints → tip, Koivo 1994 (8), (9) in the plane.
    #[inline(always)]
    pub fn tip(&self, joints: &Joints<T>) -> PlaneTip<T> {
        let arm = joints.boom * joints.arm;
        let pitch = arm * joints.bucket;
        PlaneTip {
            reach: self.a1 + (self.a2 * joints.boom.cos + (self.a3 * arm.cos + self.a4 * pitch.cos)),
            height: self.a2 * joints.boom.sin + (self.a3 * arm.sin + self.a4 * pitch.sin),
            pitch,
        }
    }

    /// Joints → wrist (bucket pin, D in Koivo 1994), Koivo 1994 (5) in the plane: (reach, height).
    #[inline(always)]
    pub fn wrist(&self, joints: &Joints<T>) -> Vec2<T> {
        let arm = joints.boom * joints.arm;
        Vec2::new(
            self.a1 + (self.a2 * joints.boom.cos + self.a3 * arm.cos),
            self.a2 * joints.boom.sin + self.a3 * arm.sin,
        )
    }

    /// Tip → joints; Koivo 1994 (24)–(27) with (27) corrected to p_D = p_N − a4·(c234, s234) in the plane.
    ///
    /// # Errors
    /// [`PoseError::Unreachable`] when the wrist lies outside what boom and arm reach.
    #[inline(always)]
    pub fn joints(&self, tip: &PlaneTip<T>) -> Result<Joints<T>, PoseError<T>> {
        let wrist = Vec2::new(tip.reach - self.a1 - self.a4 * tip.pitch.cos, tip.height - self.a4 * tip.pitch.sin);
        self.joints_about_boom_pin(wrist, tip.pitch)
    }

    /// Wrist (reach, height) and pitch → joints, for a bucket given by its pin: Koivo 1994 (23)–(26).
    ///
    /// # Errors
    /// As [`Chain::joints`].
    #[inline]
    pub fn joints_from_wrist(&self, wrist: Vec2<T>, pitch: Rotor<T>) -> Result<Joints<T>, PoseError<T>> {
        self.joints_about_boom_pin(Vec2::new(wrist.x - self.a1, wrist.z), pitch)
    }

    /// Bucket pin from the boom pin → joints, the knee above the line (θ3 < 0).
    #[inline(always)]
    fn joints_about_boom_pin(&self, wrist: Vec2<T>, pitch: Rotor<T>) -> Result<Joints<T>, PoseError<T>> {
        let square = wrist.norm_squared();
        // (2·a2·|D|)² − (a2² − a3² + |D|²)², as a product of differences: accurate near the stretched arm.
        let discriminant = (self.outer_square - square) * (square - self.inner_square);
        if !(discriminant >= T::ZERO && square >= T::from_f64(NEAREST_WRIST_M * NEAREST_WRIST_M)) {
            return Err(self.unreachable(square));
        }
        let root = discriminant.sqrt_of_magnitude();
        // The boom line from the line to the wrist: a2·rotor = (square + a2² − a3² + i·√)·D / 2|D|².
        let turn = Vec2::new(square + self.balance, root);
        let boom = turn.complex_mul(wrist).scale(self.half_over_a2 / square);
        // θ2 + θ3, from the knee to the wrist; θ3 itself from |D| alone, |D|² = a2² + a3² + 2·a2·a3·cos θ3.
        let forearm = (wrist - boom.scale(self.a2)).scale(self.one_over_a3);
        let arm =
            Rotor { cos: (square - self.sum_of_squares) * self.half_over_a2_a3, sin: -(root * self.half_over_a2_a3) };
        Ok(Joints {
            boom: Rotor { cos: boom.x, sin: boom.z },
            arm,
            bucket: pitch * Rotor { cos: forearm.x, sin: -forearm.z },
        })
    }

    #[cold]
    fn unreachable(&self, square: T) -> PoseError<T> {
        let distance = square.sqrt();
        // a2² + a3² lies half-way between both limits' squares. Next to a limit the distance may round on to it or past it:
        // then the excess is below what T resolves, and only its sign is told.
        let least = distance * T::from_f64(f64::EPSILON);
        let by = if square > self.sum_of_squares {
            let over = distance - (self.a2 + self.a3);
            if over > least { over } else { least }
        } else {
            let (inner, nearest) = (self.inner_square.sqrt(), T::from_f64(NEAREST_WRIST_M));
            let under = distance - if inner > nearest { inner } else { nearest };
            if under > -least { -least } else { under }
        };
        PoseError::Unreachable { by }
    }
}

/// Bucket pitch from the digging angle θ_dg between the bucket's bottom plane and the horizontal, and θ_b between that
/// plane and the bucket line: Koivo 1994 (28), θ4 = θ_b + θ_dg − θ2 − θ3, that is φ = θ_b + θ_dg.
///
/// ```
/// use kinematics_core::Rotor;
/// use kinematics_core::chain::{digging_angle, pitch_from_digging_angle};
/// // The bottom plane 30° from the bucket line, digging 20° below the horizontal.
/// let bottom = Rotor::<f64>::from_degrees(30.0);
/// let pitch = pitch_from_digging_angle(bottom, Rotor::from_degrees(-20.0));
/// assert!((pitch.angle().to_degrees() - 10.0).abs() < 1e-13);
/// assert!((digging_angle(bottom, pitch).angle().to_degrees() + 20.0).abs() < 1e-13);
/// ```
#[inline]
pub fn pitch_from_digging_angle<T: Real>(bottom: Rotor<T>, digging: Rotor<T>) -> Rotor<T> {
    bottom * digging
}

/// The inverse of [`pitch_from_digging_angle`]: θ_dg = φ − θ_b.
#[inline]
pub fn digging_angle<T: Real>(bottom: Rotor<T>, pitch: Rotor<T>) -> Rotor<T> {
    pitch * bottom.inverse()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tip<T: Real>(reach: f64, height: f64) -> PlaneTip<T> {
        PlaneTip { reach: T::from_f64(reach), height: T::from_f64(height), pitch: Rotor::IDENTITY }
    }

    #[test]
    fn a_wrist_next_to_the_boom_pin_is_unreachable_even_where_boom_and_arm_are_equally_long() {
        // 2.4e-20 squared survives in f32, and a quotient by it does not.
        let chain = Chain::<f32>::new([0.0, 2.0, 2.0, 1.0]);
        for height in [0.0, 1e-30, 2.4e-20, 1e-12, 5e-7] {
            let found = chain.joints(&tip(1.0, height));
            assert!(matches!(found, Err(PoseError::Unreachable { .. })), "{height}: {found:?}");
        }
    }

    #[test]
    fn a_wrist_two_micrometres_from_the_boom_pin_folds_equal_links_together() {
        let chain = Chain::<f64>::new([0.0, 2.0, 2.0, 1.0]);
        let folded = chain.joints(&tip(1.0, 2e-6)).map(|joints| joints.arm);
        assert!(folded.is_ok_and(|arm| (arm.cos + 1.0).abs() < 1e-11 && (arm.sin + 1e-6).abs() < 1e-11), "{folded:?}");
    }

    fn just_beyond<T: Real + core::fmt::Display>(a2: f64, a3: f64, limit: f64, step: f64) -> u32 {
        let chain = Chain::<T>::new([0.0, a2, a3, 0.5]);
        let mut refused = 0;
        for i in 0..1000 {
            let direction = Rotor::<f64>::from_turns(f64::from(i) * 0.001).to_vec();
            let wrist = direction.scale(limit * (1.0 + step * f64::from(i)));
            let wrist = Vec2::new(T::from_f64(wrist.x), T::from_f64(wrist.z));
            if let Err(PoseError::Unreachable { by }) = chain.joints_from_wrist(wrist, Rotor::IDENTITY) {
                let outwards = if limit > a2 { by } else { -by };
                assert!(outwards > T::ZERO && outwards < T::from_f64(1e-4), "{by} at {limit}");
                refused += 1;
            }
        }
        refused
    }

    #[test]
    fn half_a_rounding_beyond_a_limit_is_not_told_as_metres_beyond_the_other() {
        for (a2, a3) in [(4.411813674894979, 3.2520846788748363), (4.780331544359228, 1.226654695424576)] {
            assert!(just_beyond::<f32>(a2, a3, a2 + a3, 2e-10) > 0);
            assert!(just_beyond::<f64>(a2, a3, a2 + a3, 4e-19) > 0);
            assert!(just_beyond::<f32>(a2, a3, a2 - a3, -2e-10) > 0);
            assert!(just_beyond::<f64>(a2, a3, a2 - a3, -4e-19) > 0);
        }
    }

    #[test]
    fn the_unreachable_side_is_told_by_the_sign() {
        let chain = Chain::<f64>::new([0.0, 3.0, 1.0, 1.0]);
        assert_eq!(chain.joints(&tip(5.5, 0.0)), Err(PoseError::Unreachable { by: 0.5 }));
        assert_eq!(chain.joints(&tip(2.5, 0.0)), Err(PoseError::Unreachable { by: -0.5 }));
    }
}
