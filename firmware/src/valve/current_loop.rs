//! One coil's current: feed-forward of R·i and L·di/dt on a reference that the supply can follow, and a PI on what is left.
//!
//! At every tick (1 kHz): measured code → current, this loop, duty. Between ticks the timer repeats the duty at its carrier (20 kHz or so, 20
//! periods a tick); the winding's L/R of 10 to 30 ms averages it, so the loop deals with mean voltages only.
//!
//! With current x of the reference, dither d, measured current i, error e = x + d − i, I = ∫ k_I·e dt, and time constant τ:
//! ```text
//! u  = R·(x + d) + L·ḋ + L/τ·(wanted − x) + k_P·e + I        wanted coil voltage
//! u' = u within −V_f … duty_max·(V + V_f) − V_f              what supply and freewheel can give
//! ẋ  = (wanted − x)/τ + (u' − u)/L                           the reference goes as fast as u' lets it: no wind-up of its own
//! duty = (u' + V_f)/(V + V_f)                                supply compensation
//! ```
//! I stands still while u is out of bounds and e would drive it farther out.

use serde::{Deserialize, Serialize};

use super::number::{Q, Times as _, bounded, q, si};
use crate::TICK_S;
use crate::parameters::{ParameterError, within};

/// The coils, all alike, and their loops' tuning.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoopParameters {
    /// Winding resistance at 20 °C, Ω.
    pub resistance_ohm: f32,
    /// Inductance, H.
    pub inductance_h: f32,
    /// Time constant of the answer to a step that the supply can follow, s.
    pub response_s: f32,
    /// Proportional gain, V/A.
    pub proportional_v_per_a: f32,
    /// Integral gain, V/(A·s).
    pub integral_v_per_a_s: f32,
    /// Drop of the freewheeling diode, V.
    pub freewheel_v: f32,
    /// Largest duty the driver allows, fraction.
    pub max_duty: f32,
}

impl LoopParameters {
    /// Gains for a coil of this resistance and inductance: errors die away about as fast as `response_s`, without oscillation.
    pub fn tuned(resistance_ohm: f32, inductance_h: f32, response_s: f32) -> Self {
        let proportional = inductance_h / response_s - resistance_ohm;
        let proportional_v_per_a = if proportional > 0.0 { proportional } else { 0.0 };
        // From (R + k_P)²/4L on the error would oscillate.
        let stiffness = resistance_ohm + proportional_v_per_a;
        Self {
            resistance_ohm,
            inductance_h,
            response_s,
            proportional_v_per_a,
            integral_v_per_a_s: stiffness * stiffness / inductance_h / 5.0,
            freewheel_v: 0.7,
            max_duty: 1.0,
        }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        let tick_s = f64::from(TICK_S);
        within("coil.resistance_ohm", self.resistance_ohm.into(), [0.5, 100.0])?;
        // Three ticks of L/R at least: the loop is sampled.
        let least_h = 3.0 * tick_s * f64::from(self.resistance_ohm);
        within("coil.inductance_h", self.inductance_h.into(), [least_h, 1.0])?;
        within("coil.response_s", self.response_s.into(), [3.0 * tick_s, 0.5])?;
        // Half a tick's deadbeat gain.
        let most = 0.5 * f64::from(self.inductance_h) / tick_s;
        within("coil.proportional_v_per_a", self.proportional_v_per_a.into(), [0.0, most])?;
        let stiffness = f64::from(self.resistance_ohm) + f64::from(self.proportional_v_per_a);
        within("coil.integral_v_per_a_s", self.integral_v_per_a_s.into(), [0.0, 100.0 * stiffness])?;
        within("coil.freewheel_v", self.freewheel_v.into(), [0.0, 2.0])?;
        within("coil.max_duty", self.max_duty.into(), [0.5, 1.0])
    }
}

/// The supply as the loops use it, once a tick for all of them.
#[derive(Clone, Copy, Debug)]
pub struct SupplyNow {
    /// Voltage, V.
    pub volts: Q,
    /// 1/(V + V_f), 1/V.
    per_volt: Q,
    /// Highest mean voltage of a coil, V.
    most: Q,
    /// The largest duty, less a hair that rounding may take.
    limit: Q,
}

impl SupplyNow {
    /// This duty is as large as it can be.
    pub fn at_limit(&self, duty: Q) -> bool {
        duty >= self.limit
    }
}

/// A coil's loop.
#[derive(Clone, Copy, Debug)]
pub struct CurrentLoop {
    resistance: Q,
    inductance_per_tick: Q,
    inductance_per_response: Q,
    ticks_per_inductance: Q,
    proportional: Q,
    integral_per_tick: Q,
    freewheel: Q,
    max_duty: f32,
    reference: Q,
    dither: Q,
    integral: Q,
}

impl CurrentLoop {
    /// At rest, from valid parameters.
    pub fn new(parameters: &LoopParameters) -> Self {
        let p = parameters;
        Self {
            resistance: q(p.resistance_ohm),
            inductance_per_tick: q(p.inductance_h / TICK_S),
            inductance_per_response: q(p.inductance_h / p.response_s),
            ticks_per_inductance: q(TICK_S / p.inductance_h),
            proportional: q(p.proportional_v_per_a),
            integral_per_tick: q(p.integral_v_per_a_s * TICK_S),
            freewheel: q(p.freewheel_v),
            max_duty: p.max_duty,
            reference: Q::ZERO,
            dither: Q::ZERO,
            integral: Q::ZERO,
        }
    }

    /// This tick's supply. Below 1 V it counts as 1 V, so that nothing divides by zero.
    pub fn supply(&self, supply_v: f32) -> SupplyNow {
        let volts = if supply_v > 1.0 { supply_v } else { 1.0 };
        let freewheel = si(self.freewheel);
        let swing = volts + freewheel;
        SupplyNow {
            volts: q(volts),
            per_volt: q(1.0 / swing),
            most: q(self.max_duty * swing - freewheel),
            limit: q(self.max_duty - 0.001),
        }
    }

    /// No voltage; the next start begins at the current that is there.
    pub fn off(&mut self, measured: Q) -> Q {
        (self.reference, self.dither, self.integral) = (measured, Q::ZERO, Q::ZERO);
        Q::ZERO
    }

    /// Duty, a fraction, for the wanted current and the dither of the next tick, all in A.
    pub fn step(&mut self, wanted: Q, dither: Q, measured: Q, supply: &SupplyNow) -> Q {
        let error = self.reference.saturating_add(self.dither).saturating_sub(measured);
        let resistive = self.resistance.times(self.reference.saturating_add(dither));
        let shaken = self.inductance_per_tick.times(dither.saturating_sub(self.dither));
        let drive = self.inductance_per_response.times(wanted.saturating_sub(self.reference));
        let voltage = resistive
            .saturating_add(shaken)
            .saturating_add(drive)
            .saturating_add(self.proportional.times(error))
            .saturating_add(self.integral);
        let given = bounded(voltage, self.freewheel.saturating_neg(), supply.most);

        let excess = given.saturating_sub(voltage);
        let moved = self.ticks_per_inductance.times(drive.saturating_add(excess));
        self.reference = core::cmp::max(self.reference.saturating_add(moved), Q::ZERO);
        self.dither = dither;
        let farther_out = (excess < Q::ZERO && error > Q::ZERO) || (excess > Q::ZERO && error < Q::ZERO);
        if !farther_out {
            self.integral = self.integral.saturating_add(self.integral_per_tick.times(error));
        }
        bounded(given.saturating_add(self.freewheel).times(supply.per_volt), Q::ZERO, Q::ONE)
    }
}
