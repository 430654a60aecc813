//! Second stage: lengths and swing → bucket pose, in closed form (`kinematics-core`).

use kinematics_core::{Machine, Pose, PoseError};

use crate::sensing::Sensed;

/// The bucket pose of what the sensors say.
///
/// # Errors
/// The cylinder out of its stroke or the linkage that does not close.
#[inline]
pub fn pose(machine: &Machine<f32>, sensed: &Sensed) -> Result<Pose<f32>, PoseError<f32>> {
    machine.cylinders_to_tip(&sensed.lengths, sensed.swing)
}
