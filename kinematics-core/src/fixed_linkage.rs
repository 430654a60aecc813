//! Triangle and four-bar of [`crate::triangle`] and [`crate::four_bar`] in fixed point, with their transmissions dθ/dL.

use crate::fixed::{Fixed, FixedVec, Wide};
use crate::geometry::Stroke;
use crate::triangle::Side;
use crate::{PinGeometry, Real, STROKE_TOLERANCE_M, Vec2};

/// A joint moved by a cylinder, scaled so that 2ab is nearly one: w = k·cos α and r = k·sin α with k = 2ab/unit².
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedTriangle<T> {
    /// Lengths times this are whole numbers, and those times `steps` the length in steps of 2⁻²⁹ units.
    per_m: T,
    steps: i32,
    /// (a² + b²)/unit² in steps of 2⁻⁵⁸
    middle: i64,
    /// k²
    span: Wide,
    /// The joint's rotor is w·straight + r·across, times the scale given.
    straight: FixedVec,
    across: FixedVec,
    /// dθ/dL = slope·L/r
    slope: T,
    /// σ, +1 where the joint turns counter-clockwise as the cylinder extends, else −1
    sigma: T,
}

/// A joint at one length, away from its dead points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedTriangle<T> {
    /// The joint's rotor times the scale.
    pub(crate) vector: FixedVec,
    /// dθ/dL, rad/m.
    pub(crate) rate: T,
    /// cot α
    cotangent: T,
}

impl<T: Real> FixedTriangle<T> {
    /// As `Triangle::new`; `None` where the scaled numbers would not fit.
    pub(crate) fn new(fixed: Vec2<f64>, moving: Vec2<f64>, side: Side, scale: f64, stroke: Stroke) -> Option<Self> {
        let (a, b) = (fixed.norm(), moving.norm());
        let twice_ab = 2.0 * a * b;
        // Whole numbers of the spacing f32 has at the shortest length: every length is one exactly.
        let mut per_m = f64::from(1u32 << 24);
        while per_m * (stroke.min_m - STROKE_TOLERANCE_M) < f64::from(1u32 << 23) {
            per_m *= 2.0;
        }
        while per_m * (stroke.min_m - STROKE_TOLERANCE_M) >= f64::from(1u32 << 24) {
            per_m *= 0.5;
        }
        let steps = (f64::from(1u32 << 29) / (per_m * twice_ab.sqrt())).nearest_i32();
        let longest = per_m * (stroke.max_m + STROKE_TOLERANCE_M) * f64::from(steps);
        if steps < 8 || longest >= f64::from(1u32 << 31) {
            return None;
        }
        let unit = f64::from(1u32 << 29) / (per_m * f64::from(steps));
        let k = twice_ab / (unit * unit);
        let sigma = match side {
            Side::CounterClockwise => 1.0,
            Side::Clockwise => -1.0,
        };
        let offset = fixed.complex_mul(moving.conjugate()).scale(scale / (a * b * k));
        Some(Self {
            per_m: T::from_f64(per_m),
            steps,
            middle: wide((a * a + b * b) / (unit * unit), 58),
            span: Wide(wide(k * k, 60)),
            straight: FixedVec::new(offset.x, offset.z)?,
            across: FixedVec::new(-(offset.z * sigma), offset.x * sigma)?,
            slope: T::from_f64(2.0 * sigma / (unit * unit)),
            sigma: T::from_f64(sigma),
        })
    }

