//! Levers: each asks for a fraction of its actuator's full speed.

use crate::io::{Speeds, limited};
use crate::parameters::ValveDirection;

/// Full deflection of a lever.
const FULL: f32 = 32767.0;

/// What full deflection means.
#[derive(Clone, Copy, Debug)]
pub(super) struct Levers {
    /// Full speed of swing, boom, arm, bucket: \[extend, retract\].
    full_speeds: [[f32; 2]; 4],
    smallest_speed: f32,
}

impl Levers {
    pub(super) fn new(valves: &[[ValveDirection; 2]; 4], smallest_speed: f32) -> Self {
        Self { full_speeds: valves.map(|spool| spool.map(|direction| direction.full_speed)), smallest_speed }
    }

    /// Speeds the levers ask for; one that asks for less than the smallest speed asks for none.
    #[inline]
    pub(super) fn speeds(&self, levers: [i16; 4]) -> Speeds {
        let mut speeds = [0.0; 4];
        for ((speed, lever), [extend, retract]) in speeds.iter_mut().zip(levers).zip(self.full_speeds) {
            let fraction = limited(f32::from(lever) / FULL, -1.0, 1.0);
            let asked = fraction * if fraction > 0.0 { extend } else { retract };
            if asked >= self.smallest_speed || asked <= -self.smallest_speed {
                *speed = asked;
            }
        }
        Speeds::from_array(speeds)
    }
}
