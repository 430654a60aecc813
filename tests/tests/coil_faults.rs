//! The faults of a coil: each is named in its time, and a healthy coil never.

use firmware::io::Speeds;
use firmware::supervisor::Gate;
use firmware::valve::coil_fault::{CoilFault, FaultyCoil};
use firmware::valve::coil_stage::CoilStage;
use firmware::valve::coil_watch::{CoilWatch, Given, WatchLimits};
use firmware::valve::interlock::Side;
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

/// A stage whose arm spool was driven outwards for a while and now inwards, and codes by currents.
fn turned_round() -> (CoilStage, impl Fn([f32; 2]) -> [[u16; 2]; 4]) {
    let p = parameters();
    let mut stage = CoilStage::new(&p).unwrap();
    let code = move |current_a: f32| p.sense.zero_code + (current_a / p.sense.full_scale_a * 65536.0) as u16;
    let codes = move |arm: [f32; 2]| [[code(0.0); 2], [code(0.0); 2], arm.map(code), [code(0.0); 2]];
    for tick in 0_u8..100 {
        // Rises in 20 ms to a little less than wanted, as a coil might.
        let current_a = if tick < 20 { 0.0495 * f32::from(tick) } else { 0.99 };
        let driven = stage.drive(Gate::Open, &Speeds { arm: 0.8, ..Speeds::ZERO }, 24.0, &codes([current_a, 0.0]));
        assert_eq!(driven.fault, None);
    }
    for _ in 0..3 {
        assert_eq!(stage.drive(Gate::Open, &INWARDS, 24.0, &codes([0.0, 0.0])).fault, None);
    }
    (stage, codes)
}

const INWARDS: Speeds = Speeds { arm: -0.8, ..Speeds::ZERO };

#[test]
fn two_currents_in_one_spool_are_a_cross_where_each_alone_could_be_right() {
    let (mut stage, codes) = turned_round();
    let short_ticks = usize::from(parameters().watch.short_ticks);
    let faults: Vec<_> =
        (0..short_ticks).map(|_| stage.drive(Gate::Open, &INWARDS, 24.0, &codes([0.5, 0.5])).fault).collect();
    assert!(faults.iter().rev().skip(1).all(Option::is_none), "{faults:?}");
    let cross = faults.last().copied().flatten().unwrap();
    assert_eq!(cross, FaultyCoil { spool: 2, side: Side::Extend, fault: CoilFault::Cross });
    assert_eq!(cross.to_string(), "arm_extend_coil_cross");
}

#[test]
fn the_most_urgent_of_several_faults_is_named() {
    let (mut stage, codes) = turned_round();
    let mut last = None;
    for _ in 0..60 {
        let mut now = codes([0.0, 0.0]);
        // The bucket's coil reads a current nobody gave it, while the arm's stays without.
        now[3][1] = 40_000;
        last = stage.drive(Gate::Open, &INWARDS, 24.0, &now).fault;
    }
    assert_eq!(last, Some(FaultyCoil { spool: 3, side: Side::Retract, fault: CoilFault::ShortToSupply }));
}

#[test]
fn more_current_than_allowed_is_named_though_the_voltage_explains_it() {
    let p = parameters();
    let limits = WatchLimits::new(&p.watch, &p.coil, 2.3);
    let mut watch = CoilWatch::default();
    let given = Given { volts: 12.0, wanted_a: 1.0, duty: 30_000 };
    let named: Vec<_> = (0..p.watch.short_ticks).map(|_| watch.judge(&limits, &given, 1.8)).collect();
    assert_eq!(named.iter().position(Option::is_some), Some(usize::from(p.watch.short_ticks) - 1));
    assert_eq!(named.last().copied().flatten(), Some(CoilFault::OverCurrent));
}

#[test]
fn a_few_bad_samples_are_no_fault() {
    let p = parameters();
    let limits = WatchLimits::new(&p.watch, &p.coil, 2.3);
    let mut watch = CoilWatch::default();
    for tick in 0..10_000 {
        let given = Given { volts: 5.0, wanted_a: 0.9, duty: 30_000 };
        let measured = if tick % 6 == 0 { 0.9 } else { 2.2 };
        assert_eq!(watch.judge(&limits, &given, measured), None);
    }
    assert_eq!(watch.judge(&limits, &Given::NOTHING, 0.0), None);
}

#[test]
fn every_fault_of_every_coil_has_its_own_name_and_byte() {
    let mut names = std::collections::BTreeSet::new();
    for (fault, spool, side) in CoilFault::ALL
        .into_iter()
        .flat_map(|fault| (0..4).flat_map(move |spool| Side::BOTH.map(|side| (fault, spool, side))))
    {
        let faulty = FaultyCoil { spool, side, fault };
        assert_eq!(FaultyCoil::from_code(faulty.code()), Some(faulty));
        assert!(names.insert(faulty.to_string()), "{faulty}");
    }
    assert_eq!(names.len(), 48);
    let known = (0..=u8::MAX).filter(|&code| FaultyCoil::from_code(code).is_some()).count();
    assert_eq!(known, 48);
}