    /// Cylinder length (m) inside its stroke → the joint; `None` at a dead point.
    #[inline(always)]
    pub(crate) fn place(&self, length: T) -> Option<PlacedTriangle<T>> {
        let x = i64::from((length * self.per_m).truncated_i32().wrapping_mul(self.steps));
        let w = self.middle.wrapping_sub(x.wrapping_mul(x));
        // w to 30 bits, and the 28 beyond them: near a dead point k² − w² needs both.
        let (high, low) = (Fixed((w >> 28) as i32), Fixed((w & 0x0fff_ffff) as i32));
        let root = self.span.minus(high.times(high)).minus(Wide(high.times(low).0 >> 27)).root::<T>()?;
        let part = |along: Fixed, across: Fixed| high.times(along).plus(root.times(across)).narrow();
        let vector = FixedVec { x: part(self.straight.x, self.across.x), z: part(self.straight.z, self.across.z) };
        let sine: T = root.to_real();
        Some(PlacedTriangle { vector, rate: self.slope * length / sine, cotangent: high.to_real::<T>() / sine })
    }

    /// d²θ/dL² = (dθ/dL)/L − σ·(dθ/dL)²·cot α, rad/m².
    #[inline(always)]
    pub(crate) fn bend(&self, placed: &PlacedTriangle<T>, length: T) -> T {
        let PlacedTriangle { rate, cotangent, .. } = *placed;
        rate / length - self.sigma * (rate * rate) * cotangent
    }
}

fn wide(x: f64, bits: i32) -> i64 {
    (x * f64::from(1u32 << 29) * f64::from(1u32 << (bits - 29).unsigned_abs())) as i64
}

/// The bucket's linkage, lengths in a unit that none of H + c, r and |I − P| exceeds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedFourBar<T> {
    rocker: FixedTriangle<T>,
    /// I − P
    pivot_from_pin: FixedVec,
    /// (|H| + c)², (|H| − c)² and |H|² − c²
    outer: Fixed,
    inner: Fixed,
    balance: Fixed,
    /// gain·conj(H)/2|H|²
    unwind: FixedVec,
    /// 2⁵⁴/gain
    per_square: T,
    /// H
    coupler_pin: FixedVec,
}

/// The bucket's joint at one length, away from its dead points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedFourBar<T> {
    /// θ4
    pub(crate) rotor: FixedVec,
    /// dθ4/dL, rad/m.
    pub(crate) rate: T,
    /// d²θ4/dL², rad/m².
    pub(crate) bend: T,
}

/// The smallest gain·|J − P|² whose reciprocal fits.
const SMALLEST_SQUARE: f64 = 1.0 / 64.0;

impl<T: Real> FixedFourBar<T> {
    /// As `FourBar::new`; `None` where the scaled numbers would not fit.
    pub(crate) fn new(g: &PinGeometry) -> Option<Self> {
        let b = g.bucket;
        let pin = Vec2::new(g.arm_m, 0.0);
        let (h, from_pin) = (b.coupler_pin.norm(), b.rocker_pivot - pin);
        let mut unit = h + b.coupler_m;
        for length in [b.rocker_m, from_pin.norm()] {
            unit = if length > unit { length } else { unit };
        }
        let (h, c) = (h / unit, b.coupler_m / unit);
        let gain = if h < 0.5 { 2.0 * h } else { 1.0 };
        let unwind = b.coupler_pin.conjugate().scale(gain / (2.0 * h * h * unit));
        let from_pin = from_pin.scale(1.0 / unit);
        let coupler_pin = b.coupler_pin.scale(1.0 / unit);
        let base = b.base - b.rocker_pivot;
        let moving = Vec2::new(b.rocker_m, 0.0);
        let made = Self {
            rocker: FixedTriangle::new(base, moving, Side::Clockwise, b.rocker_m / unit, b.stroke)?,
            pivot_from_pin: FixedVec::new(from_pin.x, from_pin.z)?,
            outer: Fixed::new((h + c) * (h + c))?,
            inner: Fixed::new((h - c) * (h - c))?,
            balance: Fixed::new(h * h - c * c)?,
            unwind: FixedVec::new(unwind.x, unwind.z)?,
            per_square: T::from_f64(f64::from(1u32 << 27) * f64::from(1u32 << 27) / gain),
            coupler_pin: FixedVec::new(coupler_pin.x, coupler_pin.z)?,
        };
        // |J − P| is shortest at an end of the stroke, or where the rocker points at the bucket pin.
        let shortest = (b.rocker_m / unit - from_pin.norm()).abs();
        let shortest = if shortest > (h - c).abs() { shortest } else { (h - c).abs() };
        (gain * shortest * shortest >= SMALLEST_SQUARE).then_some(made)
    }

