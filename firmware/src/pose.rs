//! Second stage: lengths and swing → bucket pose, in closed form (`kinematics-core`).

use kinematics_core::{GeometryError, Machine, PinGeometry, Pose, PoseError};

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
