//! All isotropic configurations of a planar 3R chain, for any lengths: what Hareesha 2015 leaves "beyond the scope".
//!
//! Turned back by a quarter, J's columns are the complex numbers l2 + w, w and l4·f with w = l3·e + l4·f, where e and f are the unit
//! numbers at θ3 and θ3 + θ4 (θ2 = 0; it drops out). Hareesha (17) and (19) are the two parts of one equation,
//! (l2 + w)² + w² + (l4·f)² = 0, that is a·e² + b·e + c = 0 with
//! a = 2l3², b = 2l3(2l4·f + l2), c = 3l4²f² + 2l2l4·f + l2². A unit root e is a root of the reciprocal
//! polynomial too, so Schur and Cohn's resultant (a² − |c|²)² − |b·c̄ − a·b̄|² vanishes. It is real and even in f's angle: a
//! polynomial of degree four in x = cos(θ3 + θ4). Hence at most eight isolated configurations, in mirrored pairs; its real
//! roots, bracketed by those of its derivatives, give every one. For study and reports, not for the loop.

use crate::{Real, Rotor, Vec2};

/// One isotropic configuration of a chain, with any θ2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsotropicConfiguration {
    /// θ3.
    pub arm: Rotor<f64>,
    /// θ4, relative to the arm.
    pub bucket: Rotor<f64>,
    /// σ of JJᵀ = σ²·I, in the lengths' unit.
    pub sigma: f64,
}

/// A polynomial in x = cos(θ3 + θ4), constant term first.
type Polynomial = [f64; 5];

/// Two touching roots show as an extremum of this size, relative to the coefficients.
const TOUCHING: f64 = 1e-13;
/// How far from the unit circle a root e may lie before it is polished.
const NEAR_CIRCLE: f64 = 1e-5;
/// What the conditions may leave, relative to the longest length squared, and how near two solutions are one.
const RESIDUAL: f64 = 1e-12;
const SAME: f64 = 1e-7;

/// The isotropic configurations of the chain `lengths` l2, l3, l4 (positive, one unit), mirrored pairs side by side; at
/// most eight, and none if a length is not a positive finite number. Simple ones are exact to rounding; where two merge,
/// they count once.
///
/// ```
/// use kinematics_core::isotropic_configurations::isotropic_configurations;
/// // Hareesha 2015, section IV: eight.
/// let found = isotropic_configurations([2f64.sqrt(), 2f64.sqrt(), 1.0]);
/// assert_eq!(found.iter().flatten().count(), 8);
/// // An arm and bucket too short to bring the tip near the boom pin: none.
/// assert_eq!(isotropic_configurations([3.0, 1.0, 0.5]).iter().flatten().count(), 0);
/// ```
pub fn isotropic_configurations(lengths: [f64; 3]) -> [Option<IsotropicConfiguration>; 8] {
    let mut found = [None; 8];
    let longest = lengths.into_iter().fold(0.0, |longest, l| if l > longest { l } else { longest });
    if !(lengths.iter().all(|&l| l > 0.0) && longest.is_finite()) {
        return found;
    }
    let chain = Lengths(lengths.map(|l| l / longest));
    for x in roots(&chain.resultant()).into_iter().flatten() {
        let bucket = Rotor { cos: x, sin: Real::sqrt(1.0 - x * x) };
        for arm in chain.arms(bucket) {
            let Some((arm, bucket)) = chain.polished(arm, bucket) else { continue };
            let sigma = longest * chain.sigma(arm, bucket);
            let one = IsotropicConfiguration { arm, bucket: bucket * arm.inverse(), sigma };
            let mirrored = IsotropicConfiguration { arm: one.arm.inverse(), bucket: one.bucket.inverse(), sigma };
            for new in [one, mirrored] {
                note(&mut found, new);
            }
        }
    }
    found
}

