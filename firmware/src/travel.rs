//! Whether a dig stays within reach and stroke, before anything moves.

use kinematics_core::{Machine, PoseError, Real};

use crate::dig::Dig;
use crate::pose::cylinders_once;

/// A moment of a dig the machine cannot do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation<T> {
    /// When, s.
    pub time_s: T,
    /// What: cylinder and amount.
    pub error: PoseError<T>,
}

/// The first violation, tried at every tick of the dig.
pub fn first_violation<T: Real>(machine: &Machine<T>, dig: &Dig<T>) -> Option<Violation<T>> {
    violation_among(machine, dig, 0, dig.ticks().saturating_add(1))
}

/// The first violation in `count` ticks of the dig from `from` on.
pub(crate) fn violation_among<T: Real>(
    machine: &Machine<T>,
    dig: &Dig<T>,
    from: u32,
    count: u32,
) -> Option<Violation<T>> {
    let end = core::cmp::min(from.saturating_add(count), dig.ticks().saturating_add(1));
    (from..end).find_map(|tick| {
        let refused = cylinders_once(machine, &dig.at_tick(tick)).err();
        refused.map(|error| Violation { time_s: Dig::time_of(tick), error })
    })
}
