//! How well joint rates and torques turn into tip velocity and force: manipulability, condition number, ellipses, isotropy.
//!
//! Hareesha 2015 section IV, Yoshikawa 1985. J is the 2 × N Jacobian `[[T; N]; 2]` with the rows reach and height, its
//! columns one a joint. [`crate::svd`] says how accurate its singular values are.

use crate::svd::{Gram, SingularValues};
use crate::{Real, Rotor};

/// Yoshikawa's manipulability √det(JJᵀ) = σ₁σ₂, m²: the area of the velocity ellipse over π. Zero where J is singular.
///
/// ```
/// # use kinematics_core::isotropy::manipulability;
/// assert_eq!(manipulability(&[[3.0f64, 0.0, 0.0], [0.0, 2.0, 0.0]]), 6.0);
/// ```
#[inline]
pub fn manipulability<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> T {
    Gram::of(jacobian).det.sqrt()
}

/// The condition number κ = σ₁/σ₂ ≥ 1; one where J is isotropic, `None` where it is singular.
///
/// ```
/// # use kinematics_core::isotropy::condition_number;
/// assert_eq!(condition_number(&[[3.0f64, 0.0, 0.0], [0.0, 2.0, 0.0]]), Some(1.5));
/// assert_eq!(condition_number(&[[3.0f64, 1.5], [2.0, 1.0]]), None);
/// ```
#[inline]
pub fn condition_number<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> Option<T> {
    let SingularValues { largest, smallest, .. } = SingularValues::of(jacobian);
    if smallest > T::ZERO { Some(largest / smallest) } else { None }
}

/// The distance from singularity as one cheap number for the loop: 2σ₁σ₂/(σ₁² + σ₂²) = 2√det(JJᵀ)/trace(JJᵀ), which is 0 where J is
/// singular and 1 where it is isotropic. One root, one division: 38 instructions for N = 3 on the emulated Cortex-M4F (`cargo hil bench`).
///
/// It is 2/(κ + 1/κ): it orders poses as 1/κ does, 1/κ ≤ distance < 2/κ, and has neither unit nor scale. The distance to the
/// nearest singular Jacobian in metres is [`SingularValues::smallest`], for two roots more.
///
/// ```
/// # use kinematics_core::isotropy::singularity_distance;
/// assert_eq!(singularity_distance(&[[2.0f64, 0.0, 0.0], [0.0, 2.0, 0.0]]), 1.0);
/// assert_eq!(singularity_distance(&[[4.0f64, 2.0, 1.0], [4.0, 2.0, 1.0]]), 0.0);
/// ```
#[inline]
pub fn singularity_distance<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> T {
    let Gram { mean, det, .. } = Gram::of(jacobian);
    if mean > T::ZERO { det.sqrt() / mean } else { T::ZERO }
}

/// An ellipse in the plane about the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse<T> {
    /// Half the long axis.
    pub major: T,
    /// Half the short axis.
    pub minor: T,
    /// Direction of the long axis, up to half a turn.
    pub direction: Rotor<T>,
}

/// The tip velocities that joint rates with Σθ̇² ≤ 1 (rad/s)² reach: semi-axes σ₁, σ₂ in m/s.
///
/// ```
/// # use kinematics_core::isotropy::velocity_ellipse;
/// let ellipse = velocity_ellipse(&[[0.0f64, 2.0, 0.0], [3.0, 0.0, 0.0]]);
/// assert_eq!((ellipse.major, ellipse.minor, ellipse.direction.sin), (3.0, 2.0, 1.0));
/// ```
#[inline]
pub fn velocity_ellipse<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> Ellipse<T> {
    let SingularValues { largest, smallest, direction } = SingularValues::of(jacobian);
    Ellipse { major: largest, minor: smallest, direction }
}

