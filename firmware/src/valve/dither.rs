//! Dither: a small triangle on the current that keeps the spool from sticking.
//!
//! The phase is an integer and its mean frequency exact to a millionth of a hertz. At 1000 ticks a second the triangle's shape is exact
//! where a period is a multiple of four ticks (250, 125, 83⅓, 62.5, 50 … Hz); elsewhere a sample misses the corner, and the peak is lower
//! by up to 4·f/2000 of the amplitude: 20 % at 100 Hz (ten ticks, corners between samples). Above 250 Hz there is no triangle left.
//!
//! The winding sets a limit too: on the falling flank nothing but resistance and diode takes the current down, so the amplitude reached
//! ends where L·4·f·amplitude = R·i + V_f. Beyond it the mean current rises.

use serde::{Deserialize, Serialize};

use crate::TICK_S;
use crate::parameters::{ParameterError, within};

/// The dither of a spool.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DitherParameters {
    /// Frequency, Hz.
    pub frequency_hz: f32,
    /// Amplitude, mean to peak, A; 0 for none.
    pub amplitude_a: f32,
    /// Below this current the amplitude shrinks in proportion, to nothing at zero, A; at least the amplitude.
    pub fade_below_a: f32,
}

impl DitherParameters {
    /// No dither.
    pub const NONE: Self = Self { frequency_hz: 50.0, amplitude_a: 0.0, fade_below_a: 0.1 };

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        within("dither.frequency_hz", self.frequency_hz, [10.0, 250.0])?;
        within("dither.amplitude_a", self.amplitude_a, [0.0, 0.5])?;
        // Below its own amplitude the dither would ask for a current the other way.
        let least = if self.amplitude_a > 0.01 { self.amplitude_a } else { 0.01 };
        within("dither.fade_below_a", self.fade_below_a, [least.into(), 5.0])
    }
}

/// −1…1 in steps of 2⁻³⁰.
type Triangle = fixed::types::I2F30;

/// A triangle generator.
#[derive(Clone, Copy, Debug)]
pub struct Dither {
    /// Phase a tick; a whole turn is 2³².
    step: u32,
    amplitude_a: f32,
    /// Amplitude over the current below which it fades, at most 1.
    per_current: f32,
    phase: u32,
}

impl Dither {
    /// At the middle of its rise.
    pub fn new(parameters: &DitherParameters) -> Self {
        let p = parameters;
        let turns_per_tick = f64::from(p.frequency_hz) * f64::from(TICK_S);
        Self {
            step: (turns_per_tick * 4_294_967_296.0) as u32,
            amplitude_a: p.amplitude_a,
            per_current: p.amplitude_a / p.fade_below_a,
            phase: 0,
        }
    }

    /// The dither of the next tick on this current, both in A.
    #[inline(always)]
    pub fn step(&mut self, current_a: f32) -> f32 {
        self.phase = self.phase.wrapping_add(self.step);
        // |phase| as a signed number is a triangle; a quarter turn ahead it begins at its middle.
        let height = self.phase.wrapping_add(1 << 30).cast_signed().unsigned_abs();
        // 0…2³¹ → −1…1.
        let triangle = Triangle::from_bits(height.wrapping_sub(1 << 30).cast_signed());
        let faded = self.per_current * current_a;
        let amplitude = if faded < self.amplitude_a { faded } else { self.amplitude_a };
        amplitude * (triangle.to_bits() as f32 / 1_073_741_824.0)
    }

    /// Back to the middle of its rise.
    #[inline(always)]
    pub fn reset(&mut self) {
        self.phase = 0;
    }
}
