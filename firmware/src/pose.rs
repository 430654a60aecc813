//! Second stage: lengths and swing → bucket pose, in closed form (`kinematics-core`).

use kinematics_core::{Cylinders, GeometryError, Machine, PinGeometry, PlaneTip, Pose, PoseError, Real};

use crate::sensing::Sensed;

/// The maps of a geometry; nothing here asks those in fixed point. Not inlined, so that an image holds their making once: it is generic and would be compiled with every caller.
///
/// # Errors
/// The first problem of the geometry, named by its field.
#[inline(never)]
pub(crate) fn maps(geometry: &PinGeometry) -> Result<Machine<f32>, GeometryError> {
    Machine::without_fine_maps(geometry)
}

/// The bucket pose of what the sensors say.
///
/// # Errors
/// The cylinder out of its stroke or the linkage that does not close.
#[inline]
pub fn pose(machine: &Machine<f32>, sensed: &Sensed) -> Result<Pose<f32>, PoseError<f32>> {
    machine.cylinders_to_tip(&sensed.lengths, sensed.swing)
}

/// The cylinders for a tip where not every tick asks. Not inlined, so that an image holds it once.
///
/// # Errors
/// As [`Machine::tip_to_cylinders`].
#[inline(never)]
pub(crate) fn cylinders_once<T: Real>(machine: &Machine<T>, tip: &PlaneTip<T>) -> Result<Cylinders<T>, PoseError<T>> {
    machine.tip_to_cylinders(tip)
}
