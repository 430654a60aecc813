//! The run in a few numbers: the short table, `summary.json`, the exit status.

use serde::Serialize;

use super::Log;
use crate::fence::Watch;
use crate::place::{Image, Timing};
use crate::scenario::{Scenario, Task};
use crate::travel::Violation;

/// A fault in the summary.
#[derive(Clone, Debug, Serialize)]
pub struct FaultEntry {
    /// Its name.
    pub fault: &'static str,
    /// Its code.
    pub code: u8,
    /// When it was latched, s.
    pub at_s: f64,
}

/// A travel stop hit.
#[derive(Clone, Debug, Serialize)]
pub struct StopEntry {
    /// Which cylinder.
    pub cylinder: &'static str,
    /// When, s.
    pub at_s: f64,
}

/// Median and maximum over all ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct InstructionCounts {
    /// Half the ticks take no more.
    pub median: u32,
    /// The longest.
    pub max: u32,
}

/// What only the emulator tells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EmulatorFigures {
    /// Instructions of `Ecu::tick`.
    pub instructions_per_tick: InstructionCounts,
    /// Longest minus shortest distance between starts of ticks, ns of virtual time.
    pub tick_period_jitter_ns: u32,
    /// Deepest use of the stack, bytes.
    pub stack_peak_bytes: u32,
    /// Code, constants and initial values, bytes.
    pub flash_bytes: u64,
    /// Static memory without the stack, bytes.
    pub ram_bytes: u64,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done as asked.
    Done,
    /// Refused before motion.
    Refused,
    /// A fault, a travel stop, or the linkage beyond its fence.
    Violated,
}

impl Outcome {
    /// The process's exit status: 0 done, 2 refused, 3 fault or limit violation.
    pub const fn exit_status(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Refused => 2,
            Self::Violated => 3,
        }
    }
}

/// The summary. `refused`, or `faults` and `stop_hits`, and the emulator's figures are left out where they do not apply; other values
/// that do not are null.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// The scenario's name.
    pub scenario: String,
    /// The machine's name.
    pub machine: String,
    /// `host` or `emulator`.
    pub on: &'static str,
    /// Seed of the sensor noise.
    pub seed: u64,
    /// Ticks run.
    pub ticks: usize,
    /// CRC-64/XZ over every output of every tick, sixteen hexadecimal digits.
    pub output_hash: Option<String>,
    /// Whether the dig was followed to its end; null where none is asked for.
    pub dig_completed: Option<bool>,
    /// Root mean square of |reference(t) − true tip(t)| while digging, m.
    pub tip_error_rms_m: Option<f64>,
    /// Largest of the same, m.
    pub tip_error_max_m: Option<f64>,
    /// How far the true tip is from the target at the end, m; null where none is to be reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_error_m: Option<f64>,
    /// Smallest distance between the true hull and the obstacles, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smallest_clearance_m: Option<f64>,
    /// Smallest clearance between the true linkage and the fence's planes and balls, m; negative beyond.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fence_clearance_min_m: Option<f64>,
    /// Smallest distance of the true swing to an end of the fence's range, degrees; negative beyond.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fence_swing_room_min_deg: Option<f64>,
    /// Simulated time over wall clock.
    pub real_time_factor: Option<f64>,
    /// Why the dig was refused before motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<Vec<Violation>>,
    /// Faults latched.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faults: Option<Vec<FaultEntry>>,
    /// Travel stops hit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop_hits: Option<Vec<StopEntry>>,
    /// What only the emulator tells.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub emulator: Option<EmulatorFigures>,
}

