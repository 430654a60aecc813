//! Everything of a board that is no chip: pins, PWM outputs, a CAN controller's queues.

use embedded_can::nb::Can;
use embedded_hal::digital::{self, InputPin, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};

/// A pin and its level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pin {
    /// High; `None` when it is broken and cannot be read or set.
    pub level: Option<bool>,
}

impl Pin {
    /// A sound pin.
    pub const fn new(level: bool) -> Self {
        Self { level: Some(level) }
    }
}

impl digital::ErrorType for Pin {
    type Error = digital::ErrorKind;
}

impl InputPin for Pin {
    fn is_high(&mut self) -> Result<bool, Self::Error> {
        self.level.ok_or(digital::ErrorKind::Other)
    }

    fn is_low(&mut self) -> Result<bool, Self::Error> {
        self.is_high().map(|high| !high)
    }
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Self::Error> {
        self.level = self.level.and(Some(false));
        self.level.map(|_| ()).ok_or(digital::ErrorKind::Other)
    }

    fn set_high(&mut self) -> Result<(), Self::Error> {
        self.level = self.level.and(Some(true));
        self.level.map(|_| ()).ok_or(digital::ErrorKind::Other)
    }
}

/// A PWM output of 16 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pwm {
    /// 65535 is always on.
    pub duty: u16,
    /// It takes nothing any more.
    pub broken: bool,
}

impl pwm::ErrorType for Pwm {
    type Error = pwm::ErrorKind;
}

impl SetDutyCycle for Pwm {
    fn max_duty_cycle(&self) -> u16 {
        u16::MAX
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Self::Error> {
        if self.broken {
            return Err(pwm::ErrorKind::Other);
        }
        self.duty = duty;
        Ok(())
    }
}

/// A CAN controller: `IN` places for frames received, `OUT` mailboxes.
#[derive(Clone, Debug)]
pub struct Mailboxes<F, const IN: usize, const OUT: usize> {
    /// Received, the oldest first.
    pub inbound: [Option<F>; IN],
    /// To be sent, in their order.
    pub outbound: [Option<F>; OUT],
}

impl<F: Copy, const IN: usize, const OUT: usize> Mailboxes<F, IN, OUT> {
    /// Empty.
    pub const fn new() -> Self {
        Self { inbound: [None; IN], outbound: [None; OUT] }
    }
}

impl<F: Copy, const IN: usize, const OUT: usize> Default for Mailboxes<F, IN, OUT> {
    fn default() -> Self {
        Self::new()
    }
}

impl<F: embedded_can::Frame + Copy, const IN: usize, const OUT: usize> Can for Mailboxes<F, IN, OUT> {
    type Frame = F;
    type Error = embedded_can::ErrorKind;

    fn transmit(&mut self, frame: &F) -> nb::Result<Option<F>, Self::Error> {
        let free = self.outbound.iter_mut().find(|mailbox| mailbox.is_none()).ok_or(nb::Error::WouldBlock)?;
        *free = Some(*frame);
        Ok(None)
    }

    fn receive(&mut self) -> nb::Result<F, Self::Error> {
        self.inbound.iter_mut().find_map(Option::take).ok_or(nb::Error::WouldBlock)
    }
}
