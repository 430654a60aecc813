//! The three ways to give a pose, as typed.

use super::Failure;

/// One pose as it was given, in boom, arm, bucket order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Description {
    /// Cylinder lengths, m.
    Cylinders([f64; 3]),
    /// θ2, θ3, θ4, degrees.
    Joints([f64; 3]),
    /// Signed reach and height, m; pitch, degrees.
    Tip([f64; 3]),
}

/// Names of the three numbers, as CSV columns and messages call them.
pub const CYLINDER_COLUMNS: [&str; 3] = ["boom_m", "arm_m", "bucket_m"];
/// As [`CYLINDER_COLUMNS`].
pub const JOINT_COLUMNS: [&str; 3] = ["boom_deg", "arm_deg", "bucket_deg"];
/// As [`CYLINDER_COLUMNS`].
pub const TIP_COLUMNS: [&str; 3] = ["x_m", "z_m", "pitch_deg"];

impl Description {
    /// The numbers and their names.
    pub const fn named(&self) -> ([f64; 3], [&'static str; 3]) {
        match *self {
            Self::Cylinders(values) => (values, CYLINDER_COLUMNS),
            Self::Joints(values) => (values, JOINT_COLUMNS),
            Self::Tip(values) => (values, TIP_COLUMNS),
        }
    }

    /// Every number finite and every length at least 0, else which is not.
    pub(super) fn validate(&self) -> Result<(), Failure> {
        let (values, names) = self.named();
        for (value, name) in values.into_iter().zip(names) {
            finite(name, value)?;
            if matches!(self, Self::Cylinders(_)) && value < 0.0 {
                return Err(Failure::invalid_input(format!(
                    "`{name}` is a length and must be at least 0, not {value}"
                )));
            }
        }
        Ok(())
    }
}

/// An error that names the value unless it is finite.
pub(super) fn finite(name: &str, value: f64) -> Result<(), Failure> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(Failure::invalid_input(format!("`{name}` must be a finite number, not {value}")))
    }
}

/// One number of the command line.
pub(super) fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("`{}` is not a number", text.trim()))
}

/// Three numbers of the command line, separated by commas.
pub(super) fn triple(text: &str) -> Result<[f64; 3], String> {
    let mut values = Vec::with_capacity(3);
    for part in text.split(',') {
        values.push(number(part)?);
    }
    let count = values.len();
    values.try_into().map_err(|_| format!("three numbers separated by commas are needed, not {count}"))
}
