//! The papers' formulas as they print them, for the tests of their errata: angles, with libm's trigonometry.

pub mod frankel;
pub mod koivo;
pub mod park;
pub mod plain;

use core::f64::consts::{PI, TAU};

/// The difference of two angles, whole turns left out, rad; at least 0.
pub fn turn_between(a: f64, b: f64) -> f64 {
    (a - b - TAU * libm::round((a - b) / TAU)).abs()
}

/// Radians.
pub fn rad(degrees: f64) -> f64 {
    degrees * PI / 180.0
}

/// Degrees.
pub fn deg(radians: f64) -> f64 {
    radians * 180.0 / PI
}

/// df/dx at `x` by the five-point difference: exact to about 1e-11 for functions that vary over a unit.
pub fn rate<const N: usize>(f: impl Fn(f64) -> [f64; N], x: f64) -> [f64; N] {
    let h = 1e-3;
    let [a, b, c, d] = [f(x - 2.0 * h), f(x - h), f(x + h), f(x + 2.0 * h)];
    core::array::from_fn(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * h))
}

/// Asserts that two values agree.
///
/// # Panics
/// When they differ by more than `within`.
#[track_caller]
pub fn agree(what: &str, found: f64, exact: f64, within: f64) {
    assert!((found - exact).abs() <= within, "{what}: {found}, not {exact}");
}

/// Asserts that rows of values agree.
///
/// # Panics
/// When any two differ by more than `within`.
#[track_caller]
pub fn all_agree(what: &str, found: &[f64], exact: &[f64], within: f64) {
    assert_eq!(found.len(), exact.len(), "{what}");
    for (found, exact) in found.iter().zip(exact) {
        agree(what, *found, *exact, within);
    }
}

/// `count` + 1 evenly spaced values, both ends included.
pub fn steps(from: f64, until: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |i| from + (until - from) * f64::from(i) / f64::from(count))
}
