//! Tuning of the coordinated control law: what trajectory, grade and tip velocity share.

use serde::{Deserialize, Serialize};

use crate::parameters::{ParameterError, within};

/// The law's tuning beside preview and gain ([`crate::parameters::MotionParameters`]), and the limits it coordinates within.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawParameters {
    /// Share of the feed-forward that is used: 1, or 0 to follow by the error alone.
    pub feed_forward: f32,
    /// How fast what a direction of a spool lacks in speed is learnt from its error, 1/s².
    pub integral_per_s2: f32,
    /// The most a direction may lack, m/s (a swing motor rad/s).
    pub bias_limit_mps: f32,
    /// The most the feedback adds, m/s (a swing motor rad/s).
    pub correction_limit_mps: f32,
    /// Where the path stands still an error below this is left alone, until it has grown to three times as much, m.
    pub rest_zone_m: f32,
    /// Share of full speeds and flow kept for the feedback.
    pub reserve: f32,
    /// How fast the speeds of swing, boom, arm and bucket may change, m/s² (a swing motor rad/s²).
    pub acceleration: [f32; 4],
    /// Deceleration before the end of a stroke, m/s².
    pub cushion_mps2: f32,
    /// How fast the tip's velocity may change in grade and tip velocity, m/s².
    pub tip_acceleration_mps2: f32,
    /// How fast the pitch rate may change, rad/s².
    pub pitch_acceleration_radps2: f32,
    /// How far the swing may stray from its reference, rad.
    pub swing_following_error_rad: f32,
    /// Areas the pump fills in boom, arm and bucket: \[extend, retract\], m².
    pub areas_m2: [[f32; 2]; 3],
    /// What the pump gives to all cylinders together, m³/s.
    pub flow_m3ps: f32,
    /// Time constant of the feedback: a machine that rings on its oil is not to be followed in it, s.
    pub feedback_lag_s: f32,
    /// Lag at which a cylinder all but stops the path's clock, m; the swing at as large a share of its following error.
    pub lag_m: f32,
    /// Load in the direction of motion above which boom, arm and bucket run ahead of the oil they are given: \[extend, retract\], N. It
    /// needs the cylinders' pressures.
    pub overrun_n: [[f32; 2]; 3],
    /// Deceleration of the swing above which its inertia does so, rad/s².
    pub swing_overrun_radps2: f32,
}

/// Loads and decelerations above any, for actuators that never run ahead.
pub const NO_OVERRUN: f32 = 1e9;

impl LawParameters {
    /// Checks every value.
    ///
    /// # Errors
    /// The first out of its range, by name.
    pub fn validate(&self) -> Result<(), ParameterError> {
        within("motion.law.feed_forward", self.feed_forward, [0.0, 1.0])?;
        within("motion.law.integral_per_s2", self.integral_per_s2, [0.0, 100.0])?;
        within("motion.law.bias_limit_mps", self.bias_limit_mps, [0.0, 0.1])?;
        within("motion.law.correction_limit_mps", self.correction_limit_mps, [0.0, 1.0])?;
        within("motion.law.rest_zone_m", self.rest_zone_m, [0.0, 0.05])?;
        within("motion.law.reserve", self.reserve, [0.0, 0.5])?;
        for acceleration in self.acceleration {
            within("motion.law.acceleration", acceleration, [0.01, 100.0])?;
        }
        within("motion.law.cushion_mps2", self.cushion_mps2, [0.01, 100.0])?;
        within("motion.law.tip_acceleration_mps2", self.tip_acceleration_mps2, [0.01, 20.0])?;
        within("motion.law.pitch_acceleration_radps2", self.pitch_acceleration_radps2, [0.01, 20.0])?;
        within("motion.law.swing_following_error_rad", self.swing_following_error_rad, [0.001, 1.0])?;
        for area in self.areas_m2.iter().flatten() {
            within("motion.law.areas_m2", *area, [1e-5, 1.0])?;
        }
        within("motion.law.flow_m3ps", self.flow_m3ps, [1e-6, 1.0])?;
        within("motion.law.feedback_lag_s", self.feedback_lag_s, [0.0, 2.0])?;
        within("motion.law.lag_m", self.lag_m, [0.001, 1.0])?;
        for load in self.overrun_n.iter().flatten() {
            within("motion.law.overrun_n", *load, [1.0, NO_OVERRUN.into()])?;
        }
        within("motion.law.swing_overrun_radps2", self.swing_overrun_radps2, [0.001, NO_OVERRUN.into()])
    }
}
