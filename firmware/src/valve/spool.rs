//! One spool: two directions, their interlock, and their watches.

mod at_current;

use core::cell::Cell;

use super::coil_fault::CoilFault;
use super::coil_stage::{CoilStageParameters, SpoolParameters};
use super::coil_watch::{CoilWatch, Given, Suspicion, WatchLimits};
use super::current_loop::{CurrentLoop, LoopGains, SupplyNow};
use super::dither::Dither;
use super::flow_map::FlowMap;
use super::interlock::{Interlock, Side};
use super::number::{duty_code, fraction, share};
use super::ramp::Ramp;
use crate::constants::Constant;
use crate::io::Solenoids;
use crate::supervisor::Gate;

/// What all spools calculate with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared {
    pub(super) gains: LoopGains,
    limits: WatchLimits,
    amperes_per_code: f32,
    zero_code: u16,
    /// Currents up to this code are never judged.
    floor_code: u16,
    /// Both currents above this are a cross: dying current of one may still be there while the other begins to rise, but never this
    /// much of both.
    cross_code: u16,
    /// The smaller of the two.
    hush_code: u16,
    cross_ticks: u16,
}

impl Shared {
    /// From valid parameters.
    pub(super) fn new(stage: &CoilStageParameters) -> Self {
        let (sense, watch) = (&stage.sense, &stage.watch);
        let code = |current_a: f32| sense.zero_code.saturating_add((current_a / sense.full_scale_a * 65536.0) as u16);
        let (floor_code, cross_code) = (code(watch.floor_a), code(2.0 * stage.released_a));
        Self {
            gains: LoopGains::new(&stage.coil),
            limits: WatchLimits::new(watch, &stage.coil, sense.overload_a()),
            amperes_per_code: fraction(share(1, 0)) * sense.full_scale_a,
            zero_code: sense.zero_code,
            floor_code,
            cross_code,
            hush_code: core::cmp::min(floor_code, cross_code),
            cross_ticks: watch.short_ticks,
        }
    }

    /// A code as a current, A; below the zero code it is negative.
    #[inline(always)]
    fn measured_a(&self, code: u16) -> f32 {
        self.amperes_per_code * share(code, self.zero_code).to_bits() as f32
    }
}

/// What all spools have in common in a tick.
#[derive(Clone, Debug)]
pub(super) struct Now {
    pub(super) gate: Gate,
    pub(super) supply: SupplyNow,
    /// A solenoid has been switched on in this tick: another waits for the next, as that is what costs most. So four spools begin
    /// within 4 ms.
    pub(super) begun: Cell<bool>,
}

/// One direction.
#[derive(Clone, Copy, Debug)]
struct Direction {
    flow: FlowMap,
    ramp: Ramp,
}

/// Wanted currents without dither, A, and PWM duties.
pub(super) type Outputs<'a> = (&'a mut Solenoids<f32>, &'a mut Solenoids<u16>);

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
    /// The other solenoid's watch is quiet, and nothing looks like a cross.
    other_calm: bool,
    directions: Solenoids<Direction>,
}

impl Spool {
    /// Where the constants of its two directions lie.
    pub(super) fn constants(&self) -> Solenoids<Constant> {
        self.directions.each_ref().map(|direction| direction.flow.constant())
    }

    #[inline(never)]
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
            other_calm: false,
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

    /// One tick: the most urgent fault from the currents' codes; current and duty for this speed, m/s, of the one solenoid that is on
    /// into `outputs`, which are zero. Not inlined: the loop around it would take the registers. Generic only to be compiled with the tick.
    #[inline(never)]
    pub(super) fn tick<const IN_TICK: bool>(
        &mut self,
        shared: &Shared,
        now: &Now,
        speed: f32,
        codes: Solenoids<u16>,
        outputs: Outputs<'_>,
    ) -> Option<(Side, CoilFault)> {
        let Some(side) = self.interlock.holder() else {
            let fault = self.judge_off(shared, codes);
            if let Some((side, current_a)) = self.turn(shared, now, speed, codes) {
                self.start(shared, now, side, current_a, codes, outputs);
            }
            return fault;
        };
        let (own_code, other_code) = side.split(codes);
        let own_a = shared.measured_a(own_code);
        let own = side.of(&mut self.watches)?;
        let mut fault = own.judge(&shared.limits, &self.given, own_a).map(|fault| (side, fault));
        if fault.is_some() || !self.other_calm || other_code > shared.hush_code {
            fault = self.judge_other(shared, codes, side, fault.map(|(_, fault)| fault));
        }
        let direction = side.of(&mut self.directions)?;
        let wish = match side {
            Side::Extend => speed,
            Side::Retract => -speed,
        };
        let current_a = if now.gate == Gate::Open && direction.flow.stays_on(wish) {
            direction.ramp.follow(direction.flow.beyond(wish), direction.flow.min_a())
        } else {
            let Some((_, current_a)) = self.turn(shared, now, speed, codes) else { return fault };
            current_a
        };
        self.give(shared, now, side, current_a, own_a, outputs);
        fault
    }

