//! Isotropy: Hareesha's conditions, and all eight configurations of his chain.

use std::f64::consts::{PI, TAU};

use cross_tests::jacobians::jacobian;
use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::Rotor;
use kinematics_core::isotropic_configurations::{IsotropicConfiguration, isotropic_configurations};
use kinematics_core::isotropy::{condition_number, hareesha_18, hareesha_20, row_equality, row_orthogonality};

/// The chain of Hareesha 2015, section IV.
const SQRT_2: f64 = std::f64::consts::SQRT_2;
const HAREESHA: [f64; 3] = [SQRT_2, SQRT_2, 1.0];

/// (17) and half of (19) as the two parts of one number, by the trigonometric Jacobian.
fn conditions(lengths: [f64; 3], t3: f64, t4: f64) -> [f64; 2] {
    let [x, z] = jacobian(lengths, [0.0, t3, t4]);
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    [dot(x, z), 0.5 * (dot(x, x) - dot(z, z))]
}

#[test]
fn hareeshas_18_and_20_are_17_and_19_with_angles_from_the_boom_line() {
    let mut random = Random::new(17);
    let (mut by_relative, mut by_printed_19) = (0.0f64, 0.0f64);
    for _ in 0..2_000 {
        let lengths = [0.5 + random.unit(), 0.5 + random.unit(), 0.5 + random.unit()];
        let [t3, t4] = [TAU * random.unit(), TAU * random.unit()];
        let j = jacobian(lengths, [0.0, t3, t4]);
        let (arm, bucket) = (Rotor::from_angle(t3), Rotor::from_angle(t3 + t4));
        assert!((hareesha_18(lengths, arm, bucket) - row_orthogonality(&j)).abs() < 1e-13);
        assert!((hareesha_20(lengths, arm, bucket) - row_equality(&j)).abs() < 1e-13);
        // Read with θ4 relative to the arm, (18) is another equation.
        let relative = Rotor::from_angle(t4);
        by_relative = by_relative.max((hareesha_18(lengths, arm, relative) - row_orthogonality(&j)).abs());
        // (19) as printed, with an entry J33 that a 2 × 3 matrix does not have, taken as zero or as a pitch row's one.
        let [x, z] = j;
        let printed = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - z[0] * z[0] - z[1] * z[1];
        let worst = (printed - row_equality(&j)).abs().min((printed - 1.0 - row_equality(&j)).abs());
        by_printed_19 = by_printed_19.max(worst);
    }
    assert!(by_relative > 1.0 && by_printed_19 > 0.4, "{by_relative}, {by_printed_19}");
}

#[test]
fn a_chain_is_as_isotropic_at_any_boom_angle() {
    for t2 in [-1.0, 0.3, 2.5] {
        for found in isotropic_configurations(HAREESHA).into_iter().flatten() {
            let j = jacobian(HAREESHA, [t2, found.arm.angle(), found.bucket.angle()]);
            assert!((condition_number(&j).unwrap() - 1.0).abs() < 1e-14);
        }
    }
}

/// The wanted eight, by θ3 in degrees: (θ3, θ4, σ²), each with its mirror image.
const EIGHT: [[f64; 3]; 4] = [
    [94.199144430, 117.200570380, 1.853553391],
    [115.263174354, 163.157883764, 1.146446609],
    [124.975303851, 142.226659917, 1.048815536],
    [157.937808842, 128.592218308, 1.284517797],
];

#[test]
fn hareeshas_chain_has_eight_isotropic_configurations_where_jjt_is_sigma_squared_times_one() {
    let mut found: Vec<IsotropicConfiguration> = isotropic_configurations(HAREESHA).into_iter().flatten().collect();
    assert_eq!(found.len(), 8);
    found.sort_by(|l, r| l.arm.angle().total_cmp(&r.arm.angle()));
    let mirrored = EIGHT.iter().rev().map(|[t3, t4, square]| [-t3, -t4, *square]);
    for (found, [t3, t4, square]) in found.iter().zip(mirrored.chain(EIGHT)) {
        assert!((found.arm.angle().to_degrees() - t3).abs() < 1e-8, "{found:?}, not {t3}");
        assert!((found.bucket.angle().to_degrees() - t4).abs() < 1e-8, "{found:?}, not {t4}");
        assert!((found.sigma * found.sigma - square).abs() < 1e-8, "{found:?}, not {square}");
        let [x, z] = jacobian(HAREESHA, [0.7, found.arm.angle(), found.bucket.angle()]);
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let sigma_square = found.sigma * found.sigma;
        let off = [dot(x, x) - sigma_square, dot(z, z) - sigma_square, dot(x, z)];
        assert!(off.iter().all(|off| off.abs() < 1e-12), "{off:?}");
        // Hareesha (16), JJᵀ = I, holds at none of them.
        assert!((sigma_square - 1.0).abs() > 0.04);
    }
}

/// Zeros of the two conditions by Newton's method with differences, from a dense grid of starts: (θ3, θ4) in (−π, π].
fn by_newton(lengths: [f64; 3]) -> Vec<[f64; 2]> {
    const STARTS: u32 = 48;
    let mut roots: Vec<[f64; 2]> = Vec::new();
    for start in 0..STARTS * STARTS {
        let mut at = [start / STARTS, start % STARTS].map(|n| TAU * f64::from(n) / f64::from(STARTS));
        for _ in 0..40 {
            let [f, g] = conditions(lengths, at[0], at[1]);
            let h = 1e-6;
            let slope = |k: usize| {
                let (mut up, mut down) = (at, at);
                (up[k], down[k]) = (at[k] + h, at[k] - h);
                let (up, down) = (conditions(lengths, up[0], up[1]), conditions(lengths, down[0], down[1]));
                [(up[0] - down[0]) / (2.0 * h), (up[1] - down[1]) / (2.0 * h)]
            };
            let ([a, c], [b, d]) = (slope(0), slope(1));
            let det = a * d - b * c;
            at = [at[0] - (d * f - b * g) / det, at[1] - (a * g - c * f) / det];
        }
        let [f, g] = conditions(lengths, at[0], at[1]);
        let at = at.map(|x| x - TAU * ((x - PI) / TAU).ceil());
        let known =
            |known: &[f64; 2]| known.iter().zip(at).all(|(k, x)| ((k - x + PI).rem_euclid(TAU) - PI).abs() < 1e-7);
        if f.abs() + g.abs() < 1e-11 && !roots.iter().any(known) {
            roots.push(at);
        }
    }
    roots
}

