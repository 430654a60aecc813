//! Tip velocity into the rates of more joints than it needs: Hareesha 2015 (13)–(15), with damping, weights and limits.
//!
//! Two numbers say where the tip goes, N = 2…6 joints move it: the bucket's angle is free, and what is left (the null
//! space) serves a second wish. J is the 2 × N Jacobian `[[T; N]; 2]` with the rows reach and height.
//! [`Redundancy`] is what a loop calls, in fixed time: 232 instructions for three joints on the emulated Cortex-M4F
//! (`cargo hil bench`), chain, Jacobian and limits included. [`pseudo_inverse`] and [`null_projector`] are the paper's equations as they stand.

use core::fmt;

use crate::chain_n::PlanarChain;
use crate::joint_range::JointRange;
use crate::svd::Gram;
use crate::{Real, Rotor, Vec2};

/// The right pseudo-inverse J⁺ = Jᵀ(JJᵀ)⁻¹, Hareesha 2015 (14): rows joints, columns reach and height; `None` where J is
/// singular. J⁺v is the shortest of all joint rates that give the tip velocity v. Its error grows with κ²·ε.
///
/// ```
/// # use kinematics_core::redundancy::pseudo_inverse;
/// assert_eq!(pseudo_inverse(&[[1.0f64, 1.0, 0.0], [0.0, 0.0, 2.0]]), Some([[0.5, 0.0], [0.5, 0.0], [0.0, 0.5]]));
/// ```
#[inline]
pub fn pseudo_inverse<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> Option<[[T; 2]; N]> {
    let Gram { mean, stretch, shear, det } = Gram::of(jacobian);
    // Not above zero, or so small that its reciprocal overflows.
    let reciprocal = if det > T::ZERO { T::ONE / det } else { T::ZERO };
    if !(reciprocal > T::ZERO && reciprocal * T::ZERO == T::ZERO) {
        return None;
    }
    let (xx, zz) = (mean + stretch, mean - stretch);
    let [reach, height] = jacobian;
    let mut out = [[T::ZERO; 2]; N];
    for ((out, &x), &z) in out.iter_mut().zip(reach).zip(height) {
        *out = [(x * zz - z * shear) * reciprocal, (z * xx - x * shear) * reciprocal];
    }
    Some(out)
}

/// The null-space projector I − J⁺J of Hareesha 2015 (15): rates that leave the tip at rest; `None` where J is singular.
///
/// ```
/// # use kinematics_core::redundancy::null_projector;
/// let projector = null_projector(&[[1.0f64, 1.0, 0.0], [0.0, 0.0, 2.0]]).unwrap();
/// assert_eq!(projector, [[0.5, -0.5, 0.0], [-0.5, 0.5, 0.0], [0.0, 0.0, 0.0]]);
/// ```
#[inline]
pub fn null_projector<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> Option<[[T; N]; N]> {
    let inverse = pseudo_inverse(jacobian)?;
    let [reach, height] = jacobian;
    let mut out = [[T::ZERO; N]; N];
    for (i, (row, [by_x, by_z])) in out.iter_mut().zip(inverse).enumerate() {
        for (k, ((entry, &x), &z)) in row.iter_mut().zip(reach).zip(height).enumerate() {
            let unit = if i == k { T::ONE } else { T::ZERO };
            *entry = unit - (by_x * x + by_z * z);
        }
    }
    Some(out)
}

/// The one motion of boom, arm and bucket that leaves the tip at rest: J₁ × J₂, of length √det(JJᵀ). The projector of (15) is
/// n·nᵀ/|n|² of it.
///
/// ```
/// # use kinematics_core::redundancy::null_motion;
/// assert_eq!(null_motion(&[[1.0f64, 1.0, 0.0], [0.0, 0.0, 2.0]]), [2.0, -2.0, 0.0]);
/// ```
#[inline]
pub fn null_motion<T: Real>(jacobian: &[[T; 3]; 2]) -> [T; 3] {
    let [[x2, x3, x4], [z2, z3, z4]] = *jacobian;
    [x3 * z4 - x4 * z3, x4 * z2 - x2 * z4, x2 * z3 - x3 * z2]
}

/// Joint rates for a tip velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates<T, const N: usize> {
    /// rad/s.
    pub joints: [T; N],
    /// λ², m²; above zero where the tip does not wholly follow: too near a singular pose, or at too many limits.
    pub damping: T,
}

