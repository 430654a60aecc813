//! Whether a cylinder's length lies in its stroke, and by how much not.

use crate::geometry::Stroke;
use crate::{Cylinder, PoseError, Real};

/// A length this close outside an end of the stroke counts as inside, m: a micrometre, and a picometre for the rounding of decimals.
pub const STROKE_TOLERANCE_M: f64 = 1e-6 + 1e-12;

/// The stroke in T, widened by the tolerance; the ends themselves for the excess.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StrokeCheck<T> {
    lowest: T,
    highest: T,
    min: T,
    max: T,
}

impl<T: Real> StrokeCheck<T> {
    pub(crate) fn new(stroke: Stroke) -> Self {
        Self {
            lowest: T::from_f64(stroke.min_m - STROKE_TOLERANCE_M),
            highest: T::from_f64(stroke.max_m + STROKE_TOLERANCE_M),
            min: T::from_f64(stroke.min_m),
            max: T::from_f64(stroke.max_m),
        }
    }

    /// Whether the length lies in the stroke, tolerance included; false for what is not a number.
    #[inline(always)]
    pub(crate) fn contains(&self, length: T) -> bool {
        length >= self.lowest && length <= self.highest
    }

    #[inline(always)]
    pub(crate) fn check(&self, cylinder: Cylinder, length: T) -> Result<(), PoseError<T>> {
        if self.contains(length) { Ok(()) } else { Err(self.excess(cylinder, length)) }
    }

    /// The error for a length outside.
    #[cold]
    pub(crate) fn excess(&self, cylinder: Cylinder, length: T) -> PoseError<T> {
        let by = if length > self.max { length - self.max } else { length - self.min };
        PoseError::OutOfStroke { cylinder, by }
    }
}
