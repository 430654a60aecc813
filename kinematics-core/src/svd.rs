//! Singular values and directions of a 2 × N Jacobian in closed form, from JJᵀ: two square roots, no iteration.
//!
//! Two things keep the accuracy that JJᵀ usually costs. The small singular value comes from the 2 × 2 minors,
//! det JJᵀ = Σ (minor)² (Cauchy–Binet), not from a difference of products; and the roots' difference from
//! `√(stretch² + shear²)`, not from `√(mean² − det)`. Measured against double-double arithmetic over random
//! Jacobians with condition numbers from 1 to 10⁶ (f32) and 10¹³ (f64): both singular values are off by less than
//! 2 ε of the largest (ε = 1.2e-7, 2.2e-16), and a condition number within 1e-3 of one is off by less than 4 ε,
//! where `√(mean² − det)` is off by √ε. Below that a condition number cannot be told from one.

use crate::{Real, Rotor};

/// JJᵀ of a 2 × N Jacobian (rows reach, height) as the parts that matter: mean·I + [stretch shear; shear −stretch].
///
/// ```
/// use kinematics_core::svd::Gram;
/// let jacobian = [[2.0f64, 1.0, 0.0], [0.0, 1.0, 2.0]];
/// let gram = Gram::of(&jacobian);
/// assert_eq!(gram, Gram { mean: 5.0, stretch: 0.0, shear: 1.0, det: 24.0 });
/// // The eigenvalues are mean ± half_gap, σ₁² = 6 and σ₂² = 4.
/// assert_eq!(gram.half_gap(), 1.0);
/// assert!((gram.singular().smallest - 2.0).abs() < 1e-15);
/// // Without the middle joint.
/// assert_eq!(Gram::weighted(&jacobian, &[1.0, 0.0, 1.0]), Gram { mean: 4.0, stretch: 0.0, shear: 0.0, det: 16.0 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gram<T> {
    /// (|J₁|² + |J₂|²)/2, half the trace.
    pub mean: T,
    /// (|J₁|² − |J₂|²)/2, zero by Hareesha 2015 (19).
    pub stretch: T,
    /// J₁·J₂, zero by Hareesha 2015 (17).
    pub shear: T,
    /// det JJᵀ, as the sum of the squared minors.
    pub det: T,
}

impl<T: Real> Gram<T> {
    /// JJᵀ of `jacobian`.
    #[inline(always)]
    pub fn of<const N: usize>(jacobian: &[[T; N]; 2]) -> Self {
        let [reach, height] = jacobian;
        let (mut sum, mut difference, mut shear, mut det) = (T::ZERO, T::ZERO, T::ZERO, T::ZERO);
        let mut columns = reach.iter().zip(height);
        while let Some((&x, &z)) = columns.next() {
            sum = sum + (x * x + z * z);
            difference = difference + (x - z) * (x + z);
            shear = shear + x * z;
            for (&other_x, &other_z) in columns.clone() {
                let minor = x * other_z - z * other_x;
                det = det + minor * minor;
            }
        }
        let half = T::from_f64(0.5);
        Self { mean: half * sum, stretch: half * difference, shear, det }
    }

    /// J·V·Jᵀ with the diagonal V of `weights`, none negative: that of the Jacobian whose columns are √V times as long.
    #[inline(always)]
    pub fn weighted<const N: usize>(jacobian: &[[T; N]; 2], weights: &[T; N]) -> Self {
        let [reach, height] = jacobian;
        let (mut sum, mut difference, mut shear, mut det) = (T::ZERO, T::ZERO, T::ZERO, T::ZERO);
        let mut columns = reach.iter().zip(height).zip(weights);
        while let Some(((&x, &z), &weight)) = columns.next() {
            let (weighted_x, weighted_z) = (weight * x, weight * z);
            sum = sum + (weighted_x * x + weighted_z * z);
            difference = difference + (weighted_x - weighted_z) * (x + z);
            shear = shear + weighted_x * z;
            for ((&other_x, &other_z), &other_weight) in columns.clone() {
                let minor = x * other_z - z * other_x;
                det = det + (weight * other_weight) * (minor * minor);
            }
        }
        let half = T::from_f64(0.5);
        Self { mean: half * sum, stretch: half * difference, shear, det }
    }

    /// Half the difference of both eigenvalues, σ₁² − σ₂² over two.
    #[inline(always)]
    pub fn half_gap(&self) -> T {
        (self.stretch * self.stretch + self.shear * self.shear).sqrt()
    }

    /// Singular values of J and the plane's directions that belong to them.
    #[inline]
    pub fn singular(&self) -> SingularValues<T> {
        let gap = self.half_gap();
        let largest = (self.mean + gap).sqrt();
        let smallest = if largest > T::ZERO { self.det.sqrt() / largest } else { T::ZERO };
        // Rounding may make them cross at isotropy.
        let smallest = if smallest > largest { largest } else { smallest };
        // Both rows of (JJᵀ − σ₂²I) point along the major axis; the longer one is exact.
        let (x, z) =
            if self.stretch >= T::ZERO { (gap + self.stretch, self.shear) } else { (self.shear, gap - self.stretch) };
        let norm = (x * x + z * z).sqrt();
        let direction = if norm > T::ZERO { Rotor { cos: x / norm, sin: z / norm } } else { Rotor::IDENTITY };
        SingularValues { largest, smallest, direction }
    }
}

