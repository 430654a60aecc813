//! DM1: the active faults, every second and on change, in one frame or in packets (J1939-73, J1939-21).

use super::frame::CanFrame;
use super::table::network::{DIAGNOSTICS_GAP_MS, DM1, TRANSPORT_CONTROL, TRANSPORT_DATA};
use crate::fault::Fault;
use crate::trouble::{Lamp, TroubleCode};

const FAULTS: usize = Fault::ALL.len();

/// Ticks between two DM1, and between two told changes of one fault.
const SECOND: u16 = 1000;

/// As many trouble codes as packets at their distance carry within a second.
const LISTED: usize = 31;
const LONGEST: usize = 2 + 4 * if FAULTS < LISTED { FAULTS } else { LISTED };

/// An occurrence count stops here; 127 means "not available".
const MOST_OCCURRENCES: u8 = 126;

/// A set of faults.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ActiveFaults(u128);

const _: () = {
    let mut i = 0;
    while i < FAULTS {
        assert!(Fault::ALL[i].code() < 128, "a fault's code must fit the set");
        i += 1;
    }
};

impl ActiveFaults {
    /// No fault.
    pub const NONE: Self = Self(0);

    /// This set and one more.
    #[must_use]
    pub const fn with(self, fault: Fault) -> Self {
        Self(self.0 | Self::bit(fault))
    }

    /// Whether the fault is in the set.
    pub const fn has(self, fault: Fault) -> bool {
        self.0 & Self::bit(fault) != 0
    }

    const fn bit(fault: Fault) -> u128 {
        // Codes are below 128, asserted above.
        1 << (fault.code() & 127)
    }

    fn set(&mut self, fault: Fault, active: bool) {
        self.0 = if active { self.0 | Self::bit(fault) } else { self.0 & !Self::bit(fault) };
    }
}

impl From<Option<Fault>> for ActiveFaults {
    fn from(fault: Option<Fault>) -> Self {
        fault.map_or(Self::NONE, |fault| Self::NONE.with(fault))
    }
}

/// What was told of one fault.
#[derive(Clone, Copy, Debug)]
struct Told {
    occurrences: u8,
    changed_at: u32,
}

/// A message on its way in packets.
#[derive(Clone, Copy, Debug)]
struct Transfer {
    bytes: [u8; LONGEST],
    length: u8,
    /// Packets sent; the announcement is before the first.
    sent: u8,
}

/// The sender of DM1.
#[derive(Clone, Copy, Debug)]
pub struct Dm1 {
    tick: u32,
    told: ActiveFaults,
    /// Active at some time since a frame could last go.
    seen: ActiveFaults,
    each: [Told; FAULTS],
    /// Ticks since the last DM1 began.
    since: u16,
    due: bool,
    /// Ticks until the next frame may go.
    gap: u16,
    transfer: Option<Transfer>,
}

impl Dm1 {
    pub(crate) const fn new() -> Self {
        let never = 0_u32.wrapping_sub(SECOND as u32);
        Self {
            tick: 0,
            told: ActiveFaults::NONE,
            seen: ActiveFaults::NONE,
            each: [Told { occurrences: 0, changed_at: never }; FAULTS],
            since: 0,
            due: true,
            gap: 0,
            transfer: None,
        }
    }

    /// This tick's frame, if one is due.
    pub(crate) fn due(&mut self, source: u8, active: ActiveFaults) -> Option<CanFrame> {
        self.seen = ActiveFaults(self.seen.0 | active.0);
        self.tick = self.tick.wrapping_add(1);
        self.since = self.since.saturating_add(1);
        self.due |= self.since >= SECOND;
        if self.gap > 0 {
            self.gap -= 1;
        }
        if self.gap > 0 {
            return None;
        }
        let frame = match &mut self.transfer {
            Some(transfer) => {
                let (frame, last) = transfer.packet(source);
                if last {
                    self.transfer = None;
                }
                frame
            }
            None => {
                self.note();
                if !self.due {
                    return None;
                }
                self.begin(source)
            }
        };
        self.gap = DIAGNOSTICS_GAP_MS;
        Some(frame)
    }

