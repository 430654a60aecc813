//! Redundant chains: the pseudo-inverse's four properties, damping and weights, N = 2…6, random chains and all machines.

use std::f64::consts::TAU;

use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::chain_n::PlanarChain;
use kinematics_core::isotropy::condition_number;
use kinematics_core::redundancy::{
    Redundancy, RedundancyError, RedundancyParameters, damped_rates, null_motion, null_projector, pseudo_inverse,
};
use kinematics_core::svd::SingularValues;
use kinematics_core::{Joints, Machine, Real, Rotor, Vec2};

type Jacobian<T, const N: usize> = [[T; N]; 2];

fn row<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.to_f64() * b.to_f64()).sum()
}

fn moved<T: Real, const N: usize>(j: &Jacobian<T, N>, rates: &[T; N]) -> [f64; 2] {
    [row(&j[0], rates), row(&j[1], rates)]
}

fn random<T: Real, const N: usize>(random: &mut Random, low: f64, high: f64) -> [T; N] {
    [0; N].map(|_| T::from_f64(low + (high - low) * random.unit()))
}

/// A random chain at random joints, its condition number not above `worst`.
fn posed<T: Real, const N: usize>(stream: &mut Random, worst: f64) -> (PlanarChain<T, N>, [Rotor<T>; N]) {
    loop {
        let chain = PlanarChain::new(random(stream, 0.3, 2.0));
        let joints = random::<T, N>(stream, -3.2, 3.2).map(Rotor::from_angle);
        if condition_number(&chain.jacobian(&joints)).is_some_and(|k| k.to_f64() < worst) {
            return (chain, joints);
        }
    }
}

fn jacobian_is_the_slope_of_the_tip<const N: usize>(stream: &mut Random) {
    let lengths: [f64; N] = random(stream, 0.3, 2.0);
    let angles: [f64; N] = random(stream, -3.2, 3.2);
    // By sines and cosines of summed angles.
    let tip = |angles: &[f64; N]| {
        let mut sum = 0.0;
        let mut tip = [0.0; 2];
        for (length, angle) in lengths.iter().zip(angles) {
            sum += angle;
            tip = [tip[0] + length * libm::cos(sum), tip[1] + length * libm::sin(sum)];
        }
        tip
    };
    let chain = PlanarChain::new(lengths);
    let (found, j) = chain.tip_and_jacobian(&angles.map(Rotor::from_angle));
    let expected = tip(&angles);
    assert!((found.x - expected[0]).abs() + (found.z - expected[1]).abs() < 1e-13);
    let single = PlanarChain::new(lengths.map(|l| l as f32));
    let (tip32, j32) = single.tip_and_jacobian(&angles.map(|a| Rotor::from_angle(a as f32)));
    assert!((f64::from(tip32.x) - expected[0]).abs() + (f64::from(tip32.z) - expected[1]).abs() < 2e-5);
    for k in 0..N {
        let h = 1e-5;
        let at = |by: f64| {
            let mut angles = angles;
            angles[k] += by;
            tip(&angles)
        };
        // Fourth order.
        let (near, far) = ([at(h), at(-h)], [at(2.0 * h), at(-2.0 * h)]);
        for part in 0..2 {
            let slope = (8.0 * (near[0][part] - near[1][part]) - (far[0][part] - far[1][part])) / (12.0 * h);
            assert!((j[part][k] - slope).abs() < 1e-9, "{} against {slope}", j[part][k]);
            assert!((f64::from(j32[part][k]) - slope).abs() < 2e-5);
        }
    }
}

#[test]
fn the_jacobian_is_the_slope_of_the_tip_for_two_to_six_joints() {
    let mut stream = Random::new(1);
    for _ in 0..500 {
        jacobian_is_the_slope_of_the_tip::<2>(&mut stream);
        jacobian_is_the_slope_of_the_tip::<3>(&mut stream);
        jacobian_is_the_slope_of_the_tip::<4>(&mut stream);
        jacobian_is_the_slope_of_the_tip::<5>(&mut stream);
        jacobian_is_the_slope_of_the_tip::<6>(&mut stream);
    }
}

