//! One run with one fault.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

use super::kind::{Cause, KINDS};
use super::record;
use super::situation::{self, BEGIN_S, DURATION_S, Mover, Situation};
use super::spoil::Spoiler;
use crate::machine_file::MachineFile;
use crate::place::Host;
use crate::plant::Defect;
use crate::run::{Log, Row, Run};
use crate::scenario::Scenario;

/// A cylinder this far from where it would be without the fault can be seen to be elsewhere, m.
const ASTRAY_M: f64 = 0.01;
const TICK_S: f64 = 0.001;
/// The latest a released healthy cylinder begins to slow down: a dead time of 250 ms, which the controller's window covers to within 102 ms, s.
const LATEST_S: f64 = 0.352;
/// It comes to rest 2 s after the release, less the dead time, s.
const FALL_S: f64 = 1.75;
/// What measured speed may be wrong by, m/s.
const MARGIN_MPS: f64 = 0.03;
/// Half a swing of a mass that rings at 1.45 Hz, s.
const HALF_SWING_S: f64 = 0.344;

/// What came of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    /// Index into [`KINDS`]; `None` of a healthy run.
    pub(super) kind: Option<usize>,
    /// From the fault to the first tick at which it can be seen, s; `None` when it never could.
    pub(super) wait_s: Option<f64>,
    /// From there to the tick that stopped the machine, s.
    pub(super) detected_s: Option<f64>,
    /// The tip's way from where the fault could be seen to where it stands at the end, m.
    pub(super) travel_m: Option<f64>,
    /// What was named.
    pub(super) named: Option<&'static str>,
    /// What the machine was doing.
    pub(super) situation: Situation,
    /// A fault was named before anything was wrong.
    pub(super) false_trip: bool,
}

/// Case `index` of the campaign of `seed`: the same whatever else is run.
pub(super) fn run(machine: &MachineFile, seed: u64, index: u64) -> Result<Found, String> {
    let rows = KINDS.len() as u64 + 1;
    let situations = Situation::ALL.len() as u64;
    let kind = (index % rows).checked_sub(1).map(|kind| kind as usize);
    let situation = Situation::ALL[(index / rows % situations) as usize];
    let case = seed ^ (index << 20);
    let mut dice = ChaCha8Rng::seed_from_u64(case);
    let mut below = |n: u32| dice.next_u32() % n;
    let mover = Mover { spool: 1 + below(3) as usize, side: below(2) as usize };
    // Long enough after the start for the motion to be steady, long enough before the end for standstill.
    let from_s = BEGIN_S + 0.9 + f64::from(below(400)) * 0.001;
    // A spool that sticks open shows when it should close.
    let released_s = match kind.map(|kind| KINDS[kind].cause) {
        Some(Cause::Spool(Defect::Stuck)) => from_s + 0.3,
        _ => DURATION_S,
    };
    let scenario = situation::scenario(machine, situation, mover, released_s)?;
    let Some(kind) = kind else {
        let log = complete(&scenario, case, None)?;
        return Ok(Found {
            kind: None,
            wait_s: None,
            detected_s: None,
            travel_m: None,
            named: log.faults.first().map(|fault| fault.fault.name()),
            situation,
            false_trip: !log.faults.is_empty(),
        });
    };
    if KINDS[kind].cause == Cause::Record {
        let came = record::spoilt(machine, &scenario.parameters, &mut dice)?;
        let seen = |at_s| (came != record::Came::Nothing).then_some(at_s);
        let refused = came == record::Came::Refused;
        return Ok(Found {
            kind: Some(kind),
            wait_s: seen(0.0),
            detected_s: refused.then_some(0.0),
            // A controller that is not built moves nothing.
            travel_m: refused.then_some(0.0),
            named: refused.then_some("record_refused"),
            situation,
            false_trip: false,
        });
    }
    let g = &machine.geometry;
    let stroke = [g.boom.stroke, g.arm.stroke, g.bucket.stroke][mover.spool - 1];
    let cause = KINDS[kind].cause;
    let mut spoiler = Spoiler::new(cause, from_s, mover.spool, mover.side, stroke.max_m - stroke.min_m, case);
    let log = complete(&scenario, case, Some(&mut spoiler))?;
    let observable_s = match cause {
        // A healthy cylinder may run on for a while: one that is at its stop by then shows nothing.
        Cause::Spool(Defect::Stuck) if !goes_on(&log, mover.spool, released_s) => None,
        Cause::Spool(_) | Cause::NoPressure => astray(&log, &complete(&scenario, case, None)?),
        _ => spoiler.observable_s,
    };
    let named = log.faults.first().map(|fault| fault.at_s);
    let false_trip = named.is_some_and(|at_s| at_s < from_s);
    let named = named.filter(|_| !false_trip);
    let travel_m = named.and_then(|_| travel(&log, observable_s?));
    Ok(Found {
        kind: Some(kind),
        // What is named before it could be seen counts from there.
        wait_s: observable_s.map(|at_s| at_s - from_s),
        detected_s: named.map(|at_s| (at_s - observable_s.unwrap_or(at_s)).max(0.0)),
        travel_m,
        named: log.faults.first().map(|fault| fault.fault.name()),
        situation,
        false_trip,
    })
}

fn complete(scenario: &Scenario, seed: u64, spoiler: Option<&mut Spoiler>) -> Result<Log, String> {
    let run = Run::new(scenario, seed).map_err(|error| error.to_string())?;
    let mut host = Host::new(&scenario.parameters).map_err(|error| error.to_string())?;
    let log = match spoiler {
        Some(spoiler) => run.complete_with(&mut host, spoiler, |_, _| {}),
        None => run.complete(&mut host, |_, _| {}),
    };
    log.map_err(|error| error.to_string())
}

/// The first moment at which a cylinder is not where it is in the healthy run.
fn astray(log: &Log, healthy: &Log) -> Option<f64> {
    let pairs = log.rows.iter().zip(&healthy.rows);
    pairs
        .filter(|(a, b)| {
            let (a, b) = (a.lengths, b.lengths);
            [a.boom - b.boom, a.arm - b.arm, a.bucket - b.bucket].iter().any(|off| off.abs() > ASTRAY_M)
        })
        .map(|(row, _)| row.time_s)
        .next()
}

/// Whether the cylinder's true speed after the release was ever beyond the line of what does not ring, for longer than it could ring.
fn goes_on(log: &Log, spool: usize, released_s: f64) -> bool {
    let length = |row: &Row| [row.lengths.boom, row.lengths.arm, row.lengths.bucket][spool - 1];
    let speeds = || log.rows.windows(2).map(|pair| (pair[1].time_s, (length(&pair[1]) - length(&pair[0])) / TICK_S));
    let released_mps = speeds().take_while(|(time_s, _)| *time_s <= released_s).last().map_or(0.0, |(_, speed)| speed);
    let mut since_s = None;
    for (time_s, speed_mps) in speeds().filter(|(time_s, _)| *time_s > released_s) {
        let fallen = ((time_s - released_s - LATEST_S) / FALL_S).clamp(0.0, 1.0);
        if speed_mps.abs() <= released_mps.abs() * (1.0 - fallen) + MARGIN_MPS {
            since_s = None;
        } else if time_s - *since_s.get_or_insert(time_s) > HALF_SWING_S {
            return true;
        }
    }
    false
}

fn travel(log: &Log, from_s: f64) -> Option<f64> {
    let from = log.rows.iter().find(|row| row.time_s >= from_s)?.tip?;
    let end = log.rows.last()?.tip?;
    Some(libm::hypot(end[0] - from[0], end[1] - from[1]))
}
