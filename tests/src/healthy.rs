//! Healthy actuators for the diagnosis: one that starts late, rings and runs on, with a sensor of 16 bit and noise; and a bench that lets
//! the diagnosis judge four of them.

use std::collections::VecDeque;

use firmware::Fault;
use firmware::diagnosis::{Diagnosis, DiagnosisParameters, Pressures};
use firmware::io::Speeds;
use firmware::sensing::SensorView;
use hil_sim::plant::sensors::Noise;

/// Travel of the tests' cylinders, m; the sensor's 16 bit lie over it.
pub const STROKE_M: f64 = 1.2;
/// A code's worth, m.
pub const UNIT_M: f64 = STROKE_M / 59_000.0;
/// Standard deviation of the sensor's noise, m.
pub const NOISE_M: f64 = 0.0001;
/// Full speed of every actuator, m/s.
pub const FULL_MPS: f64 = 0.4;

/// Pressure that moves a cylinder, Pa.
pub const MOVING_PA: f64 = 8e6;
/// Pressure of one that is held, Pa.
const RELIEF_PA: f64 = 25e6;

const TICK_S: f64 = 0.001;

/// Numbers between limits from a seed.
#[derive(Clone, Debug)]
pub struct Dice(u64);

impl Dice {
    /// Of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0xD1B5_4A32_D192_ED03)
    }

    /// Between these, by xorshift64*.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        low + (high - low) * bits as f64 / (1_u64 << 53) as f64
    }
}

/// An actuator that starts late, lags, rings and runs on; it stands at the ends of its travel and where `soil_m` holds it.
#[derive(Clone, Debug)]
pub struct Sluggish {
    under_way: VecDeque<f64>,
    /// Time constant of the spool when it opens, and when it closes, s.
    pub lag_s: [f64; 2],
    /// Natural frequency, rad/s, and damping ratio of cylinder and load.
    pub ringing: [f64; 2],
    /// Speed at full command, as a share of what the valve's calibration says.
    pub gain: f64,
    /// Extending ends here.
    pub soil_m: f64,
    spool: f64,
    speed: f64,
    pull: f64,
    /// Travel, m.
    pub position_m: f64,
    /// Pressure of the driven side, Pa: at relief soon after something has begun to hold it.
    pub pressure_pa: f64,
}

impl Sluggish {
    /// In mid travel.
    pub fn new(dead_s: f64, lag_s: [f64; 2], ringing: [f64; 2], gain: f64) -> Self {
        Self {
            under_way: VecDeque::from(vec![0.0; (dead_s / TICK_S) as usize]),
            lag_s,
            ringing,
            gain,
            soil_m: STROKE_M,
            spool: 0.0,
            speed: 0.0,
            pull: 0.0,
            position_m: STROKE_M / 2.0,
            pressure_pa: MOVING_PA,
        }
    }

    /// Any healthy one: starts within 40 to 240 ms, rings at 2 to 5 Hz, stands 0.3 to 2 s after a release.
    pub fn any(dice: &mut Dice) -> Self {
        let closing = dice.between(0.05, 0.35);
        let opening = dice.between(0.02, 0.08);
        let ringing = [core::f64::consts::TAU * dice.between(2.0, 5.0), dice.between(0.15, 0.5)];
        Self::new(dice.between(0.04, 0.24), [opening, closing], ringing, dice.between(0.7, 1.1))
    }

    /// One tick under a commanded speed, m/s.
    pub fn step(&mut self, command: f64) {
        self.under_way.push_back(command);
        let delayed = self.under_way.pop_front().unwrap_or(command);
        let opens = delayed.abs() > self.spool.abs() && delayed * self.spool >= 0.0;
        let lag_s = self.lag_s[usize::from(!opens)];
        self.spool += (delayed - self.spool) * TICK_S / lag_s;
        let [omega, damping] = self.ringing;
        let asked = self.gain * self.spool;
        self.pull += (omega * omega * (asked - self.speed) - 2.0 * damping * omega * self.pull) * TICK_S;
        self.speed += self.pull * TICK_S;
        let moved = self.position_m + self.speed * TICK_S;
        self.position_m = moved.clamp(0.0, self.soil_m.min(STROKE_M));
        if self.position_m == moved {
            self.pressure_pa += (MOVING_PA - self.pressure_pa) * TICK_S / 0.2;
        } else {
            self.pressure_pa = RELIEF_PA;
            // It bounces back a little, and what the column of oil gives is gone.
            (self.speed, self.pull) = (-0.2 * self.speed, 0.0);
        }
    }

    /// True speed, m/s.
    pub fn speed_mps(&self) -> f64 {
        self.speed
    }
}

/// The code of a position, m, with noise.
pub fn code(position_m: f64, noise: &mut Noise) -> u16 {
    (3000.0 + (position_m + NOISE_M * noise.normal()) / UNIT_M + 0.5) as u16
}

/// A diagnosis of four such actuators.
pub fn diagnosis() -> Diagnosis {
    let parameters = DiagnosisParameters::of_full_speeds([[FULL_MPS as f32; 2]; 4]);
    parameters.validate().expect("valid defaults");
    Diagnosis::new(&parameters, [SensorView { unit: UNIT_M as f32, stops: [0, u16::MAX] }; 4])
}

/// One tick of the diagnosis: what it says after these codes, before these speeds are sent.
pub fn tick(diagnosis: &mut Diagnosis, codes: &[u16; 4], pressures: &Pressures, sent: [f64; 4]) -> Option<Fault> {
    diagnosis.judge(codes, pressures);
    let fault = diagnosis.fault();
    diagnosis.sent(&Speeds::from_array(sent.map(|speed| speed as f32)));
    fault
}