/// The singular values of a 2 × N Jacobian with its left singular vectors.
///
/// ```
/// use kinematics_core::svd::SingularValues;
/// // Joint rates move the tip three times as far along (3, 4)/5 as across it.
/// let found = SingularValues::of(&[[1.8f64, -0.8], [2.4, 0.6]]);
/// assert!((found.largest - 3.0).abs() < 1e-15 && (found.smallest - 1.0).abs() < 1e-15);
/// assert!((found.direction.cos - 0.6).abs() < 1e-15 && (found.direction.sin - 0.8).abs() < 1e-15);
/// assert!((found.across().cos + 0.8).abs() < 1e-15 && (found.across().sin - 0.6).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularValues<T> {
    /// σ₁, m.
    pub largest: T,
    /// σ₂, m: the distance (in the 2-norm and in Frobenius's) to the nearest singular Jacobian (Eckart and Young).
    pub smallest: T,
    /// Direction u₁ of σ₁ in the plane, up to half a turn; u₂ is a quarter turn ahead. Where σ₁ = σ₂ any
    /// direction is right.
    pub direction: Rotor<T>,
}

impl<T: Real> SingularValues<T> {
    /// Singular values and directions of `jacobian`.
    #[inline]
    pub fn of<const N: usize>(jacobian: &[[T; N]; 2]) -> Self {
        Gram::of(jacobian).singular()
    }

    /// u₂, a quarter turn ahead of [`SingularValues::direction`].
    #[inline(always)]
    pub fn across(&self) -> Rotor<T> {
        Rotor { cos: -self.direction.sin, sin: self.direction.cos }
    }

    /// The right singular vectors v₁, v₂: unit joint rates that move the tip along u₁ and u₂, v = Jᵀu/σ. `None` at a
    /// singular Jacobian, where v₂ is any rate that does not move the tip.
    ///
    /// ```
    /// use kinematics_core::svd::SingularValues;
    /// let jacobian = [[1.8f64, -0.8], [2.4, 0.6]];
    /// let [first, second] = SingularValues::of(&jacobian).joint_directions(&jacobian).unwrap();
    /// assert!((first[0] - 1.0).abs() < 1e-15 && (second[1] - 1.0).abs() < 1e-15);
    /// ```
    #[inline]
    pub fn joint_directions<const N: usize>(&self, jacobian: &[[T; N]; 2]) -> Option<[[T; N]; 2]> {
        if self.smallest > T::ZERO {
            let first = transposed(jacobian, self.direction, self.largest);
            Some([first, transposed(jacobian, self.across(), self.smallest)])
        } else {
            None
        }
    }
}

/// The pseudo-inverse of a Jacobian that may have any rank, rows joints: JᵀΣuuᵀ/max(σ², trusted²). Where both singular values are
/// at least `trusted` (m, above 0) it is the exact one; a smaller σ is inverted as σ/trusted², which is continuous and 0 at 0. Rounding is worth ε·(σ₁/trusted)².
///
/// ```
/// use kinematics_core::svd::trusted_inverse;
/// // Of rank one: only motion along the first axis can be asked for.
/// assert_eq!(trusted_inverse(&[[3.0f64, 4.0], [0.0, 0.0]], 0.1), [[0.12, 0.0], [0.16, 0.0]]);
/// assert_eq!(trusted_inverse(&[[0.0f64, 0.0], [0.0, 0.0]], 0.1), [[0.0, 0.0], [0.0, 0.0]]);
/// ```
#[inline]
pub fn trusted_inverse<T: Real, const N: usize>(jacobian: &[[T; N]; 2], trusted: T) -> [[T; 2]; N] {
    let singular = SingularValues::of(jacobian);
    let gain = |sigma: T| {
        let used = if sigma > trusted { sigma } else { trusted };
        T::ONE / (used * used)
    };
    let (along, across) = (gain(singular.largest), gain(singular.smallest));
    let Rotor { cos, sin } = singular.direction;
    let shear = cos * sin * (along - across);
    let (xx, zz) = (cos * cos * along + sin * sin * across, sin * sin * along + cos * cos * across);
    let [reach, height] = jacobian;
    let mut out = [[T::ZERO; 2]; N];
    for ((out, &x), &z) in out.iter_mut().zip(reach).zip(height) {
        *out = [x * xx + z * shear, x * shear + z * zz];
    }
    out
}

/// Jᵀu/σ
#[inline]
fn transposed<T: Real, const N: usize>(jacobian: &[[T; N]; 2], u: Rotor<T>, sigma: T) -> [T; N] {
    let [reach, height] = jacobian;
    let mut out = [T::ZERO; N];
    for ((out, &x), &z) in out.iter_mut().zip(reach).zip(height) {
        *out = (x * u.cos + z * u.sin) / sigma;
    }
    out
}
