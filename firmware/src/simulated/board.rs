//! The drivers on simulated chips.

use sim_chips::ads8688::Ads8688 as Chip;
use sim_chips::pins::{Mailboxes, Pin, Pwm};

use super::wires::{FRAMES_IN, FRAMES_OUT, Pins, Wires};
use crate::board::ads8688::{AdcError, Ads8688, Device};
use crate::board::signals::RANGES;
use crate::board::{Parts, Watchdog};
use crate::can::CanFrame;

/// A watchdog that remembers being fed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fed(bool);

impl Watchdog for Fed {
    fn feed(&mut self) {
        self.0 = true;
    }
}

/// The reference ECU's parts, simulated.
type SimulatedParts = Parts<Chip, Pwm, Pin, Pin, Mailboxes<CanFrame, FRAMES_IN, FRAMES_OUT>, Fed>;

/// The reference ECU's board.
#[derive(Debug)]
pub struct SimulatedBoard {
    parts: SimulatedParts,
}

impl SimulatedBoard {
    /// Powered up, converters configured: cut-off open, enable off, emergency stop released.
    ///
    /// # Errors
    /// The simulated converters refuse their configuration.
    pub fn new() -> Result<Self, AdcError> {
        let [sensors, coils] = RANGES;
        let mut adcs = [Ads8688::new(Chip::new(), Device::One, sensors), Ads8688::new(Chip::new(), Device::Two, coils)];
        adcs.iter_mut().try_for_each(Ads8688::configure)?;
        Ok(Self {
            parts: Parts {
                adcs,
                solenoids: [[Pwm::default(); 2]; 4],
                cut_off: Pin::new(false),
                cut_off_read_back: Pin::new(false),
                enable: Pin::new(false),
                emergency_stop_released: Pin::new(true),
                can: Mailboxes::new(),
                watchdog: Fed::default(),
            },
        })
    }

    /// Puts this tick's voltages, levels and frames to the board.
    pub fn connect(&mut self, wires: &Wires) {
        let parts = &mut self.parts;
        for ((adc, volts), broken) in parts.adcs.iter_mut().zip(&wires.volts).zip(wires.converters) {
            let chip = adc.bus();
            chip.set_broken(broken);
            for (channel, &volts) in (0..).zip(volts) {
                chip.set_volts(channel, volts);
            }
        }
        parts.enable = Pin::new(wires.enable);
        parts.emergency_stop_released = Pin::new(wires.emergency_stop_released);
        parts.cut_off_read_back = Pin::new(wires.cut_off_closed);
        parts.can.inbound = wires.frames;
        parts.can.outbound = [None; FRAMES_OUT];
        parts.watchdog = Fed::default();
    }

    /// The drivers' side.
    pub fn parts(&mut self) -> &mut SimulatedParts {
        &mut self.parts
    }

    /// What the board put on its pins since it was connected.
    pub fn pins(&self) -> Pins {
        let parts = &self.parts;
        Pins {
            duties: parts.solenoids.map(|spool| spool.map(|solenoid| solenoid.duty)),
            cut_off_closed: parts.cut_off.level.unwrap_or(false),
            watchdog_fed: parts.watchdog.0,
            frames: parts.can.outbound,
        }
    }
}
