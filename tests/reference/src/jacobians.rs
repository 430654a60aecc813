//! Jacobians to test with: Hareesha's by trigonometry, such with given singular values, and their exact singular values.

use std::f64::consts::TAU;

use kinematics_core::Real;

use crate::sweep::Random;
use crate::wide::Wide;

/// Hareesha 2015 (12) by sines and cosines of absolute angles: independent of every rotor.
pub fn jacobian([l2, l3, l4]: [f64; 3], [t2, t3, t4]: [f64; 3]) -> [[f64; 3]; 2] {
    let links = [(l2, t2), (l3, t2 + t3), (l4, t2 + t3 + t4)];
    let sum = |from: usize, part: fn(f64) -> f64| links[from..].iter().map(|(l, t)| l * part(*t)).sum::<f64>();
    [[0, 1, 2].map(|k| -sum(k, libm::sin)), [0, 1, 2].map(|k| sum(k, libm::cos))]
}

/// A Jacobian rounded to T.
pub fn rounded<T: Real, const N: usize>(j: &[[f64; N]; 2]) -> [[T; N]; 2] {
    j.map(|row| row.map(T::from_f64))
}

/// Singular values in double-double arithmetic from the same numbers: 100 bits, half of which JJᵀ may lose.
pub fn exact_singular<T: Real, const N: usize>(j: &[[T; N]; 2]) -> [f64; 2] {
    let wide = |x: T| Wide::from_f64(x.to_f64());
    let dot =
        |a: &[T; N], b: &[T; N]| a.iter().zip(b).fold(Wide::from_f64(0.0), |sum, (a, b)| sum + wide(*a) * wide(*b));
    let [x, z] = j;
    let (p, q, r) = (dot(x, x), dot(x, z), dot(z, z));
    let two = Wide::from_f64(2.0);
    let (half, shear) = ((p - r) / two, q);
    let largest_square = (p + r) / two + (half * half + shear * shear).sqrt();
    let mut det = Wide::from_f64(0.0);
    for i in 0..N {
        for k in i + 1..N {
            let minor = wide(x[i]) * wide(z[k]) - wide(x[k]) * wide(z[i]);
            det = det + minor * minor;
        }
    }
    [largest_square.sqrt().to_f64(), (det / largest_square).sqrt().to_f64()]
}

/// u₁ at a random angle, both singular values given: J = U·diag(σ)·Vᵀ with a random orthonormal V.
pub fn with_singular<const N: usize>(random: &mut Random, sigma: [f64; 2]) -> [[f64; N]; 2] {
    let mut v = [[0.0; N]; 2].map(|row| row.map(|_: f64| random.unit() - 0.5));
    let dot = |a: &[f64; N], b: &[f64; N]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let [first, second] = &mut v;
    let norm = dot(first, first).sqrt();
    first.iter_mut().for_each(|x| *x /= norm);
    let along = dot(first, second);
    second.iter_mut().zip(*first).for_each(|(x, y)| *x -= along * y);
    let norm = dot(second, second).sqrt();
    second.iter_mut().for_each(|x| *x /= norm);
    let angle = TAU * random.unit();
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let mut j = [[0.0; N]; 2];
    for k in 0..N {
        let (a, b) = (sigma[0] * v[0][k], sigma[1] * v[1][k]);
        j[0][k] = c * a - s * b;
        j[1][k] = s * a + c * b;
    }
    j
}
