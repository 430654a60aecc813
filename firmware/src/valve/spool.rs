//! One spool: two directions, their interlock, and their watches.

use super::coil_fault::{CoilFault, CoilWatch, Given, Suspicion};
use super::coil_stage::{CoilStageParameters, SpoolParameters};
use super::current_loop::{CurrentLoop, SupplyNow};
use super::dither::Dither;
use super::flow_map::FlowMap;
use super::interlock::{Interlock, Side};
use super::number::{Q, Times as _, duty_code, q};
use super::ramp::Ramp;
use crate::io::Solenoids;
use crate::supervisor::Gate;

/// One direction.
#[derive(Clone, Copy, Debug)]
struct Direction {
    flow: FlowMap,
    ramp: Ramp,
    current: CurrentLoop,
    watch: CoilWatch,
    given: Given,
}

/// What a spool's coils get.
pub(super) struct Driven {
    /// Wanted currents without dither, A.
    pub(super) currents: Solenoids<f32>,
    /// PWM duties.
    pub(super) duties: Solenoids<u16>,
    /// The most urgent fault.
    pub(super) fault: Option<(Side, CoilFault)>,
}

/// A spool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spool {
    directions: Solenoids<Direction>,
    dither: Dither,
    interlock: Interlock,
    released: Q,
    cross: Suspicion,
    cross_ticks: u16,
}

impl Spool {
    pub(super) fn new(spool: &SpoolParameters, stage: &CoilStageParameters) -> Self {
        let direction = |side: usize, of: &SpoolParameters| {
            let ([extend, retract], [up_extend, up_retract]) = (of.flow, of.ramp);
            let (flow, ramp) = if side == 0 { (extend, up_extend) } else { (retract, up_retract) };
            Direction {
                flow: FlowMap::new(&flow),
                ramp: Ramp::new(&ramp),
                current: CurrentLoop::new(&stage.coil),
                watch: CoilWatch::new(&stage.watch, &stage.coil, stage.sense.overload_a()),
                given: Given::NOTHING,
            }
        };
        let released = q(stage.released_a);
        Self {
            directions: [direction(0, spool), direction(1, spool)],
            dither: Dither::new(&spool.dither),
            interlock: Interlock::new(released),
            released,
            cross: Suspicion::default(),
            cross_ticks: stage.watch.short_ticks,
        }
    }

    /// One tick: faults from the measured currents, then currents and duties for this speed, m/s.
    pub(super) fn drive(&mut self, gate: Gate, speed: f32, supply: &SupplyNow, measured: Solenoids<Q>) -> Driven {
        let fault = self.judge(measured);
        let [extend, retract] = &mut self.directions;
        let targets = match gate {
            Gate::Open => [extend.flow.current_a(speed), retract.flow.current_a(-speed)],
            Gate::Closed => {
                self.interlock.release();
                self.directions.iter_mut().for_each(|direction| direction.ramp.reset());
                [0.0; 2]
            }
        };
        if let Some(side) = Side::BOTH.into_iter().find(|side| side.split(targets).0 > 0.0) {
            self.interlock.request(side, measured);
        }

        let holder = self.interlock.holder();
        let mut driven = Driven { currents: [0.0; 2], duties: [0; 2], fault };
        // One holder, one duty: the other solenoid's is the zero it began with.
        if let Some(side) = holder {
            let (target, _) = side.split(targets);
            let (own, _) = side.split(measured);
            let [extend, retract] = &mut self.directions;
            let (direction, other) = side.split([extend, retract]);
            other.rest();
            let current = direction.ramp.step(target, direction.flow.min_a());
            if current > 0.0 {
                let dither = self.dither.step(q(current));
                let duty = direction.step(current, dither, own, supply);
                driven.currents = side.join(current, 0.0);
                driven.duties = side.join(duty_code(duty), 0);
                return driven;
            }
            self.interlock.release();
        }
        self.dither.reset();
        for (direction, measured) in self.directions.iter_mut().zip(measured) {
            direction.rest();
            direction.current.off(measured);
        }
        driven
    }

    /// The most urgent fault of both coils and their interlock.
    fn judge(&mut self, measured: Solenoids<Q>) -> Option<(Side, CoilFault)> {
        let mut worst: Option<(Side, CoilFault)> = None;
        for ((direction, side), current) in self.directions.iter_mut().zip(Side::BOTH).zip(measured) {
            if let Some(fault) = direction.watch.judge(&direction.given, current)
                && worst.is_none_or(|(_, so_far)| fault < so_far)
            {
                worst = Some((side, fault));
            }
        }
        let [extend, retract] = measured;
        // Dying current of one may still be there while the other begins to rise, but never this much of both.
        let both = Q::from_bits(self.released.to_bits() << 1);
        let cross = self.cross.lasts(extend > both && retract > both, self.cross_ticks);
        if cross && worst.is_none_or(|(_, so_far)| CoilFault::Cross < so_far) {
            let idle = self.interlock.holder().map_or(Side::Extend, Side::opposite);
            worst = Some((idle, CoilFault::Cross));
        }
        worst
    }
}

impl Direction {
    /// No voltage until the next tick.
    fn rest(&mut self) {
        self.given = Given::NOTHING;
    }

    fn step(&mut self, current_a: f32, dither: Q, measured: Q, supply: &SupplyNow) -> Q {
        let wanted = q(current_a);
        let duty = self.current.step(wanted, dither, measured, supply);
        self.given = Given {
            volts: duty.times(supply.volts),
            wanted: wanted.saturating_add(dither),
            at_limit: supply.at_limit(duty),
        };
        duty
    }
}
