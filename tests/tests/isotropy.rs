//! Singular values, ellipses and isotropy: over random Jacobians, Hareesha's chain and all four machines.

use std::f64::consts::{PI, TAU};

use cross_tests::machines;
use cross_tests::sweep::Random;
use cross_tests::wide::Wide;
use hil_sim::machine_report::isotropic::{ArmPose, isotropy};
use kinematics_core::isotropic_configurations::{IsotropicConfiguration, isotropic_configurations};
use kinematics_core::isotropy::{
    condition_number, force_ellipse, hareesha_18, hareesha_20, manipulability, row_equality, row_orthogonality,
    singularity_distance, velocity_ellipse,
};
use kinematics_core::svd::Singular;
use kinematics_core::svd3::{svd3, symmetric_eigen};
use kinematics_core::{Cylinders, Machine, PinGeometry, Real, Rotor};

/// The chain of Hareesha 2015, section IV.
const SQRT_2: f64 = std::f64::consts::SQRT_2;
const HAREESHA: [f64; 3] = [SQRT_2, SQRT_2, 1.0];

/// Hareesha 2015 (12) by sines and cosines of absolute angles: independent of every rotor.
fn jacobian([l2, l3, l4]: [f64; 3], [t2, t3, t4]: [f64; 3]) -> [[f64; 3]; 2] {
    let links = [(l2, t2), (l3, t2 + t3), (l4, t2 + t3 + t4)];
    let sum = |from: usize, part: fn(f64) -> f64| links[from..].iter().map(|(l, t)| l * part(*t)).sum::<f64>();
    [[0, 1, 2].map(|k| -sum(k, libm::sin)), [0, 1, 2].map(|k| sum(k, libm::cos))]
}

/// (17) and half of (19) as the two parts of one number, by the trigonometric Jacobian.
fn conditions(lengths: [f64; 3], t3: f64, t4: f64) -> [f64; 2] {
    let [x, z] = jacobian(lengths, [0.0, t3, t4]);
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    [dot(x, z), 0.5 * (dot(x, x) - dot(z, z))]
}

fn rounded<T: Real, const N: usize>(j: &[[f64; N]; 2]) -> [[T; N]; 2] {
    j.map(|row| row.map(T::from_f64))
}

/// Singular values in double-double arithmetic from the same numbers: (trace ± √(trace² − 4 det))/2 with 100 bits to lose.
fn exact_singular<T: Real, const N: usize>(j: &[[T; N]; 2]) -> [f64; 2] {
    let wide = |x: T| Wide::from_f64(x.to_f64());
    let dot =
        |a: &[T; N], b: &[T; N]| a.iter().zip(b).fold(Wide::from_f64(0.0), |sum, (a, b)| sum + wide(*a) * wide(*b));
    let [x, z] = j;
    let (p, q, r) = (dot(x, x), dot(x, z), dot(z, z));
    let two = Wide::from_f64(2.0);
    let (half, shear) = ((p - r) / two, q);
    let largest_square = (p + r) / two + (half * half + shear * shear).sqrt();
    let mut det = Wide::from_f64(0.0);
    for i in 0..N {
        for k in i + 1..N {
            let minor = wide(x[i]) * wide(z[k]) - wide(x[k]) * wide(z[i]);
            det = det + minor * minor;
        }
    }
    [largest_square.sqrt().to_f64(), (det / largest_square).sqrt().to_f64()]
}

/// u₁ at a random angle, both singular values given: J = U·diag(σ)·Vᵀ with a random orthonormal V.
fn with_singular<const N: usize>(random: &mut Random, sigma: [f64; 2]) -> [[f64; N]; 2] {
    let mut v = [[0.0; N]; 2].map(|row| row.map(|_: f64| random.unit() - 0.5));
    let dot = |a: &[f64; N], b: &[f64; N]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let [first, second] = &mut v;
    let norm = dot(first, first).sqrt();
    first.iter_mut().for_each(|x| *x /= norm);
    let along = dot(first, second);
    second.iter_mut().zip(*first).for_each(|(x, y)| *x -= along * y);
    let norm = dot(second, second).sqrt();
    second.iter_mut().for_each(|x| *x /= norm);
    let angle = TAU * random.unit();
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let mut j = [[0.0; N]; 2];
    for k in 0..N {
        let (a, b) = (sigma[0] * v[0][k], sigma[1] * v[1][k]);
        j[0][k] = c * a - s * b;
        j[1][k] = s * a + c * b;
    }
    j
}

