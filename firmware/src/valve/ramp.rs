//! Limits how fast a direction's current rises and falls, above its dead band.

use serde::{Deserialize, Serialize};

use crate::TICK_S;
use crate::parameters::{ParameterError, within};

/// The ramps of one direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RampParameters {
    /// Fastest rise, A/s.
    pub up_a_per_s: f32,
    /// Fastest fall, A/s.
    pub down_a_per_s: f32,
}

impl RampParameters {
    /// Faster than any coil: no ramp.
    pub const NONE: Self = Self { up_a_per_s: 10_000.0, down_a_per_s: 10_000.0 };

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        within("ramp.up_a_per_s", self.up_a_per_s, [0.01, 10_000.0])?;
        within("ramp.down_a_per_s", self.down_a_per_s, [0.01, 10_000.0])
    }
}

/// A ramp and where it is.
#[derive(Clone, Copy, Debug)]
pub struct Ramp {
    up_a: f32,
    down_a: f32,
    current_a: f32,
}

impl Ramp {
    /// At zero.
    pub fn new(parameters: &RampParameters) -> Self {
        Self { up_a: parameters.up_a_per_s * TICK_S, down_a: parameters.down_a_per_s * TICK_S, current_a: 0.0 }
    }

    /// One tick nearer to `target_a` (0, or at least `floor_a`). Nothing moves below `floor_a`, so the way between it and zero is jumped.
    #[inline]
    pub fn step(&mut self, target_a: f32, floor_a: f32) -> f32 {
        if target_a <= 0.0 {
            return self.fall(floor_a);
        }
        self.follow(target_a, floor_a)
    }

    /// [`Self::step`] for a target above zero.
    #[inline(always)]
    pub(super) fn follow(&mut self, target_a: f32, floor_a: f32) -> f32 {
        let from = if self.current_a < floor_a { floor_a } else { self.current_a };
        let change = target_a - from;
        self.current_a = if change > self.up_a {
            from + self.up_a
        } else if change < -self.down_a {
            from - self.down_a
        } else {
            target_a
        };
        self.current_a
    }

    /// One tick nearer to zero.
    #[inline]
    fn fall(&mut self, floor_a: f32) -> f32 {
        let next = self.current_a - self.down_a;
        self.current_a = if next < floor_a || next < 0.0 { 0.0 } else { next };
        self.current_a
    }

    /// Back to zero at once.
    #[inline]
    pub fn reset(&mut self) {
        self.current_a = 0.0;
    }
}
