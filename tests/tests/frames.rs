//! Outputs, wires and pins as bytes: nothing is lost on the way, and bytes that name nothing are refused by field.

use cross_tests::rig::Rig;
use firmware::Outputs;
use firmware::frame::OUTPUT_BYTES;
use firmware::simulated::{PIN_BYTES, Pins, WIRE_BYTES, Wires};
use proptest::prelude::*;

#[test]
fn outputs_come_back_from_their_bytes_bit_for_bit() {
    let mut rig = Rig::new();
    let mut outputs = vec![rig.tick(), rig.dig(20)];
    rig.inputs.codes[2] = 0;
    outputs.push(rig.tick());
    for outputs in outputs {
        let bytes = outputs.to_bytes();
        let back = Outputs::from_bytes(&bytes).expect("its own bytes");
        assert_eq!(back, outputs);
        assert_eq!(back.to_bytes(), bytes);
    }
}

#[test]
fn every_byte_of_the_outputs_frame_is_used() {
    // A frame longer than what is written into it would hide a field that was forgotten.
    let mut rig = Rig::new();
    let mut seen = [false; OUTPUT_BYTES];
    let mut first = rig.tick().to_bytes();
    rig.start();
    rig.request = firmware::Request::Dig;
    for step in 0..400_u16 {
        rig.inputs.codes[0] = 32_768 + step;
        if step == 300 {
            rig.inputs.emergency_stop = true;
        }
        let bytes = rig.tick().to_bytes();
        for (seen, (a, b)) in seen.iter_mut().zip(first.iter().zip(&bytes)) {
            *seen |= a != b;
        }
        first = bytes;
    }
    assert!(seen[OUTPUT_BYTES - 16 * 2 / 2 - 1..].iter().any(|&s| s), "the duties are at the end");
    let last_field_written = seen.iter().rposition(|&s| s).expect("something changes");
    assert!(last_field_written >= OUTPUT_BYTES - 4, "the last spool's duties end the frame");
}

#[test]
fn a_byte_that_names_nothing_is_refused_by_field() {
    let healthy = [0; WIRE_BYTES];
    for (at, value, field) in [(64, 7, "converter"), (65, 200, "converter"), (66, 16, "switches"), (71, 9, "frame")] {
        let mut bytes = healthy;
        bytes[at] = value;
        assert_eq!(Wires::from_bytes(&bytes).unwrap_err().field, field);
    }
    let mut bytes = [0; PIN_BYTES];
    bytes[16] = 4;
    assert_eq!(Pins::from_bytes(&bytes).unwrap_err().field, "outputs");
    let outputs = Rig::new().tick().to_bytes();
    for (at, field) in [(4, "state"), (5, "fault"), (6, "flags")] {
        let mut bytes = outputs;
        bytes[at] = 200;
        assert_eq!(Outputs::from_bytes(&bytes).unwrap_err().field, field);
    }
}

proptest! {
    #[test]
    fn any_bytes_of_wires_and_pins_are_refused_or_come_back_the_same(
        mut wires in prop::collection::vec(any::<u8>(), WIRE_BYTES),
        mut pins in prop::collection::vec(any::<u8>(), PIN_BYTES),
    ) {
        // Mostly plausible, so that not every one is refused: no break, few flags, short frames of small identifiers.
        wires[64..67].iter_mut().for_each(|byte| *byte &= 4);
        wires[67..].chunks_mut(13).for_each(plausible);
        pins[16] &= 3;
        pins[17..].chunks_mut(13).for_each(plausible);
        let bytes: [u8; WIRE_BYTES] = wires.try_into().expect("as many");
        let there = Wires::from_bytes(&bytes).expect("plausible");
        prop_assert_eq!(there.to_bytes(), bytes);
        let bytes: [u8; PIN_BYTES] = pins.try_into().expect("as many");
        let there = Pins::from_bytes(&bytes).expect("plausible");
        prop_assert_eq!(there.to_bytes(), bytes);
    }
}

fn plausible(frame: &mut [u8]) {
    frame[3] &= 0x1f;
    match frame[4] % 10 {
        9 => {
            frame.fill(0);
            frame[4] = 0xff;
        }
        length => {
            frame[4] = length;
            frame[5 + usize::from(length)..].fill(0);
        }
    }
}
