//! Solenoids and what surrounds them: the winding at its temperature, the supply with its ripple, the current's converter.
//!
//! The high-side switch chops the supply onto the winding, at 20 kHz or so; while it is off the current freewheels through a diode. The
//! carrier is averaged: over a step the winding sees duty·V − (1 − duty)·V_f. The step is solved exactly, not by small steps.

use super::sensors::Noise;

/// Copper, 1/K at 20 °C.
pub const COPPER_PER_K: f64 = 0.003_93;

/// A winding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolenoidModel {
    /// Resistance at 20 °C, Ω.
    pub resistance_ohm: f64,
    /// Inductance without current, H.
    pub inductance_h: f64,
    /// Current at which the iron has halved the inductance, A; infinite for a linear coil.
    pub saturation_a: f64,
    /// Drop of the freewheeling diode, V.
    pub freewheel_v: f64,
    /// Voltage of the clamp against which the current dies when the cut-off opens, V.
    pub clamp_v: f64,
}

/// What is broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Broken {
    /// A wire is off.
    Open,
    /// The driver's wire touches the supply: full voltage, whatever the duty, as long as the cut-off closes the return.
    ShortToSupply,
    /// The driver's wire touches ground: the switch limits and reports overload, the winding gets nothing.
    ShortToGround,
    /// The resistance is this many times what it should be: above 1 a corroded plug, below 1 shorted turns.
    Resistance(f64),
}

/// What a solenoid is driven with over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Duty, 0…1.
    pub duty: f64,
    /// Mean supply voltage, V.
    pub supply_v: f64,
    /// The master cut-off is closed.
    pub cut_off_closed: bool,
}

/// A solenoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solenoid {
    model: SolenoidModel,
    /// Of the winding, °C.
    pub temperature_c: f64,
    /// What is broken.
    pub broken: Option<Broken>,
    current_a: f64,
    overload: bool,
}

impl Solenoid {
    /// Without current.
    pub fn new(model: SolenoidModel, temperature_c: f64) -> Self {
        Self { model, temperature_c, broken: None, current_a: 0.0, overload: false }
    }

    /// Resistance now, Ω.
    pub fn resistance_ohm(&self) -> f64 {
        let whole = self.model.resistance_ohm * (1.0 + COPPER_PER_K * (self.temperature_c - 20.0));
        if let Some(Broken::Resistance(times)) = self.broken { whole * times } else { whole }
    }

    /// One step. The inductance is that of the current at its beginning.
    pub fn step(&mut self, drive: &Drive, step_s: f64) {
        let duty = if drive.cut_off_closed { drive.duty } else { 0.0 };
        self.overload = self.broken == Some(Broken::ShortToGround) && duty > 0.0;
        let freewheel_v = if drive.cut_off_closed { self.model.freewheel_v } else { self.model.clamp_v };
        let volts = match self.broken {
            // The cut-off opens the solenoids' common return.
            Some(Broken::ShortToSupply) if drive.cut_off_closed => drive.supply_v,
            Some(Broken::ShortToSupply) => -freewheel_v,
            Some(Broken::ShortToGround) => 0.0,
            Some(Broken::Open | Broken::Resistance(_)) | None => duty * drive.supply_v - (1.0 - duty) * freewheel_v,
        };
        if self.broken == Some(Broken::Open) {
            self.current_a = 0.0;
            return;
        }
        if volts <= 0.0 && self.current_a == 0.0 {
            return;
        }
        let resistance = self.resistance_ohm();
        let saturation = self.current_a / self.model.saturation_a;
        let inductance = self.model.inductance_h / (1.0 + saturation * saturation);
        let end = volts / resistance;
        let moved = end + (self.current_a - end) * libm::exp(-step_s * resistance / inductance);
        // The diode lets nothing flow backwards.
        self.current_a = if moved > 0.0 { moved } else { 0.0 };
    }

    /// Current through the winding, A.
    pub fn current_a(&self) -> f64 {
        self.current_a
    }
}

/// A supply with a sine on top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupplyModel {
    /// Mean, V.
    pub volts: f64,
    /// Amplitude of the ripple, V.
    pub ripple_v: f64,
    /// Its frequency, Hz.
    pub ripple_hz: f64,
}

impl SupplyModel {
    fn angle(&self, time_s: f64) -> f64 {
        core::f64::consts::TAU * self.ripple_hz * time_s
    }

    /// Voltage at a moment, V.
    pub fn at(&self, time_s: f64) -> f64 {
        self.volts + self.ripple_v * libm::sin(self.angle(time_s))
    }