/// The worst errors of σ₁ and σ₂ relative to σ₁, in units of `ulp`, over condition numbers up to `worst`.
fn singular_errors<T: Real, const N: usize>(ulp: f64, worst: f64) -> [f64; 2] {
    let mut random = Random::new(7 + N as u64);
    let mut errors = [0.0f64; 2];
    for _ in 0..20_000 {
        let scale = 10f64.powf(2.0 * random.unit() - 1.0);
        let condition = worst.powf(random.unit());
        let j = rounded::<T, N>(&with_singular::<N>(&mut random, [scale, scale / condition]));
        let exact = exact_singular(&j);
        let found = Singular::of(&j);
        for (error, (found, expected)) in errors.iter_mut().zip([found.largest, found.smallest].iter().zip(exact)) {
            *error = error.max((found.to_f64() - expected).abs() / (ulp * exact[0]));
        }
        let unit = found.direction.to_vec().norm_squared().to_f64();
        assert!((unit - 1.0).abs() < 8.0 * ulp, "a direction of length² {unit}");
    }
    errors
}

#[test]
fn both_singular_values_are_right_to_two_ulp_of_the_largest() {
    let (f32_ulp, f64_ulp) = (f64::from(f32::EPSILON), f64::EPSILON);
    let all = [
        ("f32, N = 2", singular_errors::<f32, 2>(f32_ulp, 1e6)),
        ("f32, N = 3", singular_errors::<f32, 3>(f32_ulp, 1e6)),
        ("f32, N = 6", singular_errors::<f32, 6>(f32_ulp, 1e6)),
        ("f64, N = 2", singular_errors::<f64, 2>(f64_ulp, 1e13)),
        ("f64, N = 3", singular_errors::<f64, 3>(f64_ulp, 1e13)),
        ("f64, N = 6", singular_errors::<f64, 6>(f64_ulp, 1e13)),
    ];
    for (name, [largest, smallest]) in all {
        println!("{name}: sigma 1 {largest:.2} ulp, sigma 2 {smallest:.2} ulp");
        assert!(largest < 2.0 && smallest < 2.0, "{name}: {largest} and {smallest} ulp");
    }
}

fn near_isotropy<T: Real>(ulp: f64) -> (f64, f64) {
    let mut random = Random::new(11);
    let (mut ours, mut from_determinant) = (0.0f64, 0.0f64);
    for _ in 0..20_000 {
        let condition = 1.0 + 10f64.powf(-3.0 - 9.0 * random.unit());
        let j = rounded::<T, 3>(&with_singular::<3>(&mut random, [condition, 1.0]));
        let exact = exact_singular(&j);
        let expected = exact[0] / exact[1];
        ours = ours.max((condition_number(&j).unwrap().to_f64() - expected).abs() / ulp);
        // What one would write first: the eigenvalues of JJᵀ as mean ± √(mean² − det).
        let dot = |a: &[T; 3], b: &[T; 3]| a.iter().zip(b).fold(T::ZERO, |sum, (a, b)| sum + *a * *b);
        let (p, q, r) = (dot(&j[0], &j[0]), dot(&j[0], &j[1]), dot(&j[1], &j[1]));
        let mean = (p + r) * T::from_f64(0.5);
        let under = mean * mean - (p * r - q * q);
        let root = if under > T::ZERO { under.sqrt() } else { T::ZERO };
        let naive = ((mean + root) / (mean - root)).sqrt().to_f64();
        from_determinant = from_determinant.max((naive - expected).abs() / ulp);
    }
    (ours, from_determinant)
}

