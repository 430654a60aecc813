//! Spoils the wires and the machine, and notes when that can first be seen.

use std::collections::VecDeque;

use embedded_can::Frame;
use firmware::can::CanFrame;
use firmware::simulated::{FRAMES_IN, Pins, Wires};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

use super::kind::{Bus, Cause, PANEL_FRAME, Sensor};
use crate::plant::coil::Broken;
use crate::plant::{Defect, Plant};
use crate::run::Injector;

/// The channel of the battery voltage, and its divider.
const SUPPLY: (usize, f64) = (4, 10.24 / 40.0);
/// The channel of the sensors' supply.
const SENSOR_SUPPLY: usize = 5;
/// Volts at the ends of a sensor's stroke.
const ENDS_V: [f64; 2] = [3277.0 * 10.24 / 65536.0, 62258.0 * 10.24 / 65536.0];

/// Spoils one thing from a moment on.
pub(super) struct Spoiler {
    cause: Cause,
    /// Spool of the cylinder in motion, 1 to 3, and its driving solenoid.
    pub(super) spool: usize,
    pub(super) side: usize,
    from_s: f64,
    /// 0 to 1: how bad, where the cause leaves it open.
    severity: f64,
    stroke_m: f64,
    dice: ChaCha8Rng,
    /// Sensor volts of the last half second; frames of the last 50 ms.
    past_v: VecDeque<f64>,
    past_frames: VecDeque<Option<CanFrame>>,
    frozen: [Option<CanFrame>; 20],
    held_v: Option<f64>,
    /// First moment at which the fault can be seen, as far as the wires tell.
    pub(super) observable_s: Option<f64>,
}

/// A reading this wrong can be seen, m.
const SEEN_M: f64 = 0.005;

impl Spoiler {
    pub(super) fn new(cause: Cause, from_s: f64, spool: usize, side: usize, stroke_m: f64, seed: u64) -> Self {
        let mut dice = ChaCha8Rng::seed_from_u64(seed);
        let severity = (dice.next_u32() >> 8) as f64 / f64::from(1 << 24);
        Self {
            cause,
            spool,
            side,
            from_s,
            severity,
            stroke_m,
            dice,
            past_v: VecDeque::new(),
            past_frames: VecDeque::new(),
            frozen: [None; 20],
            held_v: None,
            observable_s: None,
        }
    }

    fn seen(&mut self, time_s: f64) {
        self.observable_s.get_or_insert(time_s);
    }

    fn unit(&mut self) -> f64 {
        (self.dice.next_u32() >> 8) as f64 / f64::from(1 << 24)
    }

    /// What the sensor says instead of `volts`, `since_s` after it began to be wrong.
    fn sensor(&mut self, kind: Sensor, volts: f64, since_s: f64) -> f64 {
        let [low, high] = ENDS_V;
        let held = *self.held_v.get_or_insert(volts);
        match kind {
            Sensor::Off => 0.0,
            Sensor::Shorted => 10.0,
            Sensor::Stuck => held,
            Sensor::Garbage => 10.0 * self.unit(),
            Sensor::Gain => volts * (0.9 - 0.23 * self.severity),
            Sensor::Offset => {
                let share = (0.05 + 0.15 * self.severity) * (high - low);
                if volts > 0.5 * (low + high) { volts - share } else { volts + share }
            }
            Sensor::Sign => low + high - volts,
            Sensor::Slow => {
                let next = held + (volts - held) * (0.001 / 0.5);
                self.held_v = Some(next);
                next
            }
            Sensor::Delayed => self.past_v.get(300).copied().unwrap_or(volts),
            Sensor::Intermittent if since_s % 0.05 < 0.005 => 0.0,
            Sensor::Intermittent => volts,
            Sensor::Drift => volts + 0.001 * since_s / self.stroke_m * (high - low),
        }
    }

    fn frame(&mut self, kind: Bus, frame: Option<CanFrame>, now: usize, since_s: f64) -> Option<CanFrame> {
        match kind {
            Bus::Lost => None,
            Bus::Frozen => self.frozen[now % 20],
            Bus::Garbage => frame.and_then(|frame| {
                let bit = self.dice.next_u32() as usize % (8 * frame.data().len());
                let mut data = [0; 8];
                data.copy_from_slice(frame.data());
                data[bit / 8] ^= 1 << (bit % 8);
                CanFrame::new(frame.extended_id(), &data)
            }),
            Bus::Intermittent if since_s % 0.3 < 0.15 => None,
            Bus::Intermittent => frame,
            Bus::Delayed => self.past_frames.get(50).copied().flatten(),
        }
    }
}

impl Injector for Spoiler {
    fn wires(&mut self, time_s: f64, wires: &mut Wires) {
        let (now, since_s) = ((time_s * 1000.0 + 0.5) as usize, time_s - self.from_s);
        let volts = f64::from(wires.volts[0][self.spool]);
        let frame = wires.frames[PANEL_FRAME];
        self.past_v.push_front(volts);
        self.past_v.truncate(501);
        self.past_frames.push_front(frame);
        self.past_frames.truncate(FRAMES_IN * 20);
        if since_s < 0.0 {
            self.frozen[now % 20] = frame;
            return;
        }
        match self.cause {
            Cause::Sensor(kind) => {
                let said = self.sensor(kind, volts, since_s);
                let [low, high] = ENDS_V;
                if (said - volts).abs() / (high - low) * self.stroke_m >= SEEN_M {
                    self.seen(time_s);
                }
                wires.volts[0][self.spool] = said as f32;
            }
            Cause::Bus(kind) => {
                wires.frames[PANEL_FRAME] = self.frame(kind, frame, now, since_s);
                self.seen(time_s);
            }
            Cause::Supply(supply_v) => {
                wires.volts[0][SUPPLY.0] = (supply_v * SUPPLY.1) as f32;
                self.seen(time_s);
            }
            Cause::SensorSupply(supply_v) => {
                wires.volts[0][SENSOR_SUPPLY] = supply_v as f32;
                self.seen(time_s);
            }
            Cause::Converter(chip, broken) => {
                wires.converters[chip] = Some(broken);
                self.seen(time_s);
            }
            Cause::Overrun => {
                wires.overrun = true;
                self.seen(time_s);
            }
            Cause::Coil(_) | Cause::Spool(_) | Cause::NoPressure | Cause::Record => {}
        }
    }

    fn plant(&mut self, time_s: f64, plant: &mut Plant, pins: &Pins) {
        if time_s < self.from_s {
            return;
        }
        match self.cause {
            Cause::Coil(broken) => {
                plant.set_broken(self.spool, self.side, Some(broken));
                let driven = pins.duties[self.spool][self.side] > 0;
                // A coil at the supply shows as soon as the cut-off feeds it; the others only when they are driven.
                if driven || (broken == Broken::ShortToSupply && pins.cut_off_closed) {
                    self.seen(time_s);
                }
            }
            Cause::Spool(defect) => plant.set_defect(self.spool, Some(defect)),
            Cause::NoPressure => (0..4).for_each(|spool| plant.set_defect(spool, Some(Defect::NoPressure))),
            _ => {}
        }
    }
}