/// The tip forces that joint torques with Σ(JᵀF)² ≤ 1 (N·m)² balance, by τ = JᵀF (Hareesha 2015 (21)): semi-axes 1/σ₂, 1/σ₁ in
/// newtons, the strong direction across the fast one. `None` where J is singular: there a force needs no torque.
///
/// ```
/// # use kinematics_core::isotropy::force_ellipse;
/// let ellipse = force_ellipse(&[[0.0f64, 2.0, 0.0], [4.0, 0.0, 0.0]]).unwrap();
/// assert_eq!((ellipse.major, ellipse.minor, ellipse.direction.cos.abs()), (0.5, 0.25, 1.0));
/// assert_eq!(force_ellipse(&[[0.0f64, 0.0], [4.0, 1.0]]), None);
/// ```
#[inline]
pub fn force_ellipse<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> Option<Ellipse<T>> {
    let singular = SingularValues::of(jacobian);
    if singular.smallest > T::ZERO {
        let (major, minor) = (T::ONE / singular.smallest, T::ONE / singular.largest);
        Some(Ellipse { major, minor, direction: singular.across() })
    } else {
        None
    }
}

/// Hareesha 2015 (17): J₁·J₂, zero where the rows are orthogonal, m².
#[inline]
pub fn row_orthogonality<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> T {
    Gram::of(jacobian).shear
}

/// Hareesha 2015 (19), its J33 read as J23: |J₁|² − |J₂|², zero where the rows are equally long, m².
///
/// J is isotropic where this and [`row_orthogonality`] vanish; then JJᵀ = σ²·I, which is all that holds of (16).
///
/// ```
/// # use kinematics_core::isotropy::{row_equality, row_orthogonality};
/// let jacobian = [[2.0f64, 1.0, 0.0], [0.0, 1.0, 2.0]];
/// assert_eq!((row_orthogonality(&jacobian), row_equality(&jacobian)), (1.0, 0.0));
/// ```
#[inline]
pub fn row_equality<T: Real, const N: usize>(jacobian: &[[T; N]; 2]) -> T {
    let stretch = Gram::of(jacobian).stretch;
    stretch + stretch
}

/// Hareesha 2015 (18), the rows' product J₁·J₂ of the chain l2, l3, l4 at θ2 = 0, m².
///
/// The paper's 3 and 4 are not its θ3 and θ4 but directions from the boom line: `arm` is the rotor of θ3 and `bucket` that of
/// θ3 + θ4. (Its text says "absolute joint angles"; with the relative θ4 the equation is wrong.) θ2 drops out of the
/// isotropic configurations, not of this value.
///
/// ```
/// use kinematics_core::Rotor;
/// use kinematics_core::isotropy::{hareesha_18, hareesha_20};
/// // One of the eight of l2 = l3 = √2, l4 = 1.
/// let arm = Rotor::<f64>::from_degrees(-94.19914442975715);
/// let bucket = arm * Rotor::from_degrees(-117.20057038016188);
/// let lengths = [2f64.sqrt(), 2f64.sqrt(), 1.0];
/// assert!(hareesha_18(lengths, arm, bucket).abs() < 1e-14);
/// assert!(hareesha_20(lengths, arm, bucket).abs() < 1e-14);
/// ```
#[inline]
pub fn hareesha_18<T: Real>([l2, l3, l4]: [T; 3], arm: Rotor<T>, bucket: Rotor<T>) -> T {
    let (Rotor { cos: c3, sin: s3 }, Rotor { cos: c4, sin: s4 }) = (arm, bucket);
    let (two, three) = (T::from_i32(2), T::from_i32(3));
    -(l2 * l3 * s3)
        - l2 * l4 * s4
        - two * l3 * l3 * c3 * s3
        - three * l4 * l4 * c4 * s4
        - two * l3 * l4 * c3 * s4
        - two * l3 * l4 * c4 * s3
}

/// Hareesha 2015 (20), |J₁|² − |J₂|² of the chain l2, l3, l4 at θ2 = 0, m²; the rotors are those of [`hareesha_18`], where the
/// example is.
#[inline]
pub fn hareesha_20<T: Real>([l2, l3, l4]: [T; 3], arm: Rotor<T>, bucket: Rotor<T>) -> T {
    let (Rotor { cos: c3, sin: s3 }, Rotor { cos: c4, sin: s4 }) = (arm, bucket);
    let (two, three, four) = (T::from_i32(2), T::from_i32(3), T::from_i32(4));
    two * l3 * l3 * s3 * s3 - three * l4 * l4 * c4 * c4 - two * l3 * l3 * c3 * c3 + three * l4 * l4 * s4 * s4
        - l2 * l2
        - two * l2 * l3 * c3
        - two * l2 * l4 * c4
        - four * l3 * l4 * c3 * c4
        + four * l3 * l4 * s3 * s4
}
