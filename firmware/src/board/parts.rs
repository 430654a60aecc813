//! A board put together from embedded-hal's traits.

use embedded_can::nb::Can;
use embedded_hal::digital::{InputPin, OutputPin};
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;

use super::ads8688::{AdcError, Ads8688, Codes};
use super::{Board, BoardError, Switches};
use crate::io::Solenoids;

/// An independent watchdog; embedded-hal 1.0 has no trait for it.
pub trait Watchdog {
    /// Restarts its count.
    fn feed(&mut self);
}

/// The parts, all public: a board's start-up makes them and hands them over. A HAL with a type for every PWM channel or pin
/// wraps them in an enum, or implements [`Board`] itself.
#[derive(Debug)]
pub struct Parts<SPI, PWM, OUT, IN, CAN, DOG> {
    /// The converters, configured.
    pub adcs: [Ads8688<SPI>; 2],
    /// Solenoids, a spool each: \[extend, retract\].
    pub solenoids: [Solenoids<PWM>; 4],
    /// Master cut-off; high closes it.
    pub cut_off: OUT,
    /// The cut-off's own contact; high when closed.
    pub cut_off_read_back: IN,
    /// Enable switch; high when on.
    pub enable: IN,
    /// Emergency-stop chain, closed while released: high when released, low when pressed or broken.
    pub emergency_stop_released: IN,
    /// CAN controller.
    pub can: CAN,
    /// Watchdog.
    pub watchdog: DOG,
}

impl<SPI, PWM, OUT, IN, CAN, DOG> Board for Parts<SPI, PWM, OUT, IN, CAN, DOG>
where
    SPI: SpiDevice,
    PWM: SetDutyCycle,
    OUT: OutputPin,
    IN: InputPin,
    CAN: Can,
    DOG: Watchdog,
{
    type Can = CAN;

    fn scan(&mut self) -> [Result<Codes, AdcError>; 2] {
        let [first, second] = &mut self.adcs;
        [first.scan(), second.scan()]
    }

    fn switches(&mut self) -> Result<Switches, BoardError> {
        Ok(Switches {
            enable: self.enable.is_high().map_err(|_| BoardError::Enable)?,
            emergency_stop: self.emergency_stop_released.is_low().map_err(|_| BoardError::EmergencyStop)?,
        })
    }

    fn drive(&mut self, duties: &[Solenoids<u16>; 4]) -> Result<(), BoardError> {
        let mut done = Ok(());
        for (spool, (outputs, duties)) in self.solenoids.iter_mut().zip(duties).enumerate() {
            for (solenoid, (output, duty)) in outputs.iter_mut().zip(duties).enumerate() {
                let set = output.set_duty_cycle_fraction(*duty, u16::MAX);
                done = done.and(set.map_err(|_| BoardError::Solenoid(spool, solenoid)));
            }
        }
        done
    }

    fn set_cut_off(&mut self, closed: bool) -> Result<(), BoardError> {
        self.cut_off.set_state(closed.into()).map_err(|_| BoardError::CutOff)
    }

    fn cut_off_is_closed(&mut self) -> Result<bool, BoardError> {
        self.cut_off_read_back.is_high().map_err(|_| BoardError::CutOffReadBack)
    }

    fn can(&mut self) -> &mut CAN {
        &mut self.can
    }

    fn feed_watchdog(&mut self) {
        self.watchdog.feed();
    }
}
