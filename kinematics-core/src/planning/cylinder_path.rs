//! A smooth path through planned cylinder lengths: a natural cubic spline, its parameter s from 0 to 1.
//!
//! From knot to knot s grows in proportion to the time the step takes with speeds and pump flow at their limits
//! ([`Limits::shortest_time`]): where the parameter's rate is constant, the cylinder that limits moves at its limit.
//! dL/ds and d²L/ds² are continuous, d³L/ds³ is constant between knots, so speed and acceleration have no jumps.

use crate::planning::move_limits::{Limits, larger};
use crate::{Cylinders, Real};

/// Shares of the whole that a step takes at least, over K: knots that coincide must not divide by zero.
const SHORTEST_STEP: f64 = 1e-3;

/// A place on the path: lengths (m) and their derivatives by s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint<T> {
    /// L, m.
    pub lengths: Cylinders<T>,
    /// dL/ds.
    pub slope: [T; 3],
    /// d²L/ds².
    pub curvature: [T; 3],
    /// d³L/ds³.
    pub third: [T; 3],
}

/// Bounds on the derivatives over a piece of the path, boom, arm, bucket.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extremes<T> {
    /// Lowest (or 0) and highest (or 0) dL/ds.
    pub(crate) slope: [[T; 2]; 3],
    /// |d²L/ds²|
    pub(crate) curvature: [T; 3],
    /// |d³L/ds³|
    pub(crate) third: [T; 3],
}

/// L = c0 + t·(c1 + t·(c2 + t·c3)), t from the interval's beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cubic<T> {
    c: [T; 4],
}

impl<T: Real> Cubic<T> {
    fn derivatives(&self, t: T) -> [T; 4] {
        let [c0, c1, c2, c3] = self.c;
        let [two, three, six] = [2, 3, 6].map(T::from_i32);
        [c0 + t * (c1 + t * (c2 + t * c3)), c1 + t * (two * c2 + t * (three * c3)), two * c2 + t * (six * c3), six * c3]
    }
}

/// The path through K configurations.
///
/// ```
/// use kinematics_core::Cylinders;
/// use kinematics_core::planning::cylinder_path::CylinderPath;
/// use kinematics_core::planning::move_limits::{Limits, MoveLimits};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let limits = Limits::<f64>::new(&MoveLimits {
///     speed_mps: [[0.5; 2]; 3],
///     acceleration_mps2: [1.0; 3],
///     jerk_mps3: [10.0; 3],
///     areas_m2: [[0.0; 2]; 3],
///     flow_m3ps: 1.0,
/// })?;
/// let at = |boom| Cylinders { boom, arm: 1.0, bucket: 1.0 };
/// let path = CylinderPath::new(&[at(1.0), at(1.2), at(1.8)], &limits).ok_or("no movement")?;
/// // A quarter of the way takes a quarter of the time at the limits.
/// let knot = path.at(0.25);
/// assert!((knot.lengths.boom - 1.2).abs() < 1e-15 && (knot.slope[0] - 0.8).abs() < 1e-12);
/// assert!((path.at(1.0).lengths.boom - 1.8).abs() < 1e-15);
/// assert!(CylinderPath::new(&[at(1.0); 3], &limits).is_none());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderPath<T, const K: usize> {
    /// s at the knots; the last is 1.
    knots: [T; K],
    /// An interval's cubics stand at its first knot.
    cubics: [[Cubic<T>; 3]; K],
}

impl<T: Real, const K: usize> CylinderPath<T, K> {
    /// The spline through the configurations; `None` where nothing moves or a length is no number.
    #[inline(never)]
    pub fn new(through: &[Cylinders<T>; K], limits: &Limits<T>) -> Option<Self> {
        const { assert!(K >= 2, "a path has two knots at least") };
        let mut steps = [T::ZERO; K];
        let mut whole = T::ZERO;
        for ((step, from), to) in steps.iter_mut().zip(through).zip(through.iter().skip(1)) {
            *step = limits.shortest_time(from, to);
            whole = whole + *step;
        }
        if !(whole > T::ZERO && whole * T::ZERO == T::ZERO) {
            return None;
        }
        let shortest = whole * T::from_f64(SHORTEST_STEP / K as f64);
        let mut sum = T::ZERO;
        for step in steps.iter_mut().take(K - 1) {
            *step = larger(*step, shortest);
            sum = sum + *step;
        }
        let mut knots = [T::ZERO; K];
        let mut s = T::ZERO;
        for (knot, step) in knots.iter_mut().zip(&mut steps) {
            *knot = s;
            *step = *step / sum;
            s = s + *step;
        }
        if let [.., last] = knots.as_mut_slice() {
            *last = T::ONE;
        }
        let mut cubics = [[Cubic { c: [T::ZERO; 4] }; 3]; K];
        let of_axes = [through.map(|c| c.boom), through.map(|c| c.arm), through.map(|c| c.bucket)];
        for (axis, lengths) in of_axes.iter().enumerate() {
            let one = natural_spline(lengths, &steps);
            for (all, one) in cubics.iter_mut().zip(one) {
                if let Some(slot) = all.get_mut(axis) {
                    *slot = one;
                }
            }
        }
        Some(Self { knots, cubics })
    }

