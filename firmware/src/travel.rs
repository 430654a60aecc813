//! Whether a dig stays within reach and stroke, before anything moves.

use kinematics_core::{Machine, PoseError, Real};

use crate::TICKS_PER_S;
use crate::dig::Dig;

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
    let ticks_per_s = T::from_i32(TICKS_PER_S as i32);
    let ticks = (dig.duration() * ticks_per_s).nearest_i32();
    (0..=ticks).find_map(|tick| {
        let time_s = T::from_i32(tick) / ticks_per_s;
        machine.tip_to_cylinders(&dig.tip(time_s)).err().map(|error| Violation { time_s, error })
    })
}
