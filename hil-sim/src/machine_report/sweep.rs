//! What only all three strokes together tell: how much a millimetre of stroke moves the tip, and how well f32 follows f64.

use kinematics_core::{Cylinders, Machine, PinGeometry, PoseError, Rotor};
use serde::Serialize;

use super::grid;

/// Points of each stroke.
const POINTS: usize = 41;

/// A pose by its cylinders, m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct At {
    /// Boom cylinder.
    pub boom_m: f64,
    /// Arm cylinder.
    pub arm_m: f64,
    /// Bucket cylinder.
    pub bucket_m: f64,
}

/// What a millimetre of one cylinder's stroke is at the tip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Sensitivity {
    /// The most over all poses, mm per mm.
    pub worst: f64,
    /// Where.
    pub at: At,
    /// With the tip at its greatest reach, mm per mm.
    pub at_full_reach: f64,
    /// The sensor resolution that keeps this cylinder's share, a third, of the wanted tip accuracy at the worst pose, m.
    pub resolution_m: f64,
}

/// How well the f32 maps follow the f64 ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SinglePrecision {
    /// Largest distance between the tips, m.
    pub worst_m: f64,
    /// The same over boom + arm + bucket.
    pub of_reach: f64,
    /// Where.
    pub at: At,
}

/// Results of the sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Sweep {
    /// Boom, arm, bucket.
    pub sensitivity: [Sensitivity; 3],
    /// f32 against f64.
    pub single_precision: SinglePrecision,
}

/// Sweeps every stroke; `progress` hears of each boom length done out of all.
///
/// # Errors
/// A pose the maps refuse, which validation rules out.
pub fn sweep(
    geometry: &PinGeometry,
    machine: &Machine<f64>,
    wanted_m: f64,
    mut progress: impl FnMut(u32, u32),
) -> Result<Sweep, PoseError<f64>> {
    let g = geometry;
    // Loading has validated the geometry in f64, which is all that is validated.
    let Ok(single) = Machine::<f32>::new(g) else { return Ok(Sweep::default()) };
    let mut out = Sweep::default();
    let mut full_reach = f64::NEG_INFINITY;
    for (i, boom) in grid(g.boom.stroke, POINTS).enumerate() {
        for arm in grid(g.arm.stroke, POINTS) {
            for bucket in grid(g.bucket.stroke, POINTS) {
                let at = At { boom_m: boom, arm_m: arm, bucket_m: bucket };
                let lengths = Cylinders { boom, arm, bucket };
                let (pose, jacobian) = machine.cylinders_to_tip_with_jacobian(&lengths, Rotor::IDENTITY)?;
                let sizes = [0, 1, 2].map(|c| libm::hypot(jacobian.reach[c], jacobian.height[c]));
                let stretched = pose.plane.reach > full_reach;
                full_reach = if stretched { pose.plane.reach } else { full_reach };
                for (one, size) in out.sensitivity.iter_mut().zip(sizes) {
                    if size > one.worst {
                        (one.worst, one.at) = (size, at);
                    }
                    if stretched {
                        one.at_full_reach = size;
                    }
                }
                compare(&mut out.single_precision, machine, &single, at);
            }
        }
        progress(i as u32 + 1, POINTS as u32);
    }
    for one in &mut out.sensitivity {
        one.resolution_m = wanted_m / 3.0 / one.worst;
    }
    out.single_precision.of_reach = out.single_precision.worst_m / g.reach_m();
    Ok(out)
}

/// Both maps on exactly the same lengths, those f32 can hold; an end of a stroke that f32 puts outside is left to the others.
fn compare(worst: &mut SinglePrecision, double: &Machine<f64>, single: &Machine<f32>, at: At) {
    let lengths = Cylinders { boom: at.boom_m as f32, arm: at.arm_m as f32, bucket: at.bucket_m as f32 };
    let same = Cylinders { boom: lengths.boom.into(), arm: lengths.arm.into(), bucket: lengths.bucket.into() };
    let found = (single.cylinders_to_tip(&lengths, Rotor::IDENTITY), double.cylinders_to_tip(&same, Rotor::IDENTITY));
    if let (Ok(a), Ok(b)) = found {
        let off = libm::hypot(f64::from(a.x) - b.x, f64::from(a.z()) - b.z());
        if off > worst.worst_m {
            (worst.worst_m, worst.at) = (off, at);
        }
    }
}
