//! The score of the motion: tasks on plants that no tuning has seen, the true tip against the path.

mod calibration;
mod measure;
mod task;

use rayon::prelude::*;
use serde::Serialize;

use crate::machine_file::MachineFile;
use crate::place::Host;
use crate::run::Run;
use crate::scenario::Scenario;
use crate::shard::Shard;
use measure::Deviation;
use task::Controller;

pub use task::{LAW, Task};

/// Speeds of the tip, m/s.
pub const SPEEDS_MPS: [f64; 2] = [0.3, 0.5];

/// Which plants are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Plants {
    /// Those kept for the score: no tuning has used one.
    HeldOut,
    /// Those to tune on.
    Tuning,
}

impl Plants {
    /// What is said of them in a table.
    pub const fn described(self) -> &'static str {
        match self {
            Self::HeldOut => "kept for the score",
            Self::Tuning => "to tune on",
        }
    }

    /// Seed of the first plant drawn; the others follow it.
    const fn first(self) -> u64 {
        match self {
            Self::HeldOut => 0x5c0e_0000,
            Self::Tuning => 1,
        }
    }
}

/// What is scored.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Plants drawn.
    pub seeds: u32,
    /// Which.
    pub plants: Plants,
    /// The tables `[motion]` and `[law]` of a scenario: [`LAW`], or what is to be tried.
    pub law: String,
    /// Without the controllers it is compared with.
    pub alone: bool,
}

/// A row of the score.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The task.
    pub name: &'static str,
    /// Speed asked of the tip, m/s.
    pub speed_mps: f64,
    /// Plants.
    pub plants: usize,
    /// Of the true tip normal to the path, over all plants, m.
    pub rmse_m: f64,
    /// The largest 95th percentile of a plant, m.
    pub p95_m: f64,
    /// Largest, m.
    pub max_m: f64,
    /// The better one of open loop and proportional alone, m; like all that is compared with, `None` for a score of ours alone.
    pub baseline_rmse_m: Option<f64>,
    /// Feed-forward alone, m.
    pub open_loop_rmse_m: Option<f64>,
    /// Error times gain, without feed-forward, preview and learning, m.
    pub proportional_rmse_m: Option<f64>,
    /// Ours with the nominal plant's valve map, m.
    pub uncalibrated_rmse_m: Option<f64>,
    /// Its largest, m.
    pub uncalibrated_max_m: Option<f64>,
    /// Ours with half the pump's flow, and told so, m.
    pub half_flow_rmse_m: Option<f64>,
    /// Its largest, m.
    pub half_flow_max_m: Option<f64>,
    /// Runs of ours that came to the end of the path without a fault.
    pub completed: usize,
    /// Runs of ours whose coils were still in the last second.
    pub still_at_rest: usize,
    /// Every run of ours.
    pub by_plant: Vec<OnPlant>,
}

/// One plant of a row, under our controller.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OnPlant {
    /// Number of the plant among those drawn, from 0.
    pub plant: u64,
    /// Of the true tip normal to the path, m.
    pub rmse_m: f64,
    /// Control periods that is the mean of: parts of a score are joined by them.
    pub ticks: usize,
    /// Largest, m.
    pub max_m: f64,
    /// When it was, s.
    pub max_at_s: f64,
    /// Where the tip was at last, from the path's end, m.
    pub to_end_m: f64,
    /// Name of the fault that ended the run.
    pub fault: Option<&'static str>,
    /// When, s.
    pub fault_at_s: Option<f64>,
    /// The same with half the pump's flow.
    pub half_flow_fault: Option<&'static str>,
    /// When, s.
    pub half_flow_fault_at_s: Option<f64>,
}

impl OnPlant {
    /// The tip came near the path's end, and nothing stopped it.
    pub fn completed(&self) -> bool {
        self.fault.is_none() && self.to_end_m < measure::THERE_M
    }
}

/// The score.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The machine.
    pub machine: String,
    /// Plants drawn.
    pub seeds: u32,
    /// Which.
    pub plants: Plants,
    /// The seed each plant was drawn with, in the order of their numbers.
    pub plant_seeds: Vec<u64>,
    /// A row a task and speed.
    pub tasks: Vec<Row>,
}

/// One run of a case.
#[derive(Clone, Copy, Debug)]
struct Result1 {
    row: usize,
    plant: u64,
    controller: Controller,
    deviation: Deviation,
}

/// Runs of a score.
pub fn runs(setting: &Setting) -> u64 {
    (Task::ALL.len() * SPEEDS_MPS.len() * controllers(setting).len()) as u64 * u64::from(setting.seeds)
}

fn controllers(setting: &Setting) -> &'static [Controller] {
    if setting.alone { &[Controller::Ours] } else { &Controller::ALL }
}

