//! What a healthy machine is like: the calibrated delay model and each actuator's limits.

use serde::{Deserialize, Serialize};

use crate::parameters::{ParameterError, within};

/// One actuator. Lengths are m and speeds m/s of a cylinder, rad and rad/s of a swing motor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ActuatorLimits {
    /// Full speed: extend, retract.
    pub full_speed: [f32; 2],
    /// Standard deviation of its sensor's noise; 0 where it is not known, and then its loss says nothing.
    pub noise: f32,
    /// A tick's change beyond twice the full speed and this is a jump.
    pub jump: f32,
    /// Measured speed may leave the model's envelope by this.
    pub speed_margin: f32,
    /// Predicted travel after which a sensor must have followed.
    pub stuck_travel: f32,
}

impl ActuatorLimits {
    /// With these full speeds (extend, retract) and a sensor of this noise; a noisier one is given wider limits.
    pub fn new(full_speed: [f32; 2], noise: f32) -> Self {
        let least = |limit: f32, noises: f32| if noises * noise > limit { noises * noise } else { limit };
        Self {
            full_speed,
            noise,
            jump: least(0.002, 20.0),
            // The measured speed's standard deviation is 26 times the noise's a second.
            speed_margin: least(0.03, 300.0),
            stuck_travel: least(0.005, 50.0),
        }
    }

    /// The same with a sensor of this noise.
    #[must_use]
    pub fn with_noise(self, noise: f32) -> Self {
        Self::new(self.full_speed, noise)
    }
}

/// The diagnosis stage's parameters. A healthy machine stays inside them: it starts up to `latest_start_s` after a command, follows it
/// with the lag `spool_lag_s`, rings, and comes to rest up to `run_on_s` after the release.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DiagnosisParameters {
    /// Swing, boom, arm, bucket.
    pub actuators: [ActuatorLimits; 4],
    /// Longest dead time from command to first motion, s.
    pub latest_start_s: f32,
    /// Time constant of the slowest spool, s.
    pub spool_lag_s: f32,
    /// Longest run-on after the dead time of a release, s.
    pub run_on_s: f32,
    /// Share of the command by which speed may overshoot it: it rings, and a weight drives oil through the outlet edge faster than the pump
    /// would. It costs nothing after the release: what runs on then is at most what was measured.
    pub overshoot: f32,
    /// Share of a released speed that may ring back.
    pub ring: f32,
    /// Share of its full speed at which an actuator may shake while the others move at theirs: a boom that falls faster than its full speed
    /// into its cushion throws the arm forwards.
    pub coupling: f32,
    /// Share of a standing command at which an actuator may bounce back off soil or a stop.
    pub rebound: f32,
    /// Below this pressure on the driven side there is no flow to move with, Pa.
    pub supplied_pa: f32,
    /// Above this pressure on the driven side an actuator may be stalled, Pa.
    pub stalled_pa: f32,
}

impl DiagnosisParameters {
    /// Of a machine with these full speeds (swing, boom, arm, bucket: extend, retract) and no other calibration.
    pub fn of_full_speeds(full_speeds: [[f32; 2]; 4]) -> Self {
        Self {
            actuators: full_speeds.map(|full_speed| ActuatorLimits::new(full_speed, 0.0001)),
            latest_start_s: 0.25,
            spool_lag_s: 0.1,
            run_on_s: 2.0,
            overshoot: 1.5,
            ring: 1.0,
            coupling: 2.0,
            rebound: 0.5,
            supplied_pa: 2e6,
            stalled_pa: 15e6,
        }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        for actuator in &self.actuators {
            for speed in actuator.full_speed {
                within("diagnosis.full_speed", speed, [0.001, 5.0])?;
            }
            within("diagnosis.noise", actuator.noise, [0.0, 0.01])?;
            // Closer, and noise would trip it.
            within("diagnosis.jump", actuator.jump, [10.0 * f64::from(actuator.noise) + 1e-6, 0.5])?;
            within("diagnosis.speed_margin", actuator.speed_margin, [200.0 * f64::from(actuator.noise), 5.0])?;
            within("diagnosis.stuck_travel", actuator.stuck_travel, [49.0 * f64::from(actuator.noise) + 1e-6, 0.5])?;
        }
        within("diagnosis.latest_start_s", self.latest_start_s, [0.02, 1.0])?;
        within("diagnosis.spool_lag_s", self.spool_lag_s, [0.01, 1.0])?;
        within("diagnosis.run_on_s", self.run_on_s, [0.1, 5.0])?;
        within("diagnosis.overshoot", self.overshoot, [0.0, 2.0])?;
        within("diagnosis.ring", self.ring, [0.0, 1.0])?;
        within("diagnosis.coupling", self.coupling, [0.0, 3.0])?;
        within("diagnosis.rebound", self.rebound, [0.0, self.ring.into()])?;
        within("diagnosis.supplied_pa", self.supplied_pa, [0.0, self.stalled_pa.into()])?;
        within("diagnosis.stalled_pa", self.stalled_pa, [1e6, 60e6])
    }
}
