//! Hours of nominal work: random operators on a healthy machine, and whether the controller ever stops it.

use rayon::prelude::*;
use serde::Serialize;

use crate::dice::Dice;
use crate::faults::working_scenario;
use crate::machine_file::MachineFile;
use crate::place::Host;
use crate::run::Run;
use crate::scenario::{LeverMove, Scenario, Start, Task};

/// Length of one run, s: sixty make an hour.
pub const RUN_S: f64 = 60.0;

/// A fault named though nothing was wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trip {
    /// The run.
    pub run: u64,
    /// When in it, s.
    pub at_s: f64,
    /// What was named.
    pub fault: &'static str,
}

/// Turning round at full speed is no nominal work of a swing.
const OF_SWING: f64 = 0.5;
/// One operator in so many moves one lever at a time: then no other motion excuses what runs on or shakes.
const ONE_IN: u64 = 4;

/// How an operator works.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// Often several levers at once.
    Several,
    /// One lever, or none.
    OneAtATime,
}

impl Operator {
    /// Whose a minute is.
    pub fn of(run: u64) -> Self {
        if run % ONE_IN == ONE_IN - 1 { Self::OneAtATime } else { Self::Several }
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: String,
    /// Seed of all runs.
    pub seed: u64,
    /// Simulated hours.
    pub hours: f64,
    /// The cylinders' way together, m: that it was work.
    pub travel_m: f64,
    /// Every trip.
    pub trips: Vec<Trip>,
}

/// Runs of a number of hours.
pub fn runs(hours: u32) -> u64 {
    u64::from(hours) * (3600.0 / RUN_S) as u64
}

/// Lets random operators work these minutes; `done` is called after each. A minute is the same in any company.
///
/// # Errors
/// The machine cannot be simulated.
pub fn soak(machine: &MachineFile, seed: u64, minutes: Vec<u64>, done: impl Fn() + Sync) -> Result<Report, String> {
    let count = minutes.len();
    let found: Vec<(f64, Option<Trip>)> = minutes
        .into_par_iter()
        .map(|run| {
            let found = work(machine, seed, run, Operator::of(run))?;
            done();
            Ok(found)
        })
        .collect::<Result<_, String>>()?;
    Ok(Report {
        machine: machine.name.clone(),
        seed,
        hours: count as f64 * RUN_S / 3600.0,
        travel_m: found.iter().map(|(travel, _)| travel).sum(),
        trips: found.into_iter().filter_map(|(_, trip)| trip).collect(),
    })
}

/// One operator's minute, and the seed of its noise: start, payload and levers drawn from the case alone.
///
/// # Errors
/// The machine cannot be simulated.
pub fn minute(machine: &MachineFile, seed: u64, run: u64, operator: Operator) -> Result<(Scenario, u64), String> {
    let case = seed ^ (run << 20) ^ 0x50_a4;
    let mut dice = Dice::new(case);
    let g = &machine.geometry;
    let mut place = |stroke: kinematics_core::geometry::Stroke| {
        stroke.min_m + dice.within(0.2, 0.8) * (stroke.max_m - stroke.min_m)
    };
    let (boom_m, arm_m, bucket_m) = (place(g.boom.stroke), place(g.arm.stroke), place(g.bucket.stroke));
    let start = Start { swing_deg: 0.0, boom_m, arm_m, bucket_m };
    let payload_kg = dice.within(0.0, 1000.0);
    let mut scenario = working_scenario(machine, start, RUN_S, payload_kg)?;
    let moves = match operator {
        Operator::Several => several,
        Operator::OneAtATime => one_at_a_time,
    }(&mut dice, scenario.begin_s);
    scenario.task = Task::Levers { start, moves };
    Ok((scenario, case))
}

/// One operator's minute: the way of the cylinders, m, and the first fault.
///
/// # Errors
/// The machine cannot be simulated.
pub fn work(machine: &MachineFile, seed: u64, run: u64, operator: Operator) -> Result<(f64, Option<Trip>), String> {
    let (scenario, case) = minute(machine, seed, run, operator)?;
    let mut host = Host::new(&scenario.parameters).map_err(|error| error.to_string())?;
    let run_ = Run::new(&scenario, case).map_err(|error| error.to_string())?;
    let log = run_.complete(&mut host, |_, _| {}).map_err(|error| error.to_string())?;
    let travel = log.rows.windows(2).map(|pair| {
        let (a, b) = (pair[0].lengths, pair[1].lengths);
        (a.boom - b.boom).abs() + (a.arm - b.arm).abs() + (a.bucket - b.bucket).abs()
    });
    let trip = log.faults.first().map(|fault| Trip { run, at_s: fault.at_s, fault: fault.fault.name() });
    Ok((travel.sum(), trip))
}

/// Levers held for 0.3 to 4 s, often several at once, a third of them at rest, a fifth of the others full; against the stops too.
fn several(dice: &mut Dice, begin_s: f64) -> Vec<LeverMove> {
    held(dice, begin_s, |dice, [at_s, until_s]| {
        let mut lever = || match (dice.within(-1.0, 1.0), dice.with_chance(0.35)) {
            (_, true) => 0.0,
            (deflection, _) => often_full(dice, deflection),
        };
        let (swing, boom, arm, bucket) = (lever(), lever(), lever(), lever());
        LeverMove { at_s, until_s, swing: OF_SWING * swing, boom, arm, bucket }
    })
}

/// One lever held for 0.3 to 4 s, or none, and another.
fn one_at_a_time(dice: &mut Dice, begin_s: f64) -> Vec<LeverMove> {
    held(dice, begin_s, |dice, [at_s, until_s]| {
        let deflection = dice.within(-1.0, 1.0);
        let deflection = often_full(dice, deflection);
        let mut levers = [0.0; 5];
        if let Some(lever) = levers.get_mut(dice.within(0.0, 5.0) as usize) {
            *lever = deflection;
        }
        let [swing, boom, arm, bucket, _] = levers;
        LeverMove { at_s, until_s, swing: OF_SWING * swing, boom, arm, bucket }
    })
}

fn often_full(dice: &mut Dice, deflection: f64) -> f64 {
    if dice.with_chance(0.2) { deflection.signum() } else { deflection }
}

fn held(dice: &mut Dice, begin_s: f64, lever_move: impl Fn(&mut Dice, [f64; 2]) -> LeverMove) -> Vec<LeverMove> {
    let mut moves = Vec::new();
    let mut at_s = begin_s;
    while at_s < RUN_S - 1.0 {
        let until_s = (at_s + dice.within(0.3, 4.0)).min(RUN_S - 1.0);
        moves.push(lever_move(dice, [at_s, until_s]));
        at_s = until_s;
    }
    moves
}
