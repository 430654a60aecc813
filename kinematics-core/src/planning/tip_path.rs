//! Paths of the tip in the plane, sampled at K knots evenly along their length.

use crate::{Real, Rotor, Vec2};

/// A path of the tip: K knots (reach, height), m.
///
/// ```
/// use kinematics_core::Vec2;
/// use kinematics_core::planning::tip_path::TipPath;
/// let at = Vec2::<f64>::new;
/// let line = TipPath::<f64, 5>::line(at(1.0, 0.0), at(3.0, 1.0));
/// assert_eq!(line.knots()[2], at(2.0, 0.5));
/// // A quarter circle, clockwise about the origin.
/// let arc = TipPath::<f64, 3>::arc(at(0.0, 0.0), at(0.0, 2.0), -0.25);
/// assert!((arc.knots()[2] - at(2.0, 0.0)).norm() < 1e-15 && (arc.knots()[1].norm() - 2.0).abs() < 1e-15);
/// // Along two sides of a square; a corner between two knots is cut.
/// let corner = TipPath::<f64, 5>::polyline(&[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)]);
/// assert_eq!(corner.knots()[1..4], [at(0.5, 0.0), at(1.0, 0.0), at(1.0, 0.5)]);
/// assert_eq!(corner.length(), 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipPath<T, const K: usize> {
    knots: [Vec2<T>; K],
}

impl<T: Real, const K: usize> TipPath<T, K> {
    /// The straight line.
    pub fn line(from: Vec2<T>, to: Vec2<T>) -> Self {
        Self::by_share(|share| from + (to - from).scale(share))
    }

    /// The arc about `centre` from `from` by `turns`, counter-clockwise positive.
    pub fn arc(centre: Vec2<T>, from: Vec2<T>, turns: T) -> Self {
        Self::by_share(|share| centre + Rotor::from_turns(share * turns).rotate(from - centre))
    }

    /// The line through `points`.
    pub fn polyline(points: &[Vec2<T>]) -> Self {
        let sides = || points.iter().zip(points.iter().skip(1));
        let whole = sides().fold(T::ZERO, |sum, (a, b)| sum + (*b - *a).norm());
        let first = points.first().copied().unwrap_or(Vec2::new(T::ZERO, T::ZERO));
        Self::by_share(|share| {
            let mut left = share * whole;
            let mut place = first;
            for (&a, &b) in sides() {
                let side = (b - a).norm();
                if left <= T::ZERO {
                    break;
                }
                // The last knot stands on the last point, whatever the sum of the sides rounds to.
                place = if left >= side { b } else { a + (b - a).scale(left / side) };
                left = left - side;
            }
            place
        })
    }

    fn by_share(place: impl Fn(T) -> Vec2<T>) -> Self {
        let last = T::from_i32(if K > 1 { K as i32 - 1 } else { 1 });
        let mut knots = [place(T::ZERO); K];
        for (i, knot) in knots.iter_mut().enumerate().skip(1) {
            *knot = place(T::from_i32(i as i32) / last);
        }
        Self { knots }
    }

    /// The knots.
    pub fn knots(&self) -> &[Vec2<T>; K] {
        &self.knots
    }

    /// The length from knot to knot, m.
    pub fn length(&self) -> T {
        self.knots.iter().zip(self.knots.iter().skip(1)).fold(T::ZERO, |sum, (a, b)| sum + (*b - *a).norm())
    }
}