#[test]
fn three_joints_are_the_machines_own_chain() {
    let mut stream = Random::new(2);
    for (name, g) in machines::all().unwrap() {
        let machine = Machine::<f64>::new(&g).unwrap();
        let chain = PlanarChain::from(machine.chain());
        for _ in 0..500 {
            let [boom, arm, bucket] = random::<f64, 3>(&mut stream, -3.2, 3.2).map(Rotor::from_angle);
            let tip = machine.chain().tip(&Joints { boom, arm, bucket });
            let found = chain.tip(&[boom, arm, bucket]);
            let off = (found.x + g.boom_pin_x_m - tip.reach).abs() + (found.z - tip.height).abs();
            assert!(off < 1e-14 * g.reach_m(), "{name}: off by {off} m");
        }
    }
}

/// JJ⁺ = I, J⁺J symmetric, JN = 0, N² = N, NJ⁺ = 0, trace N = N − 2, and no rates for the same velocity are shorter.
fn pseudo_inverse_properties<T: Real, const N: usize>(stream: &mut Random, within: f64) {
    let (chain, joints) = posed::<T, N>(stream, 30.0);
    let j = chain.jacobian(&joints);
    let condition = condition_number(&j).unwrap().to_f64();
    let within = within * condition * condition;
    let inverse = pseudo_inverse(&j).unwrap();
    let projector = null_projector(&j).unwrap();
    let columns = [0, 1].map(|c| inverse.map(|row| row[c]));
    for (r, row_of_j) in j.iter().enumerate() {
        for (c, column) in columns.iter().enumerate() {
            let unit = if r == c { 1.0 } else { 0.0 };
            assert!((row(row_of_j, column) - unit).abs() < within, "JJ⁺ is off the identity");
        }
    }
    let size = SingularValues::of(&j).largest.to_f64();
    let mut trace = 0.0;
    for i in 0..N {
        trace += projector[i][i].to_f64();
        let column = projector.map(|row| row[i]);
        let tip = moved(&j, &column);
        assert!(tip.iter().all(|v| v.abs() < within * size), "JN = {tip:?}");
        for (k, line) in projector.iter().enumerate() {
            assert!((row(line, &column) - projector[k][i].to_f64()).abs() < within, "N² is not N");
            assert!((projector[k][i].to_f64() - projector[i][k].to_f64()).abs() < within, "N is not symmetric");
        }
    }
    assert!((trace - (N as f64 - 2.0)).abs() < within);
    let velocity: [T; 2] = random(stream, -1.0, 1.0);
    let shortest = inverse.map(|line| T::from_f64(row(&line, &velocity)));
    let wish: [T; N] = random(stream, -1.0, 1.0);
    let other = {
        let mut other = shortest;
        for (rate, line) in other.iter_mut().zip(&projector) {
            *rate = T::from_f64(rate.to_f64() + row(line, &wish));
        }
        other
    };
    let (a, b) = (moved(&j, &other), velocity.map(T::to_f64));
    assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < within * (size + 1.0) * 4.0, "{a:?} for {b:?}");
    let (least, more) = (row(&shortest, &shortest), row(&other, &other));
    let null: f64 = projector.iter().map(|line| row(line, &wish).powi(2)).sum();
    assert!((more - least - null).abs() < within * 8.0 * (1.0 + more), "Pythagoras: {least} + {null} is not {more}");
    // The loop's form is the paper's.
    let velocity = Vec2::new(velocity[0], velocity[1]);
    let rates = damped_rates(&j, velocity, &wish, &[T::ONE; N], T::from_f64(1e-4));
    assert_eq!(rates.damping, T::ZERO);
    for (found, paper) in rates.joints.iter().zip(&other) {
        assert!((found.to_f64() - paper.to_f64()).abs() < 20.0 * within, "{found:?}, not {paper:?}");
    }
}

