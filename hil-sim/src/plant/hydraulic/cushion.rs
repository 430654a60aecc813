//! End cushions: near the end of the stroke the oil that leaves has to pass a narrowing gap.

use super::metering::in_series;

/// The cushion at one end of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cushion {
    /// Where it begins, m before the stop; 0 for none.
    pub length_m: f64,
    /// Conductance of the gap at the stop, m³/s/√Pa.
    pub gap: f64,
}

/// Times the gap at the stop that it is wide where the cushion begins.
const ENTRY: f64 = 60.0;

impl Cushion {
    /// What is left of an opening's conductance with `left_m` to go to the stop.
    pub fn narrow(&self, k: f64, left_m: f64) -> f64 {
        if left_m >= self.length_m {
            return k;
        }
        let share = if left_m > 0.0 { left_m / self.length_m } else { 0.0 };
        in_series(k, self.gap * (1.0 + (ENTRY - 1.0) * share * share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_narrows_towards_the_stop_and_not_before_its_length() {
        let cushion = Cushion { length_m: 0.1, gap: 1e-7 };
        let k = |left| cushion.narrow(2e-6, left);
        assert_eq!(k(0.1), 2e-6);
        assert!(k(0.09) > k(0.05) && k(0.05) > k(0.01) && k(0.0) < 1e-7 && k(0.0) > 0.9e-7);
    }
}
