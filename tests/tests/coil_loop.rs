//! The current loop on simulated solenoids: steps, dither, supply, temperature, wind-up, interlock.

use firmware::supervisor::Gate;
use hil_sim::coil_trial::{CoilReport, FULL_SCALE_A, Surroundings, Trial, parameters};
use proptest::prelude::*;

fn trial(supply_v: f64, temperature_c: f64) -> Trial {
    let mut surroundings = Surroundings { temperature_c, ..Surroundings::USUAL };
    surroundings.supply.volts = supply_v;
    Trial::new(&parameters(), surroundings).unwrap()
}

#[test]
fn a_step_rises_in_its_time_without_overshoot_and_ends_on_the_wanted_current() {
    let report = CoilReport::new().unwrap();
    println!("{:#?}", report.step);
    let step = report.step;
    // 2.2 time constants of 5 ms from 10 % to 90 %; iron that saturates makes it somewhat faster.
    assert!((0.009..0.0115).contains(&step.rise_s), "{step:?}");
    assert!(step.overshoot < 0.03 && step.settling_s < 0.03 && step.steady_error_a.abs() < 0.003, "{step:?}");
    for row in report.temperatures.iter().chain(&report.supplies) {
        println!("{row:?}");
        assert!(row.step.overshoot < 0.08 && row.step.steady_error_a.abs() < 0.003, "{row:?}");
        assert!(row.step.settling_s < 0.15, "{row:?}");
    }
}

#[test]
fn dither_reaches_the_winding_and_leaves_its_mean() {
    for row in CoilReport::new().unwrap().dither {
        println!("{row:?}");
        assert!(row.reached_a > 0.7 * row.wanted_a && row.reached_a < 1.2 * row.wanted_a, "{row:?}");
        assert!(row.mean_error_a.abs() < 0.003, "{row:?}");
    }
}

#[test]
fn a_supply_that_falls_and_comes_back_leaves_no_wound_up_integral() {
    let mut t = trial(24.0, 80.0);
    t.run(1.1, 300);
    t.surroundings.supply.volts = 6.0;
    let low = t.run(1.1, 400);
    assert!(low.last().unwrap().currents_a[0] < 1.0, "the supply is too low for the current");
    assert_eq!(low.last().unwrap().duties[0], 65535);
    t.surroundings.supply.volts = 24.0;
    let back = t.run(1.1, 300);
    let peak = back.iter().map(|s| s.currents_a[0]).fold(0.0, f64::max);
    println!("peak {peak:.3} A of 1.1 A");
    assert!(peak < 1.1 + 0.05 * 1.1, "{peak}");
    assert!(back[60..].iter().all(|s| (s.currents_a[0] - 1.1).abs() < 0.02));
}

#[test]
fn a_jump_of_the_supply_hardly_shows_in_the_current() {
    let mut t = trial(12.0, 20.0);
    t.run(0.8, 300);
    t.surroundings.supply.volts = 28.0;
    let after = t.run(0.8, 100);
    let worst = after.iter().map(|s| (s.currents_a[0] - 0.8).abs()).fold(0.0, f64::max);
    println!("{:.1} mA", worst * 1e3);
    assert!(worst < 0.02, "{worst}");
}

#[test]
fn a_closed_gate_gives_no_duty_from_that_tick_on() {
    let mut t = trial(24.0, 20.0);
    t.run(0.8, 100);
    let speed = t.speed_for(0.8);
    for _ in 0..100 {
        let sample = t.tick(Gate::Closed, speed);
        assert_eq!((sample.duties, sample.wanted_a), ([0; 2], [0.0; 2]));
    }
    assert_eq!(t.solenoids[0].current_a(), 0.0);
}

#[test]
fn a_change_of_direction_waits_until_the_other_coils_current_has_died_away() {
    let mut t = trial(24.0, 20.0);
    t.run(1.0, 300);
    let samples = t.run(-1.0, 300);
    let first = samples.iter().position(|s| s.duties[1] > 0).unwrap();
    println!("{first} ticks");
    let released = f64::from(parameters().released_a);
    // The converter's noise may hide 10 mA.
    assert!(samples[first].currents_a[0] < released + 0.01, "{:?}", samples[first]);
    assert!(first > 10, "it waited");
    assert!((samples.last().unwrap().currents_a[1] - 1.0).abs() < 0.01);
    assert!(samples.iter().all(|s| s.fault.is_none()));
}

#[test]
fn a_coil_that_does_not_let_go_keeps_the_other_off_for_good() {
    let mut t = trial(24.0, 20.0);
    t.solenoids[0].broken = Some(hil_sim::plant::coil::Broken::ShortToSupply);
    t.run(0.0, 100);
    assert!(t.run(-1.0, 500).iter().all(|s| s.duties == [0; 2]));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn both_solenoids_are_never_on_together(
        seed in any::<u64>(),
        temperature_c in -40.0..120.0_f64,
        supply_v in 9.0..32.0_f64,
        wishes in prop::collection::vec((-1.5..1.5_f32, any::<bool>(), 1_u32..60), 1..40),
    ) {
        let mut t = trial(supply_v, temperature_c);
        t.surroundings.seed = seed;
        let released = f64::from(parameters().released_a) + 0.01;
        for (speed, open, ticks) in wishes {
            let gate = if open { Gate::Open } else { Gate::Closed };
            for _ in 0..ticks {
                let sample = t.tick(gate, speed);
                let [extend, retract] = sample.duties;
                prop_assert!(extend == 0 || retract == 0, "{sample:?}");
                let [a, b] = sample.currents_a;
                prop_assert!(a < released || b < released, "{sample:?}");
                prop_assert!(a < 1.1 * FULL_SCALE_A && b < 1.1 * FULL_SCALE_A, "{sample:?}");
                prop_assert_eq!(sample.fault, None);
            }
        }
    }
}
