//! Bytes from outside, handled: whatever they are, there is no panic, no NaN goes on, and what is refused is named and changes nothing.
//!
//! One function for each way in. The fuzz targets under `fuzz/` call them, and so does the test of the corpus. A breach panics.

mod can;
mod link;
pub mod mutation;
mod record;
pub mod seeds;
mod text;

pub use can::can_frames;
pub use link::exchange;
pub use record::{header, parameter_record};
pub use text::{machine_file, scenario_file};

use firmware::Outputs;

/// A target: its name, which is that of its corpus, and its function.
pub type Target = (&'static str, fn(&[u8]));

/// Every target.
pub const TARGETS: [Target; 5] = [
    ("can_frames", can_frames),
    ("parameter_record", parameter_record),
    ("machine_file", machine_file),
    ("scenario_file", scenario_file),
    ("exchange", exchange),
];

/// Takes bytes one after the other; zeros when there are no more.
struct Cursor<'a>(&'a [u8]);

impl Cursor<'_> {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        let (taken, rest) = self.0.split_at(N.min(self.0.len()));
        bytes[..taken.len()].copy_from_slice(taken);
        self.0 = rest;
        bytes
    }

    fn byte(&mut self) -> u8 {
        self.take::<1>()[0]
    }
}

/// Nothing in the outputs is NaN or infinite, and nothing is driven behind a closed gate.
fn sound(outputs: &Outputs) {
    let Outputs { lengths: l, pose: p, reference: r, .. } = outputs;
    let rotors = [p.swing, p.joints.boom, p.joints.arm, p.joints.bucket, p.plane.pitch];
    let numbers = [l.boom, l.arm, l.bucket, p.x, p.y, p.plane.reach, p.plane.height, r.boom, r.arm, r.bucket]
        .into_iter()
        .chain(rotors.into_iter().flat_map(|rotor| [rotor.cos, rotor.sin]))
        .chain(outputs.asked.to_array())
        .chain(outputs.speeds.to_array())
        .chain(outputs.currents.into_iter().flatten())
        .chain([outputs.clearance_m]);
    assert!(numbers.into_iter().all(f32::is_finite), "{outputs:?}");
    let off = outputs.duties.iter().flatten().all(|&duty| duty == 0);
    assert!(outputs.cut_off_closed || off, "driven behind a closed gate: {outputs:?}");
    assert_eq!(Outputs::from_bytes(&outputs.to_bytes()), Ok(*outputs));
}
