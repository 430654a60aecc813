//! Families of plants: machines like the nominal one but not it, drawn from a case's seed alone.
//!
//! A case's plant depends on its seed and on nothing drawn before, so any split of the cases gives the same plants.

use super::model::HydraulicModel;
use super::pump::Compensation;
use crate::dice::Dice;

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

/// Uniform in the logarithm.
fn by_factor(dice: &mut Dice, [low, high]: [f64; 2]) -> f64 {
    libm::exp(dice.within(libm::log(low), libm::log(high)))
}

impl HydraulicModel {
    /// A relative of this machine: bulk modulus and dead bands ± 30 %, dead time 40–200 ms, leakage, payload 0–1 t (never more than half of
    /// what the links weigh), supply pressure, pre- or post-compensated.
    pub fn drawn(&self, seed: u64) -> Self {
        let mut dice = Dice::new(seed);
        let mut model = self.clone();
        let [least, largest] = [1.0 - SPREAD, 1.0 + SPREAD];
        model.oil.bulk_modulus_pa *= dice.within(least, largest);
        let band = dice.within(least, largest);
        model.spool.dead_time_s = dice.within(DEAD_TIME_S[0], DEAD_TIME_S[1]);
        let leakage = by_factor(&mut dice, LEAKAGE);
        for function in &mut model.functions {
            function.dead_band = function.dead_band.map(|nominal| nominal * band);
            function.piston_leak *= leakage;
            function.spool_leak *= leakage;
        }
        let links: f64 = self.links.iter().map(|link| link.mass_kg).sum();
        let [none, ton] = PAYLOAD_KG;
        let most = if ton < 0.5 * links { ton } else { 0.5 * links };
        model.payload_kg = dice.within(none, most);
        model.pump.supply_pa *= dice.within(SUPPLY[0], SUPPLY[1]);
        model.pump.compensation = if dice.with_chance(0.5) { Compensation::Pre } else { Compensation::Post };
        model
    }
}
