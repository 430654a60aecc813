//! Levers: each asks for a fraction of its actuator's full speed.

use crate::io::Speeds;
use crate::parameters::ValveDirection;

/// Full deflection of a lever.
const FULL: i16 = 32767;

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
        for ((speed, lever), full) in speeds.iter_mut().zip(levers).zip(self.full_speeds) {
            *speed = self.speed(lever, full);
        }
        Speeds::from_array(speeds)
    }

    /// The arm's of them alone.
    #[inline]
    pub(super) fn arm_mps(&self, [_, _, arm, _]: [i16; 4]) -> f32 {
        let [_, _, full, _] = self.full_speeds;
        self.speed(arm, full)
    }

    #[inline(always)]
    fn speed(&self, lever: i16, [extend, retract]: [f32; 2]) -> f32 {
        let fraction = f32::from(core::cmp::max(lever, -FULL)) / f32::from(FULL);
        let asked = fraction * if fraction > 0.0 { extend } else { retract };
        if asked >= self.smallest_speed || asked <= -self.smallest_speed { asked } else { 0.0 }
    }
}
