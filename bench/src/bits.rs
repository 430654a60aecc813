//! A hash over the raw bits of the fixed-point kernels at many poses: the same on the host and on the target, or one of them rounds
//! or shifts otherwise.

use kinematics_core::rates::CylinderRates;
use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};

/// Poses a machine.
pub const POSES: u32 = 2000;

/// FNV-1a, 32 bits.
struct Hash(u32);

impl Hash {
    fn add(&mut self, values: &[f32]) {
        for byte in values.iter().flat_map(|value| value.to_bits().to_le_bytes()) {
            self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    }
}

/// Lengths anywhere in the strokes, ends included, by a linear congruential generator: no function but + and × makes them.
fn poses(g: &PinGeometry) -> impl Iterator<Item = Cylinders<f32>> {
    let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| (s.min_m as f32, (s.max_m - s.min_m) as f32));
    let mut state = 1u32;
    let mut length = move |(min, span): (f32, f32)| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let part = (state >> 16) as f32 / 65535.0;
        // Half of them crowd towards the ends.
        let crowded = if state & 0x8000 == 0 { part } else { part * part * part * part };
        min + if state & 0x4000 == 0 { crowded } else { 1.0 - crowded } * span
    };
    (0..POSES).map(move |_| {
        let [boom, arm, bucket] = strokes.map(&mut length);
        Cylinders { boom, arm, bucket }
    })
}

/// The hash, and at how many of [`POSES`] the kernels answered; `None` for a geometry that is refused.
pub fn fine(geometry: &PinGeometry) -> Option<(u32, u32)> {
    let machine = Machine::<f32>::new(geometry).ok()?;
    let (mut hash, mut answered) = (Hash(0x811c_9dc5), 0);
    let swing = Rotor::from_turns(0.3);
    let rates = CylinderRates { boom: 0.11, arm: -0.23, bucket: 0.31 };
    for cylinders in poses(geometry) {
        let (Ok((pose, jacobian)), Ok(bias)) =
            (machine.cylinders_to_tip_with_fine_jacobian(&cylinders, swing), machine.cylinder_bias(&cylinders, &rates))
        else {
            continue;
        };
        answered += 1;
        for rotor in [pose.joints.boom, pose.joints.arm, pose.joints.bucket, pose.plane.pitch] {
            hash.add(&[rotor.cos, rotor.sin]);
        }
        hash.add(&[pose.plane.reach, pose.plane.height, pose.x, pose.y]);
        for row in [jacobian.reach, jacobian.height, jacobian.pitch] {
            hash.add(&row);
        }
        hash.add(&[bias.reach, bias.height, bias.pitch]);
        let chain = machine.chain();
        for jacobian in
            [chain.fine_swing_jacobian(&pose.joints, swing), chain.fine_swing_wrist_jacobian(&pose.joints, swing)]
        {
            jacobian.matrix().iter().for_each(|row| hash.add(row));
        }
    }
    Some((hash.0, answered))
}
