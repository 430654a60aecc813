//! The true tip against the path.

use firmware::State;

use crate::run::{FaultSeen, Log, Row};

/// What a run leaves of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Deviation {
    /// Distances to the path at every tick of the motion and of the second in which it settles, squared and summed, m².
    pub(super) squares: f64,
    /// Ticks.
    pub(super) ticks: usize,
    /// Largest distance, m.
    pub(super) max_m: f64,
    /// 95th percentile of the run, m.
    pub(super) p95_m: f64,
    /// When the tip was that far off, s.
    pub(super) max_at_s: f64,
    /// What stopped it.
    pub(super) fault: Option<FaultSeen>,
    /// From the path's end at last, m.
    pub(super) to_end_m: f64,
    /// No coil changed its current in the last second, which is after the path has let go of them.
    pub(super) still: bool,
}

/// Near enough to the end, m.
pub(super) const THERE_M: f64 = 0.05;

impl Deviation {
    /// Root of the mean square, m.
    pub(super) fn rmse_m(&self) -> f64 {
        libm::sqrt(self.squares / self.ticks as f64)
    }
}

pub(super) fn deviation(log: &Log, corners: &[[f64; 2]]) -> Option<Deviation> {
    let on_path = |row: &&Row| row.outputs.state == State::Running && row.outputs.dig_tick > 1;
    let far = |row: &Row| Some((distance(row.tip?, corners), row.time_s));
    let mut off: Vec<(f64, f64)> = log.rows.iter().filter(on_path).filter_map(far).collect();
    let end = *corners.last()?;
    let last = log.rows.last()?;
    let to_end = last.tip.map(|[x, z]| libm::hypot(end[0] - x, end[1] - z))?;
    let rest = log.rows.iter().rev().take(1000);
    let still = rest.map(|row| row.outputs.currents).all(|currents| currents == last.outputs.currents);
    off.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |share: f64| off.get(((off.len() as f64 - 1.0) * share + 0.5) as usize).copied();
    Some(Deviation {
        squares: off.iter().map(|(d, _)| d * d).sum(),
        ticks: off.len(),
        max_m: at(1.0)?.0,
        p95_m: at(0.95)?.0,
        max_at_s: at(1.0)?.1,
        fault: log.faults.first().copied(),
        to_end_m: to_end,
        still,
    })
}

/// Distance from a point to the nearest segment.
fn distance(point: [f64; 2], corners: &[[f64; 2]]) -> f64 {
    let to = |pair: &[[f64; 2]]| {
        let [[ax, az], [bx, bz]] = [pair[0], pair[1]];
        let (dx, dz, px, pz) = (bx - ax, bz - az, point[0] - ax, point[1] - az);
        let along = ((px * dx + pz * dz) / (dx * dx + dz * dz)).clamp(0.0, 1.0);
        libm::hypot(px - along * dx, pz - along * dz)
    };
    corners.windows(2).map(to).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::distance;

    #[test]
    fn the_distance_is_normal_to_a_segment_and_round_its_corners() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        assert_eq!(distance([0.5, 0.2], &corners), 0.2);
        assert_eq!(distance([1.3, 0.5], &corners), 0.30000000000000004);
        assert_eq!(distance([-0.3, -0.4], &corners), 0.5);
        assert_eq!(distance([1.0, 1.0], &corners), 0.0);
    }
}
