//! The approaches a fence follows from one weighing to the next: a fixed number of them one by one, what is more in one bound.

use crate::Real;

/// How many approaches are followed one by one.
pub(super) const NEARBY: usize = 4;

/// An approach to a limit by the rates of the actuators.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Approach<T> {
    /// How much each actuator's way brings nearer, m/m or m/rad.
    pub(super) by: [T; 4],
    /// The distance less the margin, m.
    pub(super) room: T,
    /// How much it exceeds what it has room for, m.
    pub(super) demand: T,
}

/// Several approaches in one: what keeps this keeps each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Joined<T> {
    /// The smallest and the largest share of each actuator.
    low: [T; 4],
    high: [T; 4],
    /// The smallest distance less the margin, m.
    pub(super) room: T,
}

impl<T: Real> Joined<T> {
    /// Of nothing: the first that joins it is what it becomes.
    fn nothing() -> Self {
        let most = most();
        Self { low: [most; 4], high: [-most; 4], room: most }
    }

    /// How much each rate, or each way, brings nearer at most; the sum bounds every approach joined in this one.
    #[inline(always)]
    pub(super) fn at_most(&self, rates: &[T; 4]) -> [T; 4] {
        let ([l1, l2, l3, l4], [h1, h2, h3, h4], [r1, r2, r3, r4]) = (self.low, self.high, *rates);
        let share = |low: T, high: T, rate: T| if rate > T::ZERO { high * rate } else { low * rate };
        [share(l1, h1, r1), share(l2, h2, r2), share(l3, h3, r3), share(l4, h4, r4)]
    }

    #[inline(always)]
    fn join(&mut self, other: &Approach<T>) {
        for ((low, high), &by) in self.low.iter_mut().zip(&mut self.high).zip(&other.by) {
            if by < *low {
                *low = by;
            }
            if by > *high {
                *high = by;
            }
        }
        if other.room < self.room {
            self.room = other.room;
        }
    }
}

/// More than any distance.
fn most<T: Real>() -> T {
    T::from_f64(f64::from(f32::MAX))
}

/// What one weighing of all limits has kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearby<T> {
    kept: [Approach<T>; NEARBY],
    used: usize,
    rest: Joined<T>,
    /// Something was joined to the rest.
    more: bool,
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
    /// assert!(Nearby::<f32>::none().is_clear());
    /// ```
    pub fn none() -> Self {
        let unused = Approach { by: [T::ZERO; 4], room: T::ZERO, demand: T::ZERO };
        let rest = Joined::nothing();
        Self { kept: [unused; NEARBY], used: 0, rest, more: false, turning: None, closest: most() }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        (self.used, self.more, self.turning) = (0, false, None);
        self.rest = Joined::nothing();
        self.closest = most();
    }

    /// No half-space and no ball is near: of boom, arm and bucket no wish up to the one weighed with is too fast.
    pub fn is_clear(&self) -> bool {
        self.used == 0
    }

    /// Keeps an approach by itself while there is room, else in place of the least demanding; that one is joined to the rest.
    #[inline(never)]
    pub(super) fn keep(&mut self, approach: &Approach<T>) {
        if let Some(slot) = self.kept.get_mut(self.used) {
            *slot = *approach;
            self.used += 1;
            return;
        }
        self.more = true;
        let [a, b, c, d] = &mut self.kept;
        let less = |x: &Approach<T>, y: &Approach<T>| x.demand < y.demand;
        let first = if less(b, a) { b } else { a };
        let second = if less(d, c) { d } else { c };
        let least = if less(second, first) { second } else { first };
        if less(least, approach) {
            self.rest.join(least);
            *least = *approach;
        } else {
            self.rest.join(approach);
        }
    }

    pub(super) fn kept(&self) -> &[Approach<T>] {
        self.kept.get(..self.used).unwrap_or(&self.kept)
    }

    pub(super) fn rest(&self) -> Option<&Joined<T>> {
        self.more.then_some(&self.rest)
    }
}
