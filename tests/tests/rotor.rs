//! `Rotor::from_turns` and `Rotor::angle`: as good as libm, the same on every host, and never stuck.

use std::f64::consts::{PI, TAU};

use cross_tests::sweep::Random;
use kinematics_core::{Real, Rotor};

/// sin and cos of a number of turns, whole turns taken off exactly.
fn exact(turns: f64) -> (f64, f64) {
    // Whole turns and quarters are exact in f64; only the last eighth is a rounded product with π.
    let rest = turns - libm::round(turns);
    let quarters = libm::round(4.0 * rest);
    let eighth = TAU * (rest - 0.25 * quarters);
    let (cos, sin) = (libm::cos(eighth), libm::sin(eighth));
    match quarters as i32 {
        0 => (cos, sin),
        1 => (-sin, cos),
        -1 => (sin, -cos),
        _ => (-cos, -sin),
    }
}

fn worst_within<T: Real>(largest: f64) -> f64 {
    let mut random = Random::new(21);
    let mut worst = 0.0f64;
    let mut see = |turns: f64| {
        let turns = T::from_f64(turns);
        let found = Rotor::from_turns(turns);
        let (cos, sin) = exact(turns.to_f64());
        worst = worst.max((found.cos.to_f64() - cos).abs()).max((found.sin.to_f64() - sin).abs());
    };
    for n in -80_000..=80_000 {
        see(largest * f64::from(n) / 80_000.0);
    }
    for _ in 0..400_000 {
        see(largest * (2.0 * random.unit() - 1.0));
    }
    for eighths in -16..=16 {
        for ulps in -3..=3 {
            see(f64::from(eighths) / 8.0 * (1.0 + f64::from(ulps) * 6e-8));
            see(f64::from(eighths) / 8.0 * (1.0 + f64::from(ulps) * 2.3e-16));
        }
    }
    worst
}

#[test]
fn turns_become_rotors_to_one_ulp_of_one() {
    for largest in [0.5, 1.0, 100.0] {
        let (single, double) = (worst_within::<f32>(largest), worst_within::<f64>(largest));
        println!("from_turns within ±{largest}: worst error f32 {single:.2e}, f64 {double:.2e}");
        assert!(single <= f64::from(f32::EPSILON) && double <= f64::EPSILON);
    }
}

#[test]
fn quarter_turns_are_exact() {
    for (turns, cos, sin) in
        [(0.0, 1.0, 0.0), (0.25, 0.0, 1.0), (0.5, -1.0, 0.0), (-0.5, -1.0, 0.0), (-0.25, 0.0, -1.0), (1.0, 1.0, 0.0)]
    {
        let found = Rotor::<f32>::from_turns(turns);
        assert_eq!((found.cos, found.sin), (cos, sin), "{turns}");
        let found = Rotor::<f64>::from_degrees(360.0 * f64::from(turns));
        assert_eq!((found.cos, found.sin), (f64::from(cos), f64::from(sin)), "{turns}");
    }
}

#[test]
fn degrees_and_radians_become_the_rotors_libm_gives() {
    for n in -7200..=7200 {
        let degrees = 0.1 * f64::from(n);
        let (cos, sin) = exact(degrees / 360.0);
        for found in [Rotor::<f64>::from_degrees(degrees), Rotor::<f64>::from_angle(degrees.to_radians())] {
            // The argument is rounded once more, at up to two turns.
            assert!((found.cos - cos).abs() < 4e-15 && (found.sin - sin).abs() < 4e-15, "{degrees}°: {found:?}");
        }
    }
}

#[test]
fn numbers_that_are_no_angle_return_and_give_no_finite_rotor() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let Rotor { cos, sin } = Rotor::from_turns(bad);
        assert!(!cos.is_finite() && !sin.is_finite(), "{bad}: {cos}, {sin}");
        let Rotor { cos, sin } = Rotor::from_turns(f64::from(bad));
        assert!(!cos.is_finite() && !sin.is_finite(), "{bad}: {cos}, {sin}");
    }
}

#[test]
fn many_turns_are_still_a_rotor() {
    // Every f32 from 2²³ on is a whole number of turns; below, quarters count exactly up to 2²².
    for turns in [1e3f32, 12_345.25, 1e5, 4_194_303.5, 4_194_304.0, 8_388_609.0, 5e8] {
        let found = Rotor::from_turns(turns);
        let (cos, sin) = exact(f64::from(turns));
        assert!(
            (f64::from(found.cos) - cos).abs() <= 1.2e-7 && (f64::from(found.sin) - sin).abs() <= 1.2e-7,
            "{turns}"
        );
    }
    for turns in [1e3f64, 1e6 + 0.1, 123_456_789.375, -5e8] {
        let found = Rotor::from_turns(turns);
        let (cos, sin) = exact(turns);
        assert!((found.cos - cos).abs() <= f64::EPSILON && (found.sin - sin).abs() <= f64::EPSILON, "{turns}");
    }
}

#[test]
fn beyond_five_hundred_million_turns_it_returns_and_does_not_pass_for_a_rotor() {
    // Where quarters no longer fit 32 bits the result is far from the unit circle or not finite.
    let passes = |cos: f64, sin: f64| (libm::hypot(cos, sin) - 1.0).abs() < 1e-3;
    for turns in [5.5e8f32, 6e8, 1e9, 1e20, f32::MAX, -1e9, f32::MIN] {
        let Rotor { cos, sin } = Rotor::from_turns(turns);
        assert!(!passes(f64::from(cos), f64::from(sin)), "{turns}: {cos}, {sin}");
    }
    for turns in [5.4e8, 6e8, 1e12, 1e300, -1e9, f64::MAX] {
        let Rotor { cos, sin } = Rotor::<f64>::from_turns(turns);
        assert!(!passes(cos, sin), "{turns}: {cos}, {sin}");
    }
}

#[test]
fn an_angle_lies_above_minus_half_a_turn_up_to_half_a_turn() {
    let zeros = [0.0f64, -0.0];
    for sin in zeros {
        assert_eq!(Rotor { cos: -1.0, sin }.angle(), PI);
        assert_eq!(Rotor { cos: 1.0, sin }.angle(), 0.0);
        assert_eq!(Rotor { cos: -1.0f32, sin: sin as f32 }.angle(), std::f32::consts::PI);
    }
    let mut random = Random::new(22);
    for n in 0..200_000 {
        // Some very near half a turn, to both sides.
        let angle = if n % 4 == 0 { PI * (1.0 - 1e-15 * random.unit()) } else { TAU * (random.unit() - 0.5) };
        let angle = if n % 8 < 4 { angle } else { -angle };
        let rotor = Rotor { cos: libm::cos(angle), sin: libm::sin(angle) };
        let found = rotor.angle();
        assert!(found > -PI && found <= PI);
        let around = (found - angle).abs();
        assert!(around < 1e-15 || (around - TAU).abs() < 1e-14, "{angle}: {found}");
        let found = Rotor { cos: rotor.cos as f32, sin: rotor.sin as f32 }.angle();
        assert!(found > -std::f32::consts::PI && found <= std::f32::consts::PI);
    }
}
