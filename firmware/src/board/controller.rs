//! The application on a board: everything in, one tick, everything out, and last the watchdog.

use core::borrow::BorrowMut;

use embedded_can::nb::Can;

use super::signals::Measured;
use super::{Board, BoardError, Disabled, Switches};
use crate::can::address::{AddressError, Addresses, Name};
use crate::can::dm1::ActiveFaults;
use crate::can::{CanFrame, Node};
use crate::command::Intent;
use crate::io::{Inputs, Outputs};
use crate::service::{Done, Errand};
use crate::{Ecu, Fault, Fitted, ParameterError, Parameters, SelfTest};

/// CAN frames taken in a tick: 500 kbit/s carry no more than four in a millisecond.
const FRAMES: usize = 4;

/// The application and its place on the bus; `F` as in [`Ecu`].
#[derive(Clone, Debug)]
pub struct Controller<F = Fitted> {
    ecu: Ecu<F>,
    node: Node,
}

/// Why there is no controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControllerError {
    /// A parameter.
    Parameter(ParameterError),
    /// An address or the NAME.
    Address(AddressError),
}

impl core::fmt::Display for ControllerError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Parameter(error) => error.fmt(f),
            Self::Address(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for ControllerError {}

impl Controller {
    /// [`Controller::with`] a memory of its own.
    ///
    /// # Errors
    /// As there.
    pub fn new(parameters: &Parameters, addresses: Addresses, name: &Name) -> Result<Self, ControllerError> {
        Self::with(parameters, addresses, name, Fitted::new())
    }
}

impl<F: BorrowMut<Fitted>> Controller<F> {
    /// Builds the application and its node.
    ///
    /// # Errors
    /// The first parameter, address or field of the NAME at fault, by name and range.
    pub fn with(
        parameters: &Parameters,
        addresses: Addresses,
        name: &Name,
        fitted: F,
    ) -> Result<Self, ControllerError> {
        Ok(Self {
            ecu: Ecu::with(parameters, fitted).map_err(ControllerError::Parameter)?,
            node: Node::new(addresses, name).map_err(ControllerError::Address)?,
        })
    }

    /// As [`Ecu::set_buckets`].
    pub fn set_buckets(&mut self, count: u8, mounted: u8) {
        self.ecu.set_buckets(count, mounted);
    }

    /// After [`Self::write`]: an errand that is due, once the board is proved disabled. It is run where a tick may interrupt it, and
    /// comes back by [`Self::done`].
    pub fn errand<B: Board>(&mut self, board: &mut B) -> Option<Errand<F>> {
        if self.ecu.errand_is_due() { self.errand_now(board) } else { None }
    }

    #[inline(never)]
    fn errand_now<B: Board>(&mut self, board: &mut B) -> Option<Errand<F>> {
        match Disabled::new(board) {
            Ok(permit) => self.ecu.errand(permit),
            Err(_) => {
                self.ecu.not_disabled();
                None
            }
        }
    }

    /// Before [`Self::read`]: an errand is back.
    #[inline(never)]
    pub fn done(&mut self, done: Done<F>) {
        self.ecu.done(done);
    }

    /// The application.
    pub fn ecu(&mut self) -> &mut Ecu<F> {
        &mut self.ecu
    }

    /// As [`Ecu::self_tested`].
    pub fn self_tested(&mut self, report: &SelfTest) {
        self.ecu.self_tested(report);
    }

    /// One control period: [`Self::read`], [`Self::tick`], [`Self::write`]. `overrun` says that the one before did not end in time.
    pub fn cycle<B: Board>(&mut self, board: &mut B, overrun: bool) -> Outputs {
        let inputs = self.read(board, overrun);
        let outputs = self.tick(&inputs);
        self.write(board, &outputs);
        outputs
    }

    /// CAN frames, converters and switches as the application's inputs.
    // Not inlined: the tick would keep the scans on its stack.
    #[inline(never)]
    pub fn read<B: Board>(&mut self, board: &mut B, overrun: bool) -> Inputs {
        self.node.aged();
        for _ in 0..FRAMES {
            let Ok(frame) = board.can().receive() else { break };
            if let Some(frame) = CanFrame::of_frame(&frame) {
                self.node.receive(&frame);
            }
        }
        let scans = board.scan();
        let converters_sound = scans.each_ref().map(Result::is_ok);
        let measured = Measured::from_scans(&scans.map(Result::unwrap_or_default));
        // A switch that cannot be read is a pressed emergency stop; a cut-off that cannot be read has not opened.
        let switches = board.switches().unwrap_or(Switches { enable: false, emergency_stop: true });
        let inbox = self.node.inbox();
        Inputs {
            codes: measured.positions,
            supply_code: measured.supply,
            sensor_supply_code: measured.sensor_supply,
            coil_codes: measured.coils,
            converters_sound,
            command: Intent::of(inbox),
            slope: inbox.slope().value,
            pressures_pa: inbox.pressures_pa().map(|sides| sides.map(|side| side.value)),
            service: inbox.service().value,
            cut_off_closed: board.cut_off_is_closed().unwrap_or(true),
            enable: switches.enable,
            emergency_stop: switches.emergency_stop,
            overrun,
        }
    }

    /// The application's tick.
    #[inline(always)]
    pub fn tick(&mut self, inputs: &Inputs) -> Outputs {
        self.ecu.tick(inputs)
    }

    /// Duties and cut-off, the frames due, and last the watchdog: fed only here, and only when every output took what it was given.
    // Not inlined: the tick would keep the frames on its stack.
    #[inline(never)]
    pub fn write<B: Board>(&mut self, board: &mut B, outputs: &Outputs) {
        let driven = drive(board, outputs);
        let latched = ActiveFaults::from(outputs.fault);
        let active = if outputs.late { latched.with(Fault::LateTick) } else { latched };
        self.node.set_answer(*self.ecu.answer());
        for frame in self.node.due(outputs, active).iter().flatten() {
            if let Some(frame) = embedded_can::Frame::new(frame.extended_id(), embedded_can::Frame::data(frame)) {
                // A full mailbox loses telemetry, nothing else.
                let _ = board.can().transmit(&frame);
            }
        }
        if driven.is_ok() {
            board.feed_watchdog();
        }
    }
}

/// Duties and cut-off. An output that fails takes the others down with it: all duties zero, cut-off open, watchdog unfed.
fn drive<B: Board>(board: &mut B, outputs: &Outputs) -> Result<(), BoardError> {
    let driven = board.drive(&outputs.duties);
    let done = driven.and(board.set_cut_off(outputs.cut_off_closed));
    if done.is_err() {
        // What still obeys is switched off; whether that works too changes nothing any more.
        let _ = board.set_cut_off(false);
        let _ = board.drive(&[[0; 2]; 4]);
    }
    done
}
