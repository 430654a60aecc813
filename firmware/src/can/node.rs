//! The controller as a node of the bus.

use super::address::{AddressError, Addresses, Claim, Name};
use super::dm1::{ActiveFaults, Dm1};
use super::frame::CanFrame;
use super::id::Identifier;
use super::inbox::Inbox;
use super::telemetry::{Due, Telemetry, add};
use crate::io::Outputs;
use crate::service::Answer;

/// Each tick: [`Node::aged`], [`Node::receive`] for each frame that came, then the application, then [`Node::due`].
#[derive(Clone, Copy, Debug)]
pub struct Node {
    own: u8,
    claim: Claim,
    inbox: Inbox,
    telemetry: Telemetry,
    dm1: Dm1,
}

impl Node {
    /// A node that is about to claim its address.
    ///
    /// # Errors
    /// An address or a field of the NAME, by name and range.
    #[inline(never)]
    pub fn new(addresses: Addresses, name: &Name) -> Result<Self, AddressError> {
        addresses.validate()?;
        let own = addresses.own;
        Ok(Self {
            own,
            claim: Claim::new(own, name.bits()?),
            inbox: Inbox::new(addresses),
            telemetry: Telemetry::new(),
            dm1: Dm1::new(),
        })
    }

    /// A tick has passed.
    pub fn aged(&mut self) {
        self.inbox.aged();
    }

    /// Takes a frame in.
    #[inline(never)]
    pub fn receive(&mut self, frame: &CanFrame) {
        let id = Identifier::of(frame.extended_id());
        self.claim.receive(id, frame);
        self.inbox.receive(id, frame);
    }

    /// What was received.
    pub fn inbox(&self) -> &Inbox {
        &self.inbox
    }

    /// The address is ours; before that, and after it was lost, only the claim is sent.
    pub fn has_address(&self) -> bool {
        self.claim.is_ours()
    }

    /// What the service stage has to say from now on.
    pub fn set_answer(&mut self, answer: Answer) {
        self.telemetry.set_answer(answer);
    }

    /// The frames to send this tick.
    #[inline(never)]
    pub fn due(&mut self, outputs: &Outputs, active: ActiveFaults) -> Due {
        let mut due = [None; 3];
        let claim = self.claim.due();
        if self.has_address() {
            self.telemetry.due(self.own, outputs, self.inbox.validities(), &mut due);
            // One mailbox for both: the diagnostics wait a tick for the claim.
            if claim.is_none()
                && let Some(frame) = self.dm1.due(self.own, active)
            {
                add(&mut due, frame);
            }
        }
        if let Some(frame) = claim {
            add(&mut due, frame);
        }
        due
    }
}
