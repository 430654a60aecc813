//! Families of plants: machines like the nominal one but not it, drawn from a case's seed alone.
//!
//! A case's plant depends on its seed and on nothing drawn before, so any split of the cases gives the same plants.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

use super::model::HydraulicModel;
use super::pump::Compensation;

/// Bulk modulus and dead bands lie within this share of the nominal ones.
const SPREAD: f64 = 0.3;
/// Command dead times, s.
const DEAD_TIME_S: [f64; 2] = [0.04, 0.2];
/// Leakage, times the nominal one; drawn by its logarithm.
const LEAKAGE: [f64; 2] = [0.3, 3.0];
/// Payloads, kg.
const PAYLOAD_KG: [f64; 2] = [0.0, 1000.0];
/// Supply pressure, times the nominal one.
const SUPPLY: [f64; 2] = [0.85, 1.0];

/// Uniform draws of one case.
struct Draws(ChaCha8Rng);

impl Draws {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, [low, high]: [f64; 2]) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm.
    fn by_factor(&mut self, range: [f64; 2]) -> f64 {
        libm::exp(self.within(range.map(libm::log)))
    }
}

impl HydraulicModel {
    /// A relative of this machine: bulk modulus and dead bands ± 30 %, dead time 40–200 ms, leakage, payload 0–1 t (never more than half of
    /// what the links weigh), supply pressure, pre- or post-compensated.
    pub fn drawn(&self, seed: u64) -> Self {
        let mut draws = Draws(ChaCha8Rng::seed_from_u64(seed));
        let mut model = self.clone();
        let around = [1.0 - SPREAD, 1.0 + SPREAD];
        model.oil.bulk_modulus_pa *= draws.within(around);
        let band = draws.within(around);
        model.spool.dead_time_s = draws.within(DEAD_TIME_S);
        let leakage = draws.by_factor(LEAKAGE);
        for function in &mut model.functions {
            function.dead_band = function.dead_band.map(|nominal| nominal * band);
            function.piston_leak *= leakage;
            function.spool_leak *= leakage;
        }
        let links: f64 = self.links.iter().map(|link| link.mass_kg).sum();
        let [none, ton] = PAYLOAD_KG;
        let most = if ton < 0.5 * links { ton } else { 0.5 * links };
        model.payload_kg = draws.within([none, most]);
        model.pump.supply_pa *= draws.within(SUPPLY);
        model.pump.compensation = if draws.unit() < 0.5 { Compensation::Pre } else { Compensation::Post };
        model
    }
}
