//! Inputs and outputs as bytes: nothing is lost on the way, and bytes that name nothing are refused by field.

use cross_tests::rig::Rig;
use firmware::frame::{INPUT_BYTES, OUTPUT_BYTES};
use firmware::{Inputs, Outputs};
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
    rig.inputs.request = firmware::Request::Dig;
    for step in 0..400_u16 {
        rig.inputs.codes[0] = 30_000 + step;
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
    let rig = Rig::new();
    let mut bytes = rig.inputs.to_bytes();
    bytes[11] = 9;
    assert_eq!(Inputs::from_bytes(&bytes).unwrap_err().field, "request");
    let mut bytes = rig.inputs.to_bytes();
    bytes[12] = 64;
    assert_eq!(Inputs::from_bytes(&bytes).unwrap_err().field, "switches");
    let outputs = Rig::new().tick().to_bytes();
    for (at, field) in [(4, "state"), (5, "fault"), (6, "flags")] {
        let mut bytes = outputs;
        bytes[at] = 200;
        assert_eq!(Outputs::from_bytes(&bytes).unwrap_err().field, field);
    }
}

proptest! {
    #[test]
    fn any_input_bytes_are_refused_or_come_back_the_same(bytes in prop::array::uniform21(any::<u8>())) {
        prop_assert_eq!(bytes.len(), INPUT_BYTES);
        if let Ok(inputs) = Inputs::from_bytes(&bytes) {
            prop_assert_eq!(inputs.to_bytes(), bytes);
        }
    }
}
