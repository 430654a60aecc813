//! Where a linear map of rates or forces has no inverse, by name.

use core::fmt;

use crate::Cylinder;

/// Why rates or forces cannot be turned back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Singular {
    /// The cylinder stands at a dead point of its linkage: its moment arm is zero, and it does not move its joint.
    DeadPoint {
        /// Which cylinder.
        cylinder: Cylinder,
    },
    /// Boom and arm are in line (θ3 = 0 or ±π): the bucket pin moves only across that line.
    ArmStretched,
    /// The tip stands on the swing axis: swing does not move it.
    TipOnSwingAxis,
    /// The payload's weight has no moment about the joints that would tell it.
    NoLever,
}

impl fmt::Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadPoint { cylinder } => write!(f, "the {cylinder} cylinder is at a dead point of its linkage"),
            Self::ArmStretched => f.write_str("boom and arm are in line"),
            Self::TipOnSwingAxis => f.write_str("the tip is on the swing axis"),
            Self::NoLever => f.write_str("the payload has no lever about boom pin and arm pin"),
        }
    }
}

impl core::error::Error for Singular {}