    /// Mean over a step beginning at `time_s`, V.
    pub fn mean(&self, time_s: f64, step_s: f64) -> f64 {
        let turned = self.angle(step_s);
        if turned == 0.0 {
            return self.at(time_s);
        }
        let swing = libm::cos(self.angle(time_s)) - libm::cos(self.angle(time_s + step_s));
        self.volts + self.ripple_v * swing / turned
    }
}

/// The converter of a current: 12 bit in the upper bits of a code, a zero above 0, Gaussian noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentAdc {
    /// Current of all 65536 codes, A.
    pub full_scale_a: f64,
    /// Code without current.
    pub zero_code: u16,
    /// Standard deviation, A.
    pub noise_a: f64,
}

impl CurrentAdc {
    /// The code of a solenoid's current. A switch in overload pulls the line to full scale.
    pub fn code(&self, solenoid: &Solenoid, noise: &mut Noise) -> u16 {
        if solenoid.overload {
            return u16::MAX;
        }
        let current = solenoid.current_a + self.noise_a * noise.normal();
        // The cast saturates; the lowest four bits are not converted, and half a step is added for their mean.
        (f64::from(self.zero_code) + current / self.full_scale_a * 65536.0 + 8.0) as u16 & 0xFFF0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: SolenoidModel = SolenoidModel {
        resistance_ohm: 5.0,
        inductance_h: 0.1,
        saturation_a: f64::INFINITY,
        freewheel_v: 0.7,
        clamp_v: 40.0,
    };
    const FULL: Drive = Drive { duty: 1.0, supply_v: 10.0, cut_off_closed: true };

    #[test]
    fn one_long_step_and_many_short_ones_give_the_same_current() {
        let (mut once, mut often) = (Solenoid::new(MODEL, 20.0), Solenoid::new(MODEL, 20.0));
        once.step(&FULL, 0.02);
        (0..2000).for_each(|_| often.step(&FULL, 1e-5));
        let exact = 2.0 * (1.0 - libm::exp(-1.0));
        assert!((once.current_a() - exact).abs() < 1e-12 && (often.current_a() - exact).abs() < 1e-9);
    }

    #[test]
    fn a_hot_winding_carries_less_and_an_open_cut_off_kills_the_current_faster_than_the_diode() {
        let mut hot = Solenoid::new(MODEL, 120.0);
        hot.step(&FULL, 1.0);
        assert!((hot.current_a() - 2.0 / 1.393).abs() < 1e-6);
        let (mut diode, mut clamp) = (hot, hot);
        diode.step(&Drive { duty: 0.0, ..FULL }, 0.002);
        clamp.step(&Drive { cut_off_closed: false, ..FULL }, 0.002);
        assert!(clamp.current_a() < 0.6 * diode.current_a() && diode.current_a() > 0.0);
    }

    #[test]
    fn iron_that_saturates_lets_the_current_rise_faster() {
        let mut linear = Solenoid::new(MODEL, 20.0);
        let mut saturating = Solenoid::new(SolenoidModel { saturation_a: 1.0, ..MODEL }, 20.0);
        for _ in 0..20 {
            linear.step(&FULL, 0.001);
            saturating.step(&FULL, 0.001);
        }
        assert!(saturating.current_a() > 1.05 * linear.current_a());
    }

    #[test]
    fn the_mean_of_the_ripple_over_whole_turns_is_the_supply() {
        let supply = SupplyModel { volts: 24.0, ripple_v: 2.0, ripple_hz: 1000.0 };
        assert!((supply.mean(0.0003, 0.001) - 24.0).abs() < 1e-12);
        assert!((supply.mean(0.0, 0.0005) - (24.0 + 4.0 / core::f64::consts::PI)).abs() < 1e-12);
        assert!((supply.at(0.00025) - 26.0).abs() < 1e-12);
    }

    #[test]
    fn a_short_to_ground_reads_full_scale_only_while_the_switch_is_on() {
        let adc = CurrentAdc { full_scale_a: 3.0, zero_code: 2048, noise_a: 0.0 };
        let mut noise = Noise::new(1);
        let mut solenoid = Solenoid::new(MODEL, 20.0);
        assert_eq!(adc.code(&solenoid, &mut noise), 2048);
        solenoid.broken = Some(Broken::ShortToGround);
        solenoid.step(&FULL, 0.001);
        assert_eq!(adc.code(&solenoid, &mut noise), u16::MAX);
        solenoid.step(&Drive { duty: 0.0, ..FULL }, 0.001);
        assert_eq!(adc.code(&solenoid, &mut noise), 2048);
    }
}
