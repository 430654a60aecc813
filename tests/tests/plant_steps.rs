//! The hydraulic plant's numerics: the step, the moment arms, the same bits again.

use cross_tests::plant::*;

/// Positions every 10 ms of 8 s of work.
fn course(machine: &str, substeps: u32) -> Vec<[f64; 4]> {
    let mut model = model(machine);
    model.substeps = substeps;
    let mut plant = at(&model, shares(&model, [0.5, 0.5, 0.5]));
    let tick = |tick: u32| {
        plant.step(currents(&model, work(tick)));
        plant.positions()
    };
    (0..8000).map(tick).step_by(10).collect()
}

#[test]
fn halving_the_step_changes_the_trajectory_by_less_than_a_thousandth() {
    for machine in MACHINES {
        let whole = model(machine).substeps;
        let (coarse, fine) = (course(machine, whole), course(machine, 2 * whole));
        for function in 0..4 {
            let values = || fine.iter().map(|positions| positions[function]);
            let travel = values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min);
            let apart = coarse.iter().zip(&fine).map(|(a, b)| (a[function] - b[function]).abs()).fold(0.0, f64::max);
            println!(
                "{machine} {function}: travel {travel:.3}, apart at most {apart:.2e}, {:.4} %",
                apart / travel * 1e2
            );
            assert!(travel > 0.02 && apart < 1e-3 * travel, "{machine} {function}: {apart} of {travel}");
        }
    }
}

#[test]
fn forces_act_through_the_moment_arms_that_differences_give() {
    for machine in MACHINES {
        let model = model(machine);
        let mut plant = at(&model, shares(&model, [0.5, 0.5, 0.5]));
        let (mut worst, mut seen) = (0.0, 0);
        for tick in 0..8000 {
            let (position, angle, arm) = (plant.positions(), plant.angles(), plant.moment_arms());
            plant.step(currents(&model, work(tick)));
            for i in 0..4 {
                let (turned, after) = (plant.angles()[i] - angle[i], plant.moment_arms()[i]);
                if turned.abs() > 1e-5 {
                    let by_difference = (plant.positions()[i] - position[i]) / turned;
                    let error = (by_difference / (0.5 * (arm[i] + after)) - 1.0).abs();
                    worst = if error > worst { error } else { worst };
                    seen += 1;
                }
            }
        }
        println!("{machine}: {seen} differences, worst {worst:.1e} of the arm");
        assert!(seen > 5000 && worst < 1e-4, "{machine}: {worst}");
    }
}

#[test]
fn the_same_currents_give_the_same_bits() {
    for machine in MACHINES {
        let substeps = model(machine).substeps;
        let bits = |course: Vec<[f64; 4]>| course.into_iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
        assert_eq!(bits(course(machine, substeps)), bits(course(machine, substeps)));
    }
}
