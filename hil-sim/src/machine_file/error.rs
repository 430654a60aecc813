//! What can be wrong with a machine file; every message names the file, the field and what is allowed.

use std::io;
use std::path::PathBuf;

use kinematics_core::geometry::{GeometryError, Problem};

use super::frankel::INCH_M;

/// Why a machine could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum MachineFileError {
    /// No machine of that name, and no such file.
    #[error("there is no machine `{name}`; available: {}; or give the path of a machine file", .available.join(", "))]
    Unknown {
        /// What was asked for.
        name: String,
        /// The machines found, sorted.
        available: Vec<String>,
    },
    /// The file could not be read.
    #[error("{}: {source}", .file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file's text is not a machine.
    #[error("{file}{}: {what}", .line.map(|n| format!(", line {n}")).unwrap_or_default())]
    Invalid {
        /// The file.
        file: String,
        /// Where in it, where that is known; from 1.
        line: Option<usize>,
        /// Field and fault, with what is allowed.
        what: String,
    },
}

/// How a file names and measures what the geometry's errors speak of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// Metres, the geometry's own names.
    Pins,
    /// Inches: `distances.r01_in`.
    Frankel,
    /// Metres and degrees.
    Koivo,
}

impl Layout {
    /// The geometry's field as it stands in the file, or the fields from which it follows.
    fn field(self, field: &'static str) -> String {
        let in_file = field.starts_with("distances.") || field.ends_with(".min_m") || field.ends_with(".max_m");
        match self {
            Self::Pins => field.to_owned(),
            Self::Frankel if in_file => {
                field.strip_suffix("_m").map_or_else(|| field.to_owned(), |f| format!("{f}_in"))
            }
            Self::Koivo if in_file => field.to_owned(),
            Self::Koivo if field.starts_with("boom.base") => "distances.l_ah_m, distances.l_he_m".to_owned(),
            Self::Frankel | Self::Koivo => format!("distances (for {field})"),
        }
    }

    /// A length in the file's unit.
    fn length(self, metres: f64) -> String {
        // Nine digits hide the rounding of inches to metres and back.
        let short = |x: f64| if x.abs() < 1e6 { (x * 1e9).round() / 1e9 } else { x };
        match self {
            Self::Frankel => format!("{} in", short(metres / INCH_M)),
            Self::Pins | Self::Koivo => format!("{} m", short(metres)),
        }
    }

    /// The error in the file's own names and units.
    pub(super) fn explain(self, error: &GeometryError) -> String {
        let field = self.field(error.field);
        let fault = match error.problem {
            Problem::NotFinite => "must be a finite number".to_owned(),
            // Every length in the file has been checked by its type, so what is not positive is a difference.
            Problem::NotPositive(_) if self == Self::Frankel && error.field == "distances.r3f_m" => {
                "must be below `distances.r3d_in`: F lies between the pins 3 and D".to_owned()
            }
            Problem::TooLarge(x) => {
                format!("must be within {}…{}, not {}", self.length(-1e3), self.length(1e3), self.length(x))
            }
            Problem::NotPositive(x) => format!("must be a length above 0, not {}", self.length(x)),
            Problem::MinNotBelowMax { min_m, max_m } => format!(
                "the stroke's minimum, {}, must be below its maximum, {}",
                self.length(min_m),
                self.length(max_m)
            ),
            Problem::PinsCoincide => "the pin coincides with its joint's; the two must stand apart".to_owned(),
            Problem::DoesNotClose { length_m } => format!(
                "the linkage does not close at a cylinder length of {}; it must close over the whole stroke",
                self.length(length_m)
            ),
            Problem::Folds { length_m } => format!(
                "the linkage folds (dead point) at a cylinder length of {}; it must not within the stroke",
                self.length(length_m)
            ),
            Problem::ArmStretches { length_m } => format!(
                "boom and arm are in line at a cylinder length of {}; the arm must stay curled \
                 (−180° < θ3 < 0°) over the whole stroke",
                self.length(length_m)
            ),
            Problem::NoTriangle => "this distance and the two beside it in its triangle must form one".to_owned(),
            Problem::Inconsistent(by) => format!("disagrees with the other distances by {}", self.length(by)),
        };
        format!("`{field}`: {fault}")
    }
}
