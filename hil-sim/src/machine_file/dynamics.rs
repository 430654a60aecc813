//! `[dynamics]`: masses, centres of mass and inertias. The table may be absent; where it stands it is complete, but for what only the
//! hydraulic plant asks.

use kinematics_core::Vec2;
use serde::Deserialize;

use super::value::{Length, Number};

/// A rigid link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass in the link's own frame, m.
    pub centre: Vec2<f64>,
    /// Moment of inertia about the centre of mass, kg m².
    pub inertia_kgm2: f64,
}

/// Boom, arm and bucket (empty) as rigid links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics {
    /// The boom.
    pub boom: Link,
    /// The arm.
    pub arm: Link,
    /// The empty bucket.
    pub bucket: Link,
    /// Of the upper structure about the swing axis, without the links, kg m²; for the hydraulic plant.
    pub upper_inertia_kgm2: Option<f64>,
    /// Width of the bucket, m; for digging.
    pub bucket_width_m: Option<f64>,
    /// What it holds, m³; for digging.
    pub bucket_capacity_m3: Option<f64>,
}

/// Masses and inertias are above 0 as lengths are.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DynamicsTable {
    boom_mass_kg: Length,
    boom_centre_x_m: Number,
    boom_centre_z_m: Number,
    boom_inertia_kgm2: Length,
    arm_mass_kg: Length,
    arm_centre_x_m: Number,
    arm_centre_z_m: Number,
    arm_inertia_kgm2: Length,
    bucket_mass_kg: Length,
    bucket_centre_x_m: Number,
    bucket_centre_z_m: Number,
    bucket_inertia_kgm2: Length,
    upper_inertia_kgm2: Option<Length>,
    bucket_width_m: Option<Length>,
    bucket_capacity_m3: Option<Length>,
}

impl DynamicsTable {
    pub(super) fn dynamics(&self) -> Dynamics {
        let link = |mass: &Length, x: &Number, z: &Number, inertia: &Length| Link {
            mass_kg: mass.0,
            centre: Vec2::new(x.0, z.0),
            inertia_kgm2: inertia.0,
        };
        Dynamics {
            boom: link(&self.boom_mass_kg, &self.boom_centre_x_m, &self.boom_centre_z_m, &self.boom_inertia_kgm2),
            arm: link(&self.arm_mass_kg, &self.arm_centre_x_m, &self.arm_centre_z_m, &self.arm_inertia_kgm2),
            bucket: link(
                &self.bucket_mass_kg,
                &self.bucket_centre_x_m,
                &self.bucket_centre_z_m,
                &self.bucket_inertia_kgm2,
            ),
            upper_inertia_kgm2: self.upper_inertia_kgm2.map(|inertia| inertia.0),
            bucket_width_m: self.bucket_width_m.map(|width| width.0),
            bucket_capacity_m3: self.bucket_capacity_m3.map(|capacity| capacity.0),
        }
    }
}
