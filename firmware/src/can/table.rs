//! Every message of the bus. What stands here is what is sent and accepted, what `docs/icd.md` says and what `docs/excavator.dbc` holds.

pub mod network;
pub mod received;
pub mod sent;
pub mod service;

use super::message::Entry;

/// All messages: received, sent, and those of the network itself.
pub static MESSAGES: [Entry; 27] = [
    received::SWING_COMMAND.entry(),
    received::BOOM_COMMAND.entry(),
    received::ARM_COMMAND.entry(),
    received::BUCKET_COMMAND.entry(),
    received::TIP_VELOCITY.entry(),
    received::MODE.entry(),
    received::SLOPE.entry(),
    received::BOOM_PRESSURES.entry(),
    received::ARM_PRESSURES.entry(),
    received::BUCKET_PRESSURES.entry(),
    received::SERVICE.entry(),
    sent::STATE.entry(),
    sent::LENGTHS.entry(),
    sent::TIP.entry(),
    sent::SWING_AND_PITCH.entry(),
    sent::BOOM_AND_ARM.entry(),
    sent::SWING_AND_BOOM_CURRENTS.entry(),
    sent::ARM_AND_BUCKET_CURRENTS.entry(),
    sent::RECEPTION.entry(),
    service::ANSWER.entry(),
    service::FOUND_VALVE.entry(),
    service::FOUND_ENDS.entry(),
    network::DM1.entry(),
    network::TRANSPORT_CONTROL.entry(),
    network::TRANSPORT_DATA.entry(),
    network::ADDRESS_CLAIMED.entry(),
    network::REQUEST.entry(),
];
