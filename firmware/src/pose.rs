//! Second stage: lengths and swing → bucket pose, in closed form (`kinematics-core`).

use kinematics_core::{Cylinders, GeometryError, Machine, PinGeometry, PlaneTip, Pose, PoseError, Real};

use crate::fault::Fault;
use crate::sensing::Sensed;

/// The maps of a geometry; nothing here asks those in fixed point. Not inlined, so that an image holds their making once: it is generic and
/// would be compiled with every caller.
///
/// # Errors
/// The first problem of the geometry, named by its field.
#[inline(never)]
pub(crate) fn maps(geometry: &PinGeometry) -> Result<Machine<f32>, GeometryError> {
    Machine::without_fine_maps(geometry)
}

/// The bucket pose of what the sensors say, found where it shall lie; what was there stays where there is none.
///
/// # Errors
/// [`Fault::Geometry`]: a cylinder out of its stroke or a linkage that does not close.
#[inline]
pub(crate) fn find_pose(machine: &Machine<f32>, sensed: &Sensed, pose: &mut Pose<f32>) -> Result<(), Fault> {
    *pose = machine.cylinders_to_tip(&sensed.lengths, sensed.swing).map_err(|_| Fault::Geometry)?;
    Ok(())
}

/// The cylinders for a tip where not every tick asks. Not inlined, so that an image holds it once.
///
/// # Errors
/// As [`Machine::tip_to_cylinders`].
#[inline(never)]
pub(crate) fn cylinders_once<T: Real>(machine: &Machine<T>, tip: &PlaneTip<T>) -> Result<Cylinders<T>, PoseError<T>> {
    machine.tip_to_cylinders(tip)
}
