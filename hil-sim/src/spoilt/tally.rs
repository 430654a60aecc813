//! The campaign's table.

use std::collections::BTreeMap;

use firmware::simulated::link::Zone;
use serde::Serialize;

use super::trial::{Came, Found, What};

/// What a row is of.
const KINDS: [(What, &str); 5] = [
    (What::Bit(Zone::Watched), "bit_of_watched_constants"),
    (What::Bit(Zone::State), "bit_of_controller_state"),
    (What::Bit(Zone::Followers), "bit_of_planned_motion"),
    (What::OneTick, "one_tick_lost"),
    (What::Timer, "timer_lost"),
];

/// A row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// What was spoilt.
    pub name: &'static str,
    /// Runs.
    pub runs: usize,
    /// Every duty of every tick as if nothing had happened.
    pub no_effect: usize,
    /// Outputs off.
    pub off: usize,
    /// By what, how often.
    pub off_by: BTreeMap<&'static str, usize>,
    /// The longest wait for it, ms.
    pub off_ms: Option<u32>,
    /// Other duties, but the tip within [`super::SLIGHT_M`] of where it would have been.
    pub slight: usize,
    /// Elsewhere, and not noticed.
    pub astray: usize,
    /// The farthest that the tip was from where it would have been with the outputs on, mm.
    pub astray_mm: f64,
}

/// A run that went astray, and nobody noticed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unseen {
    /// The case: `--shard` with it and the number of all cases runs it alone.
    pub case: u64,
    /// The scenario it was in.
    pub scenario: &'static str,
    /// How far the tip was from where it would have been, mm.
    pub astray_mm: f64,
}

/// The campaign's outcome.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Seed of all cases.
    pub seed: u64,
    /// Runs.
    pub runs: usize,
    /// The most instructions that the watch over the constants took in a tick, once it had begun.
    pub watch_instructions: Option<u32>,
    /// A row for each thing that was spoilt.
    pub rows: Vec<Row>,
    /// What went astray unseen.
    pub unseen: Vec<Unseen>,
}

impl Report {
    pub(super) fn of(seed: u64, found: &[Found]) -> Self {
        let row = |&(what, name): &(What, &'static str)| {
            row(name, &found.iter().filter(|found| found.what == what).collect::<Vec<_>>())
        };
        Self {
            seed,
            runs: found.len(),
            watch_instructions: found.iter().filter_map(|found| found.watch_instructions).max(),
            rows: KINDS.iter().map(row).collect(),
            unseen: found.iter().filter(|found| matches!(found.came, Came::Astray { .. })).map(unseen).collect(),
        }
    }

    /// What is promised holds: a turned bit of a watched constant goes nowhere unseen, a lost timer ends with the outputs off, one lost tick does
    /// nothing much.
    pub fn holds(&self) -> bool {
        self.rows.iter().all(|row| match row.name {
            "bit_of_watched_constants" | "timer_lost" => row.off == row.runs,
            "one_tick_lost" => row.astray == 0,
            _ => true,
        })
    }
}

fn unseen(found: &Found) -> Unseen {
    Unseen { case: found.case, scenario: found.scenario, astray_mm: mm(found.astray_m) }
}

/// To a tenth, mm.
fn mm(m: f64) -> f64 {
    (m * 1e4).round() / 10.0
}

fn row(name: &'static str, found: &[&Found]) -> Row {
    let count = |of: fn(&Came) -> bool| found.iter().filter(|found| of(&found.came)).count();
    let offs = || {
        found.iter().filter_map(|found| match found.came {
            Came::Off { by, after } => Some((by, after)),
            _ => None,
        })
    };
    let farthest_m = found.iter().map(|found| found.astray_m).fold(0.0, f64::max);
    Row {
        name,
        runs: found.len(),
        no_effect: count(|came| matches!(came, Came::Nothing)),
        off: offs().count(),
        off_by: offs().fold(BTreeMap::new(), |mut by, (what, _)| {
            *by.entry(what).or_default() += 1;
            by
        }),
        off_ms: offs().map(|(_, after)| after).max(),
        slight: count(|came| matches!(came, Came::Slight { .. })),
        astray: count(|came| matches!(came, Came::Astray { .. })),
        astray_mm: mm(farthest_m),
    }
}
