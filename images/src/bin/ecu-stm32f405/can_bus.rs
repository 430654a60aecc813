//! The CAN controller's mailboxes. bxcan sets the controller up; its own sending refuses a frame while one of higher priority waits, so
//! that most of a tick's telemetry would be lost, and its sending and its frames hold panics.

use core::convert::Infallible;

use embedded_can::nb::Can;
use embedded_can::{ExtendedId, Frame, Id, StandardId};
use firmware::can::CanFrame;
use stm32f4xx_hal::nb;
use stm32f4xx_hal::pac::CAN1;
use stm32f4xx_hal::pac::can1::RegisterBlock;

/// Bits of CAN_TIxR and CAN_RIxR (RM0090, 32.9.3): transmission requested, remote frame, extended identifier.
const TXRQ: u32 = 1;
const RTR: u32 = 1 << 1;
const IDE: u32 = 1 << 2;
/// Frames the receive FIFO holds.
const FIFO_DEPTH: usize = 3;

/// The controller, joining the bus or on it.
pub(crate) struct CanBus {
    _owned: bxcan::Can<stm32f4xx_hal::can::Can<CAN1>>,
}

impl CanBus {
    /// Frames leave in the order they were given.
    pub(crate) fn new(can: bxcan::Can<stm32f4xx_hal::can::Can<CAN1>>) -> Self {
        let bus = Self { _owned: can };
        bus.registers().mcr().modify(|_, w| w.txfp().set_bit());
        bus
    }

    fn registers(&self) -> &RegisterBlock {
        // SAFETY: the registers of the controller that this owns.
        unsafe { &*CAN1::ptr() }
    }

    /// The oldest frame of the first FIFO; within it `None` for what is no extended data frame.
    fn oldest(&self) -> nb::Result<Option<CanFrame>, Infallible> {
        let fifo = self.registers().rfr(0);
        let state = fifo.read();
        if state.fmp().bits() == 0 || state.rfom().bit_is_set() {
            return Err(nb::Error::WouldBlock);
        }
        let mailbox = self.registers().rx(0);
        let id = mailbox.rir().read().bits();
        let length = (mailbox.rdtr().read().bits() & 0xf) as usize;
        let [a, b, c, d] = mailbox.rdlr().read().bits().to_le_bytes();
        let [e, f, g, h] = mailbox.rdhr().read().bits().to_le_bytes();
        fifo.write(|w| w.rfom().set_bit());
        let bytes = [a, b, c, d, e, f, g, h];
        let extended = ExtendedId::new(id >> 3).filter(|_| id & (IDE | RTR) == IDE);
        Ok(extended.and_then(|extended| CanFrame::new(extended, bytes.get(..length).unwrap_or(&bytes))))
    }
}

impl Can for CanBus {
    type Frame = CanFrame;
    type Error = Infallible;

    /// Into an empty mailbox.
    fn transmit(&mut self, frame: &CanFrame) -> nb::Result<Option<CanFrame>, Infallible> {
        let registers = self.registers();
        let status = registers.tsr().read();
        let empty = [status.tme0(), status.tme1(), status.tme2()].map(|bit| bit.bit_is_set());
        let (mailbox, _) = registers.tx_iter().zip(empty).find(|&(_, empty)| empty).ok_or(nb::Error::WouldBlock)?;
        let id = match frame.id() {
            Id::Standard(id) => u32::from(StandardId::as_raw(&id)) << 21,
            Id::Extended(id) => id.as_raw() << 3 | IDE,
        };
        let mut bytes = [0; 8];
        for (to, from) in bytes.iter_mut().zip(frame.data()) {
            *to = *from;
        }
        let [a, b, c, d, e, f, g, h] = bytes;
        // SAFETY: any value of the data registers is valid; a frame has at most eight bytes.
        unsafe {
            mailbox.tdtr().write(|w| w.bits(frame.dlc() as u32));
            mailbox.tdlr().write(|w| w.bits(u32::from_le_bytes([a, b, c, d])));
            mailbox.tdhr().write(|w| w.bits(u32::from_le_bytes([e, f, g, h])));
            mailbox.tir().write(|w| w.bits(id | TXRQ));
        }
        Ok(None)
    }

    /// What is not J1939's is passed over.
    fn receive(&mut self) -> nb::Result<CanFrame, Infallible> {
        for _ in 0..FIFO_DEPTH {
            if let Some(frame) = self.oldest()? {
                return Ok(frame);
            }
        }
        Err(nb::Error::WouldBlock)
    }
}
