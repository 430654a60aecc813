//! Everything a hydraulic plant is built from.

use kinematics_core::PinGeometry;

use super::digging::DiggingModel;
use super::function::FunctionModel;
use super::oil::Oil;
use super::pump::PumpModel;
use super::soil_factors::Soil;
use super::spool::SpoolModel;
use crate::machine_file::{Link, MachineFile};

/// A hydraulic machine. Every field may be changed before a plant is built; what is drawn is drawn by [`HydraulicModel::drawn`].
#[derive(Clone, Debug, PartialEq)]
pub struct HydraulicModel {
    /// Pins and strokes.
    pub geometry: PinGeometry,
    /// Boom, arm and empty bucket.
    pub links: [Link; 3],
    /// Of the upper structure about the swing axis, without the links, kg m².
    pub upper_inertia_kgm2: f64,
    /// Payload that stays in the bucket, kg.
    pub payload_kg: f64,
    /// The ground, where the bucket shall meet one.
    pub digging: Option<DiggingModel>,
    /// The oil.
    pub oil: Oil,
    /// Pressure of the return line, Pa above the atmosphere.
    pub return_pa: f64,
    /// The pump.
    pub pump: PumpModel,
    /// The spools' drive.
    pub spool: SpoolModel,
    /// Swing, boom, arm, bucket.
    pub functions: [FunctionModel; 4],
    /// Sub-steps of a control tick, 1…64.
    pub substeps: u32,
}

/// Sub-steps of a control tick that the figures of `docs/plant.md` are made with.
const SUBSTEPS: u32 = 5;

/// What a machine file lacks for a hydraulic plant.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("machine `{machine}` has no `{missing}`, which the hydraulic plant needs")]
pub struct ModelError {
    machine: String,
    missing: &'static str,
}

impl HydraulicModel {
    /// The machine as its file says, without payload and ground.
    ///
    /// # Errors
    /// The first table or field of the file that is missing.
    pub fn of(machine: &MachineFile) -> Result<Self, ModelError> {
        let lacks = |missing| ModelError { machine: machine.name.clone(), missing };
        let hydraulics = machine.hydraulics.as_ref().ok_or_else(|| lacks("[hydraulics]"))?;
        let dynamics = machine.dynamics.as_ref().ok_or_else(|| lacks("[dynamics]"))?;
        let upper_inertia_kgm2 = dynamics.upper_inertia_kgm2.ok_or_else(|| lacks("dynamics.upper_inertia_kgm2"))?;
        Ok(Self {
            geometry: machine.geometry,
            links: [dynamics.boom, dynamics.arm, dynamics.bucket],
            upper_inertia_kgm2,
            payload_kg: 0.0,
            digging: None,
            oil: hydraulics.oil,
            return_pa: hydraulics.return_pa,
            pump: hydraulics.pump,
            spool: hydraulics.spool,
            functions: hydraulics.functions,
            substeps: SUBSTEPS,
        })
    }

    /// The same machine before level ground of this soil.
    ///
    /// # Errors
    /// The first field of the file that is missing.
    pub fn digging(mut self, machine: &MachineFile, soil: Soil) -> Result<Self, ModelError> {
        let lacks = |missing| ModelError { machine: machine.name.clone(), missing };
        let dynamics = machine.dynamics.as_ref().ok_or_else(|| lacks("[dynamics]"))?;
        let back = machine.outline.bucket_back;
        self.digging = Some(DiggingModel {
            soil,
            ground_m: -machine.boom_pin_height_m,
            width_m: dynamics.bucket_width_m.ok_or_else(|| lacks("dynamics.bucket_width_m"))?,
            capacity_m3: dynamics.bucket_capacity_m3.ok_or_else(|| lacks("dynamics.bucket_capacity_m3"))?,
            plate_rad: libm::atan2(back.z, self.geometry.bucket_m - back.x),
        });
        Ok(self)
    }

    /// Steady speed of a function at a solenoid's current while the pump keeps its margin, m/s or rad/s: positive extending. What a
    /// calibration of the valve would find.
    pub fn steady_speed(&self, function: usize, current_a: f64) -> f64 {
        let place = (current_a / self.spool.full_scale_a).clamp(-1.0, 1.0);
        self.functions.get(function).map_or(0.0, |model| model.steady_speed(place))
    }
}
