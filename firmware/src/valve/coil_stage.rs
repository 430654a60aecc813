//! The valve stage with measured currents: four spools, speeds in, duties and coil faults out.

use core::cell::Cell;

use serde::{Deserialize, Serialize};

use super::Coils;
use super::coil_fault::{FaultyCoil, WatchParameters};
use super::current_loop::LoopParameters;
use super::dither::DitherParameters;
use super::flow_map::FlowParameters;
use super::ramp::RampParameters;
use super::spool::{Now, Shared, Spool};
use crate::constants::Constant;
use crate::io::{Solenoids, Speeds};
use crate::near::near;
use crate::parameters::{Coil, ParameterError, ValveDirection, within};
use crate::supervisor::Gate;

/// A spool's parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpoolParameters {
    /// Extend, retract.
    pub flow: Solenoids<FlowParameters>,
    /// Extend, retract.
    pub ramp: Solenoids<RampParameters>,
    /// Of either solenoid.
    pub dither: DitherParameters,
}

/// How the coils' currents are measured: code = zero + current/full scale · 65536.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurrentSense {
    /// Current of all 65536 codes, A.
    pub full_scale_a: f32,
    /// Code without current.
    pub zero_code: u16,
}

impl CurrentSense {
    /// Current that a line within a hundredth of its end reads as, A.
    pub(super) fn overload_a(&self) -> f32 {
        self.full_scale_a * (64880.0 - f32::from(self.zero_code)) / 65536.0
    }
}

/// Everything the stage needs to know.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoilStageParameters {
    /// Swing, boom, arm, bucket.
    pub spools: [SpoolParameters; 4],
    /// The coils and their loop.
    pub coil: LoopParameters,
    /// Their faults.
    pub watch: WatchParameters,
    /// Their measurement.
    pub sense: CurrentSense,
    /// A solenoid waits until the other's current is below this, A.
    pub released_a: f32,
}

impl CoilStageParameters {
    /// For valves of linear flow, without ramp and dither. `inductance_h` is the
    /// coils'; the current answers in 5 ms where the supply lets it.
    pub fn plain(valves: &[Solenoids<ValveDirection>; 4], coil: &Coil, inductance_h: f32) -> Self {
        let spool = |valve: &Solenoids<ValveDirection>| SpoolParameters {
            flow: valve.map(|direction| FlowParameters::linear(&direction, coil)),
            ramp: [RampParameters::NONE; 2],
            dither: DitherParameters::NONE,
        };
        let [swing, boom, arm, bucket] = valves;
        // A cold coil's L/R is a third longer than at 20 °C; the rest is room.
        let slowest_s = 1.5 * inductance_h / coil.resistance_ohm;
        Self {
            spools: [spool(swing), spool(boom), spool(arm), spool(bucket)],
            coil: LoopParameters::tuned(coil.resistance_ohm, inductance_h, 0.005),
            watch: WatchParameters::for_coil(coil.full_scale_a, slowest_s),
            sense: CurrentSense { full_scale_a: 2.0 * coil.full_scale_a, zero_code: 2048 },
            released_a: 0.05 * coil.full_scale_a,
        }
    }

    /// Each direction by its dead band and full speed alone.
    pub fn valves(&self) -> [Solenoids<ValveDirection>; 4] {
        self.spools.map(|spool| spool.flow.map(|flow| flow.direction()))
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        for spool in &self.spools {
            spool.flow.iter().try_for_each(FlowParameters::validate)?;
            spool.ramp.iter().try_for_each(RampParameters::validate)?;
            spool.dither.validate()?;
        }
        self.coil.validate()?;
        self.watch.validate()?;
        within("current_sense.zero_code", self.sense.zero_code, [0.0, 16384.0])?;
        // An excess must lie inside what the converter can say.
        let visible = (64880.0 - f64::from(self.sense.zero_code)) / 65536.0;
        let least = f64::from(self.watch.over_current_a) / visible;
        within("current_sense.full_scale_a", self.sense.full_scale_a, [least, 50.0])?;
        within("released_a", self.released_a, [0.005, 0.5])
    }
}

/// The stage.
#[derive(Clone, Copy, Debug)]
pub struct CoilStage {
    shared: Shared,
    spools: [Spool; 4],
}

/// What a tick gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoilsDriven {
    /// Wanted currents without dither, and duties.
    pub coils: Coils,
    /// The most urgent fault. It stays as long as its cause: latching is the supervisor's.
    pub fault: Option<FaultyCoil>,
}

impl CoilStage {
    /// Everything off.
    ///
    /// # Errors
    /// The first parameter at fault, by name and range.
    pub fn new(parameters: &CoilStageParameters) -> Result<Self, ParameterError> {
        let p = parameters;
        p.validate()?;
        Ok(Self { shared: Shared::new(p), spools: p.spools.map(|spool| Spool::new(&spool, p.released_a)) })
    }

    /// Where its constants lie.
    pub(crate) fn constants(&self) -> [Constant; 9] {
        let mut maps = self.spools.iter().flat_map(Spool::constants);
        [(); 9].map(|()| maps.next().unwrap_or(Constant::of(&self.shared)))
    }

    /// One tick, to be called with the gate closed too: speeds behind the gate; the supply (V); the
    /// coils' current codes.
    #[inline]
    pub fn drive(&mut self, gate: Gate, speeds: &Speeds, supply_v: f32, codes: &[Solenoids<u16>; 4]) -> CoilsDriven {
        let this = near(self);
        let mut driven = CoilsDriven { coils: Coils::OFF, fault: None };
        let now = Now { gate, supply: this.shared.gains.supply(supply_v), begun: Cell::new(false) };
        let outputs = driven.coils.currents.iter_mut().zip(&mut driven.coils.duties);
        let speeds = speeds.to_array();
        let inputs = speeds.iter().zip(codes);
        for (index, ((spool, (&speed, codes)), (currents, duties))) in
            this.spools.iter_mut().zip(inputs).zip(outputs).enumerate()
        {
            if spool.sleeps(&this.shared, speed, *codes) {
                continue;
            }
            if let Some((side, fault)) = spool.tick::<true>(&this.shared, &now, speed, *codes, (currents, duties))
                && driven.fault.is_none_or(|so_far| fault < so_far.fault)
            {
                driven.fault = Some(FaultyCoil { spool: index, side, fault });
            }
        }
        driven
    }

    /// One tick in which one spool gets a signed current, A, extending positive, instead of a speed; the others get none. Everything
    /// else as [`Self::drive`]. Not for every tick: nothing sleeps here.
    #[inline(never)]
    pub fn drive_at_current(
        &mut self,
        gate: Gate,
        (spool, current_a): (usize, f32),
        supply_v: f32,
        codes: &[Solenoids<u16>; 4],
    ) -> CoilsDriven {
        let mut driven = CoilsDriven { coils: Coils::OFF, fault: None };
        let now = Now { gate, supply: self.shared.gains.supply(supply_v), begun: Cell::new(false) };
        let outputs = driven.coils.currents.iter_mut().zip(&mut driven.coils.duties);
        for (index, ((each, codes), outputs)) in self.spools.iter_mut().zip(codes).zip(outputs).enumerate() {
            let current_a = if index == spool { current_a } else { 0.0 };
            if let Some((side, fault)) = each.tick_at_current(&self.shared, &now, current_a, *codes, outputs)
                && driven.fault.is_none_or(|so_far| fault < so_far.fault)
            {
                driven.fault = Some(FaultyCoil { spool: index, side, fault });
            }
        }
        driven
    }
}
