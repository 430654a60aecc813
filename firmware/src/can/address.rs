//! Who is who on the bus: addresses, the controller's NAME, and the claim of its address (J1939-81).

use core::fmt;

use super::frame::CanFrame;
use super::id::{GLOBAL, Identifier, NULL};
use super::message::Sender;
use super::table::network::{ADDRESS_CLAIMED, CLAIM_GAP_MS, REQUEST};

/// Where each node is; a message from anywhere else is not heard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Addresses {
    /// This controller.
    pub own: u8,
    /// The operator's levers, panel or remote control.
    pub operator: u8,
    /// The chassis' slope sensor.
    pub slope_sensor: u8,
    /// The pressure sensors' gateway.
    pub pressure_sensors: u8,
    /// The engineer's service tool.
    pub service_tool: u8,
}

/// The NAME's fields that a maker sets; the rest says: construction equipment, function not listed, address fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    /// Serial number, 21 bits.
    pub identity: u32,
    /// The maker's code from SAE, 11 bits.
    pub manufacturer: u32,
    /// Which of several alike controllers of a function, 3 bits.
    pub ecu_instance: u32,
    /// Which of several alike functions, 5 bits.
    pub function_instance: u32,
}

/// What is wrong with addresses or NAME.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AddressError {
    /// Above the highest allowed.
    TooHigh {
        /// The field.
        field: &'static str,
        /// What it holds.
        value: u32,
        /// The highest allowed; the lowest is 0.
        highest: u32,
    },
    /// Two nodes at one address.
    Same {
        /// One of them.
        field: &'static str,
        /// The other.
        other: &'static str,
    },
}

impl fmt::Display for AddressError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooHigh { field, value, highest } => write!(f, "`{field}` is {value} but must be within 0…{highest}"),
            Self::Same { field, other } => write!(f, "`{field}` and `{other}` must differ"),
        }
    }
}

impl core::error::Error for AddressError {}

impl Addresses {
    /// What `docs/icd.md` and `docs/excavator.dbc` are written for.
    pub const DEFAULT: Self =
        // J1939's preferred address of an off-board service tool.
        Self { own: 0x80, operator: 0x81, slope_sensor: 0x82, pressure_sensors: 0x83, service_tool: 0xf9 };

    /// Where a sender is expected; `None` for those without an address of their own.
    pub fn of(&self, sender: Sender) -> Option<u8> {
        match sender {
            Sender::Controller => Some(self.own),
            Sender::Operator => Some(self.operator),
            Sender::SlopeSensor => Some(self.slope_sensor),
            Sender::PressureSensors => Some(self.pressure_sensors),
            Sender::ServiceTool => Some(self.service_tool),
            Sender::Any => None,
        }
    }

    /// Checks that every address is one and none is given twice.
    ///
    /// # Errors
    /// The first at fault.
    pub fn validate(&self) -> Result<(), AddressError> {
        let named = [
            ("own", self.own),
            ("operator", self.operator),
            ("slope_sensor", self.slope_sensor),
            ("pressure_sensors", self.pressure_sensors),
            ("service_tool", self.service_tool),
        ];
        for (index, (field, address)) in named.into_iter().enumerate() {
            if address >= NULL {
                let highest = u32::from(NULL) - 1;
                return Err(AddressError::TooHigh { field, value: address.into(), highest });
            }
            if let Some((other, _)) = named.into_iter().skip(index + 1).find(|&(_, same)| same == address) {
                return Err(AddressError::Same { field, other });
            }
        }
        Ok(())
    }
}

impl Name {
    const NOT_LISTED_FUNCTION: u32 = 0xff;
    const NOT_LISTED_SYSTEM: u32 = 0x7f;
    const CONSTRUCTION: u32 = 3;

    /// The 64 bits; the lower NAME wins an address.
    ///
    /// # Errors
    /// A field does not fit its bits.
    pub fn bits(&self) -> Result<u64, AddressError> {
        let codes = [
            self.identity,
            self.manufacturer,
            self.ecu_instance,
            self.function_instance,
            Self::NOT_LISTED_FUNCTION,
            0,
            Self::NOT_LISTED_SYSTEM,
            0,
            Self::CONSTRUCTION,
            0,
        ];
        // Named here, for the table has no names in an image for a board; the codes after these fit.
        let fields = ["Identity", "Manufacturer", "EcuInstance", "FunctionInstance"];
        for ((signal, field), value) in ADDRESS_CLAIMED.signals.iter().zip(fields).zip(codes) {
            let highest = signal.not_available();
            if value > highest {
                return Err(AddressError::TooHigh { field, value, highest });
            }
        }
        Ok(ADDRESS_CLAIMED.pack(codes))
    }
}

/// Ticks between claim and use.
const WAIT_TICKS: u16 = 250;

/// Whether the address is ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    /// Claimed or about to be; others may object for so many ticks.
    Waiting(u16),
    Ours,
    Lost,
}

/// The claim of the controller's address. A fixed one: whoever loses it is silent.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    own: u8,
    name: u64,
    standing: Standing,
    answer_due: bool,
    /// Ticks until the next answer may go.
    gap: u16,
}

impl Claim {
    pub(crate) const fn new(own: u8, name: u64) -> Self {
        Self { own, name, standing: Standing::Waiting(WAIT_TICKS), answer_due: true, gap: 0 }
    }

    /// Other messages may be sent.
    pub fn is_ours(&self) -> bool {
        self.standing == Standing::Ours
    }

    /// Takes in claims of our address and requests for it.
    pub(crate) fn receive(&mut self, id: Identifier, frame: &CanFrame) {
        if id.pgn == ADDRESS_CLAIMED.header.pgn && id.source == self.own && self.standing != Standing::Lost {
            let Some(other) = frame.payload() else { return };
            self.answer_due = true;
            // The same NAME twice is a mistake in the field; both falling silent is better than two with one address.
            if other <= self.name {
                self.standing = Standing::Lost;
                // J1939-81: a delay of 0 to 153 ms that differs from node to node.
                let sum = self.name.to_le_bytes().into_iter().fold(0_u8, u8::wrapping_add);
                self.gap = u16::from(sum) * 153 / 255;
            }
        }
        let asked = id.destination == GLOBAL || id.destination == self.own;
        if id.pgn == REQUEST.header.pgn && asked && frame.first_three() == Some(ADDRESS_CLAIMED.header.pgn) {
            self.answer_due = true;
        }
    }

    /// The claim, or that there is none to be had, when one is due this tick.
    pub(crate) fn due(&mut self) -> Option<CanFrame> {
        if self.gap > 0 {
            self.gap -= 1;
        }
        if let Standing::Waiting(ticks) = self.standing {
            self.standing = if ticks == 0 { Standing::Ours } else { Standing::Waiting(ticks - 1) };
        }
        if !self.answer_due || self.gap > 0 {
            return None;
        }
        (self.answer_due, self.gap) = (false, CLAIM_GAP_MS);
        let source = if self.standing == Standing::Lost { NULL } else { self.own };
        Some(ADDRESS_CLAIMED.frame(source, 0, self.name))
    }
}