#[test]
fn a_condition_number_near_one_is_right_to_four_epsilon_where_the_determinants_form_loses_half_the_digits() {
    let all = [
        ("f32", f64::from(f32::EPSILON), near_isotropy::<f32>(f64::from(f32::EPSILON))),
        ("f64", f64::EPSILON, near_isotropy::<f64>(f64::EPSILON)),
    ];
    for (name, ulp, (ours, naive)) in all {
        println!("{name}: ours {ours:.2} epsilon, from the determinant {naive:.2e} epsilon");
        assert!(ours < 4.0, "{name}: {ours} epsilon");
        assert!(naive > 0.2 / ulp.sqrt(), "{name}: the plain form is better than stated, {naive} epsilon");
    }
}

fn ellipses_hold<T: Real, const N: usize>(random: &mut Random, within: f64) {
    let sigma = [1.0 + 9.0 * random.unit(), 0.05 + 0.95 * random.unit()];
    let j = rounded::<T, N>(&with_singular::<N>(random, sigma));
    let (fast, strong) = (velocity_ellipse(&j), force_ellipse(&j).unwrap());
    let product = |a: &[T; N], b: &[T; N]| a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a.to_f64() * b.to_f64());
    let found = Singular::of(&j);
    let [first, second] = found.joint_directions(&j).unwrap();
    // Directions and sizes of the short axis carry the rounding of the long one.
    let within = within * sigma[0] / sigma[1];
    let stretched = |a: f64, b: f64| (a - b).abs() <= within * b.abs().max(1.0);
    // Unit joint rates, perpendicular to each other, that move the tip along both axes.
    assert!(stretched(product(&first, &first), 1.0) && stretched(product(&second, &second), 1.0));
    assert!(product(&first, &second).abs() < 40.0 * within);
    let along = |v: &[T; N], u: Rotor<T>| product(&j[0], v) * u.cos.to_f64() + product(&j[1], v) * u.sin.to_f64();
    assert!(stretched(along(&first, fast.direction), fast.major.to_f64()));
    assert!(along(&first, found.across()).abs() < 10.0 * within);
    assert!(stretched(along(&second, found.across()), fast.minor.to_f64()));
    // Hareesha (21): a force on the ellipse's end needs torques of length one.
    for (size, direction) in [
        (strong.major, strong.direction),
        (strong.minor, Rotor { cos: -strong.direction.sin, sin: strong.direction.cos }),
    ] {
        let torque: f64 = (0..N)
            .map(|k| (j[0][k].to_f64() * direction.cos.to_f64() + j[1][k].to_f64() * direction.sin.to_f64()).powi(2))
            .sum();
        assert!(stretched(size.to_f64() * torque.sqrt(), 1.0), "{size:?} N along {direction:?}");
    }
    // One number for all of it.
    let condition = condition_number(&j).unwrap().to_f64();
    let distance = singularity_distance(&j).to_f64();
    assert!(stretched(distance, 2.0 / (condition + 1.0 / condition)));
    assert!(distance * condition >= 1.0 - within && distance * condition < 2.0 + within);
    assert!(stretched(manipulability(&j).to_f64(), (fast.major * fast.minor).to_f64()));
}

#[test]
fn ellipses_are_what_unit_joint_rates_and_torques_reach() {
    let mut random = Random::new(5);
    for _ in 0..5_000 {
        ellipses_hold::<f64, 2>(&mut random, 1e-14);
        ellipses_hold::<f64, 3>(&mut random, 1e-14);
        ellipses_hold::<f64, 6>(&mut random, 1e-14);
        ellipses_hold::<f32, 3>(&mut random, 4e-6);
    }
}

#[test]
fn a_singular_jacobian_has_no_condition_number_and_no_force_ellipse() {
    for j in [[[0.0f32; 3]; 2], [[3.0, 2.0, 1.0], [0.0; 3]], [[3.0, 2.0, 1.0], [6.0, 4.0, 2.0]]] {
        assert_eq!(condition_number(&j), None);
        assert_eq!(force_ellipse(&j), None);
        assert_eq!(Singular::of(&j).joint_directions(&j), None);
        assert_eq!((singularity_distance(&j), manipulability(&j)), (0.0, 0.0));
        assert!(velocity_ellipse(&j).direction.to_vec().norm() > 0.999);
    }
}

