//! Clocks, pins and buses of the reference ECU, as the pin table in `docs/porting.md` has them.

use core::cell::RefCell;
use core::convert::Infallible;

use bxcan::Fifo;
use bxcan::filter::Mask32;
use cortex_m::interrupt::Mutex;
use cortex_m::singleton;
use embedded_hal::pwm::{ErrorType, SetDutyCycle};
use firmware::board::ads8688::{Ads8688, Device};
use firmware::board::{Parts, signals};
use firmware::io::Solenoids;
use stm32f4xx_hal::gpio::{Alternate, AnyPin, Input, Output, PA5, PA6, PA7, PA11, PA12, PinState, Speed};
use stm32f4xx_hal::pac::{CAN1, DMA2, GPIOA, GPIOB, GPIOC, IWDG, RCC, SPI1, TIM3, TIM4};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Enable, Rcc};
use stm32f4xx_hal::spi::{Mode, Phase, Polarity, Spi};
use stm32f4xx_hal::timer::pwm::ErasedChannel;

use crate::can_bus::CanBus;
use crate::spi_dma::{Converter, DmaSpi, SharedBus};
use crate::watchdog::IndependentWatchdog;

/// PWM of the solenoids: far above what a coil follows, far below what its driver loses in switching.
const PWM_HZ: u32 = 20_000;
/// Below the converter's 17 MHz: 84 MHz by 8.
const SPI_HZ: u32 = 10_500_000;
/// 500 kbit/s from 42 MHz: prescaler 6, 1 + 11 + 2 quanta, sample point 85.7 %, jump width 1.
const CAN_BIT_TIMING: u32 = (2 - 1) << 20 | (11 - 1) << 16 | (6 - 1);

/// A solenoid's PWM channel.
pub(crate) enum Solenoid {
    /// PC6…PC9.
    Tim3(ErasedChannel<TIM3>),
    /// PB6…PB9.
    Tim4(ErasedChannel<TIM4>),
}

impl Solenoid {
    fn enable_at_zero(&mut self) {
        match self {
            Self::Tim3(channel) => {
                channel.set_duty(0);
                channel.enable();
            }
            Self::Tim4(channel) => {
                channel.set_duty(0);
                channel.enable();
            }
        }
    }
}

impl ErrorType for Solenoid {
    type Error = Infallible;
}

impl SetDutyCycle for Solenoid {
    fn max_duty_cycle(&self) -> u16 {
        match self {
            Self::Tim3(channel) => channel.get_max_duty(),
            Self::Tim4(channel) => channel.get_max_duty(),
        }
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        match self {
            Self::Tim3(channel) => channel.set_duty(duty),
            Self::Tim4(channel) => channel.set_duty(duty),
        }
        Ok(())
    }
}

type Chip = Converter<AnyPin<Output>>;
/// The reference ECU.
pub(crate) type Ecu405 = Parts<Chip, Solenoid, AnyPin<Output>, AnyPin<Input>, CanBus, IndependentWatchdog>;

/// What the start-up takes.
pub(crate) struct Chips {
    pub(crate) spi: SPI1,
    pub(crate) dma: DMA2,
    pub(crate) can: CAN1,
    pub(crate) watchdog: IWDG,
}

/// Why a start-up fails.
#[derive(Clone, Copy, Debug)]
pub(crate) enum StartError {
    /// Called twice.
    Twice,
    /// A converter: 1 or 2.
    Adc(u8),
}

/// Pins that are not outputs of the machine.
pub(crate) struct OtherPins {
    converters: (PA5<Alternate<5>>, PA6<Alternate<5>>, PA7<Alternate<5>>),
    selects: [AnyPin<Output>; 2],
    can: (PA12, PA11),
    cut_off_read_back: AnyPin<Input>,
    enable: AnyPin<Input>,
    emergency_stop_released: AnyPin<Input>,
}

/// The outputs of the machine, all off.
pub(crate) struct OutputPins {
    cut_off: AnyPin<Output>,
    solenoids: [Solenoids<Solenoid>; 4],
}

