//! Hydraulic oil with entrained air, in one closed form both ways: content and volume → pressure, and back.
//!
//! Content is oil as m³ at atmospheric pressure, so content is mass over the density there and is conserved exactly. A unit of content
//! takes v(p) = (1 − α)(1 − (p − p₀)/β) + α·p₀/p: a liquid of constant compressibility and air that is compressed isothermally. Solved for p
//! this is a quadratic whose one positive root always exists: a starved chamber falls towards vacuum, never below. Pressures are absolute.

use libm::{log, sqrt};

/// Atmospheric pressure, Pa.
pub const ATMOSPHERE_PA: f64 = 101_325.0;

/// What the oil is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oil {
    /// Bulk modulus of the liquid, hoses and tubes included, Pa.
    pub bulk_modulus_pa: f64,
    /// Share of the volume that is air at atmospheric pressure.
    pub air_fraction: f64,
    /// Density at atmospheric pressure, kg/m³.
    pub density_kgpm3: f64,
}

impl Oil {
    /// a = (1 − α)/β, 1/Pa.
    fn liquid(&self) -> f64 {
        (1.0 - self.air_fraction) / self.bulk_modulus_pa
    }

    /// Absolute pressure of this content in this volume, Pa.
    pub fn pressure_pa(&self, content_m3: f64, volume_m3: f64) -> f64 {
        let a = self.liquid();
        let air = self.air_fraction * ATMOSPHERE_PA;
        let b = (1.0 - self.air_fraction) + a * ATMOSPHERE_PA - volume_m3 / content_m3;
        let root = sqrt(b * b + 4.0 * a * air);
        // The form without cancellation on either side.
        if b > 0.0 { (b + root) / (2.0 * a) } else { 2.0 * air / (root - b) }
    }

    /// v(p): volume of a unit of content.
    pub fn specific_volume(&self, pressure_pa: f64) -> f64 {
        let alpha = self.air_fraction;
        (1.0 - alpha) - self.liquid() * (pressure_pa - ATMOSPHERE_PA) + alpha * ATMOSPHERE_PA / pressure_pa
    }

    /// −dv/dp, 1/Pa.
    pub fn compressibility(&self, pressure_pa: f64) -> f64 {
        self.liquid() + self.air_fraction * ATMOSPHERE_PA / (pressure_pa * pressure_pa)
    }

    /// Content of a volume at a pressure, m³.
    pub fn content_m3(&self, volume_m3: f64, pressure_pa: f64) -> f64 {
        volume_m3 / self.specific_volume(pressure_pa)
    }

    /// e(p): what compressing a unit of content from atmospheric pressure takes, J/m³.
    pub fn energy(&self, pressure_pa: f64) -> f64 {
        let p = pressure_pa;
        0.5 * self.liquid() * (p * p - ATMOSPHERE_PA * ATMOSPHERE_PA)
            + self.air_fraction * ATMOSPHERE_PA * log(p / ATMOSPHERE_PA)
    }

    /// e + p·v: what a unit of content carries through an opening, J/m³.
    pub fn enthalpy(&self, pressure_pa: f64) -> f64 {
        self.energy(pressure_pa) + pressure_pa * self.specific_volume(pressure_pa)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OIL: Oil = Oil { bulk_modulus_pa: 1.2e9, air_fraction: 0.01, density_kgpm3: 860.0 };

    #[test]
    fn pressure_and_content_are_each_others_inverse_from_vacuum_to_relief() {
        for p in [1e3, 2e4, ATMOSPHERE_PA, 1e6, 4e7] {
            let found = OIL.pressure_pa(OIL.content_m3(0.02, p), 0.02);
            assert!((found / p - 1.0).abs() < 1e-9, "{p}: {found}");
        }
    }

    #[test]
    fn air_makes_it_soft_near_atmospheric_pressure_and_hardly_at_ten_megapascal() {
        let stiffness = |p: f64| OIL.specific_volume(p) / OIL.compressibility(p);
        assert!(stiffness(2e5) < 0.05 * OIL.bulk_modulus_pa);
        assert!((stiffness(1e7) / OIL.bulk_modulus_pa - 1.0).abs() < 0.03);
        // −dv/dp by a difference.
        let slope = (OIL.specific_volume(1e6 - 1.0) - OIL.specific_volume(1e6 + 1.0)) / 2.0;
        assert!((slope / OIL.compressibility(1e6) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_starved_volume_falls_towards_vacuum_and_stays_above_it() {
        let content = OIL.content_m3(0.01, ATMOSPHERE_PA);
        let p = OIL.pressure_pa(content, 0.02);
        assert!(p > 0.0 && p < 0.02 * ATMOSPHERE_PA, "{p}");
    }

    #[test]
    fn enthalpy_rises_by_volume_times_pressure() {
        let (p, dp) = (5e6, 10.0);
        let rise = (OIL.enthalpy(p + dp) - OIL.enthalpy(p - dp)) / (2.0 * dp);
        assert!((rise / OIL.specific_volume(p) - 1.0).abs() < 1e-6);
    }
}
