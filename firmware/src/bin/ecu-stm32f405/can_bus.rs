//! The CAN controller: bxcan receives; sending is ours. bxcan's own refuses a frame while one of higher priority waits, so that most of a
//! tick's telemetry would be lost, and it holds a panic.

use embedded_can::Id;
use embedded_can::nb::Can;
use stm32f4xx_hal::nb;
use stm32f4xx_hal::pac::CAN1;

type Receiver = bxcan::Can<stm32f4xx_hal::can::Can<CAN1>>;

/// Bits of CAN_TIxR (RM0090, 32.9.3): transmission requested, extended identifier.
const TXRQ: u32 = 1;
const IDE: u32 = 1 << 2;

/// The controller, joining the bus or on it.
pub(crate) struct CanBus(Receiver);

impl CanBus {
    /// Frames leave in the order they were given.
    pub(crate) fn new(receiver: Receiver) -> Self {
        // SAFETY: the registers of the controller this owns.
        unsafe { &*CAN1::ptr() }.mcr().modify(|_, w| w.txfp().set_bit());
        Self(receiver)
    }
}

impl Can for CanBus {
    type Frame = bxcan::Frame;
    type Error = bxcan::OverrunError;

    /// Into an empty mailbox; the application sends data frames only.
    fn transmit(&mut self, frame: &bxcan::Frame) -> nb::Result<Option<bxcan::Frame>, bxcan::OverrunError> {
        // SAFETY: the transmit registers of the controller this owns; bxcan uses them in its own `transmit` only, which nobody calls.
        let registers = unsafe { &*CAN1::ptr() };
        let status = registers.tsr().read();
        let empty = [status.tme0(), status.tme1(), status.tme2()].map(|bit| bit.bit_is_set());
        let (mailbox, _) = registers.tx_iter().zip(empty).find(|&(_, empty)| empty).ok_or(nb::Error::WouldBlock)?;
        let id = match embedded_can::Frame::id(frame) {
            Id::Standard(id) => u32::from(id.as_raw()) << 21,
            Id::Extended(id) => id.as_raw() << 3 | IDE,
        };
        let mut bytes = [0; 8];
        for (to, from) in bytes.iter_mut().zip(embedded_can::Frame::data(frame)) {
            *to = *from;
        }
        let [a, b, c, d, e, f, g, h] = bytes;
        // SAFETY: any value of these data registers is valid; length at most 8 by the type.
        unsafe {
            mailbox.tdtr().write(|w| w.bits(frame.dlc() as u32));
            mailbox.tdlr().write(|w| w.bits(u32::from_le_bytes([a, b, c, d])));
            mailbox.tdhr().write(|w| w.bits(u32::from_le_bytes([e, f, g, h])));
            mailbox.tir().write(|w| w.bits(id | TXRQ));
        }
        Ok(None)
    }

    fn receive(&mut self) -> nb::Result<bxcan::Frame, bxcan::OverrunError> {
        self.0.receive()
    }
}
