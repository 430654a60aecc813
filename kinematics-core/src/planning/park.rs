//! The equations of Park et al. 2008, "Optimal Path Planning for Backhoe Based on Excavation Environment", each in one place,
//! corrected where `docs/errata.md` says so.
//!
//! (1) and (2) are [`crate::chain_n::PlanarChain::tip`] and `jacobian`, (3) the functions of [`crate::redundancy`]. Velocities
//! are displacements of one iteration, m; rates are changes of the joints' angles in one iteration, rad. Links and joints are
//! counted from 0: link `k` here is Park's k + 1.

use crate::svd::trusted_inverse;
use crate::{Real, Rotor, Vec2};

/// What a task's Jacobian does to joint rates: J·θ̇, Park (2) and (8).
///
/// ```
/// use kinematics_core::{Vec2, planning::park::moved};
/// assert_eq!(moved(&[[1.0f64, 2.0], [3.0, 4.0]], &[1.0, 0.5]), Vec2::new(2.0, 5.0));
/// ```
#[inline]
pub fn moved<T: Real, const N: usize>(jacobian: &[[T; N]; 2], rates: &[T; N]) -> Vec2<T> {
    let [reach, height] = jacobian;
    let mut out = Vec2::new(T::ZERO, T::ZERO);
    for ((&x, &z), &rate) in reach.iter().zip(height).zip(rates) {
        out = Vec2::new(out.x + x * rate, out.z + z * rate);
    }
    out
}

/// J_k of Park (6), 2 × N, m: how the joints move a `point` of link `link`; with the link's end for the point P_k, with the critical point
/// J_o. `ends` are the links' ends. The column of a joint beyond the link is zero: (7) makes it something else, against (8).
///
/// ```
/// use kinematics_core::{Vec2, planning::park::link_jacobian};
/// let ends = [Vec2::new(2.0f64, 0.0), Vec2::new(2.0, 1.0), Vec2::new(3.0, 1.0)];
/// assert_eq!(link_jacobian(&ends, 1, ends[1]), [[-1.0, -1.0, 0.0], [2.0, 0.0, 0.0]]);
/// ```
#[inline]
pub fn link_jacobian<T: Real, const N: usize>(ends: &[Vec2<T>; N], link: usize, point: Vec2<T>) -> [[T; N]; 2] {
    let (mut reach, mut height) = ([T::ZERO; N], [T::ZERO; N]);
    let mut joint = Vec2::new(T::ZERO, T::ZERO);
    for ((x, z), &end) in reach.iter_mut().zip(&mut height).zip(ends).take(link.saturating_add(1)) {
        let arm = point - joint;
        (*x, *z) = (-arm.z, arm.x);
        joint = end;
    }
    [reach, height]
}

/// H_o of Park (10) and H_k of (11), the second term of (5): `(I − J_e⁺J_e)·[J(I − J_e⁺J_e)]⁺·(ẋ − J·J_e⁺ẋ_e)` with the J_o⁺J_e of
/// the print read as J_o·J_e⁺.
///
/// `projector` is I − J_e⁺J_e, `own` is J_e⁺ẋ_e. The product inverted has rank two at most, one for the first link, none where the point is
/// the tip: [`trusted_inverse`] inverts singular values from `trusted` (m, above 0) on and fades out below.
///
/// ```
/// use kinematics_core::planning::park::{moved, null_term};
/// use kinematics_core::redundancy::null_projector;
/// use kinematics_core::Vec2;
/// // The tip of three links at rest; the first link's end moves up, which is all it can do.
/// let tip = [[-1.0f64, -1.0, -0.5], [3.0, 1.0, 0.0]];
/// let first = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
/// let rates = null_term(&first, Vec2::new(0.3, 0.1), &null_projector(&tip).unwrap(), &[0.0; 3], 0.01);
/// assert!((moved(&first, &rates).z - 0.1).abs() < 1e-12);
/// assert!(moved(&tip, &rates).norm() < 1e-12);
/// ```
#[inline]
pub fn null_term<T: Real, const N: usize>(
    jacobian: &[[T; N]; 2],
    velocity: Vec2<T>,
    projector: &[[T; N]; N],
    own: &[T; N],
    trusted: T,
) -> [T; N] {
    // The projector is symmetric: a row of J times it is it times the row.
    let [reach, height] = jacobian;
    let projected = [through(projector, reach), through(projector, height)];
    let left = velocity - moved(jacobian, own);
    let mut wish = [T::ZERO; N];
    for (wish, [x, z]) in wish.iter_mut().zip(trusted_inverse(&projected, trusted)) {
        *wish = x * left.x + z * left.z;
    }
    through(projector, &wish)
}