/// Puts a configuration into the first free place, unless it is there already.
fn note(found: &mut [Option<IsotropicConfiguration>; 8], new: IsotropicConfiguration) {
    let apart = |l: Rotor<f64>, r: Rotor<f64>| (l.to_vec() - r.to_vec()).norm();
    let is_new = |old: &IsotropicConfiguration| apart(old.arm, new.arm) + apart(old.bucket, new.bucket) > SAME;
    if found.iter().flatten().all(is_new)
        && let Some(free) = found.iter_mut().find(|place| place.is_none())
    {
        *free = Some(new);
    }
}

fn complex_sqrt(v: Vec2<f64>) -> Vec2<f64> {
    let norm = v.norm();
    let larger = Real::sqrt(0.5 * (norm + if v.x < 0.0 { -v.x } else { v.x }));
    if larger == 0.0 {
        return Vec2::new(0.0, 0.0);
    }
    let smaller = 0.5 * v.z / larger;
    if v.x >= 0.0 { Vec2::new(larger, smaller) } else { Vec2::new(smaller, larger) }
}

/// l2, l3, l4, the longest one.
struct Lengths([f64; 3]);

impl Lengths {
    /// a, b, c of the quadratic in e.
    fn quadratic(&self, f: Rotor<f64>) -> (f64, Vec2<f64>, Vec2<f64>) {
        let [l2, l3, l4] = self.0;
        let (f, square) = (f.to_vec(), (f * f).to_vec());
        let one = Vec2::new(1.0, 0.0);
        let b = (f.scale(2.0 * l4) + one.scale(l2)).scale(2.0 * l3);
        let c = square.scale(3.0 * l4 * l4) + f.scale(2.0 * l2 * l4) + one.scale(l2 * l2);
        (2.0 * l3 * l3, b, c)
    }

    /// (a² − |c|²)² − |b|²(|c|² + a²) + 2a·Re(b²c̄) in powers of x.
    fn resultant(&self) -> Polynomial {
        let [l2, l3, l4] = self.0;
        let (l22, l42, l24) = (l2 * l2, l4 * l4, l2 * l4);
        let a = 2.0 * l3 * l3;
        let four = 4.0 * l3 * l3;
        let [b0, b1] = [four * (4.0 * l42 + l22), four * 4.0 * l24];
        let [c0, c1, c2] =
            [9.0 * l42 * l42 - 2.0 * l22 * l42 + l22 * l22, l24 * (12.0 * l42 + 4.0 * l22), 12.0 * l22 * l42];
        let [d0, d1, d2] = [12.0 * l42 * l42 + l22 * l42 + l22 * l22, l24 * (20.0 * l42 + 6.0 * l22), 14.0 * l22 * l42]
            .map(|d| 2.0 * a * four * d);
        let (e0, g0) = (c0 - a * a, c0 + a * a);
        [
            e0 * e0 - b0 * g0 + d0,
            2.0 * e0 * c1 - b0 * c1 - b1 * g0 + d1,
            2.0 * e0 * c2 + c1 * c1 - b0 * c2 - b1 * c1 + d2,
            2.0 * c1 * c2 - b1 * c2,
            c2 * c2,
        ]
    }

    /// The roots e of the quadratic near the unit circle, brought onto it.
    fn arms(&self, f: Rotor<f64>) -> impl Iterator<Item = Rotor<f64>> {
        let (a, b, c) = self.quadratic(f);
        let root = complex_sqrt(b.complex_mul(b) - c.scale(4.0 * a));
        let scale = -0.5 / a;
        [b + root, b - root].into_iter().map(move |v| v.scale(scale)).filter_map(|e| {
            let off = e.norm_squared() - 1.0;
            if off < NEAR_CIRCLE && -off < NEAR_CIRCLE { e.direction() } else { None }
        })
    }

