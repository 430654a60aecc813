//! Eigenvalues of symmetric 3 × 3 matrices and singular values of 3 × 3 Jacobians, by `+ − × ÷ √` only.
//!
//! The textbook's closed form of the cubic needs an arc cosine. Jacobi's rotations need one square root for the tangent
//! and one for the cosine; [`SWEEPS`] sweeps of three rotations are always made, so the time is fixed. Convergence is quadratic:
//! over random matrices, double eigenvalues included, four sweeps leave nothing but rounding in f64 and three do not.
//! For study and reports; the loop uses the closed form of [`crate::svd`].

use crate::Real;

/// Sweeps of three rotations each.
pub const SWEEPS: usize = 5;

type Vector<T> = [T; 3];

#[inline]
fn dot<T: Real>(a: &Vector<T>, b: &Vector<T>) -> T {
    let ([ax, ay, az], [bx, by, bz]) = (*a, *b);
    ax * bx + ay * by + az * bz
}

/// Cosine, sine and tangent of the rotation that makes the entry `across` between the diagonal entries p and q vanish; at
/// most an eighth of a turn.
#[inline]
fn rotation<T: Real>(p: T, q: T, across: T) -> (T, T, T) {
    let difference = q - p;
    let twice = across + across;
    let root = (difference * difference + twice * twice).sqrt();
    let denominator = if difference < T::ZERO { difference - root } else { difference + root };
    let tangent = if denominator == T::ZERO { T::ZERO } else { twice / denominator };
    let cosine = T::ONE / (T::ONE + tangent * tangent).sqrt();
    (cosine, cosine * tangent, tangent)
}

/// Turns the columns `p` and `q`: p·c − q·s, p·s + q·c.
#[inline]
fn turn<T: Real>(p: &mut Vector<T>, q: &mut Vector<T>, (cosine, sine, _): (T, T, T)) {
    for (p, q) in p.iter_mut().zip(q) {
        (*p, *q) = (*p * cosine - *q * sine, *p * sine + *q * cosine);
    }
}

/// Sorts three values with what belongs to them, largest first.
fn sorted<T: Real, X: Copy>([a, b, c]: [(T, X); 3]) -> [(T, X); 3] {
    let (a, b) = if b.0 > a.0 { (b, a) } else { (a, b) };
    let (b, c) = if c.0 > b.0 { (c, b) } else { (b, c) };
    let (a, b) = if b.0 > a.0 { (b, a) } else { (a, b) };
    [a, b, c]
}

/// Eigenvalues of a symmetric matrix, largest first, each with its unit axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigen3<T> {
    /// Largest first.
    pub values: [T; 3],
    /// `axes[k]` belongs to `values[k]`; orthonormal, signs arbitrary.
    pub axes: [[T; 3]; 3],
}

/// One rotation in the plane of two axes: their diagonal entries, the entry between them, and those towards the third axis.
#[inline]
fn eliminate<T: Real>(
    (p, q): (&mut T, &mut T),
    across: &mut T,
    (to_p, to_q): (&mut T, &mut T),
    (axis_p, axis_q): (&mut Vector<T>, &mut Vector<T>),
) {
    let by = rotation(*p, *q, *across);
    let (cosine, sine, tangent) = by;
    let moved = tangent * *across;
    (*p, *q, *across) = (*p - moved, *q + moved, T::ZERO);
    (*to_p, *to_q) = (cosine * *to_p - sine * *to_q, sine * *to_p + cosine * *to_q);
    turn(axis_p, axis_q, by);
}

/// Eigenvalues and axes of a symmetric 3 × 3 matrix; what stands below the diagonal is not read.
///
/// ```
/// use kinematics_core::svd3::symmetric_eigen;
/// let found = symmetric_eigen(&[[2.0f64, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 5.0]]);
/// for (value, expected) in found.values.iter().zip([5.0, 3.0, 1.0]) {
///     assert!((value - expected).abs() < 1e-14);
/// }
/// ```
pub fn symmetric_eigen<T: Real>(matrix: &[[T; 3]; 3]) -> Eigen3<T> {
    let [[mut a, mut ab, mut ac], [_, mut b, mut bc], [_, _, mut c]] = *matrix;
    let (zero, one) = (T::ZERO, T::ONE);
    let [mut x, mut y, mut z] = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
    for _ in 0..SWEEPS {
        eliminate((&mut a, &mut b), &mut ab, (&mut ac, &mut bc), (&mut x, &mut y));
        eliminate((&mut a, &mut c), &mut ac, (&mut ab, &mut bc), (&mut x, &mut z));
        eliminate((&mut b, &mut c), &mut bc, (&mut ab, &mut ac), (&mut y, &mut z));
    }
    let [(a, x), (b, y), (c, z)] = sorted([(a, x), (b, y), (c, z)]);
    Eigen3 { values: [a, b, c], axes: [x, y, z] }
}