    /// Cylinder length (m) inside its stroke → the bucket's joint; `None` at a dead point.
    ///
    /// With ψ the rocker's angle and q = dθ4/dψ, `dq/dψ = −(q²·p·j − 2q·p·s + s·k)/(j × p)` as in `FourBar::moment`.
    #[inline(always)]
    pub(crate) fn place(&self, length: T) -> Option<PlacedFourBar<T>> {
        let rocker = self.rocker.place(length)?;
        let s = rocker.vector;
        let j = self.pivot_from_pin.plus(s);
        let square = j.norm_squared();
        let root = self.outer.minus(square).times(square.minus(self.inner)).root::<T>()?;
        let turn = FixedVec { x: square.plus(self.balance), z: root.negated() };
        // 2|J − P|²·(K − P), then gain·|J − P|² times the rotor.
        let k = turn.complex_mul(j);
        let long = k.complex_mul(self.unwind);
        let square_steps = T::from_i32(square.0);
        let reciprocal = Fixed((self.per_square / square_steps).truncated_i32());
        let by = |x: Fixed| Fixed((x.times(reciprocal).0 >> 24) as i32);
        let rotor = FixedVec { x: by(long.x), z: by(long.z) };
        // |J − P|²·(K − I) × (J − I)
        let d = self.pivot_from_pin.scale(square);
        let sweep = FixedVec { x: k.x.half().minus(d.x), z: k.z.half().minus(d.z) }.cross(s);
        let root: T = root.to_real();
        let ratio = (T::from_i32(sweep.0) + T::from_i32(sweep.0)) / (square_steps * root);
        let p = rotor.complex_mul(self.coupler_pin);
        let (pj, ps): (T, T) = (p.dot(j).to_real(), p.dot(s).to_real());
        let sk: T = s.dot(p.minus(self.pivot_from_pin)).to_real();
        // The root is −2·j × p.
        let ratio_slope = (ratio * (ratio * pj - (ps + ps)) + sk) * T::from_i32(2) / root;
        let rate = rocker.rate * ratio;
        let curl = self.rocker.sigma * ratio * rocker.cotangent - ratio_slope;
        let bend = rate / length - rocker.rate * rocker.rate * curl;
        Some(PlacedFourBar { rotor, rate, bend })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(b: f64, stroke: Stroke) -> Option<FixedTriangle<f32>> {
        FixedTriangle::new(Vec2::new(1.0, 0.0), Vec2::new(b, 0.0), Side::CounterClockwise, 1.0, stroke)
    }

    #[test]
    fn a_triangle_out_of_range_is_none_and_not_an_overflow() {
        // The cylinder seven times √(2ab), and a seventieth of it.
        assert!(made(0.01, Stroke { min_m: 0.995, max_m: 1.005 }).is_none());
        assert!(made(1.0, Stroke { min_m: 0.02, max_m: 0.03 }).is_none());
        assert!(made(1.0, Stroke { min_m: 1.0, max_m: 1.9 }).is_some());
    }

    #[test]
    fn a_right_angle_comes_to_a_few_steps() {
        let triangle = made(1.0, Stroke { min_m: 1.0, max_m: 1.9 }).expect("in range");
        let length = 2.0f32.sqrt();
        let joint = triangle.place(length).expect("closes").vector;
        // cos α = 1 − L²/2, of the length as f32 has it.
        let cosine = 1.0 - f64::from(length) * f64::from(length) / 2.0;
        assert!((f64::from(joint.x.0) / f64::from(1u32 << 30) - cosine).abs() < 5e-9);
        assert!((f64::from(joint.z.0) / f64::from(1u32 << 30) - 1.0).abs() < 5e-9);
    }
}