/// The cut-off open, then every solenoid's timer running at zero.
pub(crate) fn outputs_off(
    (gpioa, gpiob, gpioc): (GPIOA, GPIOB, GPIOC),
    (tim3, tim4): (TIM3, TIM4),
    rcc: &mut Rcc,
) -> (OtherPins, OutputPins) {
    let (a, b, c) = (gpioa.split(rcc), gpiob.split(rcc), gpioc.split(rcc));
    let cut_off = b.pb0.into_push_pull_output_in_state(PinState::Low).erase();
    let (_, (s1, s2, s3, s4)) = tim3.pwm_hz(PWM_HZ.Hz(), rcc);
    let (_, (s5, s6, s7, s8)) = tim4.pwm_hz(PWM_HZ.Hz(), rcc);
    let mut solenoids = [
        [Solenoid::Tim3(s1.with(c.pc6).erase()), Solenoid::Tim3(s2.with(c.pc7).erase())],
        [Solenoid::Tim3(s3.with(c.pc8).erase()), Solenoid::Tim3(s4.with(c.pc9).erase())],
        [Solenoid::Tim4(s5.with(b.pb6).erase()), Solenoid::Tim4(s6.with(b.pb7).erase())],
        [Solenoid::Tim4(s7.with(b.pb8).erase()), Solenoid::Tim4(s8.with(b.pb9).erase())],
    ];
    for solenoid in solenoids.iter_mut().flatten() {
        solenoid.enable_at_zero();
    }
    let other = OtherPins {
        converters: (
            a.pa5.into_alternate().speed(Speed::High),
            a.pa6.into_alternate(),
            a.pa7.into_alternate().speed(Speed::High),
        ),
        selects: [
            a.pa4.into_push_pull_output_in_state(PinState::High).erase(),
            c.pc4.into_push_pull_output_in_state(PinState::High).erase(),
        ],
        can: (a.pa12, a.pa11),
        cut_off_read_back: b.pb1.into_pull_down_input().erase(),
        enable: b.pb10.into_pull_down_input().erase(),
        emergency_stop_released: b.pb11.into_pull_down_input().erase(),
    };
    (other, OutputPins { cut_off, solenoids })
}

/// Converters configured, on the bus when it is quiet; the watchdog runs at last.
pub(crate) fn start(chips: Chips, pins: OtherPins, outputs: OutputPins, rcc: &mut Rcc) -> Result<Ecu405, StartError> {
    let bus = converters_bus(chips.spi, chips.dma, pins.converters, rcc)?;
    let [first, second] = pins.selects.map(|select| Converter::new(bus, select));
    let [first_ranges, second_ranges] = signals::RANGES;
    let mut adcs = [Ads8688::new(first, Device::One, first_ranges), Ads8688::new(second, Device::Two, second_ranges)];
    for (number, adc) in (1..).zip(&mut adcs) {
        adc.configure().map_err(|_| StartError::Adc(number))?;
    }

    let can = stm32f4xx_hal::can::Can::new(chips.can, pins.can, rcc);
    let mut can =
        bxcan::Can::builder(can).set_bit_timing(CAN_BIT_TIMING).set_automatic_retransmit(true).leave_disabled();
    can.modify_filters().enable_bank(0, Fifo::Fifo0, Mask32::accept_all());
    // Not now is soon enough: it joins by itself when the bus is quiet.
    let _ = can.enable_non_blocking();

    Ok(Parts {
        adcs,
        solenoids: outputs.solenoids,
        cut_off: outputs.cut_off,
        cut_off_read_back: pins.cut_off_read_back,
        enable: pins.enable,
        emergency_stop_released: pins.emergency_stop_released,
        can: CanBus::new(can),
        watchdog: IndependentWatchdog::start(chips.watchdog),
    })
}

/// SPI1 in mode 1 with DMA, for both converters.
fn converters_bus(
    spi: SPI1,
    dma: DMA2,
    pins: (PA5<Alternate<5>>, PA6<Alternate<5>>, PA7<Alternate<5>>),
    rcc: &mut Rcc,
) -> Result<&'static SharedBus, StartError> {
    let (clock, answer, order) = pins;
    let mode = Mode { polarity: Polarity::IdleLow, phase: Phase::CaptureOnSecondTransition };
    let spi = Spi::new(spi, (Some(clock), Some(answer), Some(order)), mode, SPI_HZ.Hz(), rcc);
    let (spi, _) = spi.release();
    DMA2::enable(rcc);
    let bus = singleton!(: SharedBus = Mutex::new(RefCell::new(DmaSpi::new(spi, dma)))).ok_or(StartError::Twice)?;
    Ok(bus)
}

/// 168 MHz from an 8 MHz crystal.
pub(crate) fn clocks(rcc: RCC) -> Rcc {
    rcc.freeze(Config::hse(8.MHz()).sysclk(168.MHz()))
}
