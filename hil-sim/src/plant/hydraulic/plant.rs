//! The machine in motion: spools → oil → forces → rates → positions, a few sub-steps a control tick.
//!
//! Rates are stepped with the pressures of the moment, then the oil and the positions with the new rates: a staggered step, which neither damps nor
//! feeds the oscillation of oil and mass. What is stiff (openings, friction, soil) is implicit.

// Functions and sides index several arrays at once.
#![allow(clippy::needless_range_loop)]

mod readings;

use kinematics_core::{PoseError, Vec2};

use super::body::{Body, Loads, Posture, TipResistance};
use super::circuit::{Circuit, Motion};
use super::digging::Digging;
use super::function::{Function, FunctionModel};
use super::joints::{Actuators, JointMap};
use super::ledger::{Ledger, Loss, Observer};
use super::model::HydraulicModel;
use super::oil::ATMOSPHERE_PA;
use super::spool::Spool;
use crate::plant::{Defect, STEP_S};

/// Pressure of the low side of a cylinder that stands, Pa above the atmosphere.
const PRELOAD_PA: f64 = 1.0e6;

/// Time constant in which a stop takes up a motion, s: piston, pins and links give that much, though here they are rigid. At once, the
/// momentum would be thrown into the other joints, the lightest of them most: the bucket's cylinder at 4 m/s.
const STOP_S: f64 = 0.01;

/// Why a plant cannot start.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StartError {
    /// The geometry.
    #[error(transparent)]
    Geometry(#[from] kinematics_core::GeometryError),
    /// A start outside its stroke.
    #[error("at the start: {0}")]
    Position(PoseError<f64>),
    /// No sub-steps.
    #[error("`substeps` is {0} but must be within 1…64")]
    Substeps(u32),
}

/// The hydraulic machine.
#[derive(Clone, Debug)]
pub struct HydraulicPlant {
    functions: [Function; 4],
    body: Body,
    bucket: BucketLoad,
    joints: JointMap,
    spools: [Spool; 4],
    circuit: Circuit,
    digging: Option<Digging>,
    substeps: u32,
    step_s: f64,
    angles: [f64; 4],
    rates: [f64; 4],
    actuators: Actuators,
    posture: Posture,
    against_stop: [bool; 4],
    soil_force: [f64; 2],
    places: [f64; 4],
    defects: [Option<Defect>; 4],
}

/// The empty bucket, and where its load lies.
#[derive(Clone, Copy, Debug)]
struct BucketLoad {
    empty: crate::machine_file::Link,
    fixed_kg: f64,
    length_m: f64,
}

impl BucketLoad {
    /// The bucket with its load: in the middle of the mouth's line, a fifth of the bucket's length towards the back.
    fn with(&self, soil_kg: f64) -> crate::machine_file::Link {
        let load = self.fixed_kg + soil_kg;
        if load <= 0.0 {
            return self.empty;
        }
        let place = Vec2::new(0.5 * self.length_m, 0.2 * self.length_m);
        let mass_kg = self.empty.mass_kg + load;
        let centre = self.empty.centre.scale(self.empty.mass_kg / mass_kg) + place.scale(load / mass_kg);
        let apart = (place - self.empty.centre).norm_squared() * self.empty.mass_kg * load / mass_kg;
        // The load itself as a disc of half the bucket's length.
        let own = load * self.length_m * self.length_m / 32.0;
        crate::machine_file::Link { mass_kg, centre, inertia_kgm2: self.empty.inertia_kgm2 + own + apart }
    }
}

fn absolute([_, boom, arm, bucket]: [f64; 4]) -> [f64; 3] {
    [boom, boom + arm, boom + arm + bucket]
}