fn matrix3<T: Real>(random: &mut Random) -> [[T; 3]; 3] {
    [[0; 3]; 3].map(|row| row.map(|_| T::from_f64(4.0 * random.unit() - 2.0)))
}

fn product3<T: Real>(a: &[[T; 3]; 3], v: &[T; 3]) -> [f64; 3] {
    a.map(|row| row.iter().zip(v).map(|(a, v)| a.to_f64() * v.to_f64()).sum())
}

fn off_orthonormal<T: Real>(axes: &[[T; 3]; 3]) -> f64 {
    let mut worst = 0.0f64;
    for (i, a) in axes.iter().enumerate() {
        for (k, b) in axes.iter().enumerate() {
            let dot: f64 = a.iter().zip(b).map(|(a, b)| a.to_f64() * b.to_f64()).sum();
            worst = worst.max((dot - if i == k { 1.0 } else { 0.0 }).abs());
        }
    }
    worst
}

fn three_by_three<T: Real>(within: f64) {
    let mut random = Random::new(13);
    for round in 0..5_000 {
        let m = matrix3::<T>(&mut random);
        let mut symmetric = m;
        for i in 0..3 {
            for k in 0..3 {
                symmetric[i][k] = m[i.min(k)][i.max(k)];
            }
        }
        if round % 3 == 0 {
            // A double eigenvalue: 2·I − 3·n·nᵀ
            let n = m[0];
            for i in 0..3 {
                for k in i..3 {
                    let unit = if i == k { T::from_i32(2) } else { T::ZERO };
                    symmetric[i][k] = unit - T::from_i32(3) * n[i] * n[k];
                    symmetric[k][i] = symmetric[i][k];
                }
            }
        }
        let eigen = symmetric_eigen(&symmetric);
        let size = eigen.values.iter().fold(1.0, |s: f64, v| s.max(v.to_f64().abs()));
        assert!(eigen.values[0] >= eigen.values[1] && eigen.values[1] >= eigen.values[2]);
        assert!(off_orthonormal(&eigen.axes) < within);
        for (value, axis) in eigen.values.iter().zip(&eigen.axes) {
            for (found, x) in product3(&symmetric, axis).iter().zip(axis) {
                assert!((found - value.to_f64() * x.to_f64()).abs() < within * size, "{symmetric:?}: {eigen:?}");
            }
        }
        let svd = svd3(&m);
        assert!(svd.values[0] >= svd.values[1] && svd.values[1] >= svd.values[2] && svd.values[2] >= T::ZERO);
        assert!(off_orthonormal(&svd.right) < within);
        for ((value, u), v) in svd.values.iter().zip(&svd.left).zip(&svd.right) {
            for (found, x) in product3(&m, v).iter().zip(u) {
                assert!((found - value.to_f64() * x.to_f64()).abs() < within * size, "{m:?}: {svd:?}");
            }
        }
        // The product of the singular values is |det|, by the rule of Sarrus.
        let f = m.map(|row| row.map(T::to_f64));
        let det = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0])
            + f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
        let volume: f64 = svd.values.iter().map(|s| s.to_f64()).product();
        assert!((volume - det.abs()).abs() < 10.0 * within * size * size, "{volume} and {det}");
    }
}

#[test]
fn three_by_three_matrices_come_apart_into_orthonormal_axes() {
    three_by_three::<f64>(1e-14);
    three_by_three::<f32>(4e-6);
}

