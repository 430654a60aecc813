//! The ground before the machine: heights over the reach, cut by the bucket's tip as it passes.

/// Distance of the samples, m.
const CELL_M: f64 = 0.05;

/// Heights over the reach from the swing axis, m above the boom pin.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    heights: Vec<f64>,
}

impl Ground {
    /// Level ground at a height, out to a reach.
    pub fn level(height_m: f64, reach_m: f64) -> Self {
        Self { heights: vec![height_m; (reach_m / CELL_M) as usize + 2] }
    }

    /// Height at a reach; beyond the ends that of the end.
    pub fn height(&self, reach_m: f64) -> f64 {
        let place = (reach_m / CELL_M).clamp(0.0, (self.heights.len() - 1) as f64);
        let cell = (place as usize).clamp(0, self.heights.len() - 2);
        let share = place - cell as f64;
        self.heights[cell] + share * (self.heights[cell + 1] - self.heights[cell])
    }

    /// Takes away what stands above the line from one point to another; returns the area taken, m².
    pub fn cut(&mut self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let (left, right) = if from[0] < to[0] { (from, to) } else { (to, from) };
        let first = libm::ceil(left[0] / CELL_M);
        let run = right[0] - left[0];
        let mut area = 0.0;
        let mut cell = if first > 0.0 { first } else { 0.0 };
        while cell * CELL_M <= right[0] && (cell as usize) < self.heights.len() {
            let share = if run > 0.0 { (cell * CELL_M - left[0]) / run } else { 0.0 };
            let line = left[1] + share * (right[1] - left[1]);
            let height = &mut self.heights[cell as usize];
            if *height > line {
                area += (*height - line) * CELL_M;
                *height = line;
            }
            cell += 1.0;
        }
        area
    }

    /// The samples as reach and height, m.
    pub fn profile(&self) -> impl Iterator<Item = [f64; 2]> {
        self.heights.iter().enumerate().map(|(i, &height)| [i as f64 * CELL_M, height])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_lowers_the_ground_once() {
        let mut ground = Ground::level(-1.0, 10.0);
        let area = ground.cut([6.0, -1.2], [5.0, -1.2]);
        assert!((area - 0.2).abs() < 0.011, "{area}");
        assert!((ground.height(5.5) + 1.2).abs() < 1e-12 && (ground.height(4.0) + 1.0).abs() < 1e-12);
        assert_eq!(ground.cut([6.0, -1.2], [5.0, -1.2]), 0.0);
        assert_eq!(ground.cut([6.0, -0.5], [5.0, -0.5]), 0.0);
        assert_eq!(ground.height(99.0), -1.0);
    }
}
