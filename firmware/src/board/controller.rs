//! The application on a board: everything in, one tick, everything out, and last the watchdog.

use core::borrow::BorrowMut;

use embedded_can::nb::Can;

use super::signals::Measured;
use super::{Board, BoardError, Switches};
use crate::can::address::{AddressError, Addresses, Name};
use crate::can::command::Mode;
use crate::can::dm1::ActiveFaults;
use crate::can::inbox::Inbox;
use crate::can::{CanFrame, Node};
use crate::io::{Inputs, Outputs, Request};
use crate::motion::Followers;
use crate::{Ecu, Fault, ParameterError, Parameters, SelfTest};

/// CAN frames taken in a tick: 500 kbit/s carry no more than four in a millisecond.
const FRAMES: usize = 4;

/// The application and its place on the bus; `F` as in [`Ecu`].
#[derive(Clone, Debug)]
pub struct Controller<F = Followers> {
    ecu: Ecu<F>,
    node: Node,
    /// Moves on with every good command, as long as everything the command needs is fresh.
    alive: u8,
    last_modes_taken: u8,
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
    /// [`Controller::with`] followers of its own.
    ///
    /// # Errors
    /// As there.
    pub fn new(parameters: &Parameters, addresses: Addresses, name: &Name) -> Result<Self, ControllerError> {
        Self::with(parameters, addresses, name, Followers::new())
    }
}

impl<F: BorrowMut<Followers>> Controller<F> {
    /// Builds the application and its node.
    ///
    /// # Errors
    /// The first parameter, address or field of the NAME at fault, by name and range.
    pub fn with(
        parameters: &Parameters,
        addresses: Addresses,
        name: &Name,
        followers: F,
    ) -> Result<Self, ControllerError> {
        Ok(Self {
            ecu: Ecu::with(parameters, followers).map_err(ControllerError::Parameter)?,
            node: Node::new(addresses, name).map_err(ControllerError::Address)?,
            alive: 0,
            last_modes_taken: 0,
        })
    }

    /// As [`Ecu::self_tested`].
    pub fn self_tested(&mut self, report: &SelfTest) {
        self.ecu.self_tested(report);
    }

    /// One control period; `overrun` says that the one before did not end in time.
    ///
    /// The watchdog is fed only here, and only when every output took what it was given.
    pub fn cycle<B: Board>(&mut self, board: &mut B, overrun: bool) -> Outputs {
        self.node.aged();
        for _ in 0..FRAMES {
            let Ok(frame) = board.can().receive() else { break };
            if let Some(frame) = CanFrame::of_frame(&frame) {
                self.node.receive(&frame);
            }
        }
        let inputs = self.inputs(board, overrun);
        let outputs = self.ecu.tick(&inputs);
        if write(board, &outputs).is_ok() {
            board.feed_watchdog();
        }
        let latched = ActiveFaults::from(outputs.fault);
        let active = if outputs.late { latched.with(Fault::LateTick) } else { latched };
        for frame in self.node.due(&outputs, active).iter().flatten() {
            if let Some(frame) = embedded_can::Frame::new(frame.extended_id(), embedded_can::Frame::data(frame)) {
                // A full mailbox loses telemetry, nothing else.
                let _ = board.can().transmit(&frame);
            }
        }
        outputs
    }

    fn inputs<B: Board>(&mut self, board: &mut B, overrun: bool) -> Inputs {
        let scans = board.scan();
        let converters_sound = scans.each_ref().map(Result::is_ok);
        let measured = Measured::from_scans(&scans.map(Result::unwrap_or_default));
        // A switch that cannot be read is a pressed emergency stop; a cut-off that cannot be read has not opened.
        let switches = board.switches().unwrap_or(Switches { enable: false, emergency_stop: true });
        let cut_off_closed = board.cut_off_is_closed().unwrap_or(true);
        let inbox = self.node.inbox();
        let (taken, command) = (inbox.modes_taken(), command(inbox));
        if command.is_some() && taken != self.last_modes_taken {
            self.alive = self.alive.wrapping_add(1);
        }
        self.last_modes_taken = taken;
        let (request, levers) = command.unwrap_or((Request::Neutral, [0; 4]));
        Inputs {
            codes: measured.positions,
            supply_code: measured.supply,
            command_counter: self.alive,
            request,
            levers,
            converters_sound,
            cut_off_closed,
            enable: switches.enable,
            emergency_stop: switches.emergency_stop,
            overrun,
        }
    }
}

/// What the operator asks for; `None` unless every message it needs is fresh. Levers are believed together or not at all.
fn command(inbox: &Inbox) -> Option<(Request, [i16; 4])> {
    let still = [0; 4];
    match inbox.mode().value? {
        Mode::Neutral | Mode::Hold => Some((Request::Neutral, still)),
        Mode::Dig => Some((Request::Dig, still)),
        Mode::Reach => Some((Request::Reach, still)),
        Mode::Move => Some((Request::Move, still)),
        // Not a motion of this controller yet: like silence, so that it ends in a named fault.
        Mode::TipVelocity => None,
        Mode::Levers => {
            let mut levers = still;
            for (lever, valve) in levers.iter_mut().zip(inbox.valves()) {
                *lever = valve.value?.lever()?;
            }
            Some((Request::Levers, levers))
        }
    }
}

/// Duties and cut-off. An output that fails takes the others down with it: all duties zero, cut-off open, watchdog unfed.
fn write<B: Board>(board: &mut B, outputs: &Outputs) -> Result<(), BoardError> {
    let driven = board.drive(&outputs.duties);
    let done = driven.and(board.set_cut_off(outputs.cut_off_closed));
    if done.is_err() {
        // What still obeys is switched off; whether that works too changes nothing any more.
        let _ = board.set_cut_off(false);
        let _ = board.drive(&[[0; 2]; 4]);
    }
    done
}
