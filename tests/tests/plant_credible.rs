//! What an excavator engineer asks of a plant first: stall force, drift, sag, ringing.

use cross_tests::plant::*;
use hil_sim::plant::hydraulic::HydraulicModel;
use kinematics_core::payload::{LinkMass, Masses, level_gravity};
use kinematics_core::{Cylinders, Machine, Vec2};

/// What the cylinders push to hold the links and this payload, by the core's own formulas, N.
fn holding(model: &HydraulicModel, positions: [f64; 4], payload_kg: f64) -> [f64; 3] {
    let [boom, arm, bucket] = model.links.map(|link| LinkMass { mass_kg: link.mass_kg, centre: link.centre });
    let length = model.geometry.bucket_m;
    let load = LinkMass { mass_kg: payload_kg, centre: Vec2::new(0.5 * length, 0.2 * length) };
    let masses = Masses { boom, arm, bucket }.with_payload(&load);
    let machine = Machine::<f64>::new(&model.geometry).unwrap();
    let lengths = Cylinders { boom: positions[1], arm: positions[2], bucket: positions[3] };
    let joints = machine.cylinders_to_joints(&lengths).unwrap();
    let torques = machine.chain().holding_torques(&joints, &masses, level_gravity());
    let forces = machine.moment_arms(&lengths).unwrap().cylinder_forces(&torques).unwrap();
    [forces.boom, forces.arm, forces.bucket]
}

/// The largest payload a function still moves: by halving, kg.
fn lifted(model: &HydraulicModel, start: [f64; 4], function: usize, deflection: f64) -> f64 {
    let (mut lifts, mut stalls) = (0.0, 40e3);
    while stalls - lifts > 1.0 {
        let payload_kg = 0.5 * (lifts + stalls);
        let loaded = HydraulicModel { payload_kg, ..model.clone() };
        let mut plant = at(&loaded, start);
        run(&mut plant, &loaded, lever(function, deflection), 3000);
        let moved = (plant.positions()[function] - start[function]) * deflection;
        if moved > 0.002 { lifts = payload_kg } else { stalls = payload_kg }
    }
    lifts
}

#[test]
fn a_cylinder_stalls_at_pressure_times_area_within_two_per_cent() {
    // Extending lifts the excavator's boom, retracting the backhoe's: both sides of a piston are tried.
    for (machine, deflection) in [("zx200", 1.0), ("frankel", -1.0)] {
        let model = model(machine);
        let start = shares(&model, [0.5, 0.6, 0.7]);
        let payload = lifted(&model, start, BOOM, deflection);
        let force = holding(&model, start, payload)[0] * deflection;
        let side = usize::from(deflection < 0.0);
        let (area, against) = (model.functions[BOOM].areas[side], model.functions[BOOM].areas[1 - side]);
        let expected = model.pump.supply_pa * area - model.return_pa * against;
        println!(
            "{machine}: lifts {payload:.0} kg, holding it takes {:.2} kN; supply and return pressure on the areas make {:.2} kN: {:+.2} %",
            force * 1e-3,
            expected * 1e-3,
            (force / expected - 1.0) * 1e2
        );
        assert!((force / expected - 1.0).abs() < 0.02, "{machine}: {force} N, not {expected} N");
    }
}

#[test]
fn without_currents_only_leakage_moves_a_loaded_machine_and_the_way_the_load_pushes() {
    let mut model = model("zx200");
    model.payload_kg = 1000.0;
    let start = shares(&model, [0.6, 0.3, 0.8]);
    let forces = holding(&model, start, model.payload_kg);
    let drift = |model: &HydraulicModel| {
        let mut plant = at(model, start);
        run(&mut plant, model, [0.0; 4], 180_000);
        let end = plant.positions();
        [1, 2, 3].map(|i| (end[i] - start[i]) * 1e3)
    };
    let leaking = drift(&model);
    for function in &mut model.functions {
        (function.piston_leak, function.spool_leak) = (0.0, 0.0);
    }
    let tight = drift(&model);
    for (i, (name, limit_mm)) in [("boom", 6.0), ("arm", 12.0), ("bucket", 18.0)].into_iter().enumerate() {
        println!(
            "{name}: drift in 3 min {:+.2} mm (class {limit_mm} mm) under {:+.0} kN; without leakage {:+.4} mm",
            leaking[i],
            -forces[i] * 1e-3,
            tight[i]
        );
        assert!(leaking[i].abs() < limit_mm && leaking[i] * forces[i] < 0.0, "{name}: {} mm", leaking[i]);
        assert!(leaking[i].abs() > 0.1 && tight[i].abs() < 1e-3, "{name}");
    }
}