/// Runs the score's part; `done` is called after each run. The same plants give the same results in any split.
///
/// # Errors
/// The machine has no hydraulics, or cannot do a task.
pub fn score(machine: &MachineFile, setting: &Setting, shard: Shard, done: impl Fn() + Sync) -> Result<Report, String> {
    let mut bases = Vec::new();
    for task in Task::ALL {
        for speed_mps in SPEEDS_MPS {
            bases.push((task, speed_mps, task.scenario(machine, speed_mps, &setting.law)?));
        }
    }
    let cases = bases.len() as u64 * u64::from(setting.seeds);
    let mine = shard.cases(cases);
    let results: Vec<Vec<Result1>> = mine
        .into_par_iter()
        .map(|case| {
            let row = (case % bases.len() as u64) as usize;
            let plant = case / bases.len() as u64;
            let (task, _, base) = &bases[row];
            controllers(setting)
                .iter()
                .map(|&controller| {
                    let deviation = run(base, *task, controller, setting.plants.first() + plant)?;
                    done();
                    Ok(Result1 { row, plant, controller, deviation })
                })
                .collect()
        })
        .collect::<Result<_, String>>()?;
    let results: Vec<Result1> = results.into_iter().flatten().collect();
    let tasks = bases.iter().enumerate().map(|(index, (task, speed_mps, _))| row(*task, *speed_mps, index, &results));
    let first = setting.plants.first();
    Ok(Report {
        machine: machine.name.clone(),
        seeds: setting.seeds,
        plants: setting.plants,
        plant_seeds: (first..first + u64::from(setting.seeds)).collect(),
        tasks: tasks.collect(),
    })
}

/// The scenario of one case of ours: a drawn plant, its controller as calibration has left it.
///
/// # Errors
/// The machine has no hydraulics, or cannot do the task.
pub fn case(
    machine: &MachineFile,
    (task, speed_mps): (Task, f64),
    plants: Plants,
    number: u64,
) -> Result<Scenario, String> {
    fitted(&task.scenario(machine, speed_mps, LAW)?, Controller::Ours, plants.first() + number)
}

/// This plant instead of the nominal one, and what the controller takes it for.
fn fitted(base: &Scenario, controller: Controller, plant: u64) -> Result<Scenario, String> {
    let mut scenario = base.clone();
    let nominal = scenario.hydraulic.clone().ok_or("the plant is not hydraulic")?;
    let mut drawn = nominal.drawn(plant);
    let coils = scenario.parameters.coils;
    let believed = match controller {
        Controller::Uncalibrated => calibration::exact(&nominal, &coils),
        _ => calibration::calibrated(&drawn, &coils, plant),
    };
    scenario.parameters.coils = believed.coils;
    scenario.parameters.motion.preview_s = believed.preview_s as f32;
    if let Some(law) = &mut scenario.parameters.motion.law {
        law.overrun_n = believed.overrun_n;
    }
    controller.apply(&mut scenario.parameters, &mut drawn);
    scenario.hydraulic = Some(drawn);
    Ok(scenario)
}

fn run(base: &Scenario, task: Task, controller: Controller, plant: u64) -> Result<Deviation, String> {
    let scenario = fitted(base, controller, plant)?;
    let mut host = Host::new(&scenario.parameters).map_err(|error| format!("{}: {error}", task.name()))?;
    let run = Run::new(&scenario, plant).map_err(|error| format!("{}: {error}", task.name()))?;
    let log = run.complete(&mut host, |_, _| {}).map_err(|error| error.to_string())?;
    measure::deviation(&log, &task.corners()).ok_or_else(|| format!("{}: nothing was followed", task.name()))
}

fn row(task: Task, speed_mps: f64, index: usize, results: &[Result1]) -> Row {
    let of =
        |controller| results.iter().filter(move |r| r.row == index && r.controller == controller).map(|r| r.deviation);
    let rmse = |controller| {
        let (squares, ticks) = of(controller).fold((0.0, 0), |(s, n), d| (s + d.squares, n + d.ticks));
        (ticks > 0).then(|| libm::sqrt(squares / ticks as f64))
    };
    let (open, proportional) = (rmse(Controller::OpenLoop), rmse(Controller::Proportional));
    let max = |controller| of(controller).map(|d| d.max_m).reduce(f64::max);
    let by_plant = by_plant(index, results);
    Row {
        name: task.name(),
        speed_mps,
        plants: of(Controller::Ours).count(),
        rmse_m: rmse(Controller::Ours).unwrap_or(f64::NAN),
        p95_m: of(Controller::Ours).map(|d| d.p95_m).reduce(f64::max).unwrap_or(f64::NAN),
        max_m: max(Controller::Ours).unwrap_or(f64::NAN),
        baseline_rmse_m: open.zip(proportional).map(|(open, proportional)| open.min(proportional)),
        open_loop_rmse_m: open,
        proportional_rmse_m: proportional,
        uncalibrated_rmse_m: rmse(Controller::Uncalibrated),
        uncalibrated_max_m: max(Controller::Uncalibrated),
        half_flow_rmse_m: rmse(Controller::HalfFlow),
        half_flow_max_m: max(Controller::HalfFlow),
        completed: by_plant.iter().filter(|on| on.completed()).count(),
        still_at_rest: of(Controller::Ours).filter(|d| d.still).count(),
        by_plant,
    }
}

fn by_plant(index: usize, results: &[Result1]) -> Vec<OnPlant> {
    let of = |controller| results.iter().filter(move |r| r.row == index && r.controller == controller);
    let on = |ours: &Result1| {
        let d = &ours.deviation;
        let half = of(Controller::HalfFlow).find(|half| half.plant == ours.plant).and_then(|half| half.deviation.fault);
        OnPlant {
            plant: ours.plant,
            rmse_m: d.rmse_m(),
            ticks: d.ticks,
            max_m: d.max_m,
            max_at_s: d.max_at_s,
            to_end_m: d.to_end_m,
            fault: d.fault.map(|seen| seen.fault.name()),
            fault_at_s: d.fault.map(|seen| seen.at_s),
            half_flow_fault: half.map(|seen| seen.fault.name()),
            half_flow_fault_at_s: half.map(|seen| seen.at_s),
        }
    };
    of(Controller::Ours).map(on).collect()
}
