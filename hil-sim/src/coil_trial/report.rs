//! Steps, dither and sweeps.

use firmware::parameters::ParameterError;
use serde::Serialize;

use super::{FaultTime, Sample, Surroundings, Trial, fault_times, parameters};
use crate::plant::STEP_S;

/// Currents of every step, A: from here to there.
pub const STEP_A: [f64; 2] = [0.3, 1.0];
/// When the step comes, in ticks.
const STEP_AT: u32 = 200;
/// Ticks drawn and judged after it.
const STEP_TICKS: u32 = 400;
/// Dither amplitude, A.
const DITHER_A: f32 = 0.05;

/// A step's facts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Step {
    /// From 10 % to 90 % of the step, s.
    pub rise_s: f64,
    /// Beyond the new value, share of the step.
    pub overshoot: f64,
    /// Until it stays within 5 % of the step, s.
    pub settling_s: f64,
    /// Mean error over the last 100 ms, A.
    pub steady_error_a: f64,
}

/// A step at a temperature and a supply.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StepRow {
    /// °C.
    pub temperature_c: f64,
    /// V.
    pub supply_v: f64,
    /// The step.
    #[serde(flatten)]
    pub step: Step,
}

/// Dither at a frequency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DitherRow {
    /// Hz.
    pub frequency_hz: f64,
    /// Wanted, A.
    pub wanted_a: f64,
    /// Half of the current's peak to peak, A.
    pub reached_a: f64,
    /// Mean current less the wanted one, A.
    pub mean_error_a: f64,
}

/// Everything `cargo hil coil` shows.
#[derive(Clone, Debug, Serialize)]
pub struct CoilReport {
    /// The step at 24 V and 20 °C.
    pub step: Step,
    /// From −40 to 120 °C at 24 V.
    pub temperatures: Vec<StepRow>,
    /// From 9 to 32 V at 20 °C.
    pub supplies: Vec<StepRow>,
    /// Frequencies.
    pub dither: Vec<DitherRow>,
    /// Fault times.
    pub faults: Vec<FaultTime>,
    /// The step's samples.
    #[serde(skip)]
    pub step_samples: Vec<Sample>,
    /// A dither of 62.5 Hz on a current that a ramp takes up and down.
    #[serde(skip)]
    pub dither_samples: Vec<Sample>,
}

impl CoilReport {
    /// Runs all of it.
    ///
    /// # Errors
    /// The trial's parameters are at fault.
    pub fn new() -> Result<Self, ParameterError> {
        let usual = Surroundings::USUAL;
        let row = |temperature_c: f64, supply_v: f64| -> Result<StepRow, ParameterError> {
            let mut surroundings = Surroundings { temperature_c, ..usual };
            surroundings.supply.volts = supply_v;
            let step = judge(&step(surroundings)?);
            Ok(StepRow { temperature_c, supply_v, step })
        };
        let step_samples = step(usual)?;
        Ok(Self {
            step: judge(&step_samples),
            temperatures: (0..9).map(|i| row(-40.0 + 20.0 * f64::from(i), 24.0)).collect::<Result<_, _>>()?,
            supplies: [9.0, 12.0, 16.0, 20.0, 24.0, 28.0, 32.0]
                .map(|v| row(20.0, v))
                .into_iter()
                .collect::<Result<_, _>>()?,
            dither: [31.25, 50.0, 62.5, 100.0, 125.0].map(dither).into_iter().collect::<Result<_, _>>()?,
            faults: fault_times(&usual)?,
            step_samples,
            dither_samples: faded_dither()?,
        })
    }
}

/// A step of the extending coil's current; the samples begin with it.
///
/// # Errors
/// The trial's parameters are at fault.
fn step(surroundings: Surroundings) -> Result<Vec<Sample>, ParameterError> {
    let mut trial = Trial::new(&parameters(), surroundings)?;
    let [from, to] = STEP_A;
    trial.run(from, STEP_AT);
    Ok(trial.run(to, STEP_TICKS))
}

fn judge(samples: &[Sample]) -> Step {
    let [from, to] = STEP_A;
    let shares: Vec<f64> = samples.iter().map(|sample| (sample.currents_a[0] - from) / (to - from)).collect();
    // When a share is first reached, in ticks, between two of them.
    let reached = |share: f64| {
        let after = shares.iter().position(|&s| s >= share).unwrap_or(shares.len());
        let before = after.saturating_sub(1);
        match (shares.get(before), shares.get(after)) {
            (Some(low), Some(high)) if high > low => before as f64 + (share - low) / (high - low),
            _ => after as f64,
        }
    };
    let unsettled = shares.iter().rposition(|s| (s - 1.0).abs() > 0.05).map_or(0, |last| last + 1);
    let tail = &shares[shares.len() - 100..];
    Step {
        rise_s: (reached(0.9) - reached(0.1)) * STEP_S,
        overshoot: shares.iter().copied().fold(1.0, f64::max) - 1.0,
        settling_s: unsettled as f64 * STEP_S,
        steady_error_a: (tail.iter().sum::<f64>() / tail.len() as f64 - 1.0) * (to - from),
    }
}

fn dither(frequency_hz: f64) -> Result<DitherRow, ParameterError> {
    let mut p = parameters();
    let dither = &mut p.spools[super::SPOOL].dither;
    (dither.frequency_hz, dither.amplitude_a, dither.fade_below_a) = (frequency_hz as f32, DITHER_A, 0.3);
    let mut trial = Trial::new(&p, Surroundings::USUAL)?;
    trial.run(0.6, 1000);
    let currents: Vec<f64> = trial.run(0.6, 1000).iter().map(|sample| sample.currents_a[0]).collect();
    let (low, high) = currents.iter().fold((f64::MAX, f64::MIN), |(low, high), &a| (low.min(a), high.max(a)));
    Ok(DitherRow {
        frequency_hz,
        wanted_a: DITHER_A.into(),
        reached_a: 0.5 * (high - low),
        mean_error_a: currents.iter().sum::<f64>() / currents.len() as f64 - 0.6,
    })
}

fn faded_dither() -> Result<Vec<Sample>, ParameterError> {
    let mut p = parameters();
    let spool = &mut p.spools[super::SPOOL];
    (spool.dither.frequency_hz, spool.dither.amplitude_a, spool.dither.fade_below_a) = (62.5, DITHER_A, 0.6);
    spool.ramp[0].up_a_per_s = 2.0;
    spool.ramp[0].down_a_per_s = 4.0;
    let mut trial = Trial::new(&p, Surroundings::USUAL)?;
    let mut samples = trial.run(0.0, 50);
    samples.extend(trial.run(0.9, 550));
    samples.extend(trial.run(0.0, 300));
    Ok(samples)
}
