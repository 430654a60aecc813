//! `[hydraulics]`: pump, oil, spools and the four functions of a hydraulic plant. The table may be absent; where it stands it is complete.

use kinematics_core::PinGeometry;
use kinematics_core::geometry::Stroke;
use serde::Deserialize;

use crate::plant::hydraulic::{
    Compensation, Cushion, Friction, FunctionModel, Oil, PumpModel, SpoolModel, conductance,
};
use crate::scenario::within;

/// Pump, oil, spools and functions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hydraulics {
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
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HydraulicsTable {
    oil_density_kgpm3: f64,
    bulk_modulus_mpa: f64,
    air_percent: f64,
    return_mpa: f64,
    pump_flow_lpm: f64,
    pump_power_kw: f64,
    pump_margin_mpa: f64,
    pump_lag_s: f64,
    sense_lag_s: f64,
    gallery_l: f64,
    supply_mpa: f64,
    compensation: CompensationTag,
    full_scale_a: f64,
    dead_time_s: f64,
    spool_hz: f64,
    hysteresis_percent: f64,
    swing: FunctionTable,
    boom: FunctionTable,
    arm: FunctionTable,
    bucket: FunctionTable,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum CompensationTag {
    Pre,
    Post,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FunctionTable {
    /// A cylinder has bore, rod and count; a swing motor its displacement with the gear.
    bore_m: Option<f64>,
    rod_m: Option<f64>,
    count: Option<u8>,
    motor_l_per_rad: Option<f64>,
    hose_l: f64,
    dead_band_extend_percent: f64,
    dead_band_retract_percent: f64,
    fine_percent: f64,
    extend_lpm: f64,
    retract_lpm: f64,
    extend_outlet_lpm_at_1mpa: f64,
    retract_outlet_lpm_at_1mpa: f64,
    port_relief_mpa: f64,
    piston_leak_lpm_at_10mpa: f64,
    spool_leak_lpm_at_10mpa: f64,
    coulomb_friction: f64,
    breakaway_friction: f64,
    stribeck_speed: f64,
    viscous_friction: f64,
    retract_cushion_m: f64,
    extend_cushion_m: f64,
    cushion_lpm_at_1mpa: f64,
}

const LPM: f64 = 1.0 / 60e3;
const MPA: f64 = 1e6;

impl HydraulicsTable {
    /// In SI, every number within its range; a swing cylinder where the pins have one, else a motor.
    pub(super) fn hydraulics(&self, pins: &PinGeometry) -> Result<Hydraulics, String> {
        within(&[
            ("hydraulics.oil_density_kgpm3", self.oil_density_kgpm3, [700.0, 1100.0]),
            ("hydraulics.bulk_modulus_mpa", self.bulk_modulus_mpa, [200.0, 2500.0]),
            ("hydraulics.air_percent", self.air_percent, [0.01, 10.0]),
            ("hydraulics.return_mpa", self.return_mpa, [0.0, 3.0]),
            ("hydraulics.pump_flow_lpm", self.pump_flow_lpm, [1.0, 2000.0]),
            ("hydraulics.pump_power_kw", self.pump_power_kw, [0.5, 1000.0]),
            ("hydraulics.pump_margin_mpa", self.pump_margin_mpa, [0.3, 5.0]),
            ("hydraulics.pump_lag_s", self.pump_lag_s, [0.005, 0.5]),
            ("hydraulics.sense_lag_s", self.sense_lag_s, [0.0, 0.2]),
            ("hydraulics.gallery_l", self.gallery_l, [0.1, 50.0]),
            ("hydraulics.supply_mpa", self.supply_mpa, [5.0, 45.0]),
            ("hydraulics.full_scale_a", self.full_scale_a, [0.05, 5.0]),
            ("hydraulics.dead_time_s", self.dead_time_s, [0.0, 0.5]),
            ("hydraulics.spool_hz", self.spool_hz, [1.0, 50.0]),
            ("hydraulics.hysteresis_percent", self.hysteresis_percent, [0.0, 20.0]),
        ])?;
        let cylinder = |name, table: &FunctionTable, stroke| table.function(name, Some(stroke));
        Ok(Hydraulics {
            oil: Oil {
                bulk_modulus_pa: self.bulk_modulus_mpa * MPA,
                air_fraction: self.air_percent * 0.01,
                density_kgpm3: self.oil_density_kgpm3,
            },
            return_pa: self.return_mpa * MPA,
            pump: PumpModel {
                flow_m3ps: self.pump_flow_lpm * LPM,
                power_w: self.pump_power_kw * 1e3,
                margin_pa: self.pump_margin_mpa * MPA,
                supply_pa: self.supply_mpa * MPA,
                lag_s: self.pump_lag_s,
                sense_lag_s: self.sense_lag_s,
                volume_m3: self.gallery_l * 1e-3,
                compensation: match self.compensation {
                    CompensationTag::Pre => Compensation::Pre,
                    CompensationTag::Post => Compensation::Post,
                },
            },
            spool: SpoolModel {
                full_scale_a: self.full_scale_a,
                dead_time_s: self.dead_time_s,
                natural_hz: self.spool_hz,
                hysteresis: self.hysteresis_percent * 0.01,
            },
            functions: [
                self.swing.function("swing", pins.swing.map(|swing| swing.stroke))?,
                cylinder("boom", &self.boom, pins.boom.stroke)?,
                cylinder("arm", &self.arm, pins.arm.stroke)?,
                cylinder("bucket", &self.bucket, pins.bucket.stroke)?,
            ],
        })
    }
}

impl FunctionTable {
    fn function(&self, name: &str, stroke: Option<Stroke>) -> Result<FunctionModel, String> {
        let check = |field: &str, value: f64, range| within(&[(&format!("hydraulics.{name}.{field}"), value, range)]);
        let longest = stroke.map_or(1.0, |stroke| stroke.max_m - stroke.min_m);
        let (percent, flow) = ([0.0, 60.0], [0.1, 2000.0]);
        for (field, value, range) in [
            ("hose_l", self.hose_l, [0.01, 50.0]),
            ("dead_band_extend_percent", self.dead_band_extend_percent, percent),
            ("dead_band_retract_percent", self.dead_band_retract_percent, percent),
            ("fine_percent", self.fine_percent, [0.0, 100.0]),
            ("extend_lpm", self.extend_lpm, flow),
            ("retract_lpm", self.retract_lpm, flow),
            ("extend_outlet_lpm_at_1mpa", self.extend_outlet_lpm_at_1mpa, flow),
            ("retract_outlet_lpm_at_1mpa", self.retract_outlet_lpm_at_1mpa, flow),
            ("port_relief_mpa", self.port_relief_mpa, [5.0, 50.0]),
            ("piston_leak_lpm_at_10mpa", self.piston_leak_lpm_at_10mpa, [0.0, 5.0]),
            ("spool_leak_lpm_at_10mpa", self.spool_leak_lpm_at_10mpa, [0.0, 5.0]),
            ("coulomb_friction", self.coulomb_friction, [0.0, 1e5]),
            ("breakaway_friction", self.breakaway_friction, [self.coulomb_friction, 2e5]),
            ("stribeck_speed", self.stribeck_speed, [1e-3, 1.0]),
            ("viscous_friction", self.viscous_friction, [0.0, 1e6]),
            ("retract_cushion_m", self.retract_cushion_m, [0.0, 0.5 * longest]),
            ("extend_cushion_m", self.extend_cushion_m, [0.0, 0.5 * longest]),
            ("cushion_lpm_at_1mpa", self.cushion_lpm_at_1mpa, [0.01, 500.0]),
        ] {
            check(field, value, range)?;
        }
        let gap = conductance(self.cushion_lpm_at_1mpa * LPM, MPA);
        let areas = self.areas(name, stroke.is_some(), check)?;
        // Made for its piston's side: at the same speed both ends brake with the same pressure.
        let cushion = |side: usize, length_m| Cushion { length_m, gap: gap * areas[side] / areas[0] };
        let outlet = |lpm: f64| conductance(lpm * LPM, MPA);
        let leak = |lpm: f64| lpm * LPM / (10.0 * MPA);
        Ok(FunctionModel {
            areas,
            stroke,
            dead_volume_m3: self.hose_l * 1e-3,
            dead_band: [self.dead_band_extend_percent, self.dead_band_retract_percent].map(|percent| percent * 0.01),
            fine: self.fine_percent * 0.01,
            meter_in_m3ps: [self.extend_lpm, self.retract_lpm].map(|lpm| lpm * LPM),
            meter_out: [self.extend_outlet_lpm_at_1mpa, self.retract_outlet_lpm_at_1mpa].map(outlet),
            port_relief_pa: self.port_relief_mpa * MPA,
            piston_leak: leak(self.piston_leak_lpm_at_10mpa),
            spool_leak: leak(self.spool_leak_lpm_at_10mpa),
            friction: Friction {
                coulomb: self.coulomb_friction,
                breakaway: self.breakaway_friction,
                stribeck_speed: self.stribeck_speed,
                viscous: self.viscous_friction,
            },
            cushions: [cushion(0, self.retract_cushion_m), cushion(1, self.extend_cushion_m)],
        })
    }

    fn areas(
        &self,
        name: &str,
        cylinder: bool,
        check: impl Fn(&str, f64, [f64; 2]) -> Result<(), String>,
    ) -> Result<[f64; 2], String> {
        match (cylinder, self.bore_m, self.rod_m, self.count, self.motor_l_per_rad) {
            (true, Some(bore), Some(rod), Some(count), None) => {
                check("bore_m", bore, [0.01, 0.5])?;
                check("rod_m", rod, [0.005, 0.95 * bore])?;
                check("count", f64::from(count), [1.0, 4.0])?;
                let disc = |d: f64| 0.25 * core::f64::consts::PI * d * d * f64::from(count);
                Ok([disc(bore), disc(bore) - disc(rod)])
            }
            (false, None, None, None, Some(litres)) => {
                check("motor_l_per_rad", litres, [0.001, 50.0])?;
                Ok([litres * 1e-3; 2])
            }
            (true, ..) => {
                Err(format!("`hydraulics.{name}`: a cylinder needs `bore_m`, `rod_m` and `count`, and no motor"))
            }
            (false, ..) => Err(format!(
                "`hydraulics.{name}`: without a swing cylinder it needs `motor_l_per_rad` alone of the four"
            )),
        }
    }
}
