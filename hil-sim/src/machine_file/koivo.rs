//! `kind = "distances"`, `labels = "koivo"`: the lengths and angles of Koivo 1994, Figures 1 and 2.

use kinematics_core::distances::KoivoDistances;
use kinematics_core::geometry::{GeometryError, PinGeometry, Stroke};
use serde::Deserialize;
use serde::de::IgnoredAny;

use super::dynamics::DynamicsTable;
use super::hydraulics::HydraulicsTable;
use super::outline::OutlineTable;
use super::value::{Length, Number};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KoivoFile {
    pub(super) name: String,
    pub(super) description: String,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "labels")]
    _labels: IgnoredAny,
    links: Links,
    distances: Distances,
    boom: Travel,
    arm: Travel,
    bucket: Travel,
    pub(super) dynamics: Option<DynamicsTable>,
    pub(super) hydraulics: Option<HydraulicsTable>,
    pub(super) outline: Option<OutlineTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Links {
    boom_pin_height_m: Number,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Travel {
    min_m: Length,
    max_m: Length,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Distances {
    a1_m: Number,
    a2_m: Length,
    a3_m: Length,
    a4_m: Length,
    l_ab_m: Length,
    l_ah_m: Number,
    l_he_m: Number,
    beta_deg: Number,
    l_ci_m: Length,
    l_fc_m: Length,
    gamma1_deg: Number,
    gamma2_deg: Number,
    l_jl_m: Length,
    l_kl_m: Length,
    nu1_deg: Number,
    l_ld_m: Length,
    l_kg_m: Length,
    l_gd_m: Length,
    nu2_deg: Number,
    nu3_deg: Number,
}

fn radians(degrees: &Number) -> f64 {
    // Whole turns taken off first, exactly: no angle is too large.
    (degrees.0 % 360.0).to_radians()
}

impl Travel {
    fn stroke(&self) -> Stroke {
        Stroke { min_m: self.min_m.0, max_m: self.max_m.0 }
    }
}

impl KoivoFile {
    /// Height of the boom pin above the ground, m.
    pub(super) fn boom_pin_height_m(&self) -> f64 {
        self.links.boom_pin_height_m.0
    }

    /// The pins the distances and angles determine.
    pub(super) fn geometry(&self) -> Result<PinGeometry, GeometryError> {
        let d = &self.distances;
        KoivoDistances {
            a1_m: d.a1_m.0,
            a2_m: d.a2_m.0,
            a3_m: d.a3_m.0,
            a4_m: d.a4_m.0,
            l_ab_m: d.l_ab_m.0,
            l_ah_m: d.l_ah_m.0,
            l_he_m: d.l_he_m.0,
            beta_rad: radians(&d.beta_deg),
            l_ci_m: d.l_ci_m.0,
            l_fc_m: d.l_fc_m.0,
            gamma1_rad: radians(&d.gamma1_deg),
            gamma2_rad: radians(&d.gamma2_deg),
            l_jl_m: d.l_jl_m.0,
            l_kl_m: d.l_kl_m.0,
            nu1_rad: radians(&d.nu1_deg),
            l_ld_m: d.l_ld_m.0,
            l_kg_m: d.l_kg_m.0,
            l_gd_m: d.l_gd_m.0,
            nu2_rad: radians(&d.nu2_deg),
            nu3_rad: radians(&d.nu3_deg),
            boom: self.boom.stroke(),
            arm: self.arm.stroke(),
            bucket: self.bucket.stroke(),
        }
        .to_pins()
    }
}
