//! Signals and messages of the tables: they fit, do not overlap, and every code comes back as itself.

use firmware::State;
use firmware::can::command::Mode;
use firmware::can::message::Entry;
use firmware::can::protect::{COUNTER, CRC};
use firmware::can::receive::Validity;
use firmware::can::signal::{Kind, Signal, Unusable};
use firmware::can::table::MESSAGES;
use firmware::can::table::received::{MODES, TIP_VELOCITY, VALVE_STATES};
use firmware::can::table::sent::{RECEPTION, STATES};
use proptest::prelude::*;

fn all() -> impl Iterator<Item = (&'static Entry, &'static Signal)> {
    MESSAGES.iter().flat_map(|entry| entry.signals.iter().map(move |signal| (entry, signal)))
}

#[test]
fn every_signal_fits_its_message_and_overlaps_no_other() {
    for entry in &MESSAGES {
        let mut taken = 0_u64;
        for signal in entry.signals {
            assert!(signal.start + signal.length <= 8 * entry.header.bytes, "{}.{}", entry.header.name, signal.name);
            let bits = signal.put(0, u32::MAX);
            assert_eq!(bits.count_ones(), u32::from(signal.length), "{}.{}", entry.header.name, signal.name);
            assert_eq!(taken & bits, 0, "{}.{}", entry.header.name, signal.name);
            taken |= bits;
        }
    }
}

#[test]
fn every_protected_message_ends_in_counter_and_crc_and_no_other_has_them() {
    for entry in &MESSAGES {
        let ends = entry.signals.ends_with(&[COUNTER, CRC]);
        assert_eq!(ends, entry.header.protected, "{}", entry.header.name);
    }
}

#[test]
fn every_measured_code_is_a_value_within_the_range_or_named_unusable() {
    for (entry, signal) in all().filter(|(_, signal)| signal.kind == Kind::Measured) {
        let name = format!("{}.{}", entry.header.name, signal.name);
        let top = signal.length - 8;
        assert_eq!(signal.value(signal.not_available()), Err(Unusable::NotAvailable), "{name}");
        assert_eq!(signal.value(0xfe << top), Err(Unusable::Error), "{name}");
        assert_eq!(signal.value(0xfb << top), Err(Unusable::OutOfRange), "{name}");
        // A stride that meets every byte, and all codes of the shorter ones.
        let step = if signal.length == 24 { 251 } else { 1 };
        let mut usable = 0;
        for code in (0..=signal.not_available()).step_by(step) {
            if let Ok(value) = signal.value(code) {
                let [low, high] = signal.range;
                let near = 0.5 * signal.scale.factor;
                assert!(value >= low - near && value <= high + near, "{name}: {code} is {value}");
                if value >= low && value <= high {
                    assert_eq!(signal.code(value), code, "{name}: {value}");
                }
                usable += 1;
            }
        }
        assert!(usable > 200, "{name}: {usable}");
        // Both ends of the range can be sent.
        for end in signal.range {
            assert!(signal.value(signal.code(end)).is_ok(), "{name}: {end}");
        }
    }
}

#[test]
fn what_cannot_be_sent_is_sent_as_an_error() {
    for (_, signal) in all().filter(|(_, signal)| signal.kind == Kind::Measured) {
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30] {
            assert_eq!(signal.value(signal.code(value)), Err(Unusable::Error), "{} {value}", signal.name);
        }
    }
}

#[test]
fn a_standstill_comes_back_as_exactly_zero() {
    let [x, z, pitch, ..] = TIP_VELOCITY.decode(TIP_VELOCITY.encode([0.0, -0.0, 0.0, 0.0, 0.0]));
    assert_eq!([x, z, pitch].map(|v| v.unwrap().to_bits()), [0.0_f32.to_bits(); 3]);
}

#[test]
fn states_and_modes_of_the_code_are_those_of_the_tables() {
    let states: Vec<u32> = (0..=u8::MAX).filter_map(State::from_code).map(|state| state.code().into()).collect();
    assert_eq!(states, STATES.map(|(code, _)| code));
    assert_eq!(Mode::ALL.map(Mode::code), MODES.map(|(code, _)| code));
    let validities = [
        Validity::Fresh,
        Validity::Stale,
        Validity::Short,
        Validity::BadChecksum,
        Validity::FrozenCounter,
        Validity::OutOfRange,
    ];
    assert_eq!(validities.map(Validity::code), Validity::NAMES.map(|(code, _)| code));
    assert_eq!(VALVE_STATES.map(|(_, name)| name), ["blocked", "extend", "retract", "floating"]);
}

#[test]
fn the_reception_message_names_the_messages_received_in_their_order() {
    let received: Vec<&str> =
        MESSAGES.iter().filter(|e| e.header.sender.name() != "Controller").map(|e| e.header.name).collect();
    let told: Vec<&str> = RECEPTION.signals.iter().map(|signal| signal.name).collect();
    assert_eq!(received[..received.len() - 1], told);
}

proptest! {
    #[test]
    fn a_code_put_into_any_payload_is_found_there_and_nothing_else_changes(payload: u64, code: u32) {
        for (_, signal) in all() {
            let put = signal.put(payload, code);
            prop_assert_eq!(signal.code_in(put), code & signal.not_available());
            let bits = signal.put(0, u32::MAX);
            prop_assert_eq!(put & !bits, payload & !bits);
        }
    }

    #[test]
    fn a_value_comes_back_within_half_a_code(part in 0.0_f32..=1.0) {
        for (entry, signal) in all().filter(|(_, signal)| signal.kind == Kind::Measured) {
            let [low, high] = signal.range;
            let value = low + part * (high - low);
            prop_assume!(value >= low && value <= high);
            let back = signal.value(signal.code(value)).unwrap();
            // Half a code, and the rounding of the value itself.
            let near = 0.5 * signal.scale.factor + 4.0 * f32::EPSILON * (value.abs() + signal.scale.offset.abs());
            prop_assert!((back - value).abs() <= near, "{}.{}: {value} came back as {back}", entry.header.name, signal.name);
        }
    }
}