#[test]
fn a_small_singular_value_of_a_three_by_three_jacobian_keeps_its_digits() {
    let mut random = Random::new(37);
    for _ in 0..2_000 {
        let [u, v] = [0; 2].map(|_| svd3(&matrix3::<f64>(&mut random)).right);
        let sigma = [1.0, 10f64.powf(-3.0 * random.unit()), 10f64.powf(-4.0 - 8.0 * random.unit())];
        let mut m = [[0.0; 3]; 3];
        for (row, i) in m.iter_mut().zip(0..) {
            for (entry, k) in row.iter_mut().zip(0..) {
                *entry = (0..3).map(|n: usize| sigma[n] * u[n][i as usize] * v[n][k as usize]).sum();
            }
        }
        let found = svd3(&m);
        for (found, expected) in found.values.iter().zip(sigma) {
            assert!((found - expected).abs() < 4e-15, "{found}, not {expected}");
        }
        let condition = found.condition_number().unwrap();
        assert!((condition * sigma[2] - 1.0).abs() < 1e-14 / sigma[2], "{condition}");
        for (size, sigma) in found.force_axes().unwrap().iter().zip(found.values) {
            assert_eq!(*size, 1.0 / sigma);
        }
    }
    let singular = svd3(&[[1.0f32, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 0.0, 0.0]]);
    assert!(singular.condition_number().is_none_or(|condition| condition > 1e6));
    assert_eq!(svd3(&[[0.0f32; 3]; 3]).force_axes(), None);
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
fn lengths_that_are_no_lengths_have_no_configurations() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for place in 0..3 {
            let mut lengths = HAREESHA;
            lengths[place] = bad;
            assert!(isotropic_configurations(lengths).iter().all(Option::is_none), "{lengths:?}");
        }
    }
}

#[test]
fn every_machine_keeps_its_condition_number_over_its_stroke_in_both_precisions() {
    let mut random = Random::new(23);
    for (name, g) in machines::all().unwrap() {
        let machine = Machine::<f64>::new(&g).unwrap();
        for _ in 0..2_000 {
            let [boom, arm, bucket] =
                [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| s.min_m + (s.max_m - s.min_m) * random.unit());
            let joints = machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap();
            let angles = [joints.boom.angle(), joints.arm.angle(), joints.bucket.angle()];
            let j = jacobian([g.boom_m, g.arm_m, g.bucket_m], angles);
            let condition = condition_number(&j).unwrap();
            let exact = exact_singular(&j);
            assert!((condition * exact[1] / exact[0] - 1.0).abs() < 1e-14 * condition, "{name}: {condition}");
            let single = condition_number(&rounded::<f32, 3>(&j)).unwrap().to_f64();
            assert!((single / condition - 1.0).abs() < 4e-7 * condition, "{name}: {single}, not {condition}");
        }
    }
}

/// Conditions at random cylinder lengths and along the edges of both strokes, by the trigonometric Jacobian.
fn sampled(g: &PinGeometry, random: &mut Random) -> [f64; 2] {
    let machine = Machine::<f64>::new(g).unwrap();
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for round in 0..100_000 {
        let edge = |x: f64| if round % 4 == 0 { x.round() } else { x };
        let parts = [random.unit(), random.unit()];
        let parts = if round % 8 == 0 { [edge(parts[0]), parts[1]] } else { [parts[0], edge(parts[1])] };
        let [arm, bucket] = [(g.arm.stroke, parts[0]), (g.bucket.stroke, parts[1])]
            .map(|(s, part)| s.min_m + (s.max_m - s.min_m) * part);
        let joints = machine.cylinders_to_joints(&Cylinders { boom: g.boom.stroke.min_m, arm, bucket }).unwrap();
        let j = jacobian([g.boom_m, g.arm_m, g.bucket_m], [0.2, joints.arm.angle(), joints.bucket.angle()]);
        let condition = condition_number(&j).unwrap();
        (least, most) = (least.min(condition), most.max(condition));
    }
    [least, most]
}

fn condition_of(g: &PinGeometry, pose: &ArmPose) -> f64 {
    let angles = [0.4, pose.arm_deg.to_radians(), pose.bucket_deg.to_radians()];
    condition_number(&jacobian([g.boom_m, g.arm_m, g.bucket_m], angles)).unwrap()
}

