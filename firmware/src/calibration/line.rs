//! Mean and slope of evenly spaced samples, as they come.

/// A window of samples under way. Values are taken relative to the first, so that f32 loses nothing of small motions.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    first: f32,
    count: u32,
    sum: f32,
    /// Σ of index · value.
    moment: f32,
}

impl Line {
    pub(super) fn add(&mut self, value: f32) {
        if self.count == 0 {
            self.first = value;
        }
        let relative = value - self.first;
        self.sum += relative;
        self.moment += self.count as f32 * relative;
        self.count += 1;
    }

    pub(super) const fn count(&self) -> u32 {
        self.count
    }

    /// Their mean; of none, 0.
    pub(super) fn mean(&self) -> f32 {
        if self.count == 0 { 0.0 } else { self.first + self.sum / self.count as f32 }
    }

    /// Least-squares slope, a sample; of fewer than two, 0.
    pub(super) fn slope(&self) -> f32 {
        if self.count < 2 {
            return 0.0;
        }
        let n = self.count as f32;
        let middle = 0.5 * (n - 1.0);
        (self.moment - middle * self.sum) / (n * (n * n - 1.0) / 12.0)
    }
}
