//! `[plant]`: what the simulated machine is. Without `model` its actuators move at set speeds; with `model = "hydraulic"` they are the machine
//! file's cylinders, valve and pump.

use kinematics_core::geometry::Stroke;
use kinematics_core::{Machine, PinGeometry, Rotor};
use serde::Deserialize;

use super::check::within;
use crate::machine_file::MachineFile;
use crate::plant::ActuatorModel;
use crate::plant::hydraulic::{HydraulicModel, Soil};

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Plant {
    model: Option<Kind>,
    dead_time_s: Option<f64>,
    spool_lag_s: Option<f64>,
    dead_band_extend: Option<f64>,
    dead_band_retract: Option<f64>,
    swing_speed_rad_s: Option<f64>,
    boom_speed_mps: Option<f64>,
    arm_speed_mps: Option<f64>,
    bucket_speed_mps: Option<f64>,
    retract_speed_ratio: Option<f64>,
    payload_kg: Option<f64>,
    soil: Option<SoilName>,
    pub(super) coil_full_scale_a: f64,
    pub(super) coil_resistance_ohm: f64,
    pub(super) coil_inductance_h: f64,
    pub(super) supply_v: f64,
    pub(super) sensor_noise_m: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Speeds,
    Hydraulic,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SoilName {
    Sand,
    Loam,
    Clay,
}

impl SoilName {
    fn soil(self) -> Soil {
        match self {
            Self::Sand => Soil::SAND,
            Self::Loam => Soil::LOAM,
            Self::Clay => Soil::CLAY,
        }
    }
}

/// Swing, boom, arm, bucket as the controller may know them, and the hydraulic machine where there is one.
pub(super) struct Built {
    pub(super) actuators: [ActuatorModel; 4],
    pub(super) hydraulic: Option<HydraulicModel>,
}

impl Plant {
    fn is_hydraulic(&self) -> bool {
        self.model == Some(Kind::Hydraulic)
    }

    /// Fields of set speeds with their ranges.
    fn speeds(&self) -> [(&'static str, Option<f64>, [f64; 2]); 9] {
        let speed = [0.005, 4.0];
        [
            ("plant.dead_time_s", self.dead_time_s, [0.0, 1.0]),
            ("plant.spool_lag_s", self.spool_lag_s, [0.0, 1.0]),
            ("plant.dead_band_extend", self.dead_band_extend, [0.0, 0.9]),
            ("plant.dead_band_retract", self.dead_band_retract, [0.0, 0.9]),
            ("plant.swing_speed_rad_s", self.swing_speed_rad_s, speed),
            ("plant.boom_speed_mps", self.boom_speed_mps, speed),
            ("plant.arm_speed_mps", self.arm_speed_mps, speed),
            ("plant.bucket_speed_mps", self.bucket_speed_mps, speed),
            ("plant.retract_speed_ratio", self.retract_speed_ratio, [0.25, 1.25]),
        ]
    }

    /// Every number within its range; the fields of the other model left out.
    pub(super) fn check(&self) -> Result<(), String> {
        for (field, value, range) in self.speeds() {
            match value {
                Some(_) if self.is_hydraulic() => {
                    return Err(format!(
                        "`{field}` must be left out with `plant.model = \"hydraulic\"`: the machine file says it"
                    ));
                }
                Some(value) => within(&[(field, value, range)])?,
                None if self.is_hydraulic() => {}
                None => {
                    let name = field.trim_start_matches("plant.");
                    return Err(format!("`[plant]`: missing field `{name}`: every field of a table is required"));
                }
            }
        }
        if !self.is_hydraulic() && (self.payload_kg.is_some() || self.soil.is_some()) {
            return Err("`plant.payload_kg` and `plant.soil` go with `plant.model = \"hydraulic\"` alone".to_owned());
        }
        within(&[
            ("plant.payload_kg", self.payload_kg.unwrap_or(0.0), [0.0, 20e3]),
            ("plant.coil_inductance_h", self.coil_inductance_h, [0.005, 0.5]),
            ("plant.coil_full_scale_a", self.coil_full_scale_a, [0.05, 5.0]),
            ("plant.coil_resistance_ohm", self.coil_resistance_ohm, [0.5, 100.0]),
            ("plant.supply_v", self.supply_v, [0.0, 48.0]),
            ("plant.sensor_noise_m", self.sensor_noise_m, [0.0, 0.01]),
        ])
    }

    /// Swing, boom, arm, bucket.
    pub(super) fn build(&self, machine: &MachineFile, maps: &Machine<f64>) -> Result<Built, String> {
        if self.is_hydraulic() {
            let model = self.hydraulic(machine)?;
            let actuators = [0, 1, 2, 3].map(|i| nominal(&model, i));
            return Ok(Built { actuators, hydraulic: Some(model) });
        }
        Ok(Built { actuators: self.actuators(maps, &machine.geometry)?, hydraulic: None })
    }

    fn hydraulic(&self, machine: &MachineFile) -> Result<HydraulicModel, String> {
        let mut model = HydraulicModel::of(machine).map_err(|error| error.to_string())?;
        model.payload_kg = self.payload_kg.unwrap_or(0.0);
        model.spool.full_scale_a = self.coil_full_scale_a;
        match self.soil {
            Some(soil) => model.digging(machine, soil.soil()).map_err(|error| error.to_string()),
            None => Ok(model),
        }
    }

    /// Actuators at set speeds.
    fn actuators(&self, maps: &Machine<f64>, geometry: &PinGeometry) -> Result<[ActuatorModel; 4], String> {
        // As checked: none is missing.
        let [dead_time_s, spool_lag_s, extend, retract, swing, boom, arm, bucket, ratio] =
            self.speeds().map(|(_, value, _)| value.unwrap_or_default());
        let model = |stroke, speed: f64, ratio: f64| ActuatorModel {
            stroke,
            dead_time_s,
            spool_lag_s,
            dead_band: [extend, retract],
            full_speed: [speed, speed * ratio],
        };
        let swing = match (maps.swing_cylinder(), geometry.swing) {
            (Some(cylinder), Some(pins)) => {
                let ahead = cylinder.length(Rotor::IDENTITY).and_then(|length| cylinder.moment_arm(length));
                let moment_arm = ahead.map_err(|error| format!("`machine`: at zero swing: {error}"))?;
                model(Some(pins.stroke), swing * moment_arm.abs(), ratio)
            }
            // A motor is as fast either way.
            _ => model(None, swing, 1.0),
        };
        let cylinder = |stroke: Stroke, speed| model(Some(stroke), speed, ratio);
        Ok([
            swing,
            cylinder(geometry.boom.stroke, boom),
            cylinder(geometry.arm.stroke, arm),
            cylinder(geometry.bucket.stroke, bucket),
        ])
    }
}

/// What a calibration would say of a hydraulic function: dead time, the lag of its spool, dead bands, full speeds.
fn nominal(model: &HydraulicModel, function: usize) -> ActuatorModel {
    let full_a = model.spool.full_scale_a;
    let of = &model.functions[function];
    ActuatorModel {
        stroke: of.stroke,
        dead_time_s: model.spool.dead_time_s,
        // Critically damped: two lags of 1/ω.
        spool_lag_s: 2.0 / (core::f64::consts::TAU * model.spool.natural_hz),
        dead_band: of.dead_band,
        full_speed: [model.steady_speed(function, full_a), -model.steady_speed(function, -full_a)],
    }
}