fn through<T: Real, const N: usize>(matrix: &[[T; N]; N], vector: &[T; N]) -> [T; N] {
    matrix.map(|row| row.iter().zip(vector).fold(T::ZERO, |sum, (&a, &b)| sum + a * b))
}

/// Park's directional operator D, (15).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// D = +1: the link turns on, the way the tip's motion turns it.
    Add,
    /// D = −1: the link turns back, against it.
    Hold,
}

impl Direction {
    fn sign<T: Real>(self) -> T {
        if self == Self::Add { T::ONE } else { -T::ONE }
    }
}

/// Δθ'_ke of Park (14), rad in [0, π]: the angle by which `step` (m, ẋ_e) turns the line of sight `seen` (m, P_e^k, from the end of link k to the
/// tip). By libm: not for the loop.
///
/// ```
/// use kinematics_core::{Vec2, planning::park::swept_angle};
/// let quarter = swept_angle(Vec2::new(1.0f64, 0.0), Vec2::new(-1.0, -1.0));
/// assert!((quarter - core::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// assert_eq!(swept_angle(Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0)), 0.0);
/// ```
pub fn swept_angle<T: Real>(seen: Vec2<T>, step: Vec2<T>) -> T {
    let to = seen + step;
    let turned = Vec2::new(seen.dot(to), seen.cross(to)).direction().unwrap_or(Rotor::IDENTITY);
    let angle = turned.angle();
    if angle < T::ZERO { -angle } else { angle }
}

/// M of Park (18): ‖P_e^k‖/‖P_k^{k−1}‖, the distance from the link's end to the tip over the link's length. With it ‖ẋ_k‖ = ‖ẋ_e‖ for a small step across the
/// line of sight, (16), (17). 0 for a link without length.
///
/// ```
/// use kinematics_core::{Vec2, planning::park::magnification};
/// assert_eq!(magnification(Vec2::new(0.0f64, 3.0), Vec2::new(2.0, 0.0)), 1.5);
/// ```
#[inline]
pub fn magnification<T: Real>(seen: Vec2<T>, link: Vec2<T>) -> T {
    let length = link.norm();
    if length > T::ZERO { seen.norm() / length } else { T::ZERO }
}

/// ẋ_k of Park (13) for every link, m: its end turns about its joint by M·Δθ'_ke in the sense of `own` (J_e⁺ẋ_e), or against it, on top of its joint's ẋ_{k−1}.
///
/// Corrected: the link's vector is turned by 90°, M multiplies, and the sense is that in which `own` turns the link in the plane (the sum of
/// its first k entries), none where it does not.
///
/// ```
/// use kinematics_core::{Vec2, planning::park::{Direction, link_velocities}};
/// // Two links forward, the tip moves up by a millimetre and so does the first link's end: (16).
/// let ends = [Vec2::new(1.0f64, 0.0), Vec2::new(2.0, 0.0)];
/// let step = Vec2::new(0.0, 1e-3);
/// let [first, _] = link_velocities(&ends, step, &[4e-4, 2e-4], &[Direction::Add; 2]);
/// assert!((first - step).norm() < 1e-9);
/// let [first, _] = link_velocities(&ends, step, &[4e-4, 2e-4], &[Direction::Hold; 2]);
/// assert!((first + step).norm() < 1e-9);
/// ```
pub fn link_velocities<T: Real, const N: usize>(
    ends: &[Vec2<T>; N],
    step: Vec2<T>,
    own: &[T; N],
    directions: &[Direction; N],
) -> [Vec2<T>; N] {
    let tip = ends.last().copied().unwrap_or(Vec2::new(T::ZERO, T::ZERO));
    let mut joint = Vec2::new(T::ZERO, T::ZERO);
    let (mut turn, mut velocity) = (T::ZERO, Vec2::new(T::ZERO, T::ZERO));
    let mut out = [velocity; N];
    for (((out, &end), &rate), &direction) in out.iter_mut().zip(ends).zip(own).zip(directions) {
        let (link, seen) = (end - joint, tip - end);
        turn = turn + rate;
        let sense = if turn > T::ZERO {
            T::ONE
        } else if turn < T::ZERO {
            -T::ONE
        } else {
            T::ZERO
        };
        let by = direction.sign::<T>() * sense * magnification(seen, link) * swept_angle(seen, step);
        velocity = velocity + Vec2::new(-link.z, link.x).scale(by);
        *out = velocity;
        joint = end;
    }
    out
}
