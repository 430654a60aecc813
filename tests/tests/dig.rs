//! Frankel's dig as a function of time: the published one to the digit, the one as meant without its slips, and the travel
//! check that refuses the published one before anything moves.

use cross_tests::golden::Golden;
use cross_tests::machines::INCH_M;
use cross_tests::rig::scenario;
use firmware::dig::{Dig, DigParameters};
use firmware::travel::first_violation;
use firmware::{Ecu, ParameterError};
use hil_sim::travel::violations;
use kinematics_core::{Cylinder, Machine, PoseError, Real};

fn published() -> DigParameters {
    scenario("dig-published").parameters.dig.expect("a dig")
}

#[test]
fn the_published_dig_comes_out_row_by_row() {
    let dig = Dig::<f64>::new(&published());
    let rows = Golden::read("frankel_dig").columns(["t_s", "tip_x_in", "tip_z_in", "phi_seed_deg"]);
    assert_eq!(rows.len(), 200);
    // `dig.m` adds up its time step: the row at 8 s comes at a rounding before 8 s, in the plunge.
    let mut time = 0.0;
    for [row_time, x, z, phi] in rows {
        assert!((row_time - time).abs() < 1e-9);
        let tip = dig.tip(time);
        let wanted_pitch = kinematics_core::Rotor::<f64>::from_degrees(phi + 180.0);
        let apart = (tip.pitch.to_vec() - wanted_pitch.to_vec()).norm();
        assert!((tip.reach / INCH_M - x).abs() < 1e-6, "x at {time} s: {} for {x} in", tip.reach / INCH_M);
        assert!((tip.height / INCH_M - z).abs() < 1e-6, "z at {time} s: {} for {z} in", tip.height / INCH_M);
        assert!(apart < 1e-9, "pitch at {time} s");
        time += 0.1;
    }
}

#[test]
fn as_published_x_stays_short_of_the_reach_while_plunging_and_jumps_into_the_scoop() {
    let dig = Dig::<f64>::new(&published());
    assert!((dig.tip(6.0).reach / INCH_M - 88.5).abs() < 1e-9);
    assert!((dig.tip(8.0).reach / INCH_M - 90.0).abs() < 1e-9);
}

#[test]
fn as_meant_the_path_is_continuous_plunges_at_the_reach_and_scoops_at_the_given_radius() {
    let parameters = scenario("dig").parameters.dig.expect("a dig");
    let dig = Dig::<f64>::new(&parameters);
    assert!((dig.tip(6.0).reach - parameters.reach_m).abs() < 1e-12);
    let mut before = dig.tip(0.0);
    for tick in 1..=20_000 {
        let tip = dig.tip(f64::from(tick) * 1e-3);
        let step = libm::hypot(tip.reach - before.reach, tip.height - before.height);
        assert!(step < 1e-3, "{step} m in a millisecond at tick {tick}");
        before = tip;
    }
    // Three points of the scoop have one centre at the given radius.
    let [a, b, c] = [9.0, 14.0, 19.0].map(|t| dig.tip(t));
    let area2 = (b.reach - a.reach) * (c.height - a.height) - (b.height - a.height) * (c.reach - a.reach);
    let side = |p: &kinematics_core::PlaneTip<f64>, q: &kinematics_core::PlaneTip<f64>| {
        libm::hypot(p.reach - q.reach, p.height - q.height)
    };
    let circumradius = side(&a, &b) * side(&b, &c) * side(&c, &a) / (2.0 * area2.abs());
    assert!((circumradius - parameters.scoop_radius_m).abs() < 1e-9, "{circumradius}");
}

#[test]
fn before_its_start_and_after_its_end_the_dig_rests() {
    let dig = Dig::<f64>::new(&published());
    assert_eq!(dig.tip(-1.0), dig.tip(0.0));
    assert_eq!(dig.tip(25.0), dig.tip(20.0));
}

#[test]
fn in_f32_the_reference_stays_within_a_micrometre_of_f64() {
    let parameters = scenario("dig").parameters.dig.expect("a dig");
    let (single, double) = (Dig::<f32>::new(&parameters), Dig::<f64>::new(&parameters));
    let mut worst: f64 = 0.0;
    for tick in 0..=20_000_u16 {
        let (a, b) = (single.tip(f32::from(tick) * firmware::TICK_S), double.tip(f64::from(tick) * 1e-3));
        let apart = libm::hypot(a.reach.to_f64() - b.reach, a.height.to_f64() - b.height);
        worst = if apart > worst { apart } else { worst };
    }
    println!("f32 reference off by at most {worst:.2e} m");
    assert!(worst < 2e-6, "{worst}");
}

#[test]
fn the_published_dig_is_refused_with_cylinder_time_and_amount() {
    let scenario = scenario("dig-published");
    let geometry = &scenario.machine.geometry;
    let machine = Machine::<f64>::new(geometry).unwrap();
    let found = violations(geometry, &machine, &Dig::new(&scenario.parameters.dig.expect("a dig")));
    for violation in &found {
        println!("{violation}");
    }
    assert_eq!(found.len(), 2);
    let [start, end] = [&found[0], &found[1]];
    assert!(found.iter().all(|v| v.cylinder == "arm"));
    // The golden rows: up to 42.68 in at the start, limit 41.9298 in.
    assert!((start.by_m / INCH_M - (42.6819 - 41.9298)).abs() < 1e-3 && start.worst_s == 0.0);
    assert!(start.until_s > 0.2 && start.until_s < 0.3);
    assert!(end.from_s > 19.3 && end.from_s < 19.4 && (end.until_s - 20.0).abs() < 1e-9);
}

#[test]
fn the_controller_itself_refuses_it_too() {
    let error = Ecu::new(&scenario("dig-published").parameters).unwrap_err();
    let ParameterError::Dig(violation) = error else { panic!("{error}") };
    assert_eq!(violation.time_s, 0.0);
    assert!(matches!(violation.error, PoseError::OutOfStroke { cylinder: Cylinder::Arm, by } if by > 0.019));
    assert!(error.to_string().contains("arm") && error.to_string().contains("`dig` at 0 s"), "{error}");
}

#[test]
fn the_digs_of_the_other_scenarios_stay_inside_the_travel_limits() {
    let mut digs = 0;
    for name in cross_tests::rig::scenario_names().into_iter().filter(|name| name != "dig-published") {
        let scenario = scenario(&name);
        let Some(dig) = &scenario.parameters.dig else { continue };
        let machine = Machine::<f64>::new(&scenario.machine.geometry).unwrap();
        assert_eq!(first_violation(&machine, &Dig::new(dig)), None, "{name}");
        digs += 1;
    }
    assert!(digs >= 6, "{digs}");
}

#[test]
fn what_is_checked_before_motion_is_to_the_bit_what_motion_follows() {
    let dig = Dig::<f32>::new(&scenario("dig").parameters.dig.expect("a dig"));
    for tick in 0..=20_000 {
        assert_eq!(Dig::<f32>::time_of(tick).to_bits(), (tick as f32 * firmware::TICK_S).to_bits());
        assert_eq!(dig.at_tick(tick), dig.tip(tick as f32 * firmware::TICK_S));
    }
    assert_eq!(dig.ticks(), 20_000);
}
