//! Position sensors: 16 bit, with seeded Gaussian noise.

use firmware::parameters::PositionSensor;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// Seeded normal noise, the same on every platform.
#[derive(Clone, Debug)]
pub struct Noise {
    rng: ChaCha8Rng,
    spare: Option<f64>,
}

impl Noise {
    /// The noise of one run.
    pub fn new(seed: u64) -> Self {
        Self { rng: ChaCha8Rng::seed_from_u64(seed), spare: None }
    }

    /// Uniform in (0, 1].
    fn uniform(&mut self) -> f64 {
        ((self.rng.next_u64() >> 11) + 1) as f64 / (1_u64 << 53) as f64
    }

    /// Standard normal, by Box and Muller.
    pub fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let radius = libm::sqrt(-2.0 * libm::log(self.uniform()));
        let angle = core::f64::consts::TAU * self.uniform();
        self.spare = Some(radius * libm::sin(angle));
        radius * libm::cos(angle)
    }
}

/// The ADC code of a length (m) with this error added (m); saturates at the converter's ends.
pub fn code(sensor: &PositionSensor, length_m: f64, error_m: f64) -> u16 {
    let stroke = sensor.stroke;
    let span = f64::from(sensor.max_code) - f64::from(sensor.min_code);
    let fraction = (length_m + error_m - stroke.min_m) / (stroke.max_m - stroke.min_m);
    // The cast saturates.
    (f64::from(sensor.min_code) + fraction * span + 0.5) as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinematics_core::geometry::Stroke;

    const SENSOR: PositionSensor = PositionSensor {
        stroke: Stroke { min_m: 1.0, max_m: 2.0 },
        min_code: 3000,
        max_code: 62000,
        tolerance_codes: 500,
    };

    #[test]
    fn the_ends_of_the_stroke_read_the_end_codes() {
        assert_eq!(code(&SENSOR, 1.0, 0.0), 3000);
        assert_eq!(code(&SENSOR, 2.0, 0.0), 62000);
    }

    #[test]
    fn the_noise_is_normal_and_repeats_for_a_seed() {
        let mut noise = Noise::new(7);
        let samples: Vec<f64> = (0..100_000).map(|_| noise.normal()).collect();
        let mean = samples.iter().sum::<f64>() / 1e5;
        let variance = samples.iter().map(|x| x * x).sum::<f64>() / 1e5;
        assert!(mean.abs() < 0.01 && (variance - 1.0).abs() < 0.02, "mean {mean}, variance {variance}");
        let mut again = Noise::new(7);
        assert!(samples.iter().all(|&x| x == again.normal()));
        assert_ne!(Noise::new(8).normal(), samples[0]);
    }
}