/// How often the two conditions turn about zero along the border of each cell of a grid over all angles: the cells
/// where they do, that is those with a zero inside, counted with the turn.
fn turning_cells(lengths: [f64; 3]) -> (usize, i32) {
    const CELLS: i32 = 90;
    const STEPS: i32 = 16;
    // The grid starts off the zeros.
    let angle = |n: f64| 0.0123 + TAU * n / f64::from(CELLS);
    let (mut cells, mut sum) = (0, 0);
    for i in 0..CELLS {
        for k in 0..CELLS {
            let (i, k) = (f64::from(i), f64::from(k));
            let mut border = Vec::new();
            for step in 0..STEPS {
                let t = f64::from(step) / f64::from(STEPS);
                border.push((t, [i + t, k]));
                border.push((1.0 + t, [i + 1.0, k + t]));
                border.push((2.0 + t, [i + 1.0 - t, k + 1.0]));
                border.push((3.0 + t, [i, k + 1.0 - t]));
            }
            border.sort_by(|l, r| l.0.total_cmp(&r.0));
            let values: Vec<[f64; 2]> =
                border.iter().map(|(_, [x, y])| conditions(lengths, angle(*x), angle(*y))).collect();
            let turned: f64 = values
                .iter()
                .zip(values.iter().cycle().skip(1))
                .map(|(a, b)| libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]))
                .sum();
            let turns = (turned / TAU).round() as i32;
            if turns != 0 {
                cells += 1;
                sum += turns;
            }
        }
    }
    (cells, sum)
}

fn same_as_newton(lengths: [f64; 3]) -> usize {
    let found: Vec<[f64; 2]> =
        isotropic_configurations(lengths).into_iter().flatten().map(|c| [c.arm.angle(), c.bucket.angle()]).collect();
    let searched = by_newton(lengths);
    assert_eq!(found.len(), searched.len(), "{lengths:?}: {found:?}, by Newton {searched:?}");
    for one in &searched {
        let near =
            |other: &&[f64; 2]| one.iter().zip(**other).all(|(a, b)| ((a - b + PI).rem_euclid(TAU) - PI).abs() < 1e-7);
        assert!(found.iter().find(near).is_some(), "{lengths:?}: {one:?} is not among {found:?}");
    }
    found.len()
}

#[test]
fn newton_from_2304_starts_and_turning_numbers_over_all_angles_count_the_same_eight() {
    assert_eq!(same_as_newton(HAREESHA), 8);
    // Each zero turns once, half of them backwards: on a torus the turns add up to nothing.
    assert_eq!(turning_cells(HAREESHA), (8, 0));
}

#[test]
fn newton_finds_the_same_configurations_of_random_chains_and_of_all_machines() {
    let mut random = Random::new(19);
    let mut counts = [0; 9];
    for _ in 0..30 {
        let lengths = [0.3 + random.unit(), 0.3 + random.unit(), 0.3 + random.unit()];
        counts[same_as_newton(lengths)] += 1;
    }
    assert!(counts[0] > 0 && counts[4] > 0 && counts[8] > 0, "the random chains show too little: {counts:?}");
    for (name, g) in machines::all().unwrap() {
        println!("{name}: {} isotropic configurations", same_as_newton([g.boom_m, g.arm_m, g.bucket_m]));
    }
}

#[test]
fn a_chain_with_a_short_arm_has_all_the_configurations_newton_does() {
    assert!(same_as_newton([1.3, 0.9, 0.8]) > 0);
}

#[test]
fn what_is_found_of_chains_of_any_proportion_is_isotropic_by_the_trigonometric_jacobian() {
    let mut random = Random::new(103);
    let (mut found, mut chains) = (0, 0);
    for _ in 0..300 {
        let lengths = [0.4 + random.unit(), 0.4 + random.unit(), 0.4 + random.unit()];
        let all: Vec<IsotropicConfiguration> = isotropic_configurations(lengths).into_iter().flatten().collect();
        for one in &all {
            let (arm, bucket) = (one.arm.angle(), one.bucket.angle());
            let j = jacobian(lengths, [0.3, arm, bucket]);
            let condition = condition_number(&j).unwrap();
            assert!((condition - 1.0).abs() < 1e-7, "{lengths:?} {one:?}: {condition}");
            let [x, _] = j;
            assert!((x.iter().map(|a| a * a).sum::<f64>().sqrt() - one.sigma).abs() < 1e-7, "{one:?}");
        }
        // With each its mirror image.
        assert!(all.len().is_multiple_of(2), "{lengths:?}");
        (found, chains) = (found + all.len(), chains + usize::from(!all.is_empty()));
    }
    println!("{found} of {chains} chains");
    assert!(chains > 50 && found >= 4 * chains / 2, "{found} {chains}");
}

#[test]
fn lengths_that_are_no_lengths_have_no_configurations() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for place in 0..3 {
            let mut lengths = HAREESHA;
            lengths[place] = bad;
            assert!(isotropic_configurations(lengths).iter().all(Option::is_none), "{lengths:?}");
        }
    }
}
