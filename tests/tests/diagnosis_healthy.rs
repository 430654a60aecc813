//! A healthy machine never trips the diagnosis: hours of random levers on delayed, ringing cylinders that stall, and on the plant of
//! the harness; and a whole controller with noise.

use cross_tests::healthy::{Dice, FULL_MPS, NOISE_M, STROKE_M, Sluggish, code, diagnosis, tick};
use firmware::Fault;
use firmware::diagnosis::{NO_PRESSURES, Pressures};
use hil_sim::plant::sensors::Noise;
use hil_sim::plant::{Actuator, ActuatorModel};
use kinematics_core::geometry::Stroke;

const TICKS_PER_S: u32 = 1000;

/// A lever that is moved now and then: released, full, slow, reversed; sometimes like a saw.
struct Lever {
    command: f64,
    until: u32,
}

impl Lever {
    fn new() -> Self {
        Self { command: 0.0, until: 0 }
    }

    fn at(&mut self, now: u32, dice: &mut Dice) -> f64 {
        if now >= self.until {
            let kind = dice.between(0.0, 6.0) as u32;
            self.command = match kind {
                0 | 1 => 0.0,
                2 => FULL_MPS,
                3 => -FULL_MPS,
                4 => dice.between(-0.1, 0.1) * FULL_MPS,
                _ => dice.between(-1.0, 1.0) * FULL_MPS,
            };
            let longest = if dice.between(0.0, 1.0) < 0.3 { 0.3 } else { 4.0 };
            self.until = now + (dice.between(0.02, longest) * f64::from(TICKS_PER_S)) as u32;
        }
        self.command
    }
}

/// Runs four sluggish cylinders for so long; the first fault, with when and what was sent.
fn sluggish_run(seed: u64, seconds: u32, pressures_known: bool) -> Option<(u32, Fault, [f64; 4])> {
    let mut dice = Dice::new(seed);
    let mut noise = Noise::new(seed);
    let mut cylinders = [(); 4].map(|()| Sluggish::any(&mut dice));
    let mut levers = [(); 4].map(|()| Lever::new());
    let mut diagnosis = diagnosis();
    for now in 0..seconds * TICKS_PER_S {
        if now % 20_000 == 0 {
            // Soil comes and goes.
            cylinders.iter_mut().for_each(|c| c.soil_m = dice.between(c.position_m, 1.5 * STROKE_M));
        }
        let mut sent = [0.0; 4];
        for (sent, lever) in sent.iter_mut().zip(&mut levers) {
            *sent = lever.at(now, &mut dice);
        }
        let codes = cylinders.each_ref().map(|c| code(c.position_m, &mut noise));
        let pressure = |c: &Sluggish| if pressures_known { [Some(c.pressure_pa as f32); 2] } else { [None; 2] };
        let pressures: Pressures = [1, 2, 3].map(|i| pressure(&cylinders[i]));
        if let Some(fault) = tick(&mut diagnosis, &codes, &pressures, sent) {
            return Some((now, fault, sent));
        }
        cylinders.iter_mut().zip(sent).for_each(|(c, sent)| c.step(sent));
    }
    None
}

#[test]
fn an_hour_of_random_levers_on_delayed_ringing_stalling_cylinders_trips_nothing() {
    let (runs, seconds) = (60, 90);
    let mut trips = Vec::new();
    for seed in 0..runs {
        trips.extend(sluggish_run(seed, seconds, seed % 2 == 1).map(|trip| (seed, trip)));
    }
    println!(
        "delayed, ringing cylinders: {} false trips in {:.1} h",
        trips.len(),
        (runs as f64) * f64::from(seconds) / 3600.0
    );
    assert!(trips.is_empty(), "{trips:?}");
}

#[test]
fn an_hour_of_random_levers_on_the_harness_s_plant_trips_nothing() {
    let (runs, seconds) = (60, 60);
    let model = ActuatorModel {
        stroke: Some(Stroke { min_m: 0.0, max_m: STROKE_M }),
        dead_time_s: 0.1,
        spool_lag_s: 0.05,
        dead_band: [0.15, 0.2],
        full_speed: [FULL_MPS; 2],
    };
    let mut trips = Vec::new();
    for seed in 0..runs {
        let mut dice = Dice::new(seed);
        let mut noise = Noise::new(1000 + seed);
        let mut plant = [(); 4].map(|()| Actuator::new(model, dice.between(0.1, 1.1), 0.001));
        let mut levers = [(); 4].map(|()| Lever::new());
        let mut diagnosis = diagnosis();
        for now in 0..seconds * TICKS_PER_S {
            let mut sent = [0.0; 4];
            for (sent, lever) in sent.iter_mut().zip(&mut levers) {
                *sent = lever.at(now, &mut dice);
            }
            let codes = plant.each_ref().map(|c| code(c.position(), &mut noise));
            if let Some(fault) = tick(&mut diagnosis, &codes, &NO_PRESSURES, sent) {
                trips.push((seed, now, fault, sent));
                break;
            }
            for (actuator, sent) in plant.iter_mut().zip(sent) {
                let dead_band = if sent > 0.0 { 0.15 } else { 0.2 };
                let share = sent.abs() / FULL_MPS;
                let spool = if sent == 0.0 { 0.0 } else { sent.signum() * (dead_band + (1.0 - dead_band) * share) };
                actuator.step(spool, 0.001);
            }
        }
    }
    println!(
        "the harness's plant: {} false trips in {:.1} h",
        trips.len(),
        (runs as f64) * f64::from(seconds) / 3600.0
    );
    assert!(trips.is_empty(), "{trips:?}");
}