#[test]
fn the_pseudo_inverse_and_the_projector_are_what_hareesha_14_and_15_say() {
    let mut stream = Random::new(3);
    for _ in 0..1_000 {
        pseudo_inverse_properties::<f64, 2>(&mut stream, 1e-14);
        pseudo_inverse_properties::<f64, 3>(&mut stream, 1e-14);
        pseudo_inverse_properties::<f64, 4>(&mut stream, 1e-14);
        pseudo_inverse_properties::<f64, 5>(&mut stream, 1e-14);
        pseudo_inverse_properties::<f64, 6>(&mut stream, 1e-14);
        pseudo_inverse_properties::<f32, 3>(&mut stream, 4e-6);
        pseudo_inverse_properties::<f32, 6>(&mut stream, 4e-6);
    }
}

#[test]
fn the_null_motion_of_three_joints_spans_the_projector() {
    let mut stream = Random::new(4);
    for _ in 0..1_000 {
        let (chain, joints) = posed::<f64, 3>(&mut stream, 30.0);
        let j = chain.jacobian(&joints);
        let n = null_motion(&j);
        let projector = null_projector(&j).unwrap();
        for i in 0..3 {
            for k in 0..3 {
                assert!((n[i] * n[k] / row(&n, &n) - projector[i][k]).abs() < 1e-11);
            }
        }
    }
}

#[test]
fn a_singular_jacobian_has_no_pseudo_inverse() {
    for j in [[[0.0f32; 3]; 2], [[3.0, 2.0, 1.0], [0.0; 3]], [[3.0, 2.0, 1.0], [6.0, 4.0, 2.0]]] {
        assert_eq!(pseudo_inverse(&j), None);
        assert_eq!(null_projector(&j), None);
    }
    // The determinant is above zero, but its reciprocal is no number any more.
    assert_eq!(pseudo_inverse(&[[1e-10f32, 0.0], [0.0, 1e-10]]), None);
}

/// Σ(θ̇−b)²/V ≤ |v − J·b|²/s² everywhere, exact above s, at poses from well conditioned to exactly stretched.
fn damping_bounds<T: Real, const N: usize>(stream: &mut Random, within: f64) {
    let chain = PlanarChain::<T, N>::new(random(stream, 0.3, 2.0));
    // The later joints nearly straight, by 1e-9…1 rad, or wholly.
    let spread = if stream.unit() < 0.1 { 0.0 } else { 10f64.powf(-9.0 * stream.unit()) };
    let mut joints = random::<T, N>(stream, -1.0, 1.0).map(|x| Rotor::from_angle(x * T::from_f64(spread)));
    joints[0] = Rotor::from_angle(T::from_f64(TAU * stream.unit()));
    let j = chain.jacobian(&joints);
    let trusted = 10f64.powf(-2.0 * stream.unit());
    let velocity: [T; 2] = random(stream, -1.0, 1.0);
    let (wish, mobility) = (random::<T, N>(stream, -0.3, 0.3), random::<T, N>(stream, 0.2, 3.0));
    let [x, z] = velocity;
    let rates = damped_rates(&j, Vec2::new(x, z), &wish, &mobility, T::from_f64(trusted));

    let from = |rates: &[T; N]| -> f64 {
        let [a, b] = moved(&j, rates);
        ((x.to_f64() - a).powi(2) + (z.to_f64() - b).powi(2)).sqrt()
    };
    let (asked, left) = (from(&wish), from(&rates.joints));
    let effort = rates.joints.iter().zip(&wish).zip(&mobility);
    let effort: f64 = effort.map(|((r, b), m)| (r.to_f64() - b.to_f64()).powi(2) / m.to_f64()).sum::<f64>().sqrt();
    assert!(effort <= (1.0 + within / trusted) * asked / trusted, "{effort} rad/s for {asked} m/s, {trusted} m");
    let mut weighted = j;
    for row in &mut weighted {
        row.iter_mut().zip(&mobility).for_each(|(entry, m)| *entry = *entry * m.sqrt());
    }
    let smallest = SingularValues::of(&weighted).smallest.to_f64();
    assert!(smallest <= trusted * (1.0 + 1e-3) || rates.damping == T::ZERO, "damped at {smallest} of {trusted} m");
    assert!(smallest >= trusted * (1.0 - 1e-3) || rates.damping > T::ZERO, "undamped at {smallest} of {trusted} m");
    if rates.damping == T::ZERO {
        let condition = condition_number(&weighted).unwrap().to_f64();
        assert!(left < within * condition * condition, "off by {left} m/s at condition {condition}");
    } else {
        assert!(left <= asked * (1.0 + 1e-3), "{left} m/s left of {asked}");
    }
}

