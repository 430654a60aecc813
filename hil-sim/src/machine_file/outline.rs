//! `[outline]`: what the pins do not tell of the linkage's outline. Every field may be left out; metres in every layout.

use kinematics_core::PinGeometry;
use kinematics_core::planning::outline::OutlineShape;
use serde::Deserialize;

use super::value::{Length, Number};

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutlineTable {
    boom_knee_x_m: Option<Number>,
    boom_knee_z_m: Option<Number>,
    bucket_back_x_m: Option<Number>,
    bucket_back_z_m: Option<Number>,
    boom_radius_m: Option<Length>,
    boom_half_width_m: Option<Length>,
    arm_radius_m: Option<Length>,
    arm_half_width_m: Option<Length>,
    cylinder_radius_m: Option<Length>,
    boom_cylinder_half_width_m: Option<Length>,
    link_radius_m: Option<Length>,
    link_half_width_m: Option<Length>,
    bucket_radius_m: Option<Length>,
    bucket_half_width_m: Option<Length>,
}

impl OutlineTable {
    /// The defaults of the machine's pins, with what the table states in their place.
    pub(super) fn shape(&self, geometry: &PinGeometry) -> OutlineShape {
        let mut shape = OutlineShape::of(geometry);
        let coordinate = |at: &mut f64, stated: Option<Number>| *at = stated.map_or(*at, |number| number.0);
        coordinate(&mut shape.boom_knee.x, self.boom_knee_x_m);
        coordinate(&mut shape.boom_knee.z, self.boom_knee_z_m);
        coordinate(&mut shape.bucket_back.x, self.bucket_back_x_m);
        coordinate(&mut shape.bucket_back.z, self.bucket_back_z_m);
        let length = |at: &mut f64, stated: Option<Length>| *at = stated.map_or(*at, |length| length.0);
        length(&mut shape.boom_radius_m, self.boom_radius_m);
        length(&mut shape.boom_half_width_m, self.boom_half_width_m);
        length(&mut shape.arm_radius_m, self.arm_radius_m);
        length(&mut shape.arm_half_width_m, self.arm_half_width_m);
        length(&mut shape.cylinder_radius_m, self.cylinder_radius_m);
        length(&mut shape.boom_cylinder_half_width_m, self.boom_cylinder_half_width_m);
        length(&mut shape.link_radius_m, self.link_radius_m);
        length(&mut shape.link_half_width_m, self.link_half_width_m);
        length(&mut shape.bucket_radius_m, self.bucket_radius_m);
        length(&mut shape.bucket_half_width_m, self.bucket_half_width_m);
        shape
    }
}
