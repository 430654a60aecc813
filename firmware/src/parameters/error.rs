//! What can be wrong with a parameter record, and the checks that say so.

use core::fmt;

use kinematics_core::GeometryError;
use kinematics_core::planning::avoid::AvoidError;

use crate::moves::MoveError;
use crate::path::PathViolation;
use crate::travel::Violation;

/// What is wrong with a parameter record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterError {
    /// The geometry, by field.
    Geometry(GeometryError),
    /// A value outside its range.
    OutOfRange {
        /// The field.
        field: &'static str,
        /// What it holds.
        value: f64,
        /// Lowest and highest allowed.
        range: [f64; 2],
    },
    /// Two values in the wrong order: the first must be below the second.
    Order {
        /// The field that must be smaller.
        below: &'static str,
        /// The field that must be larger.
        above: &'static str,
    },
    /// The swing sensor reads a cylinder, but the geometry has none.
    NoSwingCylinder,
    /// The dig leaves reach or stroke.
    Dig(Violation<f32>),
    /// The move has no plan.
    Move(MoveError),
    /// What planning past obstacles lacks.
    Avoid(AvoidError),
    /// The path leaves reach or stroke.
    Path(PathViolation),
}

impl From<GeometryError> for ParameterError {
    fn from(error: GeometryError) -> Self {
        Self::Geometry(error)
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Geometry(error) => error.fmt(f),
            Self::OutOfRange { field, value, range: [low, high] } => {
                write!(f, "`{field}` is {value} but must be within {low}…{high}")
            }
            Self::Order { below, above } => write!(f, "`{below}` must be below `{above}`"),
            Self::NoSwingCylinder => {
                f.write_str("`swing_sensor` reads a swing cylinder, but the geometry has no `swing` pins")
            }
            Self::Move(error) => write!(f, "`move`: {error}"),
            Self::Avoid(error) => write!(f, "`reach`: {error}"),
            Self::Path(PathViolation { segment, error }) => write!(f, "`path` on segment {segment}: {error}"),
            Self::Dig(Violation { time_s, error }) => write!(f, "`dig` at {time_s} s: {error}"),
        }
    }
}

impl core::error::Error for ParameterError {}

/// A value as it is stored.
pub(crate) trait Stored: Copy + Into<f64> {
    /// The end of a range, rounded as such a value is.
    fn rounded(end: f64) -> f64 {
        end
    }
}

impl Stored for f64 {}
impl Stored for u8 {}
impl Stored for u16 {}
impl Stored for u32 {}
impl Stored for f32 {
    fn rounded(end: f64) -> f64 {
        f64::from(end as f32)
    }
}

/// The ends are rounded as the value is: what somebody writes as the end lies within.
pub(crate) fn within<V: Stored>(field: &'static str, value: V, range: [f64; 2]) -> Result<(), ParameterError> {
    let ([low, high], value) = (range.map(V::rounded), value.into());
    // Written so that NaN fails.
    if value >= low && value <= high { Ok(()) } else { Err(ParameterError::OutOfRange { field, value, range }) }
}

pub(crate) fn ordered(below: (&'static str, f64), above: (&'static str, f64)) -> Result<(), ParameterError> {
    if below.1 < above.1 { Ok(()) } else { Err(ParameterError::Order { below: below.0, above: above.0 }) }
}

/// Checks values one after the other and keeps the first error. Nothing is returned between two checks: looking at every result would take
/// more of the flash than the checks themselves.
pub(crate) struct Checks(Result<(), ParameterError>);

impl Checks {
    pub(crate) const fn new() -> Self {
        Self(Ok(()))
    }

    /// Whether all were in order, or the first that was not.
    pub(crate) const fn done(self) -> Result<(), ParameterError> {
        self.0
    }

    /// A value in its range.
    #[inline(never)]
    pub(crate) fn within<V: Stored>(&mut self, field: &'static str, value: V, range: &[f64; 2]) {
        self.and(within(field, value, *range));
    }

    /// The value of the first field below that of the second.
    #[inline(never)]
    pub(crate) fn ordered(&mut self, [below, above]: &[&'static str; 2], [low, high]: [f64; 2]) {
        self.and(ordered((*below, low), (*above, high)));
    }

    /// Another check.
    pub(crate) fn and(&mut self, checked: Result<(), ParameterError>) {
        if self.0.is_ok() {
            self.0 = checked;
        }
    }
}