#[test]
fn damped_rates_stay_below_the_velocity_over_the_trusted_singular_value() {
    let mut stream = Random::new(5);
    for _ in 0..10_000 {
        damping_bounds::<f64, 2>(&mut stream, 1e-13);
        damping_bounds::<f64, 3>(&mut stream, 1e-13);
        damping_bounds::<f64, 6>(&mut stream, 1e-13);
        damping_bounds::<f32, 3>(&mut stream, 4e-5);
    }
}

#[test]
fn rates_change_continuously_through_a_singular_pose_where_the_pseudo_inverse_blows_up() {
    let chain = PlanarChain::new([2.0f64, 1.5, 0.7]);
    let at = |bend: f64| {
        let joints = [Rotor::from_angle(0.4), Rotor::from_angle(bend), Rotor::from_angle(0.5 * bend)];
        chain.jacobian(&joints)
    };
    let velocity = Vec2::new(0.5, 0.2);
    let trusted = 0.1;
    let rates = |bend: f64| damped_rates(&at(bend), velocity, &[0.0; 3], &[1.0; 3], trusted);
    let (mut steepest, mut damped, mut largest_plain) = (0.0f64, 0, 0.0f64);
    const STEPS: i32 = 200_000;
    let bend = |n: i32| 0.3 * (f64::from(n) / f64::from(STEPS) - 0.5) * 2.0;
    for n in 0..STEPS {
        let (from, to) = (rates(bend(n)), rates(bend(n + 1)));
        let change = from.joints.iter().zip(to.joints).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        steepest = steepest.max(change / (bend(n + 1) - bend(n)));
        damped += i32::from(from.damping > 0.0);
        if let Some(inverse) = pseudo_inverse(&at(bend(n))) {
            let plain = inverse.map(|[x, z]| x * velocity.x + z * velocity.z);
            largest_plain = largest_plain.max(row(&plain, &plain).sqrt());
        }
    }
    // |dJ*/dJ| ≤ 4/s², |dJ/dbend| below the chain's length, |v| = 0.54.
    assert!(steepest < 4.0 / (trusted * trusted) * 4.2 * 0.54, "{steepest} rad/s per rad");
    assert!(damped > STEPS / 20 && damped < STEPS, "{damped} of {STEPS} poses are damped");
    assert!(largest_plain > 1e3, "the plain inverse asks for {largest_plain} rad/s");
}

fn weighted_is_least<const N: usize>(stream: &mut Random) {
    let (chain, joints) = posed::<f64, N>(stream, 10.0);
    let j = chain.jacobian(&joints);
    let mobility: [f64; N] = random(stream, 0.2, 3.0);
    let [x, z] = random::<f64, 2>(stream, -1.0, 1.0);
    let wish: [f64; N] = random(stream, -0.5, 0.5);
    let rates = damped_rates(&j, Vec2::new(x, z), &wish, &mobility, 1e-3);
    assert_eq!(rates.damping, 0.0);
    let [a, b] = moved(&j, &rates.joints);
    assert!((a - x).abs() + (b - z).abs() < 1e-10, "the tip does not follow");
    let cost = |rates: &[f64; N]| -> f64 {
        rates.iter().zip(&wish).zip(&mobility).map(|((r, b), m)| (r - b).powi(2) / m).sum()
    };
    // Any other rates with the same tip velocity.
    let (projector, push) = (null_projector(&j).unwrap(), random::<f64, N>(stream, -0.3, 0.3));
    let mut other = rates.joints;
    for (rate, line) in other.iter_mut().zip(&projector) {
        *rate += row(line, &push);
    }
    assert!(cost(&other) >= cost(&rates.joints) - 1e-12, "{} is less than {}", cost(&other), cost(&rates.joints));
}

