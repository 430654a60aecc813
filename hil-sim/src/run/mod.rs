//! Running a scenario: plant, operator and controller, tick by tick.

pub(crate) mod bus;
mod injector;
mod inside;
mod log;
mod operator;
mod reach;
mod summary;
pub(crate) mod wiring;

use std::time::Instant;

use crc::{CRC_64_XZ, Crc};
use firmware::dig::Dig;
use firmware::{Outputs, TICKS_PER_S};
use kinematics_core::{Cylinders, Machine, PlaneTip, Pose, Rotor};

use crate::place::{Place, PlaceError};
use crate::plant::coil::Broken;
use crate::plant::hydraulic::StartError;
use crate::plant::{Driven, Plant, SwingDrive};
use crate::scenario::{Kind, Scenario, Task};
use crate::travel::{Violation, violations};

use bus::{Bus, Said};
use wiring::{Measured, Wiring};

pub use injector::{Healthy, Injector};
pub use inside::{Cut, GroundSeen, Inside, OilSeen};
pub use log::{FaultSeen, Log, Row, StopHit};
pub use operator::{Doing, Operator};
pub use reach::ReachSeen;
pub use summary::{EmulatorFigures, InstructionCounts, Outcome, Summary};

/// A run that is under way.
pub struct Run<'a> {
    scenario: &'a Scenario,
    machine: Machine<f64>,
    dig: Option<Dig<f64>>,
    swing: SwingDrive,
    plant: Plant,
    operator: Operator,
    bus: Bus,
    wiring: Wiring,
}

/// Why a run cannot start or go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The dig leaves the travel limits or what the machine reaches; nothing has moved.
    #[error("the dig is refused: it leaves the travel limits")]
    Refused(Vec<Violation>),
    /// The operator asks for a dig that the parameters do not hold.
    #[error("`parameters.dig`: the operator asks for a dig, but there is none")]
    NoDig,
    /// The operator asks for a move that the parameters do not hold.
    #[error("`parameters.planned_move`: the operator asks for a move, but there is none")]
    NoMove,
    /// The operator asks for a path that the parameters do not hold.
    #[error("`parameters.path`: the operator asks for a path, but there is none")]
    NoPath,
    /// The machine cannot stand at the path's first knot.
    #[error("`knot[0]`: {0}")]
    PathStart(kinematics_core::PoseError<f64>),
    /// The machine cannot stand at the move's start.
    #[error("`move`: at the start: {0}")]
    MoveStart(kinematics_core::PoseError<f64>),
    /// The place is lost or cannot be built.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// The machine's geometry, which loading has checked.
    #[error(transparent)]
    Geometry(#[from] kinematics_core::GeometryError),
    /// The hydraulic machine cannot stand at its start.
    #[error("the hydraulic plant: {0}")]
    Plant(#[from] StartError),
    /// The swing cannot stand where the scenario starts.
    #[error("`start.swing_deg`: {0}")]
    Swing(kinematics_core::PoseError<f64>),
}

impl<'a> Run<'a> {
    /// Prepares a run: checks the dig's travel, where there is one, and puts the machine at its start.
    ///
    /// # Errors
    /// [`RunError::Refused`] with every violation.
    pub fn new(scenario: &'a Scenario, seed: u64) -> Result<Self, RunError> {
        let geometry = &scenario.machine.geometry;
        let machine = Machine::new(geometry)?;
        let dig = scenario.parameters.dig.as_ref().map(Dig::new);
        let found = dig.as_ref().map_or_else(Vec::new, |dig| violations(geometry, &machine, dig));
        if !found.is_empty() {
            return Err(RunError::Refused(found));
        }
        let swing = SwingDrive::of(&machine);
        let start = start(scenario, &machine, dig.as_ref(), swing)?;
        Ok(Self {
            scenario,
            machine,
            dig,
            swing,
            plant: match &scenario.hydraulic {
                Some(model) => Plant::hydraulic(model, scenario.coil, start)?,
                None => Plant::new(scenario.plant, scenario.coil, start),
            },
            operator: Operator::new(scenario),
            bus: Bus::default(),
            wiring: Wiring::new(&scenario.parameters, swing, scenario.sensor_noise_m, seed),
        })
    }

    /// Runs the scenario to its end; `progress` hears of every tick done out of all.
    ///
    /// # Errors
    /// The place was lost.
    pub fn complete(self, place: &mut dyn Place, progress: impl FnMut(u32, u32)) -> Result<Log, PlaceError> {
        self.complete_with(place, &mut Healthy, progress)
    }

    /// The same with something that spoils it.
    ///
    /// # Errors
    /// The place was lost.
    pub fn complete_with(
        mut self,
        place: &mut dyn Place,
        injector: &mut dyn Injector,
        mut progress: impl FnMut(u32, u32),
    ) -> Result<Log, PlaceError> {
        let ticks = (self.scenario.duration_s * f64::from(TICKS_PER_S) + 0.5) as u32;
        let crc = Crc::<u64>::new(&CRC_64_XZ);
        let mut hash = crc.digest();
        let mut log = Log::with_capacity(ticks as usize);
        let mut cut_off_closed = false;
        let started = Instant::now();
        for tick in 0..ticks {
            let time_s = f64::from(tick) / f64::from(TICKS_PER_S);
            let positions = self.plant.positions();
            let doing = self.operator.at(time_s);
            let pressures_pa = self.plant.pressures_pa();
            let frames = self.bus.frames(&Said { intent: doing.intent, slope_deg: [0.0; 2], pressures_pa });
            let supply_v = self.scenario.supply_v;
            let measured = Measured { positions, solenoids: self.plant.solenoids(), supply_v, cut_off_closed };
            let mut wires = self.wiring.wires(&measured, &doing, frames, &self.scenario.events, time_s);

            injector.wires(time_s, &mut wires);
            let reply = place.tick(&wires)?;
            // The relay's contact follows within the tick.
            cut_off_closed = reply.pins.cut_off_closed;
            hash.update(&reply.outputs.to_bytes());
            hash.update(&reply.pins.to_bytes());

            let held: Vec<_> = self.plant.against_stops().collect();
            log.stops(time_s, &held);
            if tick % inside::EVERY_TICKS == 0 {
                log.inside.push(Inside::of(&self.plant, time_s));
                log.ground.look(&self.plant, time_s);
            }
            log.push(self.row(time_s, positions, &reply.outputs), reply.timing);
            self.break_coils(time_s);
            injector.plant(time_s, &mut self.plant, &reply.pins);
            self.plant.step(&Driven { duties: reply.pins.duties, cut_off_closed, supply_v });
            progress(tick + 1, ticks);
        }
        log.finish(hash.finalize(), started.elapsed());
        Ok(log)
    }

    /// Only the boom's extending solenoid is ever broken.
    fn break_coils(&mut self, time_s: f64) {
        let broken = [
            (Kind::BoomCoilOpen, Broken::Open),
            (Kind::BoomCoilShortToSupply, Broken::ShortToSupply),
            (Kind::BoomCoilShortToGround, Broken::ShortToGround),
        ];
        let now = broken.into_iter().find(|&(kind, _)| self.scenario.events.has(kind, time_s));
        self.plant.set_broken(1, 0, now.map(|(_, broken)| broken));
    }

    fn row(&self, time_s: f64, [swing, boom, arm, bucket]: [f64; 4], outputs: &Outputs) -> Row {
        let lengths = Cylinders { boom, arm, bucket };
        // The plant stays between its stops, where the linkage closes.
        let swing = self.swing.rotor(swing);
        let pose = swing.and_then(|swing| self.machine.cylinders_to_tip(&lengths, swing).ok());
        let tip = |pose: Pose<f64>| [pose.plane.reach, pose.plane.height];
        // While the feed-forward waits out the dead time, tick 1 stands still: nothing is followed yet.
        let reference = if outputs.dig_tick > 1 { self.reference(outputs) } else { None };
        Row { time_s, lengths, swing, tip: pose.map(tip), joints: pose.map(|p| p.joints), reference, outputs: *outputs }
    }
}

impl Run<'_> {
    /// Where the tip should be, m: the dig's, or that of the move's reference lengths.
    fn reference(&self, outputs: &Outputs) -> Option<[f64; 2]> {
        if let Some(dig) = &self.dig {
            let tip = dig.tip(f64::from(outputs.dig_tick - 1) / f64::from(TICKS_PER_S));
            return Some([tip.reach, tip.height]);
        }
        let Cylinders { boom, arm, bucket } = outputs.reference;
        let lengths = Cylinders { boom: boom.into(), arm: arm.into(), bucket: bucket.into() };
        let pose = self.machine.cylinders_to_tip(&lengths, Rotor::IDENTITY).ok()?;
        Some([pose.plane.reach, pose.plane.height])
    }
}

