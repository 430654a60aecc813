//! Running a scenario: plant, operator and controller, tick by tick.

mod log;
mod operator;
mod summary;

use std::time::Instant;

use crc::{CRC_64_XZ, Crc};
use firmware::dig::Dig;
use firmware::{Outputs, TICKS_PER_S};
use kinematics_core::{Cylinders, Machine, Pose, Rotor};

use crate::place::{Place, PlaceError};
use crate::plant::Plant;
use crate::plant::sensors::{Noise, code};
use crate::scenario::Scenario;
use crate::travel::{Violation, violations};

pub use log::{FaultSeen, Log, Row, StopHit};
pub use operator::Operator;
pub use summary::{EmulatorFigures, InstructionCounts, Outcome, Summary};

/// A run that is under way.
pub struct Run<'a> {
    scenario: &'a Scenario,
    machine: Machine<f64>,
    dig: Dig<f64>,
    plant: Plant,
    operator: Operator,
    noise: Noise,
    swing_code: u16,
}

/// Why a run cannot start or go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The dig leaves the travel limits or what the machine reaches; nothing has moved.
    #[error("the dig is refused: it leaves the travel limits")]
    Refused(Vec<Violation>),
    /// The place is lost or cannot be built.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// The machine's geometry, which loading has checked.
    #[error(transparent)]
    Geometry(#[from] kinematics_core::GeometryError),
    /// The swing sensor cannot stand at zero swing.
    #[error("`machine`: at zero swing: {0}")]
    Swing(kinematics_core::PoseError<f64>),
}

impl<'a> Run<'a> {
    /// Prepares a run: checks the dig's travel and puts the machine at the dig's start.
    ///
    /// # Errors
    /// [`RunError::Refused`] with every violation.
    pub fn new(scenario: &'a Scenario, seed: u64) -> Result<Self, RunError> {
        let geometry = &scenario.machine.geometry;
        let machine = Machine::new(geometry)?;
        let dig = Dig::new(&scenario.dig);
        let found = violations(geometry, &machine, &dig);
        if !found.is_empty() {
            return Err(RunError::Refused(found));
        }
        let start = machine.tip_to_cylinders(&dig.tip(0.0)).map_err(RunError::Swing)?;
        let swing_code = swing_code(scenario, &machine)?;
        Ok(Self {
            scenario,
            machine,
            dig,
            plant: Plant::new(scenario.plant, scenario.coil, &start),
            operator: Operator::new(scenario),
            noise: Noise::new(seed),
            swing_code,
        })
    }

    /// Runs the scenario to its end; `progress` hears of every tick done out of all.
    ///
    /// # Errors
    /// The place was lost.
    pub fn complete(mut self, place: &mut dyn Place, mut progress: impl FnMut(u32, u32)) -> Result<Log, PlaceError> {
        let ticks = (self.scenario.duration_s * f64::from(TICKS_PER_S) + 0.5) as u32;
        let crc = Crc::<u64>::new(&CRC_64_XZ);
        let mut hash = crc.digest();
        let mut log = Log::with_capacity(ticks as usize);
        let started = Instant::now();
        for tick in 0..ticks {
            let time_s = f64::from(tick) / f64::from(TICKS_PER_S);
            let true_lengths = self.plant.lengths();
            let codes = self.codes(&true_lengths);
            let inputs = self.operator.inputs(time_s, codes);

            let reply = place.tick(&inputs)?;
            hash.update(&reply.outputs.to_bytes());

            let held: Vec<_> = self.plant.against_stops().collect();
            log.stops(time_s, &held);
            log.push(self.row(time_s, true_lengths, &reply.outputs), reply.timing);
            self.plant.step(&reply.outputs, self.scenario.supply_v);
            progress(tick + 1, ticks);
        }
        log.finish(hash.finalize(), started.elapsed());
        Ok(log)
    }

    fn codes(&mut self, lengths: &Cylinders<f64>) -> [u16; 4] {
        let sensors = &self.scenario.parameters.cylinder_sensors;
        let sigma = self.scenario.sensor_noise_m;
        let mut read = |i: usize, length: f64| code(&sensors[i], length, sigma * self.noise.normal());
        [self.swing_code, read(0, lengths.boom), read(1, lengths.arm), read(2, lengths.bucket)]
    }

    fn row(&self, time_s: f64, lengths: Cylinders<f64>, outputs: &Outputs) -> Row {
        // The plant stays between its stops, where the linkage closes.
        let pose = self.machine.cylinders_to_tip(&lengths, Rotor::IDENTITY).ok();
        let tip = |pose: Pose<f64>| [pose.plane.reach, pose.plane.height];
        // While the feed-forward waits out the dead time, tick 1 stands still: nothing is followed yet.
        let reference = (outputs.dig_tick > 1).then(|| {
            let tip = self.dig.tip(f64::from(outputs.dig_tick - 1) / f64::from(TICKS_PER_S));
            [tip.reach, tip.height]
        });
        Row { time_s, lengths, tip: pose.map(tip), joints: pose.map(|p| p.joints), reference, outputs: *outputs }
    }
}

/// The swing sensor's code at zero swing.
fn swing_code(scenario: &Scenario, machine: &Machine<f64>) -> Result<u16, RunError> {
    use firmware::parameters::SwingSensor;
    match (&scenario.parameters.swing_sensor, machine.swing_cylinder()) {
        (SwingSensor::Angle { zero_code }, _) => Ok(*zero_code),
        (SwingSensor::Cylinder(sensor), Some(cylinder)) => {
            let length = cylinder.length(Rotor::IDENTITY).map_err(RunError::Swing)?;
            Ok(code(sensor, length, 0.0))
        }
        (SwingSensor::Cylinder(sensor), None) => Ok(sensor.min_code),
    }
}
