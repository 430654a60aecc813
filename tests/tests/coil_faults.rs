//! The faults of a coil: each is named in its time, and a healthy coil never.

use firmware::io::Speeds;
use firmware::supervisor::Gate;
use firmware::valve::coil_fault::{CoilFault, CoilWatch, Given};
use firmware::valve::coil_stage::CoilStage;
use firmware::valve::number::{Q, q};
use hil_sim::coil_trial::{Surroundings, Trial, fault_times, parameters};
use hil_sim::plant::coil::SupplyModel;

#[test]
fn every_fault_is_called_what_it_is_in_its_time_at_any_supply_and_temperature() {
    for (volts, temperature_c) in [(24.0, 20.0), (12.0, -40.0), (28.0, 120.0), (32.0, -40.0)] {
        let mut surroundings = Surroundings { temperature_c, ..Surroundings::USUAL };
        surroundings.supply.volts = volts;
        for row in fault_times(&surroundings).unwrap() {
            println!("{volts} V {temperature_c} °C {row:?}");
            assert!(row.right, "{row:?}");
            let most_s = match row.named.as_deref() {
                Some("boom_extend_coil_open") => 0.050,
                Some("boom_extend_coil_saturated") => 0.600,
                _ => 0.020,
            };
            assert!(row.time_s.unwrap() <= most_s, "{row:?}");
        }
    }
}

/// Currents asked for, A: off, jumps, small and large steps, both directions.
const WISHES_A: [f64; 14] = [0.0, 0.3, 1.0, 0.25, 0.0, -0.3, -1.05, -0.5, 0.9, -0.9, 0.0, 0.6, 0.62, -0.24];

#[test]
fn a_healthy_coil_never_has_a_fault() {
    let mut ticks = 0_u32;
    for temperature_c in [-40.0, 0.0, 20.0, 70.0, 120.0] {
        for volts in [9.6, 12.0, 18.0, 24.0, 32.0] {
            for (ripple_v, ripple_hz) in [(0.0, 100.0), (0.05, 97.0), (0.05, 333.0), (0.05, 1000.0), (0.05, 1499.0)] {
                for dither_hz in [0.0_f32, 62.5, 100.0] {
                    let mut p = parameters();
                    if dither_hz > 0.0 {
                        let dither = &mut p.spools[1].dither;
                        (dither.frequency_hz, dither.amplitude_a, dither.fade_below_a) = (dither_hz, 0.05, 0.3);
                    }
                    let supply = SupplyModel { volts, ripple_v: ripple_v * volts, ripple_hz };
                    let mut t = Trial::new(&p, Surroundings { supply, temperature_c, seed: ticks.into() }).unwrap();
                    for (current_a, hold) in WISHES_A.into_iter().zip([150, 20, 90].into_iter().cycle()) {
                        for sample in t.run(current_a, hold) {
                            ticks += 1;
                            assert_eq!(
                                sample.fault, None,
                                "{temperature_c} °C {volts} V ripple {ripple_v} {ripple_hz} Hz dither {dither_hz}: {sample:?}"
                            );
                        }
                    }
                }
            }
        }
    }
    println!("{ticks} ticks");
    assert!(ticks > 400_000);
}

#[test]
fn two_currents_in_one_spool_are_a_cross_when_nothing_else_is_wrong() {
    let p = parameters();
    let mut stage = CoilStage::new(&p).unwrap();
    let code = |current_a: f32| p.sense.zero_code + (current_a / p.sense.full_scale_a * 65536.0) as u16;
    let mut codes = [[code(0.0); 2]; 4];
    let speeds = Speeds { arm: 0.5, ..Speeds::ZERO };
    for _ in 0..60 {
        codes[2][0] = code(0.6);
        assert_eq!(stage.drive(Gate::Open, &speeds, 24.0, &codes).fault.map(|f| f.fault), None);
    }
    // Small enough to be nobody's excess on its own: it is only a cross while the watch still allows for it.
    codes[2][1] = code(1.0);
    let named: Vec<CoilFault> =
        (0..10).filter_map(|_| stage.drive(Gate::Open, &speeds, 24.0, &codes).fault.map(|f| f.fault)).collect();
    assert!(
        !named.is_empty() && named.iter().all(|f| matches!(f, CoilFault::Cross | CoilFault::ShortToSupply)),
        "{named:?}"
    );
}

#[test]
fn more_current_than_allowed_is_named_though_the_voltage_explains_it() {
    let p = parameters();
    let mut watch = CoilWatch::new(&p.watch, &p.coil, 2.3);
    let given = Given { volts: q(12.0), wanted: q(1.0), at_limit: false };
    let named: Vec<_> = (0..p.watch.short_ticks).map(|_| watch.judge(&given, q(1.8))).collect();
    assert_eq!(named.iter().position(Option::is_some), Some(usize::from(p.watch.short_ticks) - 1));
    assert_eq!(named.last().copied().flatten(), Some(CoilFault::OverCurrent));
}

#[test]
fn a_few_bad_samples_are_no_fault() {
    let p = parameters();
    let mut watch = CoilWatch::new(&p.watch, &p.coil, 2.3);
    for tick in 0..10_000 {
        let given = Given { volts: q(5.0), wanted: q(0.9), at_limit: false };
        let measured = if tick % 6 == 0 { q(0.9) } else { q(2.2) };
        assert_eq!(watch.judge(&given, measured), None);
    }
    assert_eq!(watch.judge(&Given::NOTHING, Q::ZERO), None);
}

#[test]
fn every_name_is_its_own() {
    let names = CoilFault::ALL.map(CoilFault::name);
    assert!(names.iter().enumerate().all(|(i, a)| names.iter().skip(i + 1).all(|b| a != b)));
}
