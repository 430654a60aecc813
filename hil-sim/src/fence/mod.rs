//! How well a fence is kept: random operators on the simulated machine, with the whole linkage guarded, with the tip alone, and
//! without a fence.

mod random;
mod watch;

use kinematics_core::Machine;
use kinematics_core::planning::outline::Outline;
use rayon::prelude::*;
use serde::Serialize;

use crate::machine_file::MachineFile;
use crate::place::Host;
use crate::run::{Log, Run};
use crate::scenario::Scenario;

pub use random::Trial;
pub use watch::Watch;

/// What a fence checks, or that there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Every part of the linkage.
    Linkage,
    /// The teeth alone.
    Tip,
    /// No fence.
    None,
}

/// All kinds, as the table lists them.
pub const KINDS: [Kind; 3] = [Kind::Linkage, Kind::Tip, Kind::None];

/// What became of one random run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Smallest true clearance of the linkage to any plane or ball, m.
    pub closest_m: f64,
    /// Smallest true distance of the swing to an end of its range, rad.
    pub swing_room_rad: f64,
    /// Commanded motion, every actuator's in full speeds, times ticks.
    pub asked: f64,
    /// The part of it that was let through.
    pub through: f64,
    /// A fault stopped the run.
    pub fault: bool,
}

/// All runs of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tally {
    /// What was guarded.
    pub fence: Kind,
    /// Runs.
    pub runs: usize,
    /// Runs in which some part of the linkage went past a plane, into a ball or beyond the swing's range.
    pub violated: usize,
    /// The deepest of them past a plane or into a ball, mm.
    pub deepest_mm: f64,
    /// The smallest clearance of all runs, mm.
    pub closest_mm: f64,
    /// The smallest distance of the swing to an end of its range, degrees.
    pub swing_closest_deg: f64,
    /// Share of the commanded motion that was let through.
    pub let_through: f64,
    /// Runs ended by a fault.
    pub faults: usize,
}

impl Tally {
    /// Of these runs.
    pub fn new(fence: Kind, runs: &[Kept]) -> Self {
        let least = |of: fn(&Kept) -> f64| runs.iter().map(of).min_by(f64::total_cmp).unwrap_or(f64::INFINITY);
        let closest_m = least(|run| run.closest_m);
        let sum = |of: fn(&Kept) -> f64| runs.iter().map(of).sum::<f64>();
        Self {
            fence,
            runs: runs.len(),
            violated: runs.iter().filter(|run| run.closest_m < 0.0 || run.swing_room_rad < 0.0).count(),
            deepest_mm: if closest_m < 0.0 { -closest_m * 1e3 } else { 0.0 },
            closest_mm: closest_m * 1e3,
            swing_closest_deg: least(|run| run.swing_room_rad).to_degrees(),
            let_through: sum(|run| run.through) / sum(|run| run.asked),
            faults: runs.iter().filter(|run| run.fault).count(),
        }
    }
}

/// Why a campaign cannot run.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct CampaignError(String);

fn failed(error: impl std::fmt::Display) -> CampaignError {
    CampaignError(error.to_string())
}

/// Runs `runs` trials under each kind of fence, several at once; `done` hears of every one. Seed and machine determine every bit.
///
/// # Errors
/// The machine cannot be simulated.
pub fn campaign(
    machine: &MachineFile,
    runs: u32,
    seed: u64,
    done: impl Fn() + Sync,
) -> Result<[Tally; 3], CampaignError> {
    let trials = random::Trials::new(machine).map_err(CampaignError)?;
    let kept: Vec<[Kept; 3]> = (0..runs)
        .into_par_iter()
        .map(|index| {
            let trial = trials.trial(seed, index).map_err(CampaignError)?;
            let mut kept = KINDS.map(|_| None);
            for (slot, kind) in kept.iter_mut().zip(KINDS) {
                *slot = Some(run(&trial, kind)?);
            }
            done();
            let [Some(linkage), Some(tip), Some(none)] = kept else { return Err(failed("a run is missing")) };
            Ok([linkage, tip, none])
        })
        .collect::<Result<_, CampaignError>>()?;
    Ok([0, 1, 2].map(|i| Tally::new(KINDS[i], &kept.iter().map(|run| run[i]).collect::<Vec<_>>())))
}

/// One trial under one kind of fence.
///
/// # Errors
/// The trial cannot be simulated.
pub fn run(trial: &Trial, kind: Kind) -> Result<Kept, CampaignError> {
    let scenario = trial.with(kind);
    let run = Run::new(&scenario, trial.seed).map_err(failed)?;
    let mut host = Host::new(&scenario.parameters).map_err(failed)?;
    let log = run.complete(&mut host, |_, _| {}).map_err(failed)?;
    kept(&scenario, &trial.watch()?, &log)
}

fn kept(scenario: &Scenario, watch: &Watch, log: &Log) -> Result<Kept, CampaignError> {
    let full = scenario.parameters.coils.valves();
    let (mut asked, mut through) = (0.0, 0.0);
    for row in &log.rows {
        let pairs = row.outputs.asked.to_array().into_iter().zip(row.outputs.speeds.to_array());
        for ((wanted, let_through), [extend, retract]) in pairs.zip(full) {
            let full = f64::from(if wanted > 0.0 { extend.full_speed } else { retract.full_speed });
            asked += f64::from(wanted.abs()) / full;
            through += f64::from(let_through.abs()) / full;
        }
    }
    let (closest_m, swing_room_rad) =
        watch.over(log).ok_or_else(|| failed("the simulated machine left its strokes"))?;
    Ok(Kept { closest_m, swing_room_rad, asked, through, fault: !log.faults.is_empty() })
}

impl Trial {
    fn watch(&self) -> Result<Watch, CampaignError> {
        let fence = self.fence();
        let geometry = &self.scenario.machine.geometry;
        let machine = Machine::new(geometry).map_err(failed)?;
        let outline = Outline::new(geometry, &fence.outline).map_err(failed)?;
        Ok(Watch::new(machine, outline, fence))
    }
}
