//! Why a pose has no answer: which cylinder, and by how much.

use core::fmt;

/// The cylinder a message speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cylinder {
    /// Swing cylinder of a backhoe.
    Swing,
    /// Boom cylinder.
    Boom,
    /// Arm (stick) cylinder.
    Arm,
    /// Bucket cylinder.
    Bucket,
}

impl Cylinder {
    /// The lower-case name used in files and messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Swing => "swing",
            Self::Boom => "boom",
            Self::Arm => "arm",
            Self::Bucket => "bucket",
        }
    }
}

impl fmt::Display for Cylinder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Why a map has no answer for an input. Nothing is ever clamped.
///
/// ```
/// use kinematics_core::{Cylinder, PoseError};
/// assert_eq!(Cylinder::Arm.name(), "arm");
/// let error = PoseError::OutOfStroke { cylinder: Cylinder::Arm, by: -0.25 };
/// assert_eq!(error.kind(), "out_of_stroke");
/// assert_eq!(error.to_string(), "the arm cylinder is -0.25 m below the minimum of its stroke");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PoseError<T> {
    /// The cylinder's length lies outside its stroke by `by` metres: positive beyond the maximum, negative below
    /// the minimum.
    OutOfStroke {
        /// Which cylinder.
        cylinder: Cylinder,
        /// Signed excess, m.
        by: T,
    },
    /// The bucket pin would lie `by` metres beyond the reach of boom and arm (positive), or inside the circle they
    /// cannot fold into (negative).
    Unreachable {
        /// Signed excess, m.
        by: T,
    },
    /// The cylinder's triangle or the bucket's four-bar does not close: its sides miss each other by `by` metres, or a
    /// joint's pin would lie `by` metres beyond its dead point.
    NoAssembly {
        /// Which cylinder's linkage.
        cylinder: Cylinder,
        /// How much longer the longest side is than the others reach, or how far the pin is beyond, m.
        by: T,
    },
}

impl<T> PoseError<T> {
    /// The kind as one word, as the command line's JSON names it.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::OutOfStroke { .. } => "out_of_stroke",
            Self::Unreachable { .. } => "unreachable",
            Self::NoAssembly { .. } => "no_assembly",
        }
    }
}

impl<T: fmt::Display + PartialOrd + Default> fmt::Display for PoseError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let zero = T::default();
        match self {
            Self::OutOfStroke { cylinder, by } => {
                let side = if *by < zero { "below the minimum" } else { "above the maximum" };
                write!(f, "the {cylinder} cylinder is {by:+} m {side} of its stroke")
            }
            Self::Unreachable { by } => {
                let side = if *by < zero { "inside the inner" } else { "beyond the outer" };
                write!(f, "the bucket pin is {by:+} m {side} limit of what boom and arm reach")
            }
            Self::NoAssembly { cylinder, by } => {
                write!(f, "the {cylinder} linkage does not close: it misses by {by} m")
            }
        }
    }
}

impl<T: fmt::Debug + fmt::Display + PartialOrd + Default> core::error::Error for PoseError<T> {}
