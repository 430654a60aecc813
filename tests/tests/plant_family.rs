//! Families of plants: drawn by the case alone.

use cross_tests::plant::*;
use hil_sim::plant::hydraulic::{Compensation, HydraulicModel};

#[test]
fn any_split_of_the_cases_gives_the_same_plants() {
    let nominal = model("zx200");
    let all: Vec<HydraulicModel> = (0..60).map(|seed| nominal.drawn(seed)).collect();
    for shards in [2, 3, 7] {
        for shard in 0..shards {
            for seed in (shard..60).step_by(shards) {
                assert_eq!(nominal.drawn(seed as u64), all[seed]);
            }
        }
    }
    assert!(all.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn every_plant_lies_within_the_familys_bounds_and_the_family_fills_them() {
    for machine in MACHINES {
        let nominal = model(machine);
        let links: f64 = nominal.links.iter().map(|link| link.mass_kg).sum();
        let family: Vec<HydraulicModel> = (0..400).map(|seed| nominal.drawn(seed)).collect();
        type Of = fn(&HydraulicModel) -> f64;
        let checks: [(&str, Of, f64, [f64; 2]); 6] = [
            ("bulk modulus", |m| m.oil.bulk_modulus_pa, nominal.oil.bulk_modulus_pa, [0.7, 1.3]),
            ("dead band", |m| m.functions[1].dead_band[0], nominal.functions[1].dead_band[0], [0.7, 1.3]),
            ("dead time", |m| m.spool.dead_time_s, 1.0, [0.04, 0.2]),
            ("leakage", |m| m.functions[2].spool_leak, nominal.functions[2].spool_leak, [0.3, 3.0]),
            ("payload", |m| m.payload_kg, if links > 2000.0 { 1000.0 } else { 0.5 * links }, [0.0, 1.0]),
            ("supply", |m| m.pump.supply_pa, nominal.pump.supply_pa, [0.85, 1.0]),
        ];
        for (name, of, unit, [low, high]) in checks {
            let values = || family.iter().map(|m| of(m) / unit);
            let (least, most) = (values().fold(f64::MAX, f64::min), values().fold(f64::MIN, f64::max));
            println!("{machine} {name}: {least:.3} … {most:.3}");
            assert!(least >= low - 1e-12 && most <= high + 1e-12, "{name}");
            assert!(most - least > 0.9 * (high - low), "{name}");
        }
        let pre = family.iter().filter(|m| m.pump.compensation == Compensation::Pre).count();
        assert!((150..250).contains(&pre), "{pre}");
    }
}

#[test]
fn every_plant_of_a_family_works() {
    for machine in MACHINES {
        let nominal = model(machine);
        for seed in 0..40 {
            let model = nominal.drawn(seed);
            let start = shares(&model, [0.5, 0.5, 0.5]);
            let mut plant = at(&model, start);
            let mut highest: f64 = 0.0;
            for tick in 0..6000 {
                plant.step(currents(&model, work(tick)));
                let pressures = plant.pressures_pa();
                let most = pressures.into_iter().flatten().fold(0.0, |a: f64, b| if b > a { b } else { a });
                highest = if most > highest { most } else { highest };
            }
            assert!(plant.positions().into_iter().all(f64::is_finite));
            assert!(highest < 1.6 * model.functions[1].port_relief_pa, "{machine} {seed}: {highest} Pa");
            assert!((plant.positions()[1] - start[1]).abs() > 1e-3, "{machine} {seed}");
        }
    }
}

#[test]
fn with_too_little_oil_one_valve_slows_all_and_the_other_starves_the_heaviest_load() {
    let speeds = |compensation: Compensation, share: f64| {
        let mut model = model("zx200");
        model.pump.compensation = compensation;
        model.pump.flow_m3ps *= share;
        let mut plant = at(&model, shares(&model, [0.3, 0.6, 0.5]));
        run(&mut plant, &model, [0.0, 0.7, 0.0, 0.7], 1200);
        let before = plant.positions();
        run(&mut plant, &model, [0.0, 0.7, 0.0, 0.7], 400);
        [BOOM, BUCKET].map(|i| plant.positions()[i] - before[i])
    };
    for compensation in [Compensation::Post, Compensation::Pre] {
        let (full, half) = (speeds(compensation, 1.0), speeds(compensation, 0.4));
        let left = [half[0] / full[0], half[1] / full[1]];
        println!("{compensation:?}: of the speeds at full flow boom keeps {:.2}, bucket {:.2}", left[0], left[1]);
        match compensation {
            Compensation::Post => assert!((left[0] - left[1]).abs() < 0.15 && left[0] < 0.9, "{left:?}"),
            Compensation::Pre => assert!(left[0] < 0.6 && left[1] > 0.9, "{left:?}"),
        }
    }
}