fn within_stroke(g: &PinGeometry, pose: &ArmPose) {
    let machine = Machine::<f64>::new(g).unwrap();
    let cylinders = Cylinders { boom: g.boom.stroke.max_m, arm: pose.arm_m, bucket: pose.bucket_m };
    let joints = machine.cylinders_to_joints(&cylinders).unwrap();
    assert!((joints.arm.angle().to_degrees() - pose.arm_deg).abs() < 1e-10, "{pose}");
    assert!((joints.bucket.angle().to_degrees() - pose.bucket_deg).abs() < 1e-10, "{pose}");
}

fn search_holds(name: &str, g: &PinGeometry, random: &mut Random) -> usize {
    let found = isotropy(g).unwrap();
    println!("{name}\n{found}");
    for pose in found.isotropic.iter().chain([&found.best, &found.worst]) {
        within_stroke(g, pose);
        assert!((condition_of(g, pose) - pose.condition.unwrap()).abs() < 1e-9, "{pose}");
    }
    for pose in &found.isotropic {
        assert!((pose.condition.unwrap() - 1.0).abs() < 1e-14, "{pose}");
        assert!((pose.largest_m - pose.smallest_m).abs() < 1e-12, "{pose}");
    }
    let [least, most] = sampled(g, random);
    let (best, worst) = (found.best.condition.unwrap(), found.worst.condition.unwrap());
    assert!(best <= least + 1e-12 && best > least * 0.97, "{name}: {best}, sampled {least}");
    assert!(worst >= most - 1e-12 * most && worst < most * 1.03, "{name}: {worst}, sampled {most}");
    assert_eq!(found.isotropic.is_empty(), found.to_string().contains("none"));
    found.isotropic.len()
}

/// θ3, θ4 [degrees] and σ [m] of the one isotropic point of each machine's stroke.
const OF_THE_MACHINES: [(&str, [f64; 3]); 4] = [
    ("frankel", [-109.11, -108.35, 0.947]),
    ("exact-mini", [-114.79, -51.00, 1.551]),
    ("zx120", [-114.01, -58.59, 3.454]),
    ("zx200", [-116.02, -48.71, 4.254]),
];

#[test]
fn every_machine_has_one_isotropic_point_in_its_stroke_and_no_random_pose_beats_the_search() {
    let mut random = Random::new(29);
    for ((name, g), (expected_name, [arm, bucket, sigma])) in machines::all().unwrap().iter().zip(OF_THE_MACHINES) {
        assert_eq!(*name, expected_name);
        assert_eq!(search_holds(name, g, &mut random), 1);
        let best = isotropy(g).unwrap().best;
        assert!((best.arm_deg - arm).abs() < 0.005 && (best.bucket_deg - bucket).abs() < 0.005, "{name}: {best}");
        assert!((best.largest_m - sigma).abs() < 5e-4, "{name}: {best}");
    }
}

#[test]
fn a_stroke_without_isotropic_points_says_none_and_names_the_best_pose() {
    let mut random = Random::new(31);
    let mut short = PinGeometry::EXACT_MINI;
    // The isotropic point needs 1.4415 m.
    short.arm.stroke.max_m = 1.3;
    assert_eq!(search_holds("arm stroke cut short", &short, &mut random), 0);
    let found = isotropy(&short).unwrap();
    assert_eq!(found.of_the_links, 4);
    assert!(
        found.to_string().starts_with("isotropic points within the stroke: none (4 of the links alone)"),
        "{found}"
    );
    assert!((found.best.arm_m - 1.3).abs() < 1e-12, "the best pose lies at the end nearest to it, {}", found.best);

    let mut long = PinGeometry::EXACT_MINI;
    long.boom_m += 1.0;
    long.arm.base.x += 1.0;
    assert_eq!(search_holds("long boom", &long, &mut random), 0);
    let found = isotropy(&long).unwrap();
    assert_eq!(found.of_the_links, 0);
    assert!(found.best.condition.is_some_and(|condition| condition > 1.01), "{found}");
}

#[test]
fn a_search_of_a_broken_machine_names_the_fault() {
    let mut g = PinGeometry::EXACT_MINI;
    g.arm.stroke.max_m = 9.0;
    assert_eq!(isotropy(&g).unwrap_err().field, "arm.max_m");
}
