//! How far the true tip of a run was from the straight lines it should have gone along.

use hil_sim::place::Host;
use hil_sim::run::{Log, Run};
use hil_sim::scenario::Scenario;

/// A run on the host; it may not fail.
pub fn run(scenario: &Scenario, seed: u64) -> Log {
    let mut host = Host::new(&scenario.parameters).unwrap_or_else(|error| panic!("{}: {error}", scenario.name));
    let run = Run::new(scenario, seed).unwrap_or_else(|error| panic!("{}: {error}", scenario.name));
    run.complete(&mut host, |_, _| ()).unwrap_or_else(|error| panic!("{}: {error}", scenario.name))
}

/// Errors across the way, m.
#[derive(Clone, Copy, Debug)]
pub struct Across {
    /// Root mean square.
    pub rms_m: f64,
    /// Largest.
    pub max_m: f64,
    /// Ticks looked at.
    pub ticks: usize,
}

/// The tip's distance from the nearest of the path's segments, while it is followed.
pub fn across_path(scenario: &Scenario, log: &Log) -> Across {
    let path = scenario.parameters.path.expect("a path");
    let knots: Vec<[f64; 2]> = path.knots.iter().flatten().map(|knot| [knot.x_m, knot.z_m]).collect();
    across(log, |tip| knots.windows(2).map(|ends| from_segment(tip, ends[0], ends[1])).fold(f64::INFINITY, f64::min))
}

/// The same of any distance.
pub fn across(log: &Log, distance: impl Fn([f64; 2]) -> f64) -> Across {
    let followed = log.rows.iter().filter(|row| row.outputs.dig_tick > 0);
    let errors: Vec<f64> = followed.filter_map(|row| row.tip.map(&distance)).collect();
    assert!(!errors.is_empty(), "nothing was followed");
    let square_sum: f64 = errors.iter().map(|e| e * e).sum();
    Across {
        rms_m: libm::sqrt(square_sum / errors.len() as f64),
        max_m: errors.iter().fold(0.0, |worst, e| if e.abs() > worst { e.abs() } else { worst }),
        ticks: errors.len(),
    }
}

fn from_segment([x, z]: [f64; 2], [x0, z0]: [f64; 2], [x1, z1]: [f64; 2]) -> f64 {
    let (dx, dz) = (x1 - x0, z1 - z0);
    let square = dx * dx + dz * dz;
    let share = if square > 0.0 { ((x - x0) * dx + (z - z0) * dz) / square } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    libm::hypot(x - (x0 + share * dx), z - (z0 + share * dz))
}
