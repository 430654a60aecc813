//! End cushions: near the end of the stroke the oil that leaves has to pass a narrowing gap, whether to the valve's edge or to the port relief
//! valve, which sits at the valve.

/// The cushion at one end of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cushion {
    /// Where it begins, m before the stop; 0 for none.
    pub length_m: f64,
    /// Conductance of the gap at the stop, m³/s/√Pa.
    pub gap: f64,
}

/// Times the gap at the stop that it is wide where the cushion begins. In between it narrows with the root of the way left: so a mass is
/// braked evenly, at one pressure.
const ENTRY: f64 = 14.0;

impl Cushion {
    /// Conductance of the gap with `left_m` to go to the stop; infinite before the cushion.
    pub fn gap(&self, left_m: f64) -> f64 {
        if left_m >= self.length_m {
            return f64::INFINITY;
        }
        let share = if left_m > 0.0 { left_m / self.length_m } else { 0.0 };
        self.gap * (1.0 + (ENTRY - 1.0) * libm::sqrt(share))
    }
}

#[cfg(test)]
mod tests {
    use super::super::metering::in_series;
    use super::*;

    #[test]
    fn it_narrows_towards_the_stop_and_not_before_its_length() {
        let cushion = Cushion { length_m: 0.1, gap: 1e-7 };
        let k = |left| in_series(2e-6, cushion.gap(left));
        assert_eq!(k(0.1), 2e-6);
        assert!(k(0.09) > k(0.05) && k(0.05) > k(0.01) && k(0.0) < 1e-7 && k(0.0) > 0.9e-7);
    }
}
