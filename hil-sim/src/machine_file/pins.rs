//! `kind = "pins"`: every pin by its coordinates in the frame of its link.

use kinematics_core::Vec2;
use kinematics_core::geometry::{BoomCylinder, BucketPins, CylinderPins, PinGeometry, Stroke, SwingPins};
use serde::Deserialize;
use serde::de::IgnoredAny;

use super::dynamics::DynamicsTable;
use super::hydraulics::HydraulicsTable;
use super::outline::OutlineTable;
use super::value::{Length, Number};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PinsFile {
    pub(super) name: String,
    pub(super) description: String,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    boom_cylinder: Side,
    links: Links,
    boom: Cylinder,
    arm: Cylinder,
    bucket: Bucket,
    swing: Option<Swing>,
    pub(super) dynamics: Option<DynamicsTable>,
    pub(super) hydraulics: Option<HydraulicsTable>,
    pub(super) outline: Option<OutlineTable>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Side {
    Below,
    Above,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Links {
    boom_pin_x_m: Number,
    boom_pin_height_m: Number,
    boom_m: Length,
    arm_m: Length,
    bucket_m: Length,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cylinder {
    base_x_m: Number,
    base_z_m: Number,
    rod_x_m: Number,
    rod_z_m: Number,
    min_m: Length,
    max_m: Length,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Bucket {
    base_x_m: Number,
    base_z_m: Number,
    rocker_pivot_x_m: Number,
    rocker_pivot_z_m: Number,
    coupler_pin_x_m: Number,
    coupler_pin_z_m: Number,
    rocker_m: Length,
    coupler_m: Length,
    min_m: Length,
    max_m: Length,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Swing {
    base_x_m: Number,
    base_y_m: Number,
    rod_x_m: Number,
    rod_y_m: Number,
    min_m: Length,
    max_m: Length,
}

fn pin(x: &Number, z: &Number) -> Vec2<f64> {
    Vec2::new(x.0, z.0)
}

fn stroke(min: &Length, max: &Length) -> Stroke {
    Stroke { min_m: min.0, max_m: max.0 }
}

impl Cylinder {
    fn pins(&self) -> CylinderPins {
        CylinderPins {
            base: pin(&self.base_x_m, &self.base_z_m),
            rod: pin(&self.rod_x_m, &self.rod_z_m),
            stroke: stroke(&self.min_m, &self.max_m),
        }
    }
}

impl PinsFile {
    /// Height of the boom pin above the ground, m.
    pub(super) fn boom_pin_height_m(&self) -> f64 {
        self.links.boom_pin_height_m.0
    }

    /// The same numbers as the maps take them; not validated.
    pub(super) fn geometry(&self) -> PinGeometry {
        let b = &self.bucket;
        PinGeometry {
            boom_pin_x_m: self.links.boom_pin_x_m.0,
            boom_m: self.links.boom_m.0,
            arm_m: self.links.arm_m.0,
            bucket_m: self.links.bucket_m.0,
            boom_cylinder: match self.boom_cylinder {
                Side::Below => BoomCylinder::Below,
                Side::Above => BoomCylinder::Above,
            },
            boom: self.boom.pins(),
            arm: self.arm.pins(),
            bucket: BucketPins {
                base: pin(&b.base_x_m, &b.base_z_m),
                rocker_pivot: pin(&b.rocker_pivot_x_m, &b.rocker_pivot_z_m),
                coupler_pin: pin(&b.coupler_pin_x_m, &b.coupler_pin_z_m),
                rocker_m: b.rocker_m.0,
                coupler_m: b.coupler_m.0,
                stroke: stroke(&b.min_m, &b.max_m),
            },
            swing: self.swing.as_ref().map(|s| SwingPins {
                base: pin(&s.base_x_m, &s.base_y_m),
                rod: pin(&s.rod_x_m, &s.rod_y_m),
                stroke: stroke(&s.min_m, &s.max_m),
            }),
        }
    }
}