#[test]
fn a_load_set_into_the_bucket_sags_the_tip_as_far_as_the_oil_is_soft() {
    let model = model("zx200");
    let start = shares(&model, [0.5, 0.5, 0.6]);
    let mut plant = at(&model, start);
    for tick in 1..=2000 {
        plant.set_payload_kg(0.5 * f64::from(tick));
        run(&mut plant, &model, [0.0; 4], 1);
    }
    run(&mut plant, &model, [0.0; 4], 1000);
    let sag = start[BOOM] - plant.positions()[BOOM];
    // Two springs of oil in closed chambers; the rod side's soon has no pressure left to give.
    let function = &model.functions[BOOM];
    let volumes = function.volumes(start[BOOM]);
    let spring = |side: usize| model.oil.bulk_modulus_pa * function.areas[side] * function.areas[side] / volumes[side];
    let added = holding(&model, start, 1000.0)[0] - holding(&model, start, 0.0)[0];
    let (stiff, soft) = (added / (spring(0) + spring(1)), added / spring(0));
    println!(
        "boom cylinder shorter by {:.2} mm under {:.0} kN; both springs {:.2} mm, the head side's alone {:.2} mm",
        sag * 1e3,
        added * 1e-3,
        stiff * 1e3,
        soft * 1e3
    );
    assert!(sag > stiff && sag < soft, "{sag}");
}

#[test]
fn the_boom_rings_at_two_to_five_hertz_when_it_is_stopped() {
    let model = model("zx200");
    for (arm, bucket) in [(0.2, 0.5), (0.5, 0.5), (0.9, 0.9)] {
        let mut plant = at(&model, shares(&model, [0.4, arm, bucket]));
        run(&mut plant, &model, lever(BOOM, 0.6), 1500);
        let neutral = currents(&model, [0.0; 4]);
        let speeds: Vec<f64> = (0..2500)
            .map(|_| {
                plant.step(neutral);
                plant.velocities()[BOOM]
            })
            .collect();
        // After the spool has closed: every other change of sign is a period.
        let turns: Vec<usize> = (300..speeds.len()).filter(|&i| speeds[i - 1] < 0.0 && speeds[i] >= 0.0).collect();
        let periods = turns.len().min(4) - 1;
        let hertz = 1e3 * periods as f64 / (turns[periods] - turns[0]) as f64;
        let peak = |from: usize, to: usize| {
            speeds[from..to].iter().fold(0.0, |p: f64, v| if v.abs() > p { v.abs() } else { p })
        };
        println!(
            "arm at {arm}: {hertz:.2} Hz, from {:.1} to {:.1} mm/s in a period",
            peak(turns[0], turns[1]) * 1e3,
            peak(turns[1], turns[2]) * 1e3
        );
        assert!((2.0..5.0).contains(&hertz), "{hertz} Hz");
        assert!(peak(turns[1], turns[2]) < peak(turns[0], turns[1]));
    }
}

#[test]
fn at_three_stops_each_cylinder_alone_leaves_its_own() {
    let model = model("zx200");
    for start in [[0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]] {
        for function in [BOOM, ARM, BUCKET] {
            let out = if start[function - 1] > 0.5 { -1.0 } else { 1.0 };
            let mut plant = at(&model, shares(&model, start));
            // Pressed against all three stops, one after the other: their oil stays pressed.
            for pressed in [BOOM, ARM, BUCKET] {
                let against = if start[pressed - 1] > 0.5 { 1.0 } else { -1.0 };
                run(&mut plant, &model, lever(pressed, against), 700);
            }
            let before = plant.positions();
            run(&mut plant, &model, lever(function, out), 1500);
            let moved = (plant.positions()[function] - before[function]) * out;
            println!("from {start:?}, function {function}: {:.0} mm in 1.5 s", moved * 1e3);
            assert!(moved > 0.1, "from {start:?}, function {function}: {moved}");
        }
    }
}
