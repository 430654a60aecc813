//! From rest to rest over one unit of way: how far at which time, with an acceleration that begins and ends at zero.

use kinematics_core::Real;

/// Speed rises as `u²(3 − 2u)` over the ramp, stays, and falls likewise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profile {
    /// Largest speed, 1/s.
    top: f32,
    ramp_s: f32,
    one_over_ramp: f32,
    duration_s: f32,
}

/// The steepest place of `u²(3 − 2u)`.
const STEEPEST: f64 = 1.5;

impl Profile {
    /// Within a largest speed, 1/s, and acceleration, 1/s², both positive.
    pub(super) fn new(speed: f64, acceleration: f64) -> Self {
        let ramp_s = STEEPEST * speed / acceleration;
        // On a short way the ramps meet: what they cover, speed times ramp, is all of it.
        let (top, ramp_s) = if speed * ramp_s <= 1.0 {
            (speed, ramp_s)
        } else {
            let top = Real::sqrt(acceleration / STEEPEST);
            (top, 1.0 / top)
        };
        Self {
            top: top as f32,
            ramp_s: ramp_s as f32,
            one_over_ramp: (1.0 / ramp_s) as f32,
            duration_s: (ramp_s + 1.0 / top) as f32,
        }
    }

    /// When it ends, s.
    pub(super) fn duration_s(&self) -> f32 {
        self.duration_s
    }

    /// Way and speed (1/s) at a time, s.
    #[inline]
    pub(super) fn at(&self, time_s: f32) -> (f32, f32) {
        let left_s = self.duration_s - time_s;
        let half = 0.5 * self.top * self.ramp_s;
        let ramp = |time_s: f32| {
            let u = time_s * self.one_over_ramp;
            let square = u * u;
            (half * (square * u * (2.0 - u)), self.top * (square * (3.0 - 2.0 * u)))
        };
        if left_s <= 0.0 {
            (1.0, 0.0)
        } else if left_s < self.ramp_s {
            let (left, speed) = ramp(left_s);
            (1.0 - left, speed)
        } else if time_s < self.ramp_s {
            ramp(time_s)
        } else {
            (half + self.top * (time_s - self.ramp_s), self.top)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn way_is_the_sum_of_speed_and_both_stay_within_their_limits() {
        for (speed, acceleration) in [(0.1, 0.2), (0.5, 10.0), (3.0, 0.7), (1.0, 1.5)] {
            let profile = Profile::new(speed, acceleration);
            let step_s = profile.duration_s() / 20_000.0;
            let (mut sum, mut before) = (0.0_f64, 0.0_f32);
            for tick in 0..=20_000 {
                let (way, rate) = profile.at(tick as f32 * step_s);
                assert!((f64::from(way) - sum).abs() < 2e-4, "{speed} {acceleration} {tick}: {way} {sum}");
                assert!(f64::from(rate) <= speed * 1.000_001);
                assert!(f64::from((rate - before) / step_s).abs() <= acceleration * 1.01 + 1e-2, "{tick}");
                sum += f64::from(rate * step_s);
                before = rate;
            }
            assert_eq!(profile.at(profile.duration_s()), (1.0, 0.0));
        }
    }
}
