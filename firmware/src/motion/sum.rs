//! A sum of many small steps that loses none of them.

/// Compensated summation: `low` holds what rounding took from `high`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    high: f32,
    low: f32,
}

impl Sum {
    pub(super) const fn new(value: f32) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// Adds a step smaller than the sum.
    #[inline]
    pub(super) fn add(&mut self, step: f32) {
        let step = step + self.low;
        let sum = self.high + step;
        self.low = step - (sum - self.high);
        self.high = sum;
    }

    #[inline]
    pub(super) fn value(&self) -> f32 {
        self.high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousandth_of_a_millimetre_a_second_arrives() {
        let mut sum = Sum::new(8.0);
        for _ in 0..1_000_000 {
            sum.add(1e-9);
        }
        assert!((sum.value() - 8.001).abs() < 2e-6, "{}", sum.value());
    }
}