impl HydraulicPlant {
    /// At rest at these positions (swing motor rad, cylinders m), the pressures holding the links.
    ///
    /// # Errors
    /// [`StartError`].
    pub fn new(model: &HydraulicModel, start: [f64; 4]) -> Result<Self, StartError> {
        if !(1..=64).contains(&model.substeps) {
            return Err(StartError::Substeps(model.substeps));
        }
        let joints = JointMap::new(&model.geometry)?;
        let angles = joints.angles(start).map_err(StartError::Position)?;
        let actuators = joints.actuators(angles, &Actuators { positions: start, arms: [1.0; 4] });
        let bucket =
            BucketLoad { empty: model.links[2], fixed_kg: model.payload_kg, length_m: model.geometry.bucket_m };
        let [boom, arm, _] = model.links;
        let body = Body {
            lengths: [
                model.geometry.boom_pin_x_m,
                model.geometry.boom_m,
                model.geometry.arm_m,
                model.geometry.bucket_m,
            ],
            links: [boom, arm, bucket.with(0.0)],
            upper_inertia_kgm2: model.upper_inertia_kgm2,
        };
        let posture = body.posture(absolute(angles));
        let [of_boom, of_arm, of_bucket] = body.holding_torques(&posture);
        let torques = [0.0, of_boom, of_arm, of_bucket];
        let volumes = [0, 1, 2, 3].map(|i| model.functions[i].volumes(actuators.positions[i]));
        let pressures = [0, 1, 2, 3].map(|i| {
            let held = holding(&model.functions[i], torques[i] / actuators.arms[i]);
            held.map(|pressure| ATMOSPHERE_PA + pressure)
        });
        let step_s = STEP_S / f64::from(model.substeps);
        let tank_pa = ATMOSPHERE_PA + model.return_pa;
        let reach_m = body.lengths.iter().sum();
        let mut plant = Self {
            functions: model.functions.each_ref().map(|function| Function::new(function, &model.pump)),
            body,
            bucket,
            joints,
            spools: [0; 4].map(|_| Spool::new(&model.spool, STEP_S, step_s)),
            circuit: Circuit::new(model.oil, model.pump, tank_pa, volumes, pressures),
            digging: model.digging.as_ref().map(|digging| Digging::new(digging, reach_m)),
            substeps: model.substeps,
            step_s,
            angles,
            rates: [0.0; 4],
            actuators,
            posture,
            against_stop: [false; 4],
            soil_force: [0.0; 2],
            places: [0.0; 4],
            defects: [None; 4],
        };
        (0..4).for_each(|f| plant.circuit.settle(f, volumes[f]));
        Ok(plant)
    }

    /// One control tick under the solenoids' currents: swing, boom, arm, bucket × extend, retract; A.
    pub fn step(&mut self, solenoid_currents_a: [[f64; 2]; 4]) {
        self.observed_step(solenoid_currents_a, &mut ());
    }

    /// [`HydraulicPlant::step`] with every flow and loss written into a ledger.
    pub fn step_with_ledger(&mut self, solenoid_currents_a: [[f64; 2]; 4], ledger: &mut Ledger) {
        self.observed_step(solenoid_currents_a, ledger);
    }

    fn observed_step<O: Observer>(&mut self, currents: [[f64; 2]; 4], observer: &mut O) {
        for (spool, currents) in self.spools.iter_mut().zip(currents) {
            spool.command(currents);
        }
        if let Some(digging) = &mut self.digging {
            let tip = self.posture.tip() + Vec2::new(self.body.lengths[0], 0.0);
            digging.tick(tip, self.posture.tip_velocity(self.rates), self.posture.bucket_direction(), STEP_S);
            self.body.links[2] = self.bucket.with(digging.load_kg());
        }
        self.against_stop = [false; 4];
        for _ in 0..self.substeps {
            self.substep(observer);
        }
    }

    fn substep<O: Observer>(&mut self, observer: &mut O) {
        let h = self.step_s;
        for (i, spool) in self.spools.iter_mut().enumerate() {
            let asked = spool.advance();
            self.places[i] = match self.defects[i] {
                None => asked,
                Some(Defect::Stuck) => self.places[i],
                Some(Defect::Leaking(speed)) => asked + self.functions[i].model.place_of(speed),
                Some(Defect::NoPressure) => 0.0,
            };
        }
        let speeds = self.velocities();
        let mut loads = Loads { torques: [0.0; 4], damping: [0.0; 4], tip: TipResistance::default(), held: [None; 3] };
        for i in 0..4 {
            let (model, arm) = (&self.functions[i].model, self.actuators.arms[i]);
            loads.torques[i] = arm * model.push(self.circuit.pressures(i));
            loads.damping[i] = arm * arm * model.friction.over_speed(speeds[i]);
        }
        if let Some(digging) = &self.digging {
            loads.tip = digging.resistance(self.posture.tip_velocity(self.rates));
        }
        let free = self.body.step(&self.posture, self.rates, &loads, h);
        let rates = self.held_by_stops(free, &mut loads);
        self.rates = rates;
        let motion = [0, 1, 2, 3].map(|i| self.motion(i));
        let moved = self.circuit.step(&self.functions, &motion, h);
        for (angle, rate) in self.angles.iter_mut().zip(rates) {
            *angle += h * rate;
        }
        let (posture, actuators) = (self.posture, self.actuators);
        self.posture = self.body.posture(absolute(self.angles));
        self.actuators = self.joints.actuators(self.angles, &actuators);
        for i in 0..4 {
            self.follow(i);
        }
        let velocity = posture.tip_velocity(rates);
        self.soil_force =
            [loads.tip.force[0] - loads.tip.damping * velocity.x, loads.tip.force[1] - loads.tip.damping * velocity.z];
        if O::LISTENS {
            self.circuit.report(&moved, observer);
            let friction: f64 = loads.damping.iter().zip(rates).map(|(damping, rate)| damping * rate * rate * h).sum();
            observer.loss(Loss::Friction, friction);
            let stopped = self.body.kinetic_energy(&posture, free) - self.body.kinetic_energy(&posture, rates);
            observer.loss(Loss::Stop, stopped);
            let [reach, height] = self.soil_force;
            observer.loss(Loss::Soil, -h * (reach * velocity.x + height * velocity.z));
            for i in 0..4 {
                let areas = self.functions[i].model.areas;
                let moved = self.actuators.positions[i] - actuators.positions[i];
                observer.atmosphere(ATMOSPHERE_PA * (areas[0] - areas[1]) * moved);
            }
        }
    }

