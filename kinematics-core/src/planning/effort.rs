//! What a move costs: weighted cylinder travel, or the energy a pump puts into it.
//!
//! Both are J = Σᵢ ∫ wᵢ(sign L̇ᵢ)·|L̇ᵢ| dt over boom, arm and bucket, a cost per metre of each direction of each cylinder:
//! - **travel**: wᵢ is a plain weight, the same both ways; J in metres;
//! - **pump energy**: ∫ p·Σᵢ Aᵢ|L̇ᵢ| dt, wᵢ = p·Aᵢ with the piston's whole area extending and its ring area retracting; J in
//!   joules. The pump pressure p is one number for the whole move, that of the heaviest load plus the margin of a load-sensing
//!   pump: all cylinders draw at it and throttle what they do not need. A direction that gravity drives and the
//!   machine fills by regeneration counts by its `pump_share`: 1 where the pump fills it, 0 where none of the flow is the pump's.
//!
//! J depends on the path, not on the time it takes. Between two configurations it cannot be below that of the straight line in
//! cylinder space, and every path on which no cylinder turns back attains that.

use core::fmt;

use crate::{Cylinders, Real};

/// Piston areas of the cylinders on one joint together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piston {
    /// Bore, m.
    pub bore_m: f64,
    /// Rod diameter, m; less than the bore.
    pub rod_m: f64,
    /// How many cylinders work together.
    pub count: u8,
}

impl Piston {
    /// Areas (m²) that \[extending, retracting\] fills.
    ///
    /// ```
    /// use kinematics_core::planning::effort::Piston;
    /// let [extend, retract] = Piston { bore_m: 0.12, rod_m: 0.085, count: 2 }.areas_m2();
    /// assert!((extend - 0.02262).abs() < 1e-5 && (retract - 0.01127).abs() < 1e-5);
    /// ```
    pub fn areas_m2(&self) -> [f64; 2] {
        let whole = self.bore_m * self.bore_m;
        let quarter = core::f64::consts::FRAC_PI_4 * f64::from(self.count);
        [quarter * whole, quarter * (whole - self.rod_m * self.rod_m)]
    }
}

/// What the pump's energy depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PumpEnergy {
    /// Pump pressure over the move, Pa.
    pub pressure_pa: f64,
    /// Areas (m²) of boom, arm, bucket, each \[extending, retracting\].
    pub areas_m2: [[f64; 2]; 3],
    /// The pump's share in filling each, 0 to 1.
    pub pump_share: [[f64; 2]; 3],
}

/// A cost per metre that is negative or not finite, or none above zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EffortError;

impl fmt::Display for EffortError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("every cylinder's cost per metre must be finite and at least 0, and one of them above 0")
    }
}

impl core::error::Error for EffortError {}

/// A cost per metre of every cylinder, extending and retracting.
///
/// ```
/// use kinematics_core::Cylinders;
/// use kinematics_core::planning::effort::{Effort, PumpEnergy};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let from = Cylinders { boom: 2.0, arm: 2.0, bucket: 2.0 };
/// let to = Cylinders { boom: 2.5, arm: 1.5, bucket: 2.0 };
/// let travel = Effort::<f64>::travel([1.0, 1.0, 0.5])?;
/// assert_eq!((travel.between(&from, &to), travel.between(&to, &from)), (1.0, 1.0));
/// // 10 MPa through 0.02 m² out, 0.01 m² back; lowering the boom fills itself.
/// let pump = Effort::<f64>::pump_energy(&PumpEnergy {
///     pressure_pa: 1e7,
///     areas_m2: [[0.02, 0.01]; 3],
///     pump_share: [[1.0, 0.0], [1.0, 1.0], [1.0, 1.0]],
/// })?;
/// assert_eq!((pump.between(&from, &to), pump.between(&to, &from)), (150e3, 100e3));
/// assert_eq!(pump.per_metre()[1], [2e5, 1e5]);
/// assert!(Effort::<f32>::travel([1.0, -1.0, 1.0]).is_err());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort<T> {
    per_metre: [[T; 2]; 3],
}

impl<T: Real> Effort<T> {
    /// Σ wᵢ·|ΔLᵢ|.
    ///
    /// # Errors
    /// [`EffortError`].
    pub fn travel(weights: [f64; 3]) -> Result<Self, EffortError> {
        Self::new(weights.map(|w| [w; 2]))
    }

    /// ∫ p·Σ Aᵢ·|L̇ᵢ| dt.
    ///
    /// # Errors
    /// [`EffortError`].
    pub fn pump_energy(pump: &PumpEnergy) -> Result<Self, EffortError> {
        let mut per_metre = pump.areas_m2;
        for (cost, share) in per_metre.iter_mut().flatten().zip(pump.pump_share.iter().flatten()) {
            *cost *= pump.pressure_pa * share;
        }
        Self::new(per_metre)
    }

    fn new(per_metre: [[f64; 2]; 3]) -> Result<Self, EffortError> {
        let usable = |cost: &f64| *cost >= 0.0 && cost.is_finite();
        let mut costs = per_metre.iter().flatten();
        if !(costs.clone().all(usable) && costs.any(|cost| *cost > 0.0)) {
            return Err(EffortError);
        }
        Ok(Self { per_metre: per_metre.map(|cost| cost.map(T::from_f64)) })
    }

    /// Boom, arm, bucket, each \[extending, retracting\], per metre.
    pub fn per_metre(&self) -> [[T; 2]; 3] {
        self.per_metre
    }

    /// The cost of going straight from one configuration to another.
    #[inline(always)]
    pub fn between(&self, from: &Cylinders<T>, to: &Cylinders<T>) -> T {
        let [boom, arm, bucket] = self.shares(from, to);
        boom + (arm + bucket)
    }

    /// Each cylinder's part of [`Effort::between`].
    #[inline(always)]
    pub(crate) fn shares(&self, from: &Cylinders<T>, to: &Cylinders<T>) -> [T; 3] {
        let part = |[extend, retract]: [T; 2], by: T| if by > T::ZERO { extend * by } else { retract * -by };
        let [boom, arm, bucket] = self.per_metre;
        [part(boom, to.boom - from.boom), part(arm, to.arm - from.arm), part(bucket, to.bucket - from.bucket)]
    }

    /// The cost along a row of configurations.
    ///
    /// ```
    /// # use kinematics_core::Cylinders;
    /// # use kinematics_core::planning::effort::Effort;
    /// let travel = Effort::<f64>::travel([1.0; 3]).unwrap();
    /// let at = |boom| Cylinders { boom, arm: 1.0, bucket: 1.0 };
    /// assert_eq!(travel.along(&[at(1.0), at(1.5), at(1.25)]), 0.75);
    /// ```
    pub fn along(&self, row: &[Cylinders<T>]) -> T {
        let pairs = row.iter().zip(row.iter().skip(1));
        pairs.fold(T::ZERO, |sum, (from, to)| sum + self.between(from, to))
    }
}

#[cfg(test)]
mod tests {
    use super::Piston;

    #[test]
    fn two_cylinders_take_twice_the_oil_of_one_and_the_rod_takes_its_area_away() {
        let areas = |count| Piston { bore_m: 2.0, rod_m: 1.0, count }.areas_m2();
        assert_eq!(areas(1), [core::f64::consts::PI, 0.75 * core::f64::consts::PI]);
        assert_eq!(areas(2), areas(1).map(|area| 2.0 * area));
    }
}
