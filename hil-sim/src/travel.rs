//! A dig against reach and travel limits, in f64, before anything moves: every violation with cylinder, time and amount.

use firmware::TICKS_PER_S;
use firmware::dig::Dig;
use kinematics_core::geometry::Stroke;
use kinematics_core::{Machine, PinGeometry, PoseError};
use serde::Serialize;

/// A stretch of the dig that one cylinder spends outside its travel limits, or the whole machine out of reach.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Violation {
    /// `boom`, `arm`, `bucket`; for points out of reach or without assembly, `reach` or `bucket_linkage`.
    pub cylinder: &'static str,
    /// First moment, s.
    pub from_s: f64,
    /// Last moment, s.
    pub until_s: f64,
    /// Worst moment, s.
    pub worst_s: f64,
    /// Amount at the worst moment, m: positive beyond the maximum, negative below the minimum.
    pub by_m: f64,
}

impl std::fmt::Display for Violation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { cylinder, from_s, until_s, worst_s, by_m } = self;
        write!(f, "{cylinder}: {from_s:.3}…{until_s:.3} s, worst {:+.1} mm at {worst_s:.3} s", by_m * 1e3)
    }
}

fn outside(stroke: Stroke, length: f64) -> Option<f64> {
    let tolerance = kinematics_core::STROKE_TOLERANCE_M;
    if length > stroke.max_m + tolerance {
        Some(length - stroke.max_m)
    } else if length < stroke.min_m - tolerance {
        Some(length - stroke.min_m)
    } else {
        None
    }
}

/// Collects runs of consecutive moments into violations.
#[derive(Default)]
struct Runs {
    done: Vec<Violation>,
    open: Vec<Violation>,
}

impl Runs {
    fn note(&mut self, cylinder: &'static str, time_s: f64, by_m: Option<f64>) {
        let at = self.open.iter().position(|v| v.cylinder == cylinder);
        match (at, by_m) {
            (None, Some(by_m)) => {
                self.open.push(Violation { cylinder, from_s: time_s, until_s: time_s, worst_s: time_s, by_m });
            }
            (Some(i), Some(by_m)) => {
                let run = &mut self.open[i];
                run.until_s = time_s;
                if by_m.abs() > run.by_m.abs() {
                    (run.worst_s, run.by_m) = (time_s, by_m);
                }
            }
            (Some(i), None) => self.done.push(self.open.remove(i)),
            (None, None) => {}
        }
    }

    fn finish(mut self) -> Vec<Violation> {
        self.done.append(&mut self.open);
        self.done.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
        self.done
    }
}

/// Every violation of the dig, tried at every control tick, in the order of time.
pub fn violations(geometry: &PinGeometry, machine: &Machine<f64>, dig: &Dig<f64>) -> Vec<Violation> {
    let ticks = (dig.duration() * f64::from(TICKS_PER_S) + 0.5) as u32;
    let mut runs = Runs::default();
    for tick in 0..=ticks {
        let time_s = f64::from(tick) / f64::from(TICKS_PER_S);
        let (mut boom, mut arm, mut bucket, mut linkage, mut reach) = (None, None, None, None, None);
        match machine.tip_to_joints(&dig.tip(time_s)).and_then(|j| machine.joints_to_cylinders_any_stroke(&j)) {
            Ok(lengths) => {
                boom = outside(geometry.boom.stroke, lengths.boom);
                arm = outside(geometry.arm.stroke, lengths.arm);
                bucket = outside(geometry.bucket.stroke, lengths.bucket);
            }
            Err(PoseError::Unreachable { by }) => reach = Some(by),
            Err(PoseError::NoAssembly { by, .. } | PoseError::OutOfStroke { by, .. }) => linkage = Some(by),
        }
        let found = [("boom", boom), ("arm", arm), ("bucket", bucket), ("bucket_linkage", linkage), ("reach", reach)];
        for (cylinder, by) in found {
            runs.note(cylinder, time_s, by);
        }
    }
    runs.finish()
}
