//! The campaign's table.

use std::collections::BTreeMap;

use serde::Serialize;

use super::kind::{Cause, ELSEWHERE, KINDS, Kind};
use super::situation::Situation;
use super::trial::Found;

/// Median, 99th percentile, largest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Median.
    pub p50: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values.get(((values.len() - 1) as f64 * share + 0.5) as usize).copied();
        (!values.is_empty()).then_some(())?;
        Some(Self { p50: at(0.5)?, p99: at(0.99)?, max: at(1.0)? })
    }
}

/// A fault's row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The fault.
    pub name: &'static str,
    /// Runs in which it could be seen or was.
    pub runs: usize,
    /// Runs in which nothing of it could ever be seen, and nothing was.
    pub never_observable: usize,
    /// It was named and the machine stopped.
    pub detected: usize,
    /// It could be seen, and was not.
    pub undetected: usize,
    /// Longest wait from the fault to the first tick at which it can be seen, ms.
    pub observable_ms: Option<f64>,
    /// From there to the tick that names it, ms.
    pub detect_ms: Option<Spread>,
    /// The tip's way from where it can be seen to standstill, mm.
    pub tip_travel_mm: Option<Spread>,
    /// What is promised, ms.
    pub bound_ms: Option<f64>,
    /// Whether every run kept it.
    pub bound_held: Option<bool>,
    /// What it was named, how often.
    pub named: BTreeMap<&'static str, usize>,
    /// Why nothing is promised, or what the bound is made of.
    pub reason: Option<&'static str>,
}

/// The campaign's outcome.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: String,
    /// Seed of all cases.
    pub seed: u64,
    /// Runs, healthy ones included.
    pub runs: usize,
    /// Healthy runs.
    pub healthy: usize,
    /// Runs in which a fault was named though nothing was wrong yet.
    pub false_trips: usize,
    /// What they named, and in which situation.
    pub false_trips_named: Vec<(&'static str, Situation)>,
    /// A row a fault.
    pub faults: Vec<Row>,
}

impl Report {
    pub(super) fn of(machine: &str, seed: u64, found: &[Found]) -> Self {
        let faults = KINDS.iter().enumerate();
        Self {
            machine: machine.to_owned(),
            seed,
            runs: found.len(),
            healthy: found.iter().filter(|found| found.kind.is_none()).count(),
            false_trips: found.iter().filter(|found| found.false_trip).count(),
            false_trips_named: found
                .iter()
                .filter(|found| found.false_trip)
                .filter_map(|found| Some((found.named?, found.situation)))
                .collect(),
            faults: faults
                .map(|(index, kind)| {
                    let of_kind = |found: &&Found| found.kind == Some(index) && !found.false_trip;
                    row(kind, &found.iter().filter(of_kind).copied().collect::<Vec<_>>())
                })
                .chain(ELSEWHERE.iter().map(elsewhere))
                .collect(),
        }
    }

    /// Every promised bound holds, and nothing tripped that was healthy.
    pub fn holds(&self) -> bool {
        self.false_trips == 0 && self.faults.iter().all(|row| row.bound_held != Some(false))
    }
}

/// The row of a fault that is tried elsewhere: no runs, and where.
fn elsewhere(&(name, reason): &(&'static str, &'static str)) -> Row {
    row(&Kind { name, cause: Cause::Record, bound_ms: None, reason: Some(reason) }, &[])
}

fn row(kind: &Kind, found: &[Found]) -> Row {
    let ms = |values: Vec<f64>| Spread::of(values.into_iter().map(|s| (s * 1e6).round() / 1e3).collect());
    let detected = found.iter().filter(|found| found.detected_s.is_some()).count();
    let undetected = found.iter().filter(|found| found.wait_s.is_some() && found.detected_s.is_none()).count();
    let detect_ms = ms(found.iter().filter_map(|found| found.detected_s).collect());
    let held = |bound_ms: f64| undetected == 0 && detect_ms.is_none_or(|spread| spread.max <= bound_ms);
    Row {
        name: kind.name,
        runs: detected + undetected,
        never_observable: found.len() - detected - undetected,
        detected,
        undetected,
        observable_ms: ms(found.iter().filter_map(|found| found.wait_s).collect()).map(|spread| spread.max),
        detect_ms,
        tip_travel_mm: ms(found.iter().filter_map(|found| found.travel_m).collect()),
        bound_ms: kind.bound_ms,
        bound_held: kind.bound_ms.map(held),
        named: found.iter().filter_map(|found| found.named).fold(BTreeMap::new(), |mut named, name| {
            *named.entry(name).or_default() += 1;
            named
        }),
        reason: kind.reason,
    }
}