/// Damped, weighted least squares with a second wish:
/// `θ̇ = b + V·Jᵀ(J·V·Jᵀ + λ²·I)⁻¹(v − J·b)`, tip velocity v (m/s), wished rates b (rad/s), mobilities V.
///
/// - Without damping the tip follows v, and of all rates that do θ̇ is nearest to b in Σ(θ̇−b)²/V: (15), written
///   J⁺v + (I − J⁺J)b, without a projector. A joint of mobility 0 keeps b.
/// - The damping rule is λ² = max(0, s² − σ₂²) with σ₂ the smallest singular value of J·√V and s the `trusted` one, m:
///   none above s, then just enough that the smallest eigenvalue inverted is s². It is continuous, and
///   Σ(θ̇−b)²/V ≤ |v − J·b|²/s² at every pose, singular or not. s must be above 0 and s⁴ a number of T;
///   [`Redundancy::new`] sees to it.
///
/// ```
/// use kinematics_core::Vec2;
/// use kinematics_core::redundancy::damped_rates;
/// let jacobian = [[1.0f64, 1.0, 0.0], [0.0, 0.0, 2.0]];
/// let rates = damped_rates(&jacobian, Vec2::new(1.0, 1.0), &[0.0; 3], &[1.0; 3], 0.1);
/// assert_eq!((rates.joints, rates.damping), ([0.5, 0.5, 0.5], 0.0));
/// // Stretched out, no rate moves the tip along the links, and none is asked for.
/// let stretched = [[0.0, 0.0, 0.0], [3.0, 2.0, 1.0]];
/// let rates = damped_rates(&stretched, Vec2::new(1.0, 0.0), &[0.0; 3], &[1.0; 3], 0.1);
/// assert_eq!(rates.joints, [0.0; 3]);
/// ```
#[inline(always)]
pub fn damped_rates<T: Real, const N: usize>(
    jacobian: &[[T; N]; 2],
    velocity: Vec2<T>,
    wish: &[T; N],
    mobility: &[T; N],
    trusted: T,
) -> Rates<T, N> {
    let gram = Gram::weighted(jacobian, mobility);
    let largest = gram.mean + gram.half_gap();
    let smallest = if largest > T::ZERO { gram.det / largest } else { T::ZERO };
    let missing = trusted * trusted - smallest;
    let damping = if missing > T::ZERO { missing } else { T::ZERO };
    let det = (largest + damping) * (smallest + damping);

    let [reach, height] = jacobian;
    let mut left = velocity;
    for ((&x, &z), &wish) in reach.iter().zip(height).zip(wish) {
        left = Vec2::new(left.x - x * wish, left.z - z * wish);
    }
    // (J·V·Jᵀ + λ²·I)⁻¹(v − J·b)
    let (xx, zz) = (gram.mean + gram.stretch + damping, gram.mean - gram.stretch + damping);
    let reciprocal = T::ONE / det;
    let effort = Vec2::new(zz * left.x - gram.shear * left.z, xx * left.z - gram.shear * left.x).scale(reciprocal);
    let mut joints = *wish;
    for (((joint, &x), &z), &mobility) in joints.iter_mut().zip(reach).zip(height).zip(mobility) {
        *joint = *joint + mobility * (x * effort.x + z * effort.z);
    }
    Rates { joints, damping }
}

/// What is wrong with the parameters of a [`Redundancy`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RedundancyError {
    /// A mobility is negative or not finite.
    Mobility {
        /// The joint, counted from 0.
        joint: usize,
    },
    /// The trusted singular value is not above zero, or its square is no finite positive number.
    Trusted,
    /// The retreat from the limits is negative or not finite.
    Retreat,
}

impl fmt::Display for RedundancyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mobility { joint } => write!(f, "`mobility` of joint {joint} must be finite and not negative"),
            Self::Trusted => f.write_str("`trusted_m` must be a finite length above 0, its square too"),
            Self::Retreat => f.write_str("`retreat_rad_s` must be finite and not negative"),
        }
    }
}

impl core::error::Error for RedundancyError {}