    /// [`Self::give`] to a solenoid that was off.
    #[inline]
    fn start(
        &mut self,
        shared: &Shared,
        now: &Now,
        side: Side,
        current_a: f32,
        codes: Solenoids<u16>,
        outputs: Outputs<'_>,
    ) {
        let own_a = shared.measured_a(side.split(codes).0);
        self.give(shared, now, side, current_a, own_a, outputs);
    }

    /// Current and duty of the solenoid that is on.
    #[inline(always)]
    fn give(
        &mut self,
        shared: &Shared,
        now: &Now,
        side: Side,
        current_a: f32,
        own_a: f32,
        (currents, duties): Outputs<'_>,
    ) {
        let dither_a = self.dither.step(current_a);
        let duty = self.current.step(&shared.gains, &now.supply, current_a, dither_a, own_a);
        let code = duty_code(duty);
        self.given = Given { volts: duty * now.supply.volts, wanted_a: current_a + dither_a, duty: code };
        if let (Some(current), Some(duty)) = (side.of(currents), side.of(duties)) {
            (*current, *duty) = (current_a, code);
        }
    }

    /// Neither solenoid was given anything.
    #[inline]
    fn judge_off(&mut self, shared: &Shared, codes: Solenoids<u16>) -> Option<(Side, CoilFault)> {
        let ([watch, _], [code, _]) = (&mut self.watches, codes);
        let fault = watch.judge_idle(&shared.limits, shared.measured_a(code));
        self.judge_other(shared, codes, Side::Extend, fault)
    }

    /// The other solenoid, which was given nothing, and both: the most urgent fault.
    #[inline(always)]
    fn judge_other(
        &mut self,
        shared: &Shared,
        codes: Solenoids<u16>,
        side: Side,
        fault: Option<CoilFault>,
    ) -> Option<(Side, CoilFault)> {
        let (_, other_code) = side.split(codes);
        let watch = side.opposite().of(&mut self.watches)?;
        let other = watch.judge_idle(&shared.limits, shared.measured_a(other_code));
        self.other_calm = watch.quiet();
        let [extend_code, retract_code] = codes;
        let both = extend_code > shared.cross_code && retract_code > shared.cross_code;
        if !both && self.cross.none() && fault.is_none() && other.is_none() {
            return None;
        }
        self.most_urgent(shared, both, side.join(fault, other))
    }

    /// The most urgent of the solenoids' faults and a cross. Not inlined: it is for faults.
    #[inline(never)]
    fn most_urgent(
        &mut self,
        shared: &Shared,
        both: bool,
        [extend, retract]: Solenoids<Option<CoilFault>>,
    ) -> Option<(Side, CoilFault)> {
        let cross = self.cross.lasts(both, shared.cross_ticks).then_some(CoilFault::Cross);
        self.other_calm = self.other_calm && self.cross.none();
        let idle = self.interlock.holder().map_or(Side::Extend, Side::opposite);
        // The first of equally urgent ones.
        [(Side::Extend, extend), (Side::Retract, retract), (idle, cross)]
            .into_iter()
            .filter_map(|(side, fault)| fault.map(|fault| (side, fault)))
            .min_by_key(|(_, fault)| *fault)
    }

    /// The gate is closed.
    #[inline]
    fn close(&mut self) {
        self.interlock.release();
        for direction in &mut self.directions {
            direction.ramp.reset();
            direction.flow.rest();
        }
        self.rest();
    }

    /// The solenoid that is on, and its current, when it is not the one that was asked for and is on already.
    #[inline]
    fn turn(&mut self, shared: &Shared, now: &Now, speed: f32, codes: Solenoids<u16>) -> Option<(Side, f32)> {
        if now.gate == Gate::Closed {
            self.close();
            return None;
        }
        let (asked, wish) = if speed < 0.0 { (Side::Retract, -speed) } else { (Side::Extend, speed) };
        let [extend, retract] = &mut self.directions;
        let (direction, opposite) = asked.split([extend, retract]);
        opposite.flow.rest();
        let target_a = direction.flow.current_a(wish);
        if target_a > 0.0 && self.interlock.holder().is_none() && !now.begun.replace(true) {
            let measured_a = codes.map(|code| shared.measured_a(code));
            self.interlock.request(asked, measured_a);
            self.current = CurrentLoop::start(asked.split(measured_a).0);
            self.dither.reset();
            self.other_calm = false;
        }
        if let Some(side) = self.interlock.holder() {
            let [extend, retract] = &mut self.directions;
            let (direction, _) = side.split([extend, retract]);
            let target_a = if side == asked { target_a } else { 0.0 };
            let current_a = direction.ramp.step(target_a, direction.flow.min_a());
            if current_a > 0.0 {
                self.asleep = false;
                let [extend, retract] = &mut self.watches;
                side.split([extend, retract]).0.wake();
                return Some((side, current_a));
            }
            self.interlock.release();
        }
        self.rest();
        None
    }

    /// Both solenoids are off.
    #[inline]
    fn rest(&mut self) {
        self.given = Given::NOTHING;
        let flows = self.directions.iter().all(|direction| direction.flow.rests());
        self.asleep = flows && self.cross.none() && self.watches.iter().all(CoilWatch::quiet);
    }
}
