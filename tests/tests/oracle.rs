//! The reference itself: enough bits, and pins that keep their distances.

use cross_tests::machines;
use cross_tests::oracle::Oracle;
use cross_tests::sweep::Random;
use cross_tests::wide::Wide;

/// Relative error allowed to one operation: 2⁻⁹⁸.
const ONE_OPERATION: f64 = 3.2e-30;

fn wide(random: &mut Random) -> Wide {
    // Both parts filled: a f64 plus one 2⁻⁵³ of it.
    Wide::from_f64(0.5 + random.unit()) + Wide::from_f64(random.unit() * 1e-16)
}

fn relative(found: Wide, exact: Wide) -> f64 {
    ((found - exact) / exact).to_f64().abs()
}

#[test]
fn a_product_of_two_integers_of_53_bits_is_exact() {
    let mut random = Random::new(2);
    for _ in 0..10_000 {
        let (a, b) = (random.bits() >> 11, random.bits() >> 11);
        let product = u128::from(a) * u128::from(b);
        let found = Wide::from_f64(a as f64) * Wide::from_f64(b as f64);
        // Taken apart into f64s that hold their part exactly.
        let (high, low) = (product >> 64 << 64, product & u128::from(u64::MAX));
        let low = (low >> 32 << 32, low & 0xffff_ffff);
        let exact = Wide::from_f64(high as f64) + Wide::from_f64(low.0 as f64) + Wide::from_f64(low.1 as f64);
        assert!(relative(found, exact) < ONE_OPERATION, "{a} × {b}");
    }
}

#[test]
fn quotients_and_roots_are_good_to_98_bits() {
    let mut random = Random::new(3);
    let (mut quotient, mut root) = (0.0f64, 0.0f64);
    for _ in 0..100_000 {
        let (a, b) = (wide(&mut random), wide(&mut random));
        quotient = quotient.max(relative(a / b * b, a));
        let r = a.sqrt();
        // The square doubles a relative error.
        root = root.max(0.5 * relative(r * r, a));
    }
    println!("worst relative error: quotient {quotient:.1e}, root {root:.1e} (2⁻⁹⁸ = {:.1e})", 0.5f64.powi(98));
    assert!(quotient < ONE_OPERATION && root < ONE_OPERATION);
}

#[test]
fn the_oracles_pins_keep_their_distances_to_1e_30_m_over_the_whole_stroke() {
    for (name, g) in machines::all().unwrap() {
        let oracle = Oracle::new(&g);
        let mut random = Random::new(4);
        let mut worst = 0.0f64;
        for n in 0..2000 {
            let lengths = [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| {
                let part = match n {
                    0 => 0.0,
                    1 => 1.0,
                    _ => random.unit(),
                };
                s.min_m + part * (s.max_m - s.min_m)
            });
            worst = oracle.residuals(lengths).iter().fold(worst, |worst, miss| worst.max(miss.abs()));
        }
        println!("{name}: pins miss their distances by at most {worst:.1e} m");
        assert!(worst < 1e-30, "{name}: {worst:e}");
    }
}

#[test]
fn the_oracles_two_directions_agree_to_1e_28_m() {
    for (name, g) in machines::all().unwrap() {
        let oracle = Oracle::new(&g);
        let mut random = Random::new(5);
        for _ in 0..2000 {
            let lengths =
                [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| s.min_m + random.unit() * (s.max_m - s.min_m));
            let placed = oracle.forward(lengths);
            let back = oracle.inverse(placed.tip, placed.pitch);
            for (found, sent) in back.into_iter().zip(lengths) {
                assert!((found - Wide::from_f64(sent)).to_f64().abs() < 1e-28, "{name} at {lengths:?}");
            }
        }
    }
}

#[test]
fn twofloats_own_quotient_keeps_only_53_bits() {
    // Why `Wide` divides for itself; once this fails, it need not.
    let mut random = Random::new(6);
    let worst = (0..10_000).fold(0.0f64, |worst, _| {
        let (a, b) = (twofloat::TwoFloat::from(random.unit() + 0.5), twofloat::TwoFloat::from(random.unit() + 0.5));
        worst.max(((a / b * b - a) / a.hi()).hi().abs())
    });
    println!("twofloat's quotient: worst relative error {worst:.1e}");
    assert!(worst > 1e-18);
}