    /// Three Newton steps in both angles; `None` if the conditions do not hold then.
    fn polished(&self, mut e: Rotor<f64>, mut f: Rotor<f64>) -> Option<(Rotor<f64>, Rotor<f64>)> {
        let [l2, l3, l4] = self.0;
        let one = Vec2::new(1.0, 0.0);
        let residual = |e: Rotor<f64>, f: Rotor<f64>| {
            let (a, b, c) = self.quadratic(f);
            e.rotate(e.to_vec().scale(a) + b) + c
        };
        for _ in 0..3 {
            let left = residual(e, f);
            // Derivatives by the angles, turned back by a quarter.
            let by_e =
                e.rotate(e.to_vec().scale(4.0 * l3 * l3) + f.to_vec().scale(4.0 * l3 * l4) + one.scale(2.0 * l2 * l3));
            let by_f =
                f.rotate(f.to_vec().scale(6.0 * l4 * l4) + e.to_vec().scale(4.0 * l3 * l4) + one.scale(2.0 * l2 * l4));
            let determinant = by_e.cross(by_f);
            let turned = Vec2::new(left.z, -left.x);
            let (step_e, step_f) = (-(turned.cross(by_f)) / determinant, -(by_e.cross(turned)) / determinant);
            // Where two configurations merge, the step means nothing.
            if step_e * step_e + step_f * step_f < NEAR_CIRCLE {
                e = Vec2::new(e.cos - step_e * e.sin, e.sin + step_e * e.cos).direction()?;
                f = Vec2::new(f.cos - step_f * f.sin, f.sin + step_f * f.cos).direction()?;
            }
        }
        let left = residual(e, f).norm_squared();
        if left < RESIDUAL * RESIDUAL { Some((e, f)) } else { None }
    }

    /// √(half the trace of JJᵀ)
    fn sigma(&self, e: Rotor<f64>, f: Rotor<f64>) -> f64 {
        let [l2, l3, l4] = self.0;
        let w = e.to_vec().scale(l3) + f.to_vec().scale(l4);
        Real::sqrt(0.5 * ((w + Vec2::new(l2, 0.0)).norm_squared() + w.norm_squared() + l4 * l4))
    }
}

fn value(p: &Polynomial, x: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

fn derivative(p: &Polynomial) -> Polynomial {
    let [_, b, c, d, e] = *p;
    [b, 2.0 * c, 3.0 * d, 4.0 * e, 0.0]
}

/// Every real root in [−1, 1]: between neighbouring extrema there is one where the sign changes; an extremum that
/// touches zero is one.
fn roots(p: &Polynomial) -> [Option<f64>; 5] {
    let first = derivative(p);
    let second = derivative(&first);
    let third = derivative(&second);
    // The third derivative is linear and has no extremum.
    let mut extrema = [None; 5];
    for p in [&third, &second, &first] {
        extrema = roots_between(p, extrema, 0.0);
    }
    let scale = p.iter().fold(0.0, |sum, &c| sum + if c < 0.0 { -c } else { c });
    roots_between(p, extrema, TOUCHING * scale)
}

/// The roots of `p` in [−1, 1] given its extrema there, in ascending order.
fn roots_between(p: &Polynomial, extrema: [Option<f64>; 5], touching: f64) -> [Option<f64>; 5] {
    let mut found = [None; 5];
    let mut places = found.iter_mut();
    let mut left = -1.0;
    for right in extrema.into_iter().flatten().chain([1.0]) {
        let (from, to) = (value(p, left), value(p, right));
        let touches = right < 1.0 && to <= touching && -to <= touching;
        let root = if touches {
            Some(right)
        } else if (from < 0.0) != (to < 0.0) {
            Some(bisected(p, left, right, from < 0.0))
        } else {
            None
        };
        if let Some(root) = root
            && let Some(place) = places.next()
        {
            *place = Some(root);
        }
        left = right;
    }
    found
}

/// Halves until the ends are neighbours; at most 64 times, which a root near zero may leave with 1e-19.
fn bisected(p: &Polynomial, mut left: f64, mut right: f64, negative_left: bool) -> f64 {
    for _ in 0..64 {
        let middle = 0.5 * (left + right);
        if (value(p, middle) < 0.0) == negative_left {
            left = middle;
        } else {
            right = middle;
        }
    }
    0.5 * (left + right)
}