    /// What the oil needs to know of an actuator.
    fn motion(&self, i: usize) -> Motion {
        let function = &self.functions[i];
        let (position, speed) = (self.actuators.positions[i], self.actuators.arms[i] * self.rates[i]);
        let [head, rod] = function.model.areas;
        Motion {
            volumes_m3: function.model.volumes(position),
            growth_m3ps: [head * speed, -rod * speed],
            opened: function.opened(self.places[i]),
            ends_m: function.model.stroke.map_or([f64::INFINITY; 2], |s| [position - s.min_m, s.max_m - position]),
        }
    }

    /// Rates with every joint that would pass its end held by its stop.
    fn held_by_stops(&mut self, free: [f64; 4], loads: &mut Loads) -> [f64; 4] {
        let mut rates = free;
        // Holding one joint may push another against its end: three at most.
        for _ in 0..3 {
            let mut more = false;
            for joint in 1..4 {
                if let Some(rate) = self.stopping_rate(joint, rates[joint]).filter(|_| loads.held[joint - 1].is_none())
                {
                    loads.held[joint - 1] = Some(rate);
                    more = true;
                }
            }
            if !more {
                break;
            }
            rates = self.body.step(&self.posture, self.rates, loads, self.step_s);
        }
        if loads.held.iter().flatten().count() > 1 {
            rates = self.let_go(rates, loads);
        }
        for (against, held) in self.against_stop[1..].iter_mut().zip(loads.held) {
            *against |= held.is_some();
        }
        if let Some(rate) = self.stopping_rate(0, rates[0]) {
            rates[0] = rate;
            self.against_stop[0] = true;
        }
        rates
    }

    /// A stop pushes and does not pull: a joint that was pushed against its end only by one that is itself held by now is let go.
    fn let_go(&self, mut rates: [f64; 4], loads: &mut Loads) -> [f64; 4] {
        for joint in 1..4 {
            let held = loads.held[joint - 1].take();
            let without = self.body.step(&self.posture, self.rates, loads, self.step_s);
            let stays = |joint: usize| self.stopping_rate(joint, without[joint]);
            // Without it no other may pass its end either.
            let passes = (1..4).any(|other| loads.held[other - 1].is_none() && stays(other).is_some());
            if held.is_some() && passes {
                loads.held[joint - 1] = held;
            } else if held.is_some() {
                rates = without;
            }
        }
        rates
    }

    /// The rate that comes to rest at the joint's end, where this one would pass it.
    fn stopping_rate(&self, joint: usize, rate: f64) -> Option<f64> {
        let [low, high] = self.joints.range(joint)?;
        let angle = self.angles[joint];
        let (most, least) = ((high - angle) / STOP_S, (low - angle) / STOP_S);
        if rate > most {
            Some(most)
        } else if rate < least {
            Some(least)
        } else {
            None
        }
    }

    /// The oil after an actuator has moved: a cylinder's volumes change, a motor carries oil from one side to the other.
    fn follow(&mut self, i: usize) {
        let model = &self.functions[i].model;
        if model.stroke.is_none() {
            let [head, rod] = self.circuit.pressures(i);
            let swept = model.areas[0] * self.rates[i] * self.step_s;
            let carried = swept / self.circuit.specific_volume(0.5 * (head + rod));
            self.circuit.chambers[i][0].content_m3 -= carried;
            self.circuit.chambers[i][1].content_m3 += carried;
        }
        let volumes = model.volumes(self.actuators.positions[i]);
        self.circuit.settle(i, volumes);
    }

    /// Spoils a function's spool, or repairs it: stuck where it is; off its centre by what makes this speed; centred for want of pilot
    /// pressure.
    pub fn set_defect(&mut self, function: usize, defect: Option<Defect>) {
        self.defects[function] = defect;
    }

    /// Changes the payload that stays in the bucket, kg: as if it were set down or taken off at rest.
    pub fn set_payload_kg(&mut self, payload_kg: f64) {
        self.bucket.fixed_kg = payload_kg;
        self.body.links[2] = self.bucket.with(self.load_kg());
    }
}

/// Pressures of head and rod side that push with a force, Pa above the atmosphere.
fn holding(model: &FunctionModel, force: f64) -> [f64; 2] {
    let [head, rod] = model.areas;
    let most = model.port_relief_pa;
    let with_low_rod = (force + PRELOAD_PA * rod) / head;
    if with_low_rod >= PRELOAD_PA {
        [if with_low_rod < most { with_low_rod } else { most }, PRELOAD_PA]
    } else {
        let high = (PRELOAD_PA * head - force) / rod;
        [PRELOAD_PA, if high < most { high } else { most }]
    }
}
