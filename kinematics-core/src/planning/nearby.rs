//! The approaches a fence follows from one weighing to the next: a fixed number of them one by one, what is more in one bound.

use super::clearance::Clearance;
use crate::Real;

/// How many approaches are followed one by one.
pub(super) const NEARBY: usize = 4;

/// Approaches to limits by the rates of the actuators.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Approach<T> {
    /// The smallest and the largest share of each actuator: the same for a single approach.
    low: [T; 4],
    high: [T; 4],
    /// The smallest distance less the margin, m.
    pub(super) room: T,
}

impl<T: Real> Approach<T> {
    pub(super) fn new(by: [T; 4], room: T) -> Self {
        Self { low: by, high: by, room }
    }

    /// How much each rate, or each way, brings nearer at most; the sum bounds every approach joined in this one.
    #[inline(always)]
    pub(super) fn at_most(&self, rates: &[T; 4]) -> [T; 4] {
        let ([l1, l2, l3, l4], [h1, h2, h3, h4], [r1, r2, r3, r4]) = (self.low, self.high, *rates);
        let share = |low: T, high: T, rate: T| if rate > T::ZERO { high * rate } else { low * rate };
        [share(l1, h1, r1), share(l2, h2, r2), share(l3, h3, r3), share(l4, h4, r4)]
    }

    /// Both in one: what keeps this keeps either.
    fn join(&mut self, other: &Self) {
        for (low, &by) in self.low.iter_mut().zip(&other.low) {
            *low = if by < *low { by } else { *low };
        }
        for (high, &by) in self.high.iter_mut().zip(&other.high) {
            *high = if by > *high { by } else { *high };
        }
        self.room = if other.room < self.room { other.room } else { self.room };
    }
}

/// What one weighing of all limits has kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearby<T> {
    /// With how much each exceeds what it has room for.
    kept: [(Approach<T>, T); NEARBY],
    used: usize,
    rest: Option<Approach<T>>,
    /// Distances of the swing to the right and the left end of its range, rad, and dθ1 by its actuator's way.
    pub(super) turning: Option<([T; 2], T)>,
    /// The smallest clearance to any half-space or ball, m; the largest number there is without any.
    pub closest: T,
}

impl<T: Real> Nearby<T> {
    /// Nothing yet.
    ///
    /// ```
    /// use kinematics_core::planning::fence::Nearby;
    /// assert_eq!(Nearby::<f32>::none().closest, f32::MAX);
    /// ```
    pub fn none() -> Self {
        let unused = Approach::new([T::ZERO; 4], T::ZERO);
        let closest = T::from_f64(f64::from(f32::MAX));
        Self { kept: [(unused, T::ZERO); NEARBY], used: 0, rest: None, turning: None, closest }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        (self.used, self.rest, self.turning) = (0, None, None);
        self.closest = T::from_f64(f64::from(f32::MAX));
    }

    /// Keeps an approach by itself while there is room, else in place of the least demanding; that one is joined to the rest.
    #[inline(never)]
    pub(super) fn keep(&mut self, clearance: &Clearance<T>, &[t1, t2, t3, t4]: &[T; 4], room: T, demand: T) {
        let [a1, a2, a3, a4] = clearance.approach;
        let approach = Approach::new([a1 * t1, a2 * t2, a3 * t3, a4 * t4], room);
        if let Some(slot) = self.kept.get_mut(self.used) {
            *slot = (approach, demand);
            self.used += 1;
            return;
        }
        let mut least = demand;
        let mut place = None;
        for kept in &mut self.kept {
            if kept.1 < least {
                least = kept.1;
                place = Some(kept);
            }
        }
        let joined = match place {
            Some(kept) => core::mem::replace(kept, (approach, demand)).0,
            None => approach,
        };
        match &mut self.rest {
            Some(rest) => rest.join(&joined),
            None => self.rest = Some(joined),
        }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Approach<T>> {
        self.kept.iter().take(self.used).map(|(approach, _)| approach).chain(&self.rest)
    }
}