/// Singular values of a 3 × 3 matrix J, largest first, with the joint and tip directions that belong to them: J·vₖ = σₖ·uₖ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Svd3<T> {
    /// σ₁ ≥ σ₂ ≥ σ₃ ≥ 0.
    pub values: [T; 3],
    /// u₁, u₂, u₃ in the row space's units; the zero vector where σ = 0.
    pub left: [[T; 3]; 3],
    /// v₁, v₂, v₃, orthonormal joint directions.
    pub right: [[T; 3]; 3],
}

impl<T: Real> Svd3<T> {
    /// κ = σ₁/σ₃, `None` where the Jacobian is singular. The velocity ellipsoid's semi-axes are [`Svd3::values`] along
    /// [`Svd3::left`].
    ///
    /// ```
    /// use kinematics_core::svd3::svd3;
    /// let found = svd3(&[[0.0f64, 2.0, 0.0], [-4.0, 0.0, 0.0], [0.0, 0.0, 0.5]]);
    /// assert_eq!(found.condition_number(), Some(8.0));
    /// assert_eq!(found.force_axes(), Some([0.25, 0.5, 2.0]));
    /// ```
    #[inline]
    pub fn condition_number(&self) -> Option<T> {
        let [largest, _, smallest] = self.values;
        if smallest > T::ZERO { Some(largest / smallest) } else { None }
    }

    /// The force ellipsoid's semi-axes 1/σ₁, 1/σ₂, 1/σ₃ along [`Svd3::left`], by τ = JᵀF (Hareesha 2015 (21)); `None`
    /// where the Jacobian is singular.
    #[inline]
    pub fn force_axes(&self) -> Option<[T; 3]> {
        let [_, _, smallest] = self.values;
        if smallest > T::ZERO { Some(self.values.map(|sigma| T::ONE / sigma)) } else { None }
    }
}

/// The singular value decomposition of a 3 × 3 Jacobian by one-sided Jacobi rotations: small singular values keep
/// ε·σ₁, where the eigenvalues of JJᵀ keep √ε·σ₁ only.
///
/// A Jacobian with a pitch row (Hareesha 2015 (10) with φ below it) mixes metres and radians: scale that row by a length of
/// your choice first, or its singular values mean nothing.
///
/// ```
/// use kinematics_core::svd3::svd3;
/// let found = svd3(&[[0.0f64, 2.0, 0.0], [-3.0, 0.0, 0.0], [0.0, 0.0, 0.5]]);
/// for (value, expected) in found.values.iter().zip([3.0, 2.0, 0.5]) {
///     assert!((value - expected).abs() < 1e-15);
/// }
/// ```
pub fn svd3<T: Real>(jacobian: &[[T; 3]; 3]) -> Svd3<T> {
    let [[a1, b1, c1], [a2, b2, c2], [a3, b3, c3]] = *jacobian;
    let [mut a, mut b, mut c] = [[a1, a2, a3], [b1, b2, b3], [c1, c2, c3]];
    let (zero, one) = (T::ZERO, T::ONE);
    let [mut x, mut y, mut z] = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
    let orthogonalise = |p: &mut Vector<T>, q: &mut Vector<T>, v: &mut Vector<T>, w: &mut Vector<T>| {
        let by = rotation(dot(p, p), dot(q, q), dot(p, q));
        turn(p, q, by);
        turn(v, w, by);
    };
    for _ in 0..SWEEPS {
        orthogonalise(&mut a, &mut b, &mut x, &mut y);
        orthogonalise(&mut a, &mut c, &mut x, &mut z);
        orthogonalise(&mut b, &mut c, &mut y, &mut z);
    }
    let measured = [(a, x), (b, y), (c, z)].map(|(column, v)| {
        let sigma = dot(&column, &column).sqrt();
        let unit = if sigma > T::ZERO { column.map(|e| e / sigma) } else { [T::ZERO; 3] };
        (sigma, (unit, v))
    });
    let [(s1, (u1, v1)), (s2, (u2, v2)), (s3, (u3, v3))] = sorted(measured);
    Svd3 { values: [s1, s2, s3], left: [u1, u2, u3], right: [v1, v2, v3] }
}
