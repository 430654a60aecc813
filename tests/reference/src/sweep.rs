//! Cylinder lengths over whole strokes, and reproducible random numbers.

use kinematics_core::geometry::Stroke;
use kinematics_core::{Real, STROKE_TOLERANCE_M};

/// SplitMix64: the same numbers on every host.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A stream of its own for each seed.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (0.5f64).powi(53)
    }

    /// An index below `len`.
    pub fn index(&mut self, len: usize) -> usize {
        (self.bits() % len as u64) as usize
    }
}

/// Points of the even grid over a stroke, and random ones beside it.
const GRID: u32 = 4000;
/// Steps of T's own spacing next to each end.
const NEXT_TO_END: i32 = 64;
/// Halvings of the stroke towards each end: down to 2⁻³⁰ of it.
const HALVINGS: i32 = 30;

/// Lengths of type T inside `stroke` (tolerance included): both ends exactly, the outermost accepted lengths, every one of the
/// 64 numbers next to an end, distances to the ends halved thirty times, an even grid and random points; sorted.
pub fn lengths<T: Real>(stroke: Stroke, random: &mut Random) -> Vec<T> {
    let Stroke { min_m, max_m } = stroke;
    let span = max_m - min_m;
    let spacing = if T::from_f64(1.0 + 1e-12) == T::ONE { f64::from(f32::EPSILON) } else { f64::EPSILON };
    let mut wanted = Vec::new();
    for (end, inwards) in [(min_m, 1.0), (max_m, -1.0)] {
        wanted.extend([end, end - inwards * STROKE_TOLERANCE_M, end - 0.5 * inwards * STROKE_TOLERANCE_M]);
        wanted.extend((-NEXT_TO_END..=NEXT_TO_END).map(|n| end * (1.0 + f64::from(n) * spacing)));
        wanted.extend((0..=HALVINGS).map(|n| end + inwards * span * 0.5f64.powi(n)));
    }
    wanted.extend((0..=GRID).map(|n| min_m + span * f64::from(n) / f64::from(GRID)));
    wanted.extend((0..GRID).map(|_| min_m + span * random.unit()));
    let inside = |x: &f64| *x >= min_m - STROKE_TOLERANCE_M && *x <= max_m + STROKE_TOLERANCE_M;
    let mut rounded: Vec<f64> = wanted.into_iter().map(|x| T::from_f64(x).to_f64()).filter(inside).collect();
    rounded.sort_by(f64::total_cmp);
    rounded.dedup();
    rounded.into_iter().map(T::from_f64).collect()
}