/// Positions of swing, boom, arm, bucket before the first tick.
fn start(
    scenario: &Scenario,
    machine: &Machine<f64>,
    dig: Option<&Dig<f64>>,
    swing: SwingDrive,
) -> Result<[f64; 4], RunError> {
    match (&scenario.task, dig) {
        (
            Task::Levers { start, .. }
            | Task::Reach { start }
            | Task::Grade { start, .. }
            | Task::TipVelocity { start, .. },
            _,
        ) => {
            let swing = swing.position(start.swing_deg.to_radians()).map_err(RunError::Swing)?;
            Ok([swing, start.boom_m, start.arm_m, start.bucket_m])
        }
        (Task::Move, _) => {
            let planned = scenario.parameters.planned_move.as_ref().ok_or(RunError::NoMove)?;
            let [reach, height] = planned.start_m;
            let tip = PlaneTip { reach, height, pitch: Rotor::from_degrees(planned.start_pitch_deg) };
            let Cylinders { boom, arm, bucket } = machine.tip_to_cylinders(&tip).map_err(RunError::MoveStart)?;
            Ok([swing.position(0.0).map_err(RunError::Swing)?, boom, arm, bucket])
        }
        (Task::Path, _) => {
            let path = scenario.parameters.path.as_ref().ok_or(RunError::NoPath)?;
            let [Some(first), ..] = path.knots else { return Err(RunError::NoPath) };
            let tip = PlaneTip { reach: first.x_m, height: first.z_m, pitch: Rotor::from_degrees(first.pitch_deg) };
            let Cylinders { boom, arm, bucket } = machine.tip_to_cylinders(&tip).map_err(RunError::PathStart)?;
            let swing = swing.position(first.swing_deg.to_radians()).map_err(RunError::Swing)?;
            Ok([swing, boom, arm, bucket])
        }
        (Task::Dig, dig) => {
            let dig = dig.ok_or(RunError::NoDig)?;
            let Cylinders { boom, arm, bucket } = machine.tip_to_cylinders(&dig.tip(0.0)).map_err(RunError::Swing)?;
            Ok([swing.position(0.0).map_err(RunError::Swing)?, boom, arm, bucket])
        }
    }
}
