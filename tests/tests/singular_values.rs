//! Singular values, condition numbers and ellipses: over random Jacobians with known ones, and all four machines.

use cross_tests::jacobians::{exact_singular, jacobian, rounded, with_singular};
use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::isotropy::{
    condition_number, force_ellipse, manipulability, singularity_distance, velocity_ellipse,
};
use kinematics_core::svd::SingularValues;
use kinematics_core::svd3::{svd3, symmetric_eigen};
use kinematics_core::{Cylinders, Machine, Real, Rotor};

/// The worst errors of σ₁ and σ₂ relative to σ₁, in units of `ulp`, over condition numbers up to `worst`.
fn singular_errors<T: Real, const N: usize>(ulp: f64, worst: f64) -> [f64; 2] {
    let mut random = Random::new(7 + N as u64);
    let mut errors = [0.0f64; 2];
    for _ in 0..20_000 {
        let scale = 10f64.powf(2.0 * random.unit() - 1.0);
        let condition = worst.powf(random.unit());
        let j = rounded::<T, N>(&with_singular::<N>(&mut random, [scale, scale / condition]));
        let exact = exact_singular(&j);
        let found = SingularValues::of(&j);
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
    let found = SingularValues::of(&j);
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
        assert_eq!(SingularValues::of(&j).joint_directions(&j), None);
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

#[test]
fn at_isotropy_rounding_never_makes_the_smallest_the_largest() {
    let mut random = Random::new(83);
    let mut equal = 0;
    for _ in 0..10_000 {
        let (size, at) = (0.1 + 10.0 * random.unit(), Rotor::from_turns(random.unit()));
        let (x, z) = ((size * at.cos) as f32, (size * at.sin) as f32);
        let found = SingularValues::of(&[[x, -z], [z, x]]);
        assert!(found.smallest <= found.largest, "{found:?}");
        equal += u32::from(found.smallest == found.largest);
    }
    assert!(equal > 100, "{equal}");
}
