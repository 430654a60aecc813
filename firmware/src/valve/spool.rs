//! One spool: two directions, their interlock, and their watches.

use super::coil_fault::CoilFault;
use super::coil_stage::{CoilStageParameters, SpoolParameters};
use super::coil_watch::{CoilWatch, Given, Suspicion, WatchLimits};
use super::current_loop::{CurrentLoop, LoopGains, SupplyNow};
use super::dither::Dither;
use super::flow_map::FlowMap;
use super::interlock::{Interlock, Side};
use super::number::duty_code;
use super::ramp::Ramp;
use crate::io::Solenoids;
use crate::supervisor::Gate;

/// What all spools calculate with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared {
    pub(super) gains: LoopGains,
    limits: WatchLimits,
    /// Both currents above this are a cross, A: dying current of one may still be there while the other begins to rise, but never
    /// this much of both.
    cross_a: f32,
    cross_ticks: u16,
}

impl Shared {
    pub(super) fn new(stage: &CoilStageParameters) -> Self {
        Self {
            gains: LoopGains::new(&stage.coil),
            limits: WatchLimits::new(&stage.watch, &stage.coil, stage.sense.overload_a()),
            cross_a: 2.0 * stage.released_a,
            cross_ticks: stage.watch.short_ticks,
        }
    }
}

/// One direction.
#[derive(Clone, Copy, Debug)]
struct Direction {
    flow: FlowMap,
    ramp: Ramp,
}

/// What a spool's one solenoid that is on gets.
pub(super) struct Driven {
    pub(super) side: Side,
    /// Wanted current without dither, A.
    pub(super) current_a: f32,
    /// PWM duty.
    pub(super) duty: u16,
}

/// A spool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spool {
    /// Off, and as long as currents and speed are next to nothing it stays so and nothing in here would change.
    asleep: bool,
    wakes_above: Solenoids<f32>,
    interlock: Interlock,
    /// Of the solenoid that is on: one at most.
    current: CurrentLoop,
    given: Given,
    dither: Dither,
    watches: Solenoids<CoilWatch>,
    cross: Suspicion,
    directions: Solenoids<Direction>,
}

impl Spool {
    pub(super) fn new(spool: &SpoolParameters, released_a: f32) -> Self {
        let ([extend, retract], [ramp_extend, ramp_retract]) = (&spool.flow, &spool.ramp);
        let directions = [(extend, ramp_extend), (retract, ramp_retract)]
            .map(|(flow, ramp)| Direction { flow: FlowMap::new(flow), ramp: Ramp::new(ramp) });
        Self {
            asleep: true,
            wakes_above: directions.map(|direction| direction.flow.on_above()),
            interlock: Interlock::new(released_a),
            current: CurrentLoop::default(),
            given: Given::NOTHING,
            dither: Dither::new(&spool.dither),
            watches: [CoilWatch::default(); 2],
            cross: Suspicion::default(),
            directions,
        }
    }

    /// Nothing to do at this speed, if no code of a current is above its floor.
    #[inline(always)]
    pub(super) fn sleeps(&self, speed: f32) -> bool {
        let [extend, retract] = self.wakes_above;
        // So that NaN, which wakes nothing below, wakes nothing here.
        self.asleep && !(speed > extend || -speed > retract)
    }

    /// One tick: faults from the measured currents.
    #[inline(always)]
    pub(super) fn judge(&mut self, shared: &Shared, measured_a: Solenoids<f32>) -> Option<(Side, CoilFault)> {
        let limits = &shared.limits;
        let [extend_a, retract_a] = measured_a;
        let both = extend_a > shared.cross_a && retract_a > shared.cross_a;
        let cross = self.cross.lasts(both, shared.cross_ticks);
        // No holder was given anything.
        let side = self.interlock.holder().unwrap_or(Side::Extend);
        let [extend, retract] = &mut self.watches;
        let ((own, other), (own_a, other_a)) = (side.split([extend, retract]), side.split(measured_a));
        let own = own.judge(limits, &self.given, own_a);
        let other = other.judge_idle(limits, other_a);
        if own.is_none() && other.is_none() && !cross {
            return None;
        }
        let [extend, retract] = side.join(own, other);
        let cross = cross.then_some(CoilFault::Cross);
        let idle = self.interlock.holder().map_or(Side::Extend, Side::opposite);
        // The first of equally urgent ones.
        [(Side::Extend, extend), (Side::Retract, retract), (idle, cross)]
            .into_iter()
            .filter_map(|(side, fault)| fault.map(|fault| (side, fault)))
            .min_by_key(|(_, fault)| *fault)
    }

    /// The rest of the tick: current and duty for this speed, m/s.
    #[inline(always)]
    pub(super) fn drive(
        &mut self,
        shared: &Shared,
        gate: Gate,
        speed: f32,
        supply: &SupplyNow,
        measured_a: Solenoids<f32>,
    ) -> Option<Driven> {
        let (asked, magnitude) = if speed < 0.0 { (Side::Retract, -speed) } else { (Side::Extend, speed) };
        let [extend, retract] = &mut self.directions;
        let target_a = match gate {
            Gate::Open => {
                let (direction, opposite) = asked.split([&mut *extend, &mut *retract]);
                opposite.flow.rest();
                direction.flow.current_a(magnitude)
            }
            Gate::Closed => {
                self.interlock.release();
                for direction in [&mut *extend, &mut *retract] {
                    direction.ramp.reset();
                    direction.flow.rest();
                }
                0.0
            }
        };
        let was_off = self.interlock.holder().is_none();
        if target_a > 0.0 {
            self.interlock.request(asked, measured_a);
        }
        if let Some(side) = self.interlock.holder() {
            let (direction, _) = side.split([extend, retract]);
            let (own_a, _) = side.split(measured_a);
            let target_a = if side == asked { target_a } else { 0.0 };
            let current_a = direction.ramp.step(target_a, direction.flow.min_a());
            if current_a > 0.0 {
                if was_off {
                    self.current = CurrentLoop::start(own_a);
                    self.dither.reset();
                }
                self.asleep = false;
                let dither_a = self.dither.step(current_a);
                let duty = self.current.step(&shared.gains, supply, current_a, dither_a, own_a);
                self.given = Given {
                    volts: duty * supply.volts,
                    wanted_a: current_a + dither_a,
                    at_limit: shared.gains.at_limit(duty),
                };
                return Some(Driven { side, current_a, duty: duty_code(duty) });
            }
            self.interlock.release();
        }
        self.given = Given::NOTHING;
        let rests = self.directions.iter().all(|direction| direction.flow.rests());
        self.asleep = rests && self.cross.none() && self.watches.iter().all(CoilWatch::quiet);
        None
    }
}
