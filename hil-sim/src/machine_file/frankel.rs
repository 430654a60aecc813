//! `kind = "distances"`, `labels = "frankel"`: the names of Frankel 2003 `dimensions.m`, in inches.

use kinematics_core::distances::FrankelDistances;
use kinematics_core::geometry::{GeometryError, PinGeometry, Stroke};
use serde::Deserialize;
use serde::de::IgnoredAny;

use super::dynamics::DynamicsTable;
use super::hydraulics::HydraulicsTable;
use super::outline::OutlineTable;
use super::value::{Length, Number};

/// One inch in metres, exactly.
pub(super) const INCH_M: f64 = 0.0254;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FrankelFile {
    pub(super) name: String,
    pub(super) description: String,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "labels")]
    _labels: IgnoredAny,
    links: Links,
    distances: Distances,
    swing: Travel,
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
    boom_pin_height_in: Number,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Travel {
    min_in: Length,
    max_in: Length,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Distances {
    r01_in: Length,
    r0n_in: Length,
    ran_in: Length,
    rjm_in: Length,
    r0m_in: Length,
    r0k_in: Length,
    r1c_in: Length,
    r12_in: Length,
    r2c_in: Length,
    r1b_in: Length,
    r2b_in: Length,
    r2d_in: Length,
    rde_in: Length,
    r23_in: Length,
    r3d_in: Length,
    ref_in: Length,
    r3f_in: Length,
    r34_in: Length,
    r3g_in: Length,
    r4g_in: Length,
    rfh_in: Length,
    rgh_in: Length,
}

fn metres(length: &Length) -> f64 {
    length.0 * INCH_M
}

impl Travel {
    fn stroke(&self) -> Stroke {
        Stroke { min_m: metres(&self.min_in), max_m: metres(&self.max_in) }
    }
}

impl FrankelFile {
    /// Height of the boom pin above the ground, m.
    pub(super) fn boom_pin_height_m(&self) -> f64 {
        self.links.boom_pin_height_in.0 * INCH_M
    }

    /// The pins the distances determine.
    pub(super) fn geometry(&self) -> Result<PinGeometry, GeometryError> {
        let d = &self.distances;
        FrankelDistances {
            r01_m: metres(&d.r01_in),
            r0n_m: metres(&d.r0n_in),
            ran_m: metres(&d.ran_in),
            rjm_m: metres(&d.rjm_in),
            r0m_m: metres(&d.r0m_in),
            r0k_m: metres(&d.r0k_in),
            r1c_m: metres(&d.r1c_in),
            r12_m: metres(&d.r12_in),
            r2c_m: metres(&d.r2c_in),
            r1b_m: metres(&d.r1b_in),
            r2b_m: metres(&d.r2b_in),
            r2d_m: metres(&d.r2d_in),
            rde_m: metres(&d.rde_in),
            r23_m: metres(&d.r23_in),
            r3d_m: metres(&d.r3d_in),
            ref_m: metres(&d.ref_in),
            r3f_m: metres(&d.r3f_in),
            r34_m: metres(&d.r34_in),
            r3g_m: metres(&d.r3g_in),
            r4g_m: metres(&d.r4g_in),
            rfh_m: metres(&d.rfh_in),
            rgh_m: metres(&d.rgh_in),
            swing: self.swing.stroke(),
            boom: self.boom.stroke(),
            arm: self.arm.stroke(),
            bucket: self.bucket.stroke(),
        }
        .to_pins()
    }
}
