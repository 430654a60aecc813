//! Oil and energy of the hydraulic plant: nothing is lost that no ledger names.

use cross_tests::plant::*;
use hil_sim::plant::hydraulic::{Compensation, HydraulicModel};

fn variants() -> Vec<(&'static str, HydraulicModel)> {
    let mut all = Vec::new();
    for machine in MACHINES {
        for compensation in [Compensation::Pre, Compensation::Post] {
            let mut model = model(machine);
            model.pump.compensation = compensation;
            model.payload_kg = 0.1 * model.links.iter().map(|link| link.mass_kg).sum::<f64>();
            all.push((machine, model));
        }
    }
    all
}

#[test]
fn the_oil_in_the_machine_is_what_came_less_what_went() {
    for (machine, model) in variants() {
        let mut plant = at(&model, shares(&model, [0.5, 0.5, 0.5]));
        let (mut ledger, before) = (plant.ledger(), plant.oil_m3());
        (0..20_000).for_each(|tick| plant.step_with_ledger(currents(&model, work(tick)), &mut ledger));
        let error = (plant.oil_m3() - before - ledger.kept_m3()) / ledger.pumped_m3;
        println!(
            "{machine} {:?}: {:.2} l pumped, {:.3} l sucked in, {error:.1e} of it astray",
            model.pump.compensation,
            ledger.pumped_m3 * 1e3,
            ledger.made_up_m3 * 1e3
        );
        assert!(ledger.pumped_m3 > 0.005 && error.abs() < 1e-12, "{machine}: {error}");
    }
}

#[test]
fn energy_is_kept_within_one_per_cent() {
    for (machine, model) in variants() {
        let mut plant = at(&model, shares(&model, [0.5, 0.5, 0.5]));
        let (mut ledger, before) = (plant.ledger(), plant.energy_j());
        (0..20_000).for_each(|tick| plant.step_with_ledger(currents(&model, work(tick)), &mut ledger));
        let after = plant.energy_j();
        let gained: f64 = after.iter().zip(before).map(|(after, before)| after - before).sum();
        let astray = ledger.pump_j - gained - ledger.lost_j() - ledger.atmosphere_j;
        println!(
            "{machine} {:?}: pump {:.0} kJ; oil, motion, height {:.1?} kJ; lost in edges {:.0}, valves {:.0}, friction {:.0}, stops {:.2} kJ; astray {:+.2} %",
            model.pump.compensation,
            ledger.pump_j * 1e-3,
            [0, 1, 2].map(|i| (after[i] - before[i]) * 1e-3),
            ledger.metering_j * 1e-3,
            ledger.valves_j * 1e-3,
            ledger.friction_j * 1e-3,
            ledger.stops_j * 1e-3,
            astray / ledger.pump_j * 1e2
        );
        assert!(astray.abs() < 0.01 * ledger.pump_j, "{machine}: {astray} J of {} J", ledger.pump_j);
        assert!(ledger.metering_j > 0.0 && ledger.friction_j > 0.0 && ledger.valves_j > 0.0);
    }
}
