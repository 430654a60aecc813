//! How long each fault of a coil takes to be named.

use firmware::parameters::ParameterError;
use firmware::valve::coil_fault::CoilFault;
use serde::Serialize;

use super::{Surroundings, Trial, parameters};
use crate::plant::coil::Broken;

/// Something broken while the coil was doing something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// In words.
    pub what: &'static str,
    /// What breaks, in the extending solenoid.
    pub broken: Broken,
    /// Current asked for before and after, A.
    pub current_a: [f64; 2],
    /// Supply before and after, V.
    pub supply_v: [f64; 2],
    /// What it must be called.
    pub named: CoilFault,
}

const fn case(what: &'static str, broken: Broken, current_a: [f64; 2], named: CoilFault) -> Case {
    Case { what, broken, current_a, supply_v: [24.0; 2], named }
}

/// The cases of the table.
pub const CASES: [Case; 9] = [
    case("open while driven", Broken::Open, [0.6; 2], CoilFault::Open),
    case("open, found when driven", Broken::Open, [0.0, 0.6], CoilFault::Open),
    case("plug corroded to 10 × R", Broken::Resistance(10.0), [0.6; 2], CoilFault::Open),
    case("short to supply while off", Broken::ShortToSupply, [0.0; 2], CoilFault::ShortToSupply),
    case("short to supply while driven", Broken::ShortToSupply, [0.6; 2], CoilFault::ShortToSupply),
    case("short to ground while driven", Broken::ShortToGround, [0.6; 2], CoilFault::ShortToGround),
    case("short to ground, found when driven", Broken::ShortToGround, [0.0, 0.6], CoilFault::ShortToGround),
    case("short to supply, other solenoid driven", Broken::ShortToSupply, [-0.6; 2], CoilFault::ShortToSupply),
    Case {
        what: "supply too low for the current",
        broken: Broken::Resistance(1.0),
        current_a: [1.1; 2],
        supply_v: [24.0, 3.5],
        named: CoilFault::Saturated,
    },
];

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FaultTime {
    /// The case in words.
    pub case: &'static str,
    /// What it was called; nothing if it was not seen within two seconds.
    pub named: Option<String>,
    /// From the break to the name, s.
    pub time_s: Option<f64>,
    /// Largest current of the winding until then, A.
    pub peak_a: f64,
    /// It was called what it is.
    pub right: bool,
}

/// Breaks each case after half a second and waits two seconds for its name.
///
/// # Errors
/// The trial's parameters are at fault.
pub fn fault_times(surroundings: &Surroundings) -> Result<Vec<FaultTime>, ParameterError> {
    CASES.iter().map(|case| time(case, *surroundings)).collect()
}

fn time(case: &Case, mut surroundings: Surroundings) -> Result<FaultTime, ParameterError> {
    let [volts_before, volts_after] = case.supply_v;
    surroundings.supply.volts = volts_before;
    let mut trial = Trial::new(&parameters(), surroundings)?;
    let [before, after] = case.current_a;
    let early = trial.run(before, 500).into_iter().find_map(|sample| sample.fault);
    trial.solenoids[0].broken = Some(case.broken);
    trial.surroundings.supply.volts = volts_after;
    let begin_s = 0.5;
    let samples = trial.run(after, 2000);
    let seen = samples.iter().position(|sample| sample.fault.is_some());
    let until = seen.map_or(samples.len(), |index| index + 1);
    let peak_a = samples.iter().take(until).map(|sample| sample.currents_a[0]).fold(0.0, f64::max);
    let found =
        seen.and_then(|index| samples.get(index)).and_then(|s| s.fault.map(|fault| (s.time_s - begin_s, fault)));
    Ok(FaultTime {
        case: case.what,
        named: found.map(|(_, fault)| fault.to_string()),
        time_s: found.map(|(time_s, _)| time_s),
        peak_a,
        right: early.is_none() && found.is_some_and(|(_, fault)| fault.fault == case.named),
    })
}
