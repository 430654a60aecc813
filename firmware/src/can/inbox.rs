//! Everything received, each message with its own validity.

use core::convert::Infallible;

use super::address::Addresses;
use super::command::{Mode, Pressures, Slope, TipVelocity, ValveCommand};
use super::frame::CanFrame;
use super::id::Identifier;
use super::message::Header;
use super::receive::{Reading, Received, Validity};
use super::table::received as table;
use crate::service::ServiceRequest;

/// The swing, boom, arm and bucket commands.
static VALVES: [&Header; 4] = [
    &table::SWING_COMMAND.header,
    &table::BOOM_COMMAND.header,
    &table::ARM_COMMAND.header,
    &table::BUCKET_COMMAND.header,
];

/// Boom, arm and bucket pressures.
static PRESSURES: [&Header; 3] =
    [&table::BOOM_PRESSURES.header, &table::ARM_PRESSURES.header, &table::BUCKET_PRESSURES.header];

/// The messages received.
#[derive(Clone, Copy, Debug)]
pub struct Inbox {
    addresses: Addresses,
    valves: [Received<ValveCommand>; 4],
    tip_velocity: Received<TipVelocity>,
    mode: Received<Mode>,
    slope: Received<Slope>,
    pressures: [Received<Pressures>; 3],
    service: Received<ServiceRequest>,
}

impl Inbox {
    /// Nothing received yet.
    pub(crate) const fn new(addresses: Addresses) -> Self {
        Self {
            addresses,
            valves: [Received::new(table::TIMEOUT_MS); 4],
            tip_velocity: Received::new(table::TIMEOUT_MS),
            mode: Received::new(table::TIMEOUT_MS),
            slope: Received::new(table::TIMEOUT_MS),
            pressures: [Received::new(table::TIMEOUT_MS); 3],
            service: Received::new(table::TIMEOUT_MS),
        }
    }

    /// Takes a frame in. Only the configured sender of a message is heard; frames of no message of ours are passed over.
    pub(crate) fn receive(&mut self, id: Identifier, frame: &CanFrame) {
        let addresses = self.addresses;
        let is = |header: &Header| id.pgn == header.pgn && addresses.of(header.sender) == Some(id.source);
        for (valve, header) in self.valves.iter_mut().zip(VALVES) {
            if is(header) {
                valve.take(header, id, frame, ValveCommand::of);
            }
        }
        if is(&table::TIP_VELOCITY.header) {
            self.tip_velocity.take(&table::TIP_VELOCITY.header, id, frame, TipVelocity::of);
        }
        if is(&table::MODE.header) {
            self.mode.take(&table::MODE.header, id, frame, Mode::of);
        }
        if is(&table::SLOPE.header) {
            self.slope.take(&table::SLOPE.header, id, frame, Slope::of);
        }
        if is(&table::SERVICE.header) {
            self.service.take(&table::SERVICE.header, id, frame, ServiceRequest::of);
        }
        for (pressures, header) in self.pressures.iter_mut().zip(PRESSURES) {
            if is(header) {
                pressures.take(header, id, frame, |payload| Ok::<_, Infallible>(Pressures::of(payload)));
            }
        }
    }

    /// A tick has passed.
    pub(crate) fn aged(&mut self) {
        self.valves.iter_mut().for_each(Received::aged);
        self.tip_velocity.aged();
        self.mode.aged();
        self.slope.aged();
        self.pressures.iter_mut().for_each(Received::aged);
        self.service.aged();
    }

    /// The commands of swing, boom, arm and bucket.
    pub fn valves(&self) -> [Reading<ValveCommand>; 4] {
        self.valves.each_ref().map(Received::reading)
    }

    /// The tip velocity command.
    pub fn tip_velocity(&self) -> Reading<TipVelocity> {
        self.tip_velocity.reading()
    }

    /// The mode command.
    pub fn mode(&self) -> Reading<Mode> {
        self.mode.reading()
    }

    /// The chassis' slope.
    pub fn slope(&self) -> Reading<Slope> {
        self.slope.reading()
    }

    /// The service command.
    pub fn service(&self) -> Reading<ServiceRequest> {
        self.service.reading()
    }

    /// The pressures of boom, arm and bucket, \[head, rod\], Pa: each with its own validity.
    pub fn pressures_pa(&self) -> [[Reading<f32>; 2]; 3] {
        self.pressures.each_ref().map(|cylinder| {
            let Reading { value, validity } = cylinder.reading();
            [value.map(|pressures| pressures.head_pa), value.map(|pressures| pressures.rod_pa)].map(|side| match side {
                Some(Ok(pa)) => Reading { value: Some(pa), validity },
                Some(Err(_)) => Reading { value: None, validity: Validity::OutOfRange },
                None => Reading { value: None, validity },
            })
        })
    }

    /// Every message's validity, in the order of [`super::table::sent::RECEPTION`].
    pub fn validities(&self) -> [Validity; 11] {
        let [swing, boom, arm, bucket] = self.valves.each_ref().map(Received::validity);
        let [boom_p, arm_p, bucket_p] = self.pressures.each_ref().map(Received::validity);
        let (tip, mode, slope) = (self.tip_velocity.validity(), self.mode.validity(), self.slope.validity());
        [swing, boom, arm, bucket, tip, mode, slope, boom_p, arm_p, bucket_p, self.service.validity()]
    }
}