    /// Takes in what was active since the last frame could go, when the next can: so a change is told when it is noted. A fault
    /// that comes and goes within a second of its last change is told as it stands after it.
    fn note(&mut self) {
        let active = core::mem::take(&mut self.seen);
        if active == self.told {
            return;
        }
        for (fault, told) in Fault::ALL.into_iter().zip(&mut self.each) {
            let is_active = active.has(fault);
            let settled = self.tick.wrapping_sub(told.changed_at) >= u32::from(SECOND);
            if is_active != self.told.has(fault) && settled {
                self.told.set(fault, is_active);
                told.changed_at = self.tick;
                if is_active && told.occurrences < MOST_OCCURRENCES {
                    told.occurrences += 1;
                }
                self.due = true;
            }
        }
    }

    /// The frame that tells all, or the announcement of the packets that do.
    fn begin(&mut self, source: u8) -> CanFrame {
        (self.due, self.since) = (false, 0);
        let active = self.told;
        let lamps = lamps(active);
        let mut bytes = [0xff; LONGEST];
        let mut slots = bytes.iter_mut();
        let mut put = |byte: u8| {
            if let Some(slot) = slots.next() {
                *slot = byte;
            }
        };
        let [lamp, flash, ..] = lamps.to_le_bytes();
        put(lamp);
        put(flash);
        let (mut length, mut first) = (2_u8, None);
        let told = Fault::ALL.into_iter().zip(&self.each).filter(|&(fault, _)| active.has(fault)).take(LISTED);
        for (fault, told) in told {
            let payload = with_code(lamps, fault.trouble_code(), told.occurrences);
            let [_, _, a, b, c, d, _, _] = payload.to_le_bytes();
            [a, b, c, d].into_iter().for_each(&mut put);
            length += 4;
            first = first.or(Some(payload));
        }
        if length <= 6 {
            let payload = first.unwrap_or_else(|| with_code(lamps, NO_CODE, 0));
            return DM1.frame(source, 0, payload);
        }
        let packets = length.div_ceil(7);
        self.transfer = Some(Transfer { bytes, length, sent: 0 });
        let codes = [32, length.into(), packets.into(), DM1.header.pgn];
        TRANSPORT_CONTROL.frame(source, 0, TRANSPORT_CONTROL.pack(codes))
    }
}

/// What stands where no fault is active.
const NO_CODE: TroubleCode = TroubleCode { spn: 0, fmi: 0, lamp: Lamp::AmberWarning };

/// The payload with the lamps of all active faults; lamps do not flash.
fn lamps(active: ActiveFaults) -> u64 {
    let (mut amber_on, mut red_on) = (false, false);
    for fault in Fault::ALL.into_iter().filter(|&fault| active.has(fault)) {
        match fault.trouble_code().lamp {
            Lamp::AmberWarning => amber_on = true,
            Lamp::RedStop => red_on = true,
        }
    }
    let [protect, amber, red, malfunction, ..] = &DM1.signals;
    let lamps = [(protect, false), (amber, amber_on), (red, red_on), (malfunction, false)];
    lamps.into_iter().fold(u64::MAX, |payload, (lamp, on)| lamp.put(payload, on.into()))
}

/// The payload with this trouble code in its place.
fn with_code(payload: u64, code: TroubleCode, occurrences: u8) -> u64 {
    let [_, _, _, _, low, fmi, high, count, conversion, _] = &DM1.signals;
    let fields =
        [(low, code.spn), (fmi, code.fmi.into()), (high, code.spn >> 16), (count, occurrences.into()), (conversion, 0)];
    fields.into_iter().fold(payload, |payload, (signal, code)| signal.put(payload, code))
}

impl Transfer {
    /// The next packet, and whether it is the last.
    fn packet(&mut self, source: u8) -> (CanFrame, bool) {
        let before = usize::from(self.sent) * 7;
        self.sent += 1;
        let mut codes = [0xff; 8];
        let bytes = self.bytes.iter().take(self.length.into()).skip(before).map(|&byte| u32::from(byte));
        let sequence = core::iter::once(u32::from(self.sent));
        for (code, byte) in codes.iter_mut().zip(sequence.chain(bytes)) {
            *code = byte;
        }
        let frame = TRANSPORT_DATA.frame(source, 0, TRANSPORT_DATA.pack(codes));
        (frame, self.sent >= self.length.div_ceil(7))
    }
}
