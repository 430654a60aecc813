//! The emulated controller with something that breaks in it, as a place: when the image has ended, its outputs are off.

use firmware::Outputs;
use firmware::frame::OUTPUT_BYTES;
use firmware::simulated::link::{self, Spoil, Zone};
use firmware::simulated::{Pins, Wires};

use crate::place::{Emulator, Place, PlaceError, Reply, Timing};

/// Until the watchdog bites the outputs stay as they are, ticks.
const WATCHDOG_TICKS: u32 = 50;
/// Exit codes of the image that only the watchdog would have ended on a board.
const WATCHDOG: [i32; 2] = [14, 134];

/// What the outputs are when the image has ended.
const OFF: Pins = Pins { duties: [[0; 2]; 4], cut_off_closed: false, watchdog_fed: false, frames: [None; 3] };

/// The place.
pub(super) struct Spoilt {
    emulator: Emulator,
    spoil: Spoil,
    at_tick: u32,
    tick: u32,
    /// Ticks that are still lost.
    lost: u32,
    last: Option<(Outputs, Pins)>,
    /// Where the bit was.
    pub(super) zone: Option<Zone>,
    /// How the image ended, and in which tick.
    pub(super) ended: Option<(i32, u32)>,
    /// What the controller put on its pins, tick by tick.
    pub(super) pins: Vec<Pins>,
}

impl Spoilt {
    pub(super) fn new(emulator: Emulator, spoil: Spoil, at_tick: u32) -> Self {
        Self { emulator, spoil, at_tick, tick: 0, lost: 0, last: None, zone: None, ended: None, pins: Vec::new() }
    }

    /// The most instructions that the watch over the constants took in a tick; `None` of an image that has ended.
    pub(super) fn finish(self) -> Result<Option<u32>, PlaceError> {
        if self.ended.is_some() { Ok(None) } else { self.emulator.finish().map(Some) }
    }

    fn next(&mut self, wires: &Wires) -> Result<(Outputs, Pins), PlaceError> {
        if self.tick == self.at_tick {
            self.zone = Some(self.emulator.spoil(self.spoil)?);
            self.lost = match self.spoil {
                Spoil::LoseTicks(ticks) if ticks < u32::MAX => ticks,
                _ => 0,
            };
        }
        if let (1.., Some(last)) = (self.lost, self.last) {
            self.lost -= 1;
            return Ok(last);
        }
        let bytes = self.emulator.exchange(wires)?;
        match link::Reply::from_bytes(&bytes) {
            Ok(reply) => Ok((reply.outputs, reply.pins)),
            // A state that is none: what it says of itself is nothing to go by, what it does stands behind it.
            Err(error) => match (self.last, bytes.get(OUTPUT_BYTES..).and_then(|rest| rest.first_chunk())) {
                (Some((outputs, _)), Some(pins)) => Ok((outputs, Pins::from_bytes(pins).map_err(|_| error)?)),
                _ => Err(error.into()),
            },
        }
    }
}

impl Place for Spoilt {
    fn tick(&mut self, wires: &Wires) -> Result<Reply, PlaceError> {
        if self.ended.is_none() {
            match self.next(wires) {
                Ok(next) => self.last = Some(next),
                Err(error) => {
                    let code = self.emulator.exit_code().ok_or(error)?;
                    self.ended = Some((code, self.tick));
                }
            }
        }
        let Some((outputs, held)) = self.last else {
            return Err(PlaceError::Lost {
                why: "the image ended before its first tick".to_owned(),
                said: String::new(),
            });
        };
        let pins = match self.ended {
            None => held,
            Some((code, at)) if WATCHDOG.contains(&code) && self.tick < at + WATCHDOG_TICKS => held,
            Some(_) => OFF,
        };
        self.tick += 1;
        self.pins.push(pins);
        Ok(Reply { outputs, pins, timing: Timing::Host { wall_ns: 0 } })
    }
}
