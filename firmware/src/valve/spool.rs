//! One spool: two directions, their interlock, and their watches.

use super::coil_fault::CoilFault;
use super::coil_stage::{CoilStageParameters, SpoolParameters};
use super::coil_watch::{CoilWatch, Given, Suspicion, WatchLimits};
use super::current_loop::{CurrentLoop, LoopGains, SupplyNow};
use super::dither::Dither;
use super::flow_map::FlowMap;
use super::interlock::{Interlock, Side};
use super::number::{duty_code, fraction, share};
use super::ramp::Ramp;
use crate::io::Solenoids;
use crate::supervisor::Gate;

/// What all spools calculate with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared {
    pub(super) gains: LoopGains,
    limits: WatchLimits,
    full_scale_a: f32,
    zero_code: u16,
    /// Currents up to this code are never judged.
    floor_code: u16,
    /// Both currents above this are a cross: dying current of one may still be there while the other begins to rise, but never this
    /// much of both.
    cross_code: u16,
    cross_ticks: u16,
}

impl Shared {
    /// From valid parameters.
    pub(super) fn new(stage: &CoilStageParameters) -> Self {
        let (sense, watch) = (&stage.sense, &stage.watch);
        let code = |current_a: f32| sense.zero_code.saturating_add((current_a / sense.full_scale_a * 65536.0) as u16);
        Self {
            gains: LoopGains::new(&stage.coil),
            limits: WatchLimits::new(watch, &stage.coil, sense.overload_a()),
            full_scale_a: sense.full_scale_a,
            zero_code: sense.zero_code,
            floor_code: code(watch.floor_a),
            cross_code: code(2.0 * stage.released_a),
            cross_ticks: watch.short_ticks,
        }
    }

    /// A code as a current, A; below the zero code it is negative.
    #[inline(always)]
    fn measured_a(&self, code: u16) -> f32 {
        self.full_scale_a * fraction(share(code, self.zero_code))
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

    /// Nothing to do at this speed with these codes of the currents.
    #[inline(always)]
    pub(super) fn sleeps(&self, shared: &Shared, speed: f32, codes: Solenoids<u16>) -> bool {
        let ([extend, retract], [extend_code, retract_code]) = (self.wakes_above, codes);
        // So that NaN, which wakes nothing below, wakes nothing here.
        self.asleep
            && extend_code <= shared.floor_code
            && retract_code <= shared.floor_code
            && !(speed > extend || -speed > retract)
    }

    /// One tick: faults from the currents' codes.
    #[inline(always)]
    pub(super) fn judge(&mut self, shared: &Shared, codes: Solenoids<u16>) -> Option<(Side, CoilFault)> {
        let Some(side) = self.interlock.holder() else { return self.judge_off(shared, codes) };
        let [extend, retract] = &mut self.watches;
        let ((own, other), (own_code, other_code)) = (side.split([extend, retract]), side.split(codes));
        let fault = own.judge(&shared.limits, &self.given, shared.measured_a(own_code));
        let calm = other.quiet() && other_code <= shared.floor_code && other_code <= shared.cross_code;
        if fault.is_none() && calm && self.cross.none() {
            return None;
        }
        self.judge_other(shared, codes, side, fault)
    }

    /// Neither solenoid was given anything. Not inlined: it is for currents that die.
    #[inline(never)]
    fn judge_off(&mut self, shared: &Shared, codes: Solenoids<u16>) -> Option<(Side, CoilFault)> {
        let ([watch, _], [code, _]) = (&mut self.watches, codes);
        let fault = watch.judge_idle(&shared.limits, shared.measured_a(code));
        self.judge_other(shared, codes, Side::Extend, fault)
    }

    /// The other solenoid, which was given nothing, and both: the most urgent fault. Not inlined: mostly the other one is off.
    #[inline(never)]
    fn judge_other(
        &mut self,
        shared: &Shared,
        codes: Solenoids<u16>,
        side: Side,
        fault: Option<CoilFault>,
    ) -> Option<(Side, CoilFault)> {
        let [extend, retract] = &mut self.watches;
        let ((_, other), (_, other_code)) = (side.split([extend, retract]), side.split(codes));
        let other = other.judge_idle(&shared.limits, shared.measured_a(other_code));
        let both = codes.into_iter().all(|code| code > shared.cross_code);
        let cross = self.cross.lasts(both, shared.cross_ticks).then_some(CoilFault::Cross);
        let idle = self.interlock.holder().map_or(Side::Extend, Side::opposite);
        let [extend, retract] = side.join(fault, other);
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
        codes: Solenoids<u16>,
    ) -> Option<Driven> {
        if gate == Gate::Closed {
            self.close();
            return None;
        }
        let (asked, magnitude) = if speed < 0.0 { (Side::Retract, -speed) } else { (Side::Extend, speed) };
        let [extend, retract] = &mut self.directions;
        let (direction, opposite) = asked.split([extend, retract]);
        opposite.flow.rest();
        let target_a = direction.flow.current_a(magnitude);
        let (side, current_a) = if target_a > 0.0 && self.interlock.holder() == Some(asked) {
            (asked, direction.ramp.step(target_a, direction.flow.min_a()))
        } else {
            self.turn(shared, asked, target_a, codes)?
        };
        let (own_code, _) = side.split(codes);
        let dither_a = self.dither.step(current_a);
        let duty = self.current.step(&shared.gains, supply, current_a, dither_a, shared.measured_a(own_code));
        let code = duty_code(duty);
        self.given = Given { volts: duty * supply.volts, wanted_a: current_a + dither_a, duty: code };
        Some(Driven { side, current_a, duty: code })
    }

    /// The gate is closed.
    #[inline(never)]
    fn close(&mut self) {
        self.interlock.release();
        for direction in &mut self.directions {
            direction.ramp.reset();
            direction.flow.rest();
        }
        self.rest();
    }

    /// The solenoid that is on, and its current, when it is not the one that was asked for and is on already. Not inlined: it is
    /// for starts, ends and changes of direction.
    #[inline(never)]
    fn turn(&mut self, shared: &Shared, asked: Side, target_a: f32, codes: Solenoids<u16>) -> Option<(Side, f32)> {
        let measured_a = codes.map(|code| shared.measured_a(code));
        if target_a > 0.0 && self.interlock.holder().is_none() {
            self.interlock.request(asked, measured_a);
            self.current = CurrentLoop::start(asked.split(measured_a).0);
            self.dither.reset();
        }
        if let Some(side) = self.interlock.holder() {
            let [extend, retract] = &mut self.directions;
            let (direction, _) = side.split([extend, retract]);
            let target_a = if side == asked { target_a } else { 0.0 };
            let current_a = direction.ramp.step(target_a, direction.flow.min_a());
            if current_a > 0.0 {
                self.asleep = false;
                return Some((side, current_a));
            }
            self.interlock.release();
        }
        self.rest();
        None
    }

    /// Both solenoids are off.
    fn rest(&mut self) {
        self.given = Given::NOTHING;
        let flows = self.directions.iter().all(|direction| direction.flow.rests());
        self.asleep = flows && self.cross.none() && self.watches.iter().all(CoilWatch::quiet);
    }
}
