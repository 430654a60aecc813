//! The plane that boom and bucket hold while the operator moves the arm.

use serde::{Deserialize, Serialize};

use crate::parameters::Checks;

/// A plane as it cuts the boom's plane: a line through a point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GradeParameters {
    /// A point of it, reach, m.
    pub point_x_m: f64,
    /// The same point, height over the boom pin, m.
    pub point_z_m: f64,
    /// Its slope against level, rising outwards, degrees; against the machine where the chassis' slope is unknown.
    pub slope_deg: f64,
    /// Largest speed of the tip along it, m/s.
    pub speed_mps: f64,
    /// How far the tip may be from it when grading begins, m.
    pub tolerance_m: f64,
}

impl GradeParameters {
    /// Checks every value.
    #[inline(never)]
    pub(crate) fn check(&self, checks: &mut Checks) {
        checks.within("grade.point_x_m", self.point_x_m, &[-50.0, 50.0]);
        checks.within("grade.point_z_m", self.point_z_m, &[-50.0, 50.0]);
        checks.within("grade.slope_deg", self.slope_deg, &[-80.0, 80.0]);
        checks.within("grade.speed_mps", self.speed_mps, &[0.001, 3.0]);
        checks.within("grade.tolerance_m", self.tolerance_m, &[0.001, 1.0]);
    }
}