#[test]
fn weighted_rates_are_the_nearest_to_the_wish_among_all_that_move_the_tip_so() {
    let mut stream = Random::new(6);
    for _ in 0..3_000 {
        weighted_is_least::<2>(&mut stream);
        weighted_is_least::<3>(&mut stream);
        weighted_is_least::<4>(&mut stream);
        weighted_is_least::<6>(&mut stream);
    }
}

#[test]
fn a_joint_of_no_mobility_keeps_its_wish_and_the_others_move_the_tip() {
    let mut stream = Random::new(7);
    for round in 0..3_000 {
        let (chain, joints) = posed::<f64, 4>(&mut stream, 10.0);
        let j = chain.jacobian(&joints);
        let locked = round % 4;
        let mut mobility = [1.0; 4];
        mobility[locked] = 0.0;
        let wish = random::<f64, 4>(&mut stream, -0.5, 0.5);
        let [x, z] = random::<f64, 2>(&mut stream, -1.0, 1.0);
        let rates = damped_rates(&j, Vec2::new(x, z), &wish, &mobility, 1e-3);
        assert_eq!(rates.joints[locked], wish[locked]);
        if rates.damping == 0.0 {
            let [a, b] = moved(&j, &rates.joints);
            assert!((a - x).abs() + (b - z).abs() < 1e-6, "off at {rates:?}");
        }
    }
}

#[test]
fn a_wish_in_the_null_space_is_met_whole_and_turns_the_bucket_alone() {
    let mut stream = Random::new(8);
    for _ in 0..1_000 {
        let (chain, joints) = posed::<f64, 3>(&mut stream, 30.0);
        let j = chain.jacobian(&joints);
        let wish = null_motion(&j);
        let rates = damped_rates(&j, Vec2::new(0.0, 0.0), &wish, &[1.0; 3], 1e-3);
        for (rate, wish) in rates.joints.iter().zip(wish) {
            assert!((rate - wish).abs() < 1e-11 * (1.0 + wish.abs()));
        }
    }
}

#[test]
fn parameters_out_of_range_are_named() {
    let chain = PlanarChain::new([1.0f32, 1.0, 1.0]);
    let good = RedundancyParameters { ranges: [None; 3], mobility: [1.0; 3], trusted_m: 0.1, retreat_rad_s: 0.0 };
    assert!(Redundancy::new(chain, good).is_ok());
    for bad in [-1.0, f32::NAN, f32::INFINITY] {
        let mobility = RedundancyParameters { mobility: [1.0, bad, 1.0], ..good };
        assert_eq!(Redundancy::new(chain, mobility), Err(RedundancyError::Mobility { joint: 1 }));
        let retreat = RedundancyParameters { retreat_rad_s: bad, ..good };
        assert_eq!(Redundancy::new(chain, retreat), Err(RedundancyError::Retreat));
        let trusted = RedundancyParameters { trusted_m: bad, ..good };
        assert_eq!(Redundancy::new(chain, trusted), Err(RedundancyError::Trusted));
    }
    for bad in [0.0, 1e-30, 1e-15] {
        let trusted = RedundancyParameters { trusted_m: bad, ..good };
        let error = Redundancy::new(chain, trusted).unwrap_err();
        assert!(error.to_string().contains("`trusted_m`"), "{error}");
    }
}
