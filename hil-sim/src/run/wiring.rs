//! From the machine and the operator to the board's connectors.

use firmware::Parameters;
use firmware::board::signals::{RANGES, SIGNALS, Signal};
use firmware::io::Solenoids;
use firmware::simulated::Wires;
use sim_chips::ads8688::{Break, Span};

use super::bus::Frames;
use super::operator::Doing;
use crate::plant::SwingDrive;
use crate::plant::coil::{CurrentAdc, Solenoid};
use crate::plant::sensors::{Noise, code};
use crate::scenario::{Events, Kind};

/// Supply of the position sensors, V.
pub(crate) const SENSOR_SUPPLY_V: f64 = 10.0;

/// Volts of every channel, from what the sensors and shunts see.
pub(crate) struct Wiring {
    parameters: Parameters,
    swing: SwingDrive,
    sensor_noise_m: f64,
    adc: CurrentAdc,
    noise: Noise,
    coil_noise: Noise,
}

/// What is measured in a tick.
pub(crate) struct Measured<'a> {
    /// Swing, boom, arm, bucket: m, a swing motor rad.
    pub(crate) positions: [f64; 4],
    /// The solenoids, a spool each.
    pub(crate) solenoids: &'a [Solenoids<Solenoid>; 4],
    /// Battery, V.
    pub(crate) supply_v: f64,
    /// The cut-off's contact.
    pub(crate) cut_off_closed: bool,
}

impl Wiring {
    /// For this controller; the seed is that of the sensors' noise.
    pub(crate) fn new(parameters: &Parameters, swing: SwingDrive, sensor_noise_m: f64, seed: u64) -> Self {
        let sense = parameters.coils.sense;
        Self {
            parameters: *parameters,
            swing,
            sensor_noise_m,
            // 12 bit over twice the full scale, and 2 mA of noise.
            adc: CurrentAdc { full_scale_a: sense.full_scale_a.into(), zero_code: sense.zero_code, noise_a: 0.002 },
            noise: Noise::new(seed),
            coil_noise: Noise::new(!seed),
        }
    }

    /// The wires of this tick; called once a tick.
    pub(crate) fn wires(
        &mut self,
        measured: &Measured<'_>,
        doing: &Doing,
        frames: Frames,
        events: &Events,
        time_s: f64,
    ) -> Wires {
        let now = |kind| events.has(kind, time_s);
        let positions = self.positions(measured.positions);
        let open = [Kind::SwingSensorOpen, Kind::BoomSensorOpen, Kind::ArmSensorOpen, Kind::BucketSensorOpen].map(now);
        let coils =
            measured.solenoids.map(|spool| spool.map(|solenoid| self.adc.code(&solenoid, &mut self.coil_noise)));
        let supply_v = if now(Kind::SupplyLost) { 0.0 } else { measured.supply_v };
        let p = &self.parameters;
        // The cast saturates.
        let share = |volts: f64, full_scale_v: f32| (volts / f64::from(full_scale_v) * 65535.0 + 0.5) as u16;
        let code_of = |signal: Signal| match signal {
            Signal::Position(spool) if open[spool] => 0,
            Signal::Position(spool) => positions[spool],
            Signal::Supply => share(supply_v, p.supply.full_scale_v),
            Signal::SensorSupply => share(SENSOR_SUPPLY_V, p.sensor_supply.full_scale_v),
            Signal::Coil(spool, solenoid) => coils[spool][solenoid],
            Signal::Spare => 0,
        };
        Wires {
            volts: std::array::from_fn(|chip| {
                std::array::from_fn(|channel| {
                    Span::of(RANGES[chip][channel].code()).volts(code_of(SIGNALS[chip][channel]))
                })
            }),
            converters: [Kind::SensorConverterLost, Kind::CoilConverterLost]
                .map(|kind| now(kind).then_some(Break::StuckHigh)),
            enable: doing.enable,
            emergency_stop_released: !doing.emergency_stop,
            cut_off_closed: measured.cut_off_closed,
            overrun: now(Kind::TickOverrun),
            frames,
        }
    }

    fn positions(&mut self, [swing, boom, arm, bucket]: [f64; 4]) -> [u16; 4] {
        let mut error = || self.sensor_noise_m * self.noise.normal();
        let swing = self.swing.code(&self.parameters.swing_sensor, swing, error());
        let [of_boom, of_arm, of_bucket] = &self.parameters.cylinder_sensors;
        [swing, code(of_boom, boom, error()), code(of_arm, arm, error()), code(of_bucket, bucket, error())]
    }
}
