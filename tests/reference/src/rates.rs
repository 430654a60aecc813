//! What the tests of rates share: triples of numbers, errors relative to a row, and the poses they are taken at.

use kinematics_core::geometry::Stroke;
use kinematics_core::jacobian::Twist;
use kinematics_core::rates::{CylinderRates, JointRates};
use kinematics_core::{Cylinders, Joints, PinGeometry, Real, Rotor, STROKE_TOLERANCE_M};

use crate::differences::on_grid;
use crate::sweep::{Random, lengths};

/// Lengths of boom, arm and bucket cylinder.
pub fn cylinders<T: Real>(lengths: [f64; 3]) -> Cylinders<T> {
    let [boom, arm, bucket] = lengths.map(T::from_f64);
    Cylinders { boom, arm, bucket }
}

/// Rates of boom, arm and bucket joint.
pub fn joint_rates<T: Real>(rates: [f64; 3]) -> JointRates<T> {
    let [boom, arm, bucket] = rates.map(T::from_f64);
    JointRates { boom, arm, bucket }
}

/// Rates of boom, arm and bucket cylinder.
pub fn cylinder_rates<T: Real>(rates: [f64; 3]) -> CylinderRates<T> {
    let [boom, arm, bucket] = rates.map(T::from_f64);
    CylinderRates { boom, arm, bucket }
}

/// Reach, height, pitch.
pub fn twist<T: Real>(t: Twist<T>) -> [f64; 3] {
    [t.reach, t.height, t.pitch].map(T::to_f64)
}

/// A rotor rounded to T.
pub fn rotor<T: Real>(r: Rotor<f64>) -> Rotor<T> {
    Rotor { cos: T::from_f64(r.cos), sin: T::from_f64(r.sin) }
}

/// The largest error relative to the largest entry of `exact`.
///
/// # Panics
/// For errors that are not finite and rows of zeros.
pub fn row_error<const N: usize, T: Real>(found: [T; N], exact: [f64; N]) -> f64 {
    let largest = exact.iter().fold(0.0f64, |l, x| l.max(x.abs()));
    let error = found.iter().zip(exact).fold(0.0f64, |e, (f, x)| e.max((f.to_f64() - x).abs()));
    assert!(error.is_finite() && largest > 0.0, "{found:?} {exact:?}");
    error / largest
}

/// The worst error seen and where.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst(pub f64, pub [f64; 3]);

impl Worst {
    /// Another error and where.
    pub fn see(&mut self, error: f64, at: [f64; 3]) {
        if error > self.0 {
            *self = Self(error, at);
        }
    }

    /// Prints it and holds it to a bound.
    ///
    /// # Panics
    /// Where it exceeds the bound.
    #[track_caller]
    pub fn hold(self, name: &str, what: &str, bound: f64) {
        println!("{name} {what}: {:.2e} at cylinders {:?} m (at most {bound:.0e})", self.0, self.1);
        assert!(self.0 <= bound, "{name} {what}: {:e} at {:?}", self.0, self.1);
    }
}

/// The largest error of the first rows (those of velocities), relative to their largest entry.
pub fn matrix_error<const N: usize, T: Real>(found: &[[T; N]], exact: &[[f64; N]]) -> f64 {
    let largest = exact.iter().flatten().fold(0.0f64, |l, x| l.max(x.abs()));
    let pairs = found.iter().flatten().zip(exact.iter().flatten());
    pairs.fold(0.0f64, |e, (f, x)| e.max((f.to_f64() - x).abs())) / largest
}

/// Lengths over one stroke that differences can be taken at.
///
/// # Panics
/// Where the sweep lost its lengths: it would prove nothing.
pub fn sweep<T: Real>(g: &PinGeometry, which: usize, random: &mut Random) -> Vec<f64> {
    let stroke = [g.boom.stroke, g.arm.stroke, g.bucket.stroke][which];
    let mut all: Vec<f64> = lengths::<T>(stroke, random).into_iter().map(|l| on_grid(l.to_f64())).collect();
    let (lowest, highest) = (stroke.min_m - STROKE_TOLERANCE_M, stroke.max_m + STROKE_TOLERANCE_M);
    all.retain(|l| T::from_f64(*l).to_f64() == *l && *l >= lowest && *l <= highest);
    all.dedup();
    assert!(all.len() > 5000, "{}", all.len());
    all
}

/// Lengths of all three cylinders: every combination of those next to the ends, and random ones.
pub fn poses<T: Real>(g: &PinGeometry) -> Vec<[f64; 3]> {
    let mut random = Random::new(12);
    let all = [0, 1, 2].map(|which| sweep::<T>(g, which, &mut random));
    let ends = all.each_ref().map(|of| {
        let mut some = vec![of[0], of[1], of[of.len() / 2], of[of.len() - 2], of[of.len() - 1]];
        some.extend((0..3).map(|_| of[random.index(of.len())]));
        some
    });
    let mut poses = Vec::new();
    for &boom in &ends[0] {
        for &arm in &ends[1] {
            poses.extend(ends[2].iter().map(|&bucket| [boom, arm, bucket]));
        }
    }
    poses.extend((0..20_000).map(|_| [0, 1, 2].map(|which| all[which][random.index(all[which].len())])));
    poses
}

/// A length inside the stroke, three quarters of them crowding towards its ends.
pub fn crowding(stroke: Stroke, random: &mut Random) -> f64 {
    let part = random.unit();
    let part = match random.bits() & 3 {
        0 => part,
        1 => part.powi(3),
        2 => part.powi(8),
        _ => part.powi(20),
    };
    let part = if random.bits() & 1 == 0 { part } else { 1.0 - part };
    f64::from((stroke.min_m + part * (stroke.max_m - stroke.min_m)) as f32)
}

/// Exactly the directions of joints in f32.
pub fn exactly(joints: &Joints<f32>) -> Joints<f64> {
    let unit = |r: Rotor<f32>| Rotor { cos: f64::from(r.cos), sin: f64::from(r.sin) }.renormalised();
    Joints { boom: unit(joints.boom), arm: unit(joints.arm), bucket: unit(joints.bucket) }
}