/// Parameters of a [`Redundancy`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RedundancyParameters<T, const N: usize> {
    /// Each joint's limits; `None` for one that turns freely.
    pub ranges: [Option<JointRange<T>>; N],
    /// Each joint's willingness to move, 1/weight: 1 is plain, 0 locks it to the wish.
    pub mobility: [T; N],
    /// The smallest singular value of J·√V that is inverted as it stands, m; a twentieth of the reach does well.
    pub trusted_m: T,
    /// How fast a joint wishes to leave its limits, rad/s: the wish is −retreat·dH/dθ, of H in [`crate::joint_range::Place`].
    pub retreat_rad_s: T,
}

/// A chain's redundancy resolved: tip velocity first, the joints' limits always, the second wish with what is left.
///
/// To the caller's wish it adds the descent of the limit function, b − retreat·dH/dθ (Liégeois's gradient in rotors), and
/// it lets each mobility fade to zero towards the joint's limits. At a limit the tip's task moves the joint no more, and the retreat
/// leads back: in continuous time no joint passes its limit unless the caller's wish drives it there. With steps
/// of `dt` that holds, to first order, while `4·dt·mobility·|dH/dθ|·|Jₖ|·|v − J·b| < trusted²`, |Jₖ| the joint's distance from the tip.
///
/// ```
/// use kinematics_core::chain_n::PlanarChain;
/// use kinematics_core::joint_range::JointRange;
/// use kinematics_core::redundancy::{Redundancy, RedundancyParameters};
/// use kinematics_core::{Rotor, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let degrees = Rotor::<f64>::from_degrees;
/// let redundancy = Redundancy::new(PlanarChain::new([2.05, 1.05, 0.567]), RedundancyParameters {
///     ranges: [
///         JointRange::between(degrees(-27.0), degrees(62.0)),
///         JointRange::between(degrees(-148.0), degrees(-29.0)),
///         JointRange::between(degrees(-164.0), degrees(45.0)),
///     ],
///     mobility: [1.0; 3],
///     trusted_m: 0.2,
///     retreat_rad_s: 0.1,
/// })?;
/// let joints = [degrees(30.0), degrees(-90.0), degrees(-50.0)];
/// let rates = redundancy.rates(&joints, Vec2::new(0.3, 0.0), &[0.0; 3]);
/// let [reach, height] = redundancy.chain().jacobian(&joints);
/// let along = |row: [f64; 3]| row.iter().zip(rates.joints).map(|(j, rate)| j * rate).sum::<f64>();
/// assert!((along(reach) - 0.3).abs() < 1e-14 && along(height).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Redundancy<T, const N: usize> {
    chain: PlanarChain<T, N>,
    parameters: RedundancyParameters<T, N>,
}

impl<T: Real, const N: usize> Redundancy<T, N> {
    /// Checks the parameters once.
    ///
    /// # Errors
    /// The first parameter out of its range.
    pub fn new(chain: PlanarChain<T, N>, parameters: RedundancyParameters<T, N>) -> Result<Self, RedundancyError> {
        let usable = |x: T| x >= T::ZERO && x * T::ZERO == T::ZERO;
        if let Some(joint) = parameters.mobility.iter().position(|&m| !usable(m)) {
            return Err(RedundancyError::Mobility { joint });
        }
        let square = parameters.trusted_m * parameters.trusted_m;
        // The determinant inverted is never below its square.
        if !(parameters.trusted_m > T::ZERO && usable(square) && square * square > T::ZERO) {
            return Err(RedundancyError::Trusted);
        }
        if !usable(parameters.retreat_rad_s) {
            return Err(RedundancyError::Retreat);
        }
        Ok(Self { chain, parameters })
    }

    /// The chain.
    pub fn chain(&self) -> &PlanarChain<T, N> {
        &self.chain
    }

    /// Joint rates for the tip velocity (m/s) and the wished joint rates (rad/s, zeros for none).
    #[inline]
    pub fn rates(&self, joints: &[Rotor<T>; N], velocity: Vec2<T>, wish: &[T; N]) -> Rates<T, N> {
        let (_, jacobian) = self.chain.tip_and_jacobian(joints);
        let RedundancyParameters { ranges, mut mobility, trusted_m, retreat_rad_s } = self.parameters;
        let mut wish = *wish;
        for (((range, &joint), mobility), wish) in ranges.iter().zip(joints).zip(&mut mobility).zip(&mut wish) {
            if let Some(range) = range {
                let place = range.place(joint);
                *mobility = *mobility * place.freedom();
                *wish = *wish - retreat_rad_s * place.slope;
            }
        }
        damped_rates(&jacobian, velocity, &wish, &mobility, trusted_m)
    }
}