    /// The place at s; before 0 and beyond 1 the ends' cubics go on.
    pub fn at(&self, s: T) -> PathPoint<T> {
        let mut here = (self.knots.first(), self.cubics.first());
        for (knot, cubics) in self.knots.iter().zip(&self.cubics).take(K - 1) {
            if *knot <= s {
                here = (Some(knot), Some(cubics));
            }
        }
        let nothing = [T::ZERO; 4];
        let [boom, arm, bucket] = match here {
            (Some(&knot), Some(cubics)) => cubics.map(|cubic| cubic.derivatives(s - knot)),
            _ => [nothing; 3],
        };
        let ([b0, b1, b2, b3], [a0, a1, a2, a3], [k0, k1, k2, k3]) = (boom, arm, bucket);
        PathPoint {
            lengths: Cylinders { boom: b0, arm: a0, bucket: k0 },
            slope: [b1, a1, k1],
            curvature: [b2, a2, k2],
            third: [b3, a3, k3],
        }
    }

    /// Bounds over `from`…`to`.
    pub(crate) fn extremes(&self, from: T, to: T) -> Extremes<T> {
        let mut out = Extremes { slope: [[T::ZERO; 2]; 3], curvature: [T::ZERO; 3], third: [T::ZERO; 3] };
        let ends = self.knots.iter().skip(1);
        for ((&begin, &end), cubics) in self.knots.iter().zip(ends).zip(&self.cubics) {
            if end < from || begin > to {
                continue;
            }
            let first = larger(begin, from) - begin;
            let last = (if to < end { to } else { end }) - begin;
            let outs = out.slope.iter_mut().zip(&mut out.curvature).zip(&mut out.third);
            for (cubic, ((slope, curvature), third)) in cubics.iter().zip(outs) {
                // dL/ds is a parabola: its ends, and its vertex where d²L/ds² passes zero inside.
                let [_, s0, k0, t0] = cubic.derivatives(first);
                let [_, s1, k1, _] = cubic.derivatives(last);
                let vertex = if k0 * k1 < T::ZERO {
                    let [_, vertex, ..] = cubic.derivatives(first + (last - first) * (k0 / (k0 - k1)));
                    vertex
                } else {
                    s0
                };
                let [low, high] = slope;
                for s in [s0, s1, vertex] {
                    *low = if s < *low { s } else { *low };
                    *high = larger(*high, s);
                }
                *curvature = larger(*curvature, larger(magnitude(k0), magnitude(k1)));
                *third = larger(*third, magnitude(t0));
            }
        }
        out
    }
}

pub(crate) fn magnitude<T: Real>(x: T) -> T {
    if x < T::ZERO { -x } else { x }
}

/// The natural cubic spline through `values`, `steps` apart: second derivatives by one sweep down and one back up (Thomas).
#[inline(never)]
fn natural_spline<T: Real, const K: usize>(values: &[T; K], steps: &[T; K]) -> [Cubic<T>; K] {
    let [two, six] = [2, 6].map(T::from_i32);
    let mut chords = [T::ZERO; K];
    for (((chord, from), to), step) in chords.iter_mut().zip(values).zip(values.iter().skip(1)).zip(steps) {
        *chord = (*to - *from) / *step;
    }
    // h₋·m₋ + 2(h₋ + h)·m + h·m₊ = 6(d − d₋) at every inner knot; after the sweep m = right − above·m₊.
    let (mut above, mut right) = ([T::ZERO; K], [T::ZERO; K]);
    let (mut last_above, mut last_right) = (T::ZERO, T::ZERO);
    let inner = steps.iter().zip(steps.iter().skip(1)).zip(chords.iter().zip(chords.iter().skip(1)));
    let slots = above.iter_mut().zip(&mut right).skip(1);
    for ((above, right), ((&before, &after), (&chord_before, &chord))) in slots.zip(inner).take(K - 2) {
        let pivot = two * (before + after) - before * last_above;
        *above = after / pivot;
        *right = (six * (chord - chord_before) - before * last_right) / pivot;
        (last_above, last_right) = (*above, *right);
    }
    let mut second = [T::ZERO; K];
    let mut next = T::ZERO;
    for at in (1..K - 1).rev() {
        if let (Some(m), Some(above), Some(right)) = (second.get_mut(at), above.get(at), right.get(at)) {
            *m = *right - *above * next;
            next = *m;
        }
    }
    let mut cubics = [Cubic { c: [T::ZERO; 4] }; K];
    let moments = second.iter().zip(second.iter().skip(1));
    let given = values.iter().zip(steps).zip(chords);
    for ((cubic, (&m, &m_next)), ((&value, &step), chord)) in cubics.iter_mut().zip(moments).zip(given) {
        let slope = chord - step * (two * m + m_next) / six;
        cubic.c = [value, slope, m / two, (m_next - m) / (six * step)];
    }
    cubics
}
