//! The coil current loop on simulated solenoids. What `cargo hil coil` prints and draws.
//!
//! [`Trial`] runs the valve stage's boom spool against two [`Solenoid`]s, tick by tick; [`CoilReport`] is what is asked of it.

mod faults;
mod report;
mod table;

pub use faults::{CASES, Case, FaultTime, fault_times};
pub use report::{CoilReport, DitherRow, STEP_A, Step, StepRow};
pub(crate) use table::{STEP_HEADS, ms};

use firmware::io::{Solenoids, Speeds};
use firmware::parameters::{Coil, ParameterError, ValveDirection};
use firmware::supervisor::Gate;
use firmware::valve::coil_fault::FaultyCoil;
use firmware::valve::coil_stage::{CoilStage, CoilStageParameters};

use crate::plant::STEP_S;
use crate::plant::coil::{CurrentAdc, Drive, Solenoid, SolenoidModel, SupplyModel};
use crate::plant::sensors::Noise;

/// The spool in the trial.
pub const SPOOL: usize = 1;

/// The winding of the reference solenoid: 5.3 Ω and 1.2 A as in the scenarios, so that even hot it gets its current from 9 V. L/R is 19 ms.
pub const REFERENCE: SolenoidModel =
    SolenoidModel { resistance_ohm: 5.3, inductance_h: 0.1, saturation_a: 3.0, freewheel_v: 0.7, clamp_v: 40.0 };

/// Full-scale current of the reference solenoid, A.
pub const FULL_SCALE_A: f64 = 1.2;

/// The stage's parameters for the reference solenoid: a full speed of 1 m/s, no ramp, no dither.
pub fn parameters() -> CoilStageParameters {
    let coil = Coil { full_scale_a: FULL_SCALE_A as f32, resistance_ohm: REFERENCE.resistance_ohm as f32 };
    let directions = [0.15, 0.20].map(|dead_band| ValveDirection { dead_band, full_speed: 1.0 });
    CoilStageParameters::plain(&[directions; 4], &coil, REFERENCE.inductance_h as f32)
}

/// Surroundings of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// The supply.
    pub supply: SupplyModel,
    /// The windings' temperature, °C.
    pub temperature_c: f64,
    /// Seed of the converters' noise.
    pub seed: u64,
}

impl Surroundings {
    /// 24 V with 0.5 V of ripple at 290 Hz, 20 °C.
    pub const USUAL: Self =
        Self { supply: SupplyModel { volts: 24.0, ripple_v: 0.5, ripple_hz: 290.0 }, temperature_c: 20.0, seed: 1 };
}

/// One tick of a trial: the currents at its beginning, and what the stage made of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Since the beginning, s.
    pub time_s: f64,
    /// Through the windings, A.
    pub currents_a: Solenoids<f64>,
    /// Wanted, without dither, A.
    pub wanted_a: Solenoids<f64>,
    /// Duties.
    pub duties: Solenoids<u16>,
    /// The fault named.
    pub fault: Option<FaultyCoil>,
}

/// The boom spool's two solenoids under the valve stage.
#[derive(Clone, Debug)]
pub struct Trial {
    stage: CoilStage,
    /// The solenoids, to be broken or heated.
    pub solenoids: Solenoids<Solenoid>,
    /// The surroundings, to be changed.
    pub surroundings: Surroundings,
    adc: CurrentAdc,
    noise: Noise,
    min_a: Solenoids<f64>,
    ticks: u32,
}

impl Trial {
    /// At rest.
    ///
    /// # Errors
    /// The first parameter at fault.
    pub fn new(parameters: &CoilStageParameters, surroundings: Surroundings) -> Result<Self, ParameterError> {
        let sense = parameters.sense;
        Ok(Self {
            stage: CoilStage::new(parameters)?,
            solenoids: [Solenoid::new(REFERENCE, surroundings.temperature_c); 2],
            surroundings,
            // 12 bit over 2.4 A are 0.6 mA.
            adc: CurrentAdc { full_scale_a: sense.full_scale_a.into(), zero_code: sense.zero_code, noise_a: 0.002 },
            noise: Noise::new(surroundings.seed),
            min_a: parameters.spools[SPOOL].flow.map(|flow| flow.min_current_a.into()),
            ticks: 0,
        })
    }

    /// The speed that asks for this current, A; extending positive. For the linear curve of [`parameters`].
    pub fn speed_for(&self, current_a: f64) -> f32 {
        let [extend, retract] = self.min_a;
        let (min_a, sign) = if current_a > 0.0 { (extend, 1.0) } else { (retract, -1.0) };
        let share = (current_a * sign - min_a) / (FULL_SCALE_A - min_a);
        if current_a == 0.0 { 0.0 } else { (sign * share) as f32 }
    }

    /// One tick at this speed; the cut-off is as the gate.
    pub fn tick(&mut self, gate: Gate, speed_mps: f32) -> Sample {
        let time_s = f64::from(self.ticks) * STEP_S;
        let mut codes = [[self.adc.zero_code; 2]; 4];
        codes[SPOOL] = self.solenoids.map(|solenoid| self.adc.code(&solenoid, &mut self.noise));
        let speeds = Speeds { boom: speed_mps, ..Speeds::ZERO };
        let supply = self.surroundings.supply;
        let driven = self.stage.drive(gate, &speeds, supply.at(time_s) as f32, &codes);
        let sample = Sample {
            time_s,
            currents_a: self.solenoids.map(|solenoid| solenoid.current_a()),
            wanted_a: driven.coils.currents[SPOOL].map(f64::from),
            duties: driven.coils.duties[SPOOL],
            fault: driven.fault,
        };
        let supply_v = supply.mean(time_s, STEP_S);
        for (solenoid, duty) in self.solenoids.iter_mut().zip(sample.duties) {
            let duty = f64::from(duty) / 65535.0;
            solenoid.step(&Drive { duty, supply_v, cut_off_closed: gate == Gate::Open }, STEP_S);
        }
        self.ticks += 1;
        sample
    }

    /// Ticks at the speed of this current.
    pub fn run(&mut self, current_a: f64, ticks: u32) -> Vec<Sample> {
        let speed = self.speed_for(current_a);
        (0..ticks).map(|_| self.tick(Gate::Open, speed)).collect()
    }
}
