//! Last stage: actuator speeds → coil currents → PWM duties, through each direction's dead band and gain.

use crate::io::{Solenoids, Speeds, limited};
use crate::parameters::{Coil, ValveDirection};
use crate::supervisor::Gate;

/// One direction of a spool: current = dead band + slope · speed, as fractions of full scale.
#[derive(Clone, Copy, Debug)]
struct Direction {
    dead_band_a: f32,
    amperes_per_speed: f32,
    full_scale_a: f32,
}

impl Direction {
    fn new(valve: &ValveDirection, coil: &Coil) -> Self {
        let full_scale_a = coil.full_scale_a;
        Self {
            dead_band_a: valve.dead_band * full_scale_a,
            amperes_per_speed: (1.0 - valve.dead_band) * full_scale_a / valve.full_speed,
            full_scale_a,
        }
    }

    /// Current for a speed in this direction, A; no speed, no current.
    fn current(&self, speed: f32) -> f32 {
        if speed > 0.0 {
            limited(self.dead_band_a + self.amperes_per_speed * speed, 0.0, self.full_scale_a)
        } else {
            0.0
        }
    }
}

/// What the coils get.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coils {
    /// A, a spool each.
    pub currents: [Solenoids<f32>; 4],
    /// PWM duties, a spool each; 65535 is always on.
    pub duties: [Solenoids<u16>; 4],
}

impl Coils {
    /// No current anywhere.
    pub const OFF: Self = Self { currents: [[0.0; 2]; 4], duties: [[0; 2]; 4] };
}

/// The valve stage.
#[derive(Clone, Copy, Debug)]
pub struct Valve {
    /// Swing, boom, arm, bucket: \[extend, retract\].
    spools: [[Direction; 2]; 4],
    resistance_ohm: f32,
}

impl Valve {
    pub(crate) fn new(spools: &[[ValveDirection; 2]; 4], coil: &Coil) -> Self {
        let directions = spools.map(|spool| spool.map(|direction| Direction::new(&direction, coil)));
        Self { spools: directions, resistance_ohm: coil.resistance_ohm }
    }

    /// Coil currents and duties for the speeds behind the gate, at this supply voltage.
    pub fn drive(&self, gate: Gate, speeds: &Speeds, supply_v: f32) -> Coils {
        let mut coils = Coils::OFF;
        if gate == Gate::Closed {
            return coils;
        }
        let duty_per_ampere = self.resistance_ohm / supply_v * 65535.0;
        let driven = coils.currents.iter_mut().zip(&mut coils.duties);
        let wanted = self.spools.iter().zip(speeds.to_array());
        for ((currents, duties), ([extend, retract], speed)) in driven.zip(wanted) {
            // One of the two is zero: both solenoids of a spool are never on together.
            *currents = [extend.current(speed), retract.current(-speed)];
            // The cast saturates: a supply too low for the current gives full duty.
            *duties = currents.map(|current| (current * duty_per_ampere + 0.5) as u16);
        }
        coils
    }
}
