//! Every valve of a machine searched through the pins: found against true, and the courses of current and speed.

use firmware::io::SPOOLS;
use firmware::service::Task;
use firmware::{Fault, TICKS_PER_S};
use serde::Serialize;

use super::{FoundValves, Workshop, on_spool};
use crate::plant::ActuatorModel;
use crate::run::RunError;
use crate::scenario::Scenario;

/// No search takes longer, ticks.
const PATIENCE: u32 = 600 * TICKS_PER_S;

/// Every so many ticks a sample.
const SAMPLE_TICKS: u32 = 20;

/// A direction, found and true.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Row {
    /// swing, boom, arm or bucket.
    pub spool: &'static str,
    /// extend or retract.
    pub direction: &'static str,
    /// Share of full-scale current.
    pub dead_band: f64,
    /// As found.
    pub found_dead_band: f64,
    /// Speed per share of full-scale current beyond the dead band, m/s or rad/s.
    pub gain: f64,
    /// As found.
    pub found_gain: f64,
}

impl Row {
    /// Of full scale.
    pub fn dead_band_error(&self) -> f64 {
        self.found_dead_band - self.dead_band
    }

    /// Relative.
    pub fn gain_error(&self) -> f64 {
        self.found_gain / self.gain - 1.0
    }
}

/// A moment of a search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sample {
    /// Since the search began, s.
    pub time_s: f64,
    /// Measured by nobody but the simulation: extending minus retracting, A.
    pub current_a: f64,
    /// m/s or rad/s.
    pub speed: f64,
}

/// One spool's search.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Search {
    /// swing, boom, arm or bucket.
    pub spool: &'static str,
    /// How it ended, on the bus.
    pub phase: &'static str,
    /// Why.
    pub reason: &'static str,
    /// The controller's latched fault.
    pub fault: Option<&'static str>,
    /// s
    pub duration_s: f64,
    /// Extend, retract; none where it gave up.
    pub rows: Vec<Row>,
    /// Its course.
    #[serde(skip)]
    pub samples: Vec<Sample>,
}

/// All of a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Calibration {
    /// The machine's name.
    pub machine: String,
    /// The seed of valves and noise.
    pub seed: u64,
    /// Swing, boom, arm, bucket.
    pub searches: Vec<Search>,
}

impl Calibration {
    /// Every search was done within one percent of full scale and three of gain.
    pub fn kept_promise(&self) -> bool {
        let good = |row: &Row| row.dead_band_error().abs() <= 0.01 && row.gain_error().abs() <= 0.03;
        self.searches.iter().all(|search| search.rows.len() == 2 && search.rows.iter().all(good))
    }
}

impl Calibration {
    /// For people.
    pub fn to_table(&self) -> String {
        let mut out = format!(
            "calibration of {} by command, through the pins (simulation), valves of seed {}\n\n\
             spool   direction   dead band: true    found    off   gain: true    found     off\n",
            self.machine, self.seed
        );
        for search in &self.searches {
            if search.rows.is_empty() {
                let fault = search.fault.map_or(String::new(), |fault| format!(", {fault}"));
                out += &format!(
                    "{:<8}{} after {:.0} s: {}{fault}\n",
                    search.spool, search.phase, search.duration_s, search.reason
                );
            }
            for row in &search.rows {
                out += &format!(
                    "{:<8}{:<12}{:>13.2} %{:>7.2} %{:>+6.2} %{:>11.3}{:>9.3}{:>+7.2} %\n",
                    row.spool,
                    row.direction,
                    100.0 * row.dead_band,
                    100.0 * row.found_dead_band,
                    100.0 * row.dead_band_error(),
                    row.gain,
                    row.found_gain,
                    100.0 * row.gain_error(),
                );
            }
        }
        let longest = self.searches.iter().map(|search| search.duration_s).fold(0.0, f64::max);
        out + &format!(
            "\nlongest search {longest:.0} s; promised: dead band within 1 % of full scale, gain within 3 %\n"
        )
    }
}

/// SplitMix64.
struct Dice(u64);

impl Dice {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The scenario with valves that its controller does not know: dead bands of 5 to 37 %, speeds of half to one and a half times the
/// scenario's, dead times of 40 to 200 ms and lags of 10 to 80 ms.
pub fn with_random_valves(scenario: &Scenario, seed: u64) -> Scenario {
    let mut dice = Dice(seed);
    let mut scenario = Scenario { hydraulic: None, ..scenario.clone() };
    for model in &mut scenario.plant {
        model.dead_band = [0; 2].map(|_| dice.within(0.05, 0.37));
        model.full_speed = model.full_speed.map(|speed| speed * dice.within(0.5, 1.5));
        (model.dead_time_s, model.spool_lag_s) = (dice.within(0.04, 0.2), dice.within(0.01, 0.08));
    }
    scenario
}

/// Actuators in the middle of their strokes, a swing motor straight ahead.
pub fn middle(models: &[ActuatorModel; 4]) -> [f64; 4] {
    models.map(|model| model.stroke.map_or(0.0, |stroke| 0.5 * (stroke.min_m + stroke.max_m)))
}

/// Searches this spool's valve: the tool asks, enable goes on, and the answer on the bus is awaited.
///
/// # Errors
/// Parameters the controller refuses.
pub fn search(scenario: &Scenario, spool: usize, seed: u64) -> Result<Search, RunError> {
    let mut workshop = Workshop::new(scenario, middle(&scenario.plant), seed)?;
    workshop.begin(on_spool(Task::ValveSearch, spool as u8));
    let began = workshop.now();
    let (mut samples, mut fault) = (Vec::new(), None);
    let mut before = workshop.plant.positions()[spool];
    while !matches!(workshop.heard.phase, "done" | "aborted" | "refused") && workshop.now() - began < PATIENCE {
        let outputs = workshop.ticks(SAMPLE_TICKS);
        fault = outputs.and_then(|outputs| outputs.fault).map(Fault::name);
        let [extend, retract] = workshop.plant.solenoids()[spool].each_ref().map(|solenoid| solenoid.current_a());
        let position = workshop.plant.positions()[spool];
        samples.push(Sample {
            time_s: f64::from(workshop.now() - began) / f64::from(TICKS_PER_S),
            current_a: extend - retract,
            speed: (position - before) * f64::from(TICKS_PER_S) / f64::from(SAMPLE_TICKS),
        });
        before = position;
    }
    // The values come with their own message.
    workshop.ticks(200);
    let model = &scenario.plant[spool];
    let found = workshop.heard.valves.filter(|_| workshop.heard.phase == "done");
    Ok(Search {
        spool: SPOOLS[spool],
        phase: workshop.heard.phase,
        reason: workshop.heard.reason,
        fault,
        duration_s: samples.last().map_or(0.0, |sample| sample.time_s),
        rows: found.map_or_else(Vec::new, |found| rows(SPOOLS[spool], model, &found)),
        samples,
    })
}

fn rows(spool: &'static str, model: &ActuatorModel, found: &FoundValves) -> Vec<Row> {
    let gain = |speed: f64, dead_band: f64| speed / (1.0 - dead_band);
    ["extend", "retract"]
        .into_iter()
        .enumerate()
        .map(|(side, direction)| {
            let (dead_band, found_dead_band) = (model.dead_band[side], f64::from(found.dead_band[side]));
            Row {
                spool,
                direction,
                dead_band,
                found_dead_band,
                gain: gain(model.full_speed[side], dead_band),
                found_gain: gain(found.full_speed[side].into(), found_dead_band),
            }
        })
        .collect()
}
