//! What cylinders and pump can do, by the limits a move keeps to.

use core::fmt;

use crate::planning::cylinder_path::Extremes;
use crate::{Cylinders, Real};

/// Limits of boom, arm and bucket; where there are two, \[extending, retracting\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveLimits {
    /// Largest speeds, m/s.
    pub speed_mps: [[f64; 2]; 3],
    /// Largest accelerations, m/s².
    pub acceleration_mps2: [f64; 3],
    /// Largest jerks, m/s³.
    pub jerk_mps3: [f64; 3],
    /// Areas the pump fills, m²; 0 where it fills none.
    pub areas_m2: [[f64; 2]; 3],
    /// What the pump gives to all of them together, m³/s.
    pub flow_m3ps: f64,
}

/// A limit out of its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LimitError {
    /// The field.
    pub field: &'static str,
}

impl fmt::Display for LimitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let range = if self.field == "areas_m2" { "0…10" } else { "1e-6…1e6" };
        write!(f, "`{}` must be within {range}", self.field)
    }
}

impl core::error::Error for LimitError {}

/// Validated limits in T.
///
/// ```
/// use kinematics_core::Cylinders;
/// use kinematics_core::planning::move_limits::{Limits, MoveLimits};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let limits = MoveLimits {
///     speed_mps: [[0.3, 0.4], [0.5, 0.5], [0.5, 0.5]],
///     acceleration_mps2: [1.0; 3],
///     jerk_mps3: [10.0; 3],
///     areas_m2: [[0.02, 0.01]; 3],
///     flow_m3ps: 0.008,
/// };
/// let checked = Limits::<f64>::new(&limits)?;
/// let from = Cylinders { boom: 2.0, arm: 2.0, bucket: 2.0 };
/// // The boom's own speed would do in a second; with the arm along, the pump needs more than that.
/// let alone = Cylinders { boom: 2.3, ..from };
/// assert!((checked.shortest_time(&from, &alone) - 1.0).abs() < 1e-12);
/// let both = Cylinders { arm: 2.3, ..alone };
/// assert!((checked.shortest_time(&from, &both) - 1.5).abs() < 1e-12);
/// assert_eq!(Limits::<f64>::new(&MoveLimits { flow_m3ps: 0.0, ..limits }).unwrap_err().field, "flow_m3ps");
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<T> {
    pub(crate) speed: [[T; 2]; 3],
    pub(crate) acceleration: [T; 3],
    pub(crate) jerk: [T; 3],
    pub(crate) areas: [[T; 2]; 3],
    pub(crate) flow: T,
}

impl<T: Real> Limits<T> {
    /// Checks every limit.
    ///
    /// # Errors
    /// The first out of its range, by name.
    pub fn new(limits: &MoveLimits) -> Result<Self, LimitError> {
        let usable = |x: &f64| *x >= 1e-6 && *x <= 1e6;
        let refuse = |fine: bool, field| if fine { Ok(()) } else { Err(LimitError { field }) };
        refuse(limits.speed_mps.iter().flatten().all(usable), "speed_mps")?;
        refuse(limits.acceleration_mps2.iter().all(usable), "acceleration_mps2")?;
        refuse(limits.jerk_mps3.iter().all(usable), "jerk_mps3")?;
        refuse(limits.areas_m2.iter().flatten().all(|x| *x >= 0.0 && *x <= 10.0), "areas_m2")?;
        refuse(usable(&limits.flow_m3ps), "flow_m3ps")?;
        Ok(Self {
            speed: limits.speed_mps.map(|pair| pair.map(T::from_f64)),
            acceleration: limits.acceleration_mps2.map(T::from_f64),
            jerk: limits.jerk_mps3.map(T::from_f64),
            areas: limits.areas_m2.map(|pair| pair.map(T::from_f64)),
            flow: T::from_f64(limits.flow_m3ps),
        })
    }

    /// The shortest time between two configurations with speeds and flow at their limits, accelerations left aside, s; no number where a length is
    /// none.
    pub fn shortest_time(&self, from: &Cylinders<T>, to: &Cylinders<T>) -> T {
        let by = [to.boom - from.boom, to.arm - from.arm, to.bucket - from.bucket];
        let [mut longest, mut volume] = [T::ZERO; 2];
        for ((&by, [extend, retract]), [out, back]) in by.iter().zip(self.speed).zip(self.areas) {
            let (time, filled) = if by > T::ZERO { (by / extend, out * by) } else { (-by / retract, back * -by) };
            longest = larger(longest, time);
            volume = volume + filled;
        }
        // In this order what is no number stays none: each length counts in the volume, and `longest` leaves such a one out.
        larger(volume / self.flow, longest)
    }

    /// The largest rate ṡ at which speeds and flow keep to their limits with these slopes dL/ds; `None` where none moves.
    pub(crate) fn rate(&self, extremes: &Extremes<T>) -> Option<T> {
        // The reciprocal of the rate, so that a cylinder at rest limits nothing.
        let [mut least, mut flow] = [T::ZERO; 2];
        for (([low, high], [extend, retract]), [out, back]) in extremes.slope.iter().zip(self.speed).zip(self.areas) {
            least = larger(least, larger(*high / extend, -*low / retract));
            flow = flow + larger(T::ZERO, larger(out * *high, -(back * *low)));
        }
        least = larger(least, flow / self.flow);
        (least > T::ZERO).then(|| T::ONE / least)
    }
}

/// The larger of two, by comparison.
pub(crate) fn larger<T: Real>(a: T, b: T) -> T {
    if b > a { b } else { a }
}