impl EmulatorFigures {
    /// From a run's log, the image and the image's last word; `None` for a run on the host.
    pub fn new(log: &Log, image: &Image, stack_peak_bytes: u32) -> Option<Self> {
        let measured: Option<Vec<(u32, u32)>> = log
            .timing
            .iter()
            .map(|timing| match *timing {
                Timing::Emulator { started_ns, instructions } => Some((started_ns, instructions)),
                Timing::Host { .. } => None,
            })
            .collect();
        let measured = measured?;
        let periods = measured.windows(2).map(|pair| pair[1].0.wrapping_sub(pair[0].0));
        let jitter = periods.clone().max()? - periods.min()?;
        let mut instructions: Vec<u32> = measured.iter().map(|&(_, instructions)| instructions).collect();
        instructions.sort_unstable();
        Some(Self {
            instructions_per_tick: InstructionCounts {
                median: instructions[instructions.len() / 2],
                max: *instructions.last()?,
            },
            tick_period_jitter_ns: jitter,
            stack_peak_bytes,
            flash_bytes: image.flash_bytes,
            ram_bytes: image.ram_bytes,
        })
    }
}

impl Summary {
    /// Of a run that was refused before motion, or only drawn.
    pub fn without_run(scenario: &Scenario, on: &'static str, seed: u64, refused: Vec<Violation>) -> Self {
        Self {
            scenario: scenario.name.clone(),
            machine: scenario.machine.name.clone(),
            on,
            seed,
            ticks: 0,
            output_hash: None,
            dig_completed: (scenario.task == Task::Dig).then_some(false),
            tip_error_rms_m: None,
            tip_error_max_m: None,
            target_error_m: None,
            smallest_clearance_m: None,
            fence_clearance_min_m: None,
            fence_swing_room_min_deg: None,
            real_time_factor: None,
            refused: Some(refused),
            faults: None,
            stop_hits: None,
            emulator: None,
        }
    }

    /// Of a complete run.
    pub fn of(scenario: &Scenario, on: &'static str, seed: u64, log: &Log, emulator: Option<EmulatorFigures>) -> Self {
        let errors: Vec<f64> = log.rows.iter().filter_map(super::Row::tip_error_m).collect();
        let square_sum: f64 = errors.iter().map(|e| e * e).sum();
        let faults = log.faults.iter();
        let hits = log.stop_hits.iter();
        let reach = super::ReachSeen::of(scenario, log);
        let fence = Watch::of(scenario).and_then(|watch| watch.over(log));
        Self {
            ticks: log.rows.len(),
            output_hash: Some(format!("{:016x}", log.output_hash)),
            dig_completed: scenario.parameters.dig.map(|dig| {
                let [_, _, duration_s] = dig.until_s;
                log.dig_completed(duration_s)
            }),
            tip_error_rms_m: (!errors.is_empty()).then(|| libm::sqrt(square_sum / errors.len() as f64)),
            tip_error_max_m: errors.iter().copied().max_by(f64::total_cmp),
            target_error_m: reach.as_ref().map(|reach| reach.target_error_m),
            smallest_clearance_m: reach.as_ref().map(|reach| reach.smallest_clearance_m),
            fence_clearance_min_m: fence.map(|(closest, _)| closest).filter(|m| m.is_finite()),
            fence_swing_room_min_deg: fence.map(|(_, room)| room.to_degrees()).filter(|deg| deg.is_finite()),
            real_time_factor: Some(scenario.duration_s / log.wall.as_secs_f64()),
            refused: None,
            faults: Some(
                faults.map(|f| FaultEntry { fault: f.fault.name(), code: f.fault.code(), at_s: f.at_s }).collect(),
            ),
            stop_hits: Some(hits.map(|h| StopEntry { cylinder: h.cylinder, at_s: h.at_s }).collect()),
            emulator,
            ..Self::without_run(scenario, on, seed, Vec::new())
        }
    }

    /// How the run ended.
    pub fn outcome(&self) -> Outcome {
        let beyond = |room: Option<f64>| room.is_some_and(|room| room < 0.0);
        let some = |list: Option<usize>| list.is_some_and(|n| n > 0);
        if some(self.refused.as_ref().map(Vec::len)) {
            Outcome::Refused
        } else if some(self.faults.as_ref().map(Vec::len))
            || some(self.stop_hits.as_ref().map(Vec::len))
            || beyond(self.fence_clearance_min_m)
            || beyond(self.fence_swing_room_min_deg)
        {
            Outcome::Violated
        } else {
            Outcome::Done
        }
    }
}
