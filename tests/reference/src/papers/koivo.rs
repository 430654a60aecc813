//! Koivo 1994's labels for a machine given by its pins, and the angles of its four-bar at a pose.

use core::f64::consts::PI;

use kinematics_core::distances::KoivoDistances;
use kinematics_core::{PinGeometry, Rotor, Vec2};

fn direction(v: Vec2<f64>) -> f64 {
    libm::atan2(v.z, v.x)
}

/// The inverse of [`KoivoDistances::to_pins`].
pub fn distances(g: &PinGeometry) -> KoivoDistances {
    let arm_base = g.arm.base - Vec2::new(g.boom_m, 0.0);
    let pivot = g.bucket.rocker_pivot - Vec2::new(g.arm_m, 0.0);
    let cylinder = g.bucket.base - g.bucket.rocker_pivot;
    let nu2 = PI - direction(pivot);
    KoivoDistances {
        a1_m: g.boom_pin_x_m,
        a2_m: g.boom_m,
        a3_m: g.arm_m,
        a4_m: g.bucket_m,
        l_ab_m: g.boom.rod.norm(),
        l_ah_m: -g.boom.base.z,
        l_he_m: g.boom.base.x,
        beta_rad: direction(g.boom.rod),
        l_ci_m: arm_base.norm(),
        l_fc_m: g.arm.rod.norm(),
        gamma1_rad: PI - direction(arm_base),
        gamma2_rad: direction(g.arm.rod),
        l_jl_m: cylinder.norm(),
        l_kl_m: g.bucket.rocker_m,
        nu1_rad: direction(cylinder) + nu2,
        l_ld_m: pivot.norm(),
        l_kg_m: g.bucket.coupler_m,
        l_gd_m: g.bucket.coupler_pin.norm(),
        nu2_rad: nu2,
        nu3_rad: direction(g.bucket.coupler_pin),
        boom: g.boom.stroke,
        arm: g.arm.stroke,
        bucket: g.bucket.stroke,
    }
}

/// ε1 = ∠KLD, ε2 = ∠KGD, ε3 = ∠LKG, rad.
#[derive(Clone, Copy, Debug)]
pub struct FourBarAngles {
    /// ∠KLD
    pub e1: f64,
    /// ∠KGD
    pub e2: f64,
    /// ∠LKG, which the paper reads from a sensor.
    pub e3: f64,
}

fn angle_at(corner: Vec2<f64>, one: Vec2<f64>, other: Vec2<f64>) -> f64 {
    let (one, other) = (one - corner, other - corner);
    libm::atan2(one.cross(other).abs(), one.dot(other))
}

/// The four-bar's angles at a bucket cylinder length (m) and the bucket angle that belongs to it, from its pins in the arm frame.
pub fn four_bar(g: &PinGeometry, length: f64, bucket: Rotor<f64>) -> FourBarAngles {
    let k = distances(g);
    let pin_d = Vec2::new(g.arm_m, 0.0);
    let pin_l = g.bucket.rocker_pivot;
    let pin_g = pin_d + bucket.rotate(g.bucket.coupler_pin);
    // The cylinder's angle at L, clockwise from J.
    let cos = (k.l_jl_m * k.l_jl_m + k.l_kl_m * k.l_kl_m - length * length) / (2.0 * k.l_jl_m * k.l_kl_m);
    let rocker = direction(g.bucket.base - pin_l) - libm::acos(cos);
    let pin_k = pin_l + Vec2::new(libm::cos(rocker), libm::sin(rocker)).scale(k.l_kl_m);
    FourBarAngles {
        e1: angle_at(pin_l, pin_k, pin_d),
        e2: angle_at(pin_g, pin_k, pin_d),
        e3: angle_at(pin_k, pin_l, pin_g),
    }
}