#[test]
fn a_machine_that_stands_still_for_ten_minutes_with_noise_neither_trips_nor_counts_as_moving() {
    let mut noise = Noise::new(5);
    let mut diagnosis = diagnosis();
    for now in 0..600 * TICKS_PER_S {
        let codes = [0.3, 0.6, 0.9, 0.1].map(|at| code(at, &mut noise));
        assert_eq!(tick(&mut diagnosis, &codes, &NO_PRESSURES, [0.0; 4]), None, "{now}");
        assert!(!diagnosis.moving(), "{now}");
    }
}

#[test]
fn the_measured_speed_follows_and_its_noise_is_a_tenth_of_the_margin() {
    let mut noise = Noise::new(9);
    let mut diagnosis = diagnosis();
    let mut squares = 0.0;
    for now in 0..20 * TICKS_PER_S {
        let at = 0.1 + 0.05 * f64::from(now) / 1000.0;
        tick(&mut diagnosis, &[code(at, &mut noise); 4], &NO_PRESSURES, [0.05; 4]);
        if now > 500 {
            let error = f64::from(diagnosis.speeds().boom) - 0.05;
            squares += error * error / f64::from(20 * TICKS_PER_S - 501);
        }
    }
    println!("measured speed: {:.1} mm/s RMS at {:.1} mm of noise", squares.sqrt() * 1e3, NOISE_M * 1e3);
    assert!(squares.sqrt() < 0.003);
}

/// The first fault of a cylinder at this speed (m/s over s), sent 0.3 m/s from 1 to 2 s if `driven`; it begins at 2.1 s.
fn swinging(driven: bool, speed_mps: impl Fn(f64) -> f64) -> Option<(u32, Fault)> {
    let mut noise = Noise::new(11);
    let mut diagnosis = diagnosis();
    let mut at = 0.2;
    (0..12 * TICKS_PER_S).find_map(|now| {
        let time_s = f64::from(now) / f64::from(TICKS_PER_S);
        let moved_mps = match time_s {
            t if t >= 2.1 => speed_mps(t - 2.1),
            t if t >= 1.1 && driven => 0.3,
            _ => 0.0,
        };
        at += moved_mps / f64::from(TICKS_PER_S);
        let sent = if driven && (1.0..2.0).contains(&time_s) { 0.3 } else { 0.0 };
        let codes = [0.6, at, 0.6, 0.6].map(|at| code(at, &mut noise));
        tick(&mut diagnosis, &codes, &NO_PRESSURES, [0.0, sent, 0.0, 0.0]).map(|fault| (now, fault))
    })
}

#[test]
fn a_released_mass_may_swing_on_for_ten_seconds_one_that_stood_may_not_and_none_may_drift() {
    let swing = |t: f64| 0.2 * (-0.15 * t).exp() * (core::f64::consts::TAU * 2.5 * t).cos();
    assert_eq!(swinging(true, swing), None);
    let (at, fault) = swinging(false, swing).expect("named");
    assert!(fault == Fault::Uncommanded(kinematics_core::Cylinder::Boom) && at < 2300, "{at} {fault:?}");
    // While it drifts it does not swing back: the memory of its swing fades.
    let drift = |t: f64| if t < 3.0 { swing(t) } else { 0.06 };
    let (at, fault) = swinging(true, drift).expect("named");
    assert!(fault == Fault::Uncommanded(kinematics_core::Cylinder::Boom) && at < 7000, "{at} {fault:?}");
}

#[test]
fn a_cylinder_that_slows_down_as_late_and_slowly_as_it_may_and_rings_the_while_trips_nothing_one_that_goes_on_does() {
    // Released at 2.0 s; what is given begins at 2.1 s.
    let line = |t: f64| 0.3 * (1.0 - ((t - 0.15) / 1.75).clamp(0.0, 1.0));
    for ring in [0.0, 0.2] {
        let ringing = |t: f64| line(t) * (1.0 + ring * (core::f64::consts::TAU * 2.0 * t).sin());
        assert_eq!(swinging(true, ringing), None, "{ring}");
    }
    let (at, fault) = swinging(true, |_| 0.3).expect("named");
    println!("a cylinder that goes on: named {} ms after its release", at - 2000);
    assert!(fault == Fault::Uncommanded(kinematics_core::Cylinder::Boom) && at < 2900, "{at} {fault:?}");
}
