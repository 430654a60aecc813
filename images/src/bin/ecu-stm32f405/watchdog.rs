//! The independent watchdog. Its clock is specified as 17 to 47 kHz: a count chosen for 32 kHz lasts 0.7 to 1.9 times as long.

use firmware::board::Watchdog;
use stm32f4xx_hal::pac::IWDG;

const UNLOCK: u16 = 0x5555;
const RELOAD: u16 = 0xAAAA;
const START: u16 = 0xCCCC;

/// Clocks of 32 kHz, undivided by four (the smallest divider), for 20 ms: between 13.6 and 37.6 ms over the clock's whole range.
const COUNT: u16 = 160;

/// Running; nothing stops it but a reset.
pub(crate) struct IndependentWatchdog(IWDG);

impl IndependentWatchdog {
    /// Starts it.
    pub(crate) fn start(iwdg: IWDG) -> Self {
        // SAFETY: keys and a prescaler of the reference manual RM0090, 21.4.
        unsafe {
            iwdg.kr().write(|w| w.key().bits(START));
            iwdg.kr().write(|w| w.key().bits(UNLOCK));
            iwdg.pr().write(|w| w.pr().bits(0));
            iwdg.rlr().write(|w| w.rl().bits(COUNT - 1));
        }
        // The new values cross into the slow clock; without a bound a dead oscillator would hang the start here.
        for _ in 0..1_000_000_u32 {
            if iwdg.sr().read().bits() == 0 {
                break;
            }
        }
        let mut started = Self(iwdg);
        started.feed();
        started
    }
}

impl Watchdog for IndependentWatchdog {
    fn feed(&mut self) {
        // SAFETY: the reload key.
        unsafe { self.0.kr().write(|w| w.key().bits(RELOAD)) };
    }
}
