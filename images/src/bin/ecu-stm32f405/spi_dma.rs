//! One converter's `SpiDevice` on SPI1 with DMA 2: stream 0 receives, stream 3 sends (RM0090 table 43, channel 3).
//!
//! The CPU waits for the three or six microseconds of a frame, interrupts off: the control task is the only one.

use core::cell::RefCell;
use core::convert::Infallible;
use core::sync::atomic::{Ordering, compiler_fence};

use cortex_m::interrupt::{self, Mutex};
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::{Error, ErrorKind, ErrorType, Operation, SpiDevice};
use stm32f4xx_hal::pac::{DMA2, SPI1};

/// The longest frame of a converter, bytes.
const FRAME_BYTES: usize = 8;
/// A frame of eight bytes lasts 7 µs, about 1,200 cycles; a bus that needs this many looks at the flag is dead.
const PATIENCE: u32 = 20_000;
const CHANNEL: u8 = 3;

/// What can go wrong on the bus.
#[derive(Clone, Copy, Debug)]
pub(crate) enum BusError {
    /// A transaction longer than a frame of the converter.
    TooLong,
    /// The transfer did not end.
    TimeOut,
    /// The DMA controller reports an error.
    Dma,
}

impl Error for BusError {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Other
    }
}

/// SPI1 and its streams, shared by both converters.
pub(crate) struct DmaSpi {
    spi: SPI1,
    dma: DMA2,
    sent: [u8; FRAME_BYTES],
    received: [u8; FRAME_BYTES],
}

impl DmaSpi {
    /// Takes over a bus whose clock, pins and mode are set up.
    pub(crate) fn new(spi: SPI1, dma: DMA2) -> Self {
        spi.cr2().modify(|_, w| w.rxdmaen().enabled().txdmaen().enabled());
        Self { spi, dma, sent: [0; FRAME_BYTES], received: [0; FRAME_BYTES] }
    }

    /// Full duplex: `count` bytes of `sent` out, as many into `received`.
    fn frame(&mut self, count: usize) -> Result<(), BusError> {
        let data_register = self.spi.dr().as_ptr() as u32;
        let (receive, send) = (self.dma.st(0), self.dma.st(3));
        // SAFETY: addresses of this struct's buffers, which outlive the transfer: it ends, or is disabled, before this returns.
        unsafe {
            self.dma.lifcr().write(|w| w.bits(0b111101 | 0b111101 << 22));
            for (stream, memory) in
                [(receive, self.received.as_mut_ptr() as u32), (send, self.sent.as_mut_ptr() as u32)]
            {
                stream.par().write(|w| w.bits(data_register));
                stream.m0ar().write(|w| w.bits(memory));
                stream.ndtr().write(|w| w.bits(count as u32));
            }
        }
        compiler_fence(Ordering::SeqCst);
        receive.cr().write(|w| w.chsel().set(CHANNEL).minc().incremented().dir().peripheral_to_memory().en().enabled());
        send.cr().write(|w| w.chsel().set(CHANNEL).minc().incremented().dir().memory_to_peripheral().en().enabled());
        let ended = (0..PATIENCE).any(|_| self.dma.lisr().read().tcif0().is_complete());
        let failed = self.dma.lisr().read().teif0().is_error() || self.dma.lisr().read().teif3().is_error();
        for stream in [receive, send] {
            stream.cr().modify(|_, w| w.en().disabled());
        }
        compiler_fence(Ordering::SeqCst);
        if failed {
            Err(BusError::Dma)
        } else if ended {
            Ok(())
        } else {
            Err(BusError::TimeOut)
        }
    }
}

/// The bus both converters share.
pub(crate) type SharedBus = Mutex<RefCell<DmaSpi>>;

/// A converter behind its chip-select pin.
pub(crate) struct Converter<CS> {
    bus: &'static SharedBus,
    select: CS,
}

impl<CS: OutputPin<Error = Infallible>> Converter<CS> {
    /// Not selected.
    pub(crate) fn new(bus: &'static SharedBus, mut select: CS) -> Self {
        let Ok(()) = select.set_high();
        Self { bus, select }
    }
}

impl<CS> ErrorType for Converter<CS> {
    type Error = BusError;
}

impl<CS: OutputPin<Error = Infallible>> SpiDevice for Converter<CS> {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), BusError> {
        interrupt::free(|cs| {
            let mut bus = self.bus.borrow(cs).try_borrow_mut().map_err(|_| BusError::TimeOut)?;
            let Ok(()) = self.select.set_low();
            let done = operations.iter_mut().try_for_each(|operation| perform(&mut bus, operation));
            let Ok(()) = self.select.set_high();
            done
        })
    }
}

/// As many as both have: compiled for size, `copy_from_slice` would keep its panic for unlike lengths.
fn copy(to: &mut [u8], from: &[u8]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

fn perform(bus: &mut DmaSpi, operation: &mut Operation<'_, u8>) -> Result<(), BusError> {
    let (read, write): (&mut [u8], &[u8]) = match operation {
        Operation::Read(read) => (read, &[]),
        Operation::Write(write) => (&mut [], write),
        Operation::Transfer(read, write) => (read, write),
        Operation::TransferInPlace(both) => return in_place(bus, both),
        // Pauses between frames are not needed by a converter.
        Operation::DelayNs(_) => return Ok(()),
    };
    let count = core::cmp::max(read.len(), write.len());
    bus.sent = [0; FRAME_BYTES];
    copy(bus.sent.get_mut(..write.len()).ok_or(BusError::TooLong)?, write);
    if count > FRAME_BYTES {
        return Err(BusError::TooLong);
    }
    bus.frame(count)?;
    let received = bus.received.get(..read.len()).ok_or(BusError::TooLong)?;
    copy(read, received);
    Ok(())
}

fn in_place(bus: &mut DmaSpi, both: &mut [u8]) -> Result<(), BusError> {
    copy(bus.sent.get_mut(..both.len()).ok_or(BusError::TooLong)?, both);
    bus.frame(both.len())?;
    copy(both, bus.received.get(..both.len()).ok_or(BusError::TooLong)?);
    Ok(())
}
