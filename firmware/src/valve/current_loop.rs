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

use crate::TICK_S;
use crate::io::limited;
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
        within("coil.resistance_ohm", self.resistance_ohm, [0.5, 100.0])?;
        // Three ticks of L/R at least: the loop is sampled.
        let least_h = 3.0 * tick_s * f64::from(self.resistance_ohm);
        within("coil.inductance_h", self.inductance_h, [least_h, 1.0])?;
        within("coil.response_s", self.response_s, [3.0 * tick_s, 0.5])?;
        // Half a tick's deadbeat gain.
        let most = 0.5 * f64::from(self.inductance_h) / tick_s;
        within("coil.proportional_v_per_a", self.proportional_v_per_a, [0.0, most])?;
        let stiffness = f64::from(self.resistance_ohm) + f64::from(self.proportional_v_per_a);
        within("coil.integral_v_per_a_s", self.integral_v_per_a_s, [0.0, 100.0 * stiffness])?;
        within("coil.freewheel_v", self.freewheel_v, [0.0, 2.0])?;
        within("coil.max_duty", self.max_duty, [0.5, 1.0])
    }
}

/// The supply as the loops use it, once a tick for all of them.
#[derive(Clone, Copy, Debug)]
pub struct SupplyNow {
    /// Voltage, V.
    pub volts: f32,
    /// 1/(V + V_f), 1/V.
    per_volt: f32,
    /// Highest mean voltage of a coil, V.
    most_v: f32,
}

/// What all the loops calculate with.
#[derive(Clone, Copy, Debug)]
pub struct LoopGains {
    resistance_ohm: f32,
    inductance_per_tick: f32,
    inductance_per_response: f32,
    ticks_per_inductance: f32,
    proportional: f32,
    integral_per_tick: f32,
    freewheel_v: f32,
    max_duty: f32,
}

impl LoopGains {
    /// From valid parameters.
    pub fn new(parameters: &LoopParameters) -> Self {
        let p = parameters;
        Self {
            resistance_ohm: p.resistance_ohm,
            inductance_per_tick: p.inductance_h / TICK_S,
            inductance_per_response: p.inductance_h / p.response_s,
            ticks_per_inductance: TICK_S / p.inductance_h,
            proportional: p.proportional_v_per_a,
            integral_per_tick: p.integral_v_per_a_s * TICK_S,
            freewheel_v: p.freewheel_v,
            max_duty: p.max_duty,
        }
    }

    /// This tick's supply. Outside 1…1000 V it counts as the nearer of the two, and NaN as 1 V, so that every quotient is finite.
    #[inline(always)]
    pub fn supply(&self, supply_v: f32) -> SupplyNow {
        let volts = if supply_v > 1.0 { limited(supply_v, 1.0, 1000.0) } else { 1.0 };
        let swing = volts + self.freewheel_v;
        SupplyNow { volts, per_volt: 1.0 / swing, most_v: self.max_duty * swing - self.freewheel_v }
    }
}

/// A loop: where its reference, dither (A) and integral (V) are.
#[derive(Clone, Copy, Debug, Default)]
pub struct CurrentLoop {
    reference_a: f32,
    dither_a: f32,
    integral_v: f32,
}

impl CurrentLoop {
    /// Begins at the current that is there, A.
    #[inline(always)]
    pub fn start(measured_a: f32) -> Self {
        Self { reference_a: measured_a, dither_a: 0.0, integral_v: 0.0 }
    }

    /// Duty, a fraction to within rounding, for the wanted current and the dither of the next tick, all in A.
    #[inline(always)]
    pub fn step(&mut self, g: &LoopGains, supply: &SupplyNow, wanted_a: f32, dither_a: f32, measured_a: f32) -> f32 {
        let error = self.reference_a + self.dither_a - measured_a;
        let resistive = g.resistance_ohm * (self.reference_a + dither_a);
        let shaken = g.inductance_per_tick * (dither_a - self.dither_a);
        let drive = g.inductance_per_response * (wanted_a - self.reference_a);
        let voltage = resistive + shaken + drive + g.proportional * error + self.integral_v;
        let given = limited(voltage, -g.freewheel_v, supply.most_v);

        let excess = given - voltage;
        let reference = self.reference_a + g.ticks_per_inductance * (drive + excess);
        self.reference_a = if reference > 0.0 { reference } else { 0.0 };
        self.dither_a = dither_a;
        // Opposite signs: u is out of bounds and the error would drive it farther out.
        if excess * error >= 0.0 {
            self.integral_v += g.integral_per_tick * error;
        }
        (given + g.freewheel_v) * supply.per_volt
    }
}
