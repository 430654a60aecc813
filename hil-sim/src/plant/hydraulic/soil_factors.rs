//! The fundamental earthmoving equation (Reece 1964; McKyes 1985): what a blade needs per metre of width,
//! `F = γ·g·d²·N_γ + c·d·N_c + c_a·d·N_ca`, the wedge in front of it failing at the angle that needs least.

use libm::{cos, sin, tan};

use super::body::GRAVITY_MPS2;

/// A soil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Soil {
    /// kg/m³.
    pub density_kgpm3: f64,
    /// Cohesion, Pa.
    pub cohesion_pa: f64,
    /// Adhesion to the blade, Pa.
    pub adhesion_pa: f64,
    /// Internal friction, rad.
    pub friction_rad: f64,
    /// Between soil and blade, rad.
    pub blade_friction_rad: f64,
}

impl Soil {
    /// Dry sand.
    pub const SAND: Self = Self {
        density_kgpm3: 1600.0,
        cohesion_pa: 0.0,
        adhesion_pa: 0.0,
        friction_rad: 0.61,
        blade_friction_rad: 0.40,
    };
    /// Sandy loam.
    pub const LOAM: Self = Self {
        density_kgpm3: 1700.0,
        cohesion_pa: 6.0e3,
        adhesion_pa: 1.0e3,
        friction_rad: 0.52,
        blade_friction_rad: 0.35,
    };
    /// Firm clay.
    pub const CLAY: Self = Self {
        density_kgpm3: 1850.0,
        cohesion_pa: 2.5e4,
        adhesion_pa: 5.0e3,
        friction_rad: 0.26,
        blade_friction_rad: 0.19,
    };

    /// N_γ, N_c and N_ca at a rake and a failure angle; `None` where no wedge forms.
    fn factors_at(&self, rake: f64, failure: f64) -> Option<[f64; 3]> {
        let cot = |angle: f64| 1.0 / tan(angle);
        let blade = rake + self.blade_friction_rad;
        let shear = cot(failure + self.friction_rad);
        let divisor = cos(blade) + sin(blade) * shear;
        let spread = cot(rake) + cot(failure);
        (divisor > 1e-3 && spread > 1e-3).then(|| {
            [0.5 * spread / divisor, (1.0 + cot(failure) * shear) / divisor, (1.0 - cot(rake) * shear) / divisor]
        })
    }

    /// N_γ, N_c and N_ca at a rake, rad: of the failure angle with the least N_γ.
    pub fn factors(&self, rake: f64) -> [f64; 3] {
        let angles = (1..150).map(|i| f64::from(i) * 0.01);
        let least =
            angles.filter_map(|failure| self.factors_at(rake, failure)).fold(None, |least: Option<[f64; 3]>, n| {
                if least.is_none_or(|l| n[0] < l[0]) { Some(n) } else { least }
            });
        least.unwrap_or_default()
    }

    /// Force per metre of width at a depth (m) and these factors, N/m.
    pub fn force(&self, depth_m: f64, [gravity, cohesion, adhesion]: [f64; 3]) -> f64 {
        let own = self.density_kgpm3 * GRAVITY_MPS2 * depth_m * depth_m * gravity;
        own + depth_m * (self.cohesion_pa * cohesion + self.adhesion_pa * adhesion)
    }
}

/// The factors over the rake, so that nothing is searched while digging.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FactorTable {
    rows: Vec<[f64; 3]>,
}

/// Rakes of the table, rad.
pub(super) const RAKES: [f64; 2] = [0.35, 2.1];
const ROWS: usize = 36;

impl FactorTable {
    /// Of a soil.
    pub(super) fn new(soil: &Soil) -> Self {
        let step = (RAKES[1] - RAKES[0]) / (ROWS - 1) as f64;
        Self { rows: (0..ROWS).map(|i| soil.factors(RAKES[0] + step * i as f64)).collect() }
    }

    /// At a rake, by interpolation.
    pub(super) fn at(&self, rake: f64) -> [f64; 3] {
        let place = (rake.clamp(RAKES[0], RAKES[1]) - RAKES[0]) / (RAKES[1] - RAKES[0]) * (ROWS - 1) as f64;
        let row = (place as usize).clamp(0, ROWS - 2);
        let share = place - row as f64;
        [0, 1, 2].map(|i| self.rows[row][i] + share * (self.rows[row + 1][i] - self.rows[row][i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_vertical_wall_in_sand_is_rankines_passive_wedge() {
        let sand = Soil { blade_friction_rad: 0.0, ..Soil::SAND };
        let quarter = core::f64::consts::FRAC_PI_4 + 0.5 * sand.friction_rad;
        let passive = 0.5 * tan(quarter) * tan(quarter);
        let [gravity, ..] = sand.factors(core::f64::consts::FRAC_PI_2);
        assert!((gravity / passive - 1.0).abs() < 1e-3, "{gravity} {passive}");
    }

    #[test]
    fn the_table_is_the_factors_within_a_per_cent() {
        let table = FactorTable::new(&Soil::LOAM);
        for rake in [0.4, 0.77, 1.2, 1.61, 2.0] {
            for (found, exact) in table.at(rake).into_iter().zip(Soil::LOAM.factors(rake)) {
                assert!((found - exact).abs() < 0.02 * exact.abs() + 0.01, "{rake}: {found} {exact}");
            }
        }
    }
}
