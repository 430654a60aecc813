//! Joint limits as rotors, and closed loops that respect them whatever the tip is told, on all four machines.

use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::chain_n::PlanarChain;
use kinematics_core::joint_range::JointRange;
use kinematics_core::redundancy::{Redundancy, RedundancyParameters};
use kinematics_core::{Cylinders, Machine, PinGeometry, Real, Rotor, Vec2};

fn dot<T: Real>(row: &[T; 3], rates: &[T; 3]) -> f64 {
    row.iter().zip(rates).map(|(a, b)| a.to_f64() * b.to_f64()).sum()
}

/// The joints' ranges over the strokes.
fn ranges<T: Real>(g: &PinGeometry) -> [Option<JointRange<T>>; 3] {
    let machine = Machine::<f64>::new(g).unwrap();
    let joints = |[boom, arm, bucket]: [f64; 3]| machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap();
    let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
    let (short, long) = (joints(strokes.map(|s| s.min_m)), joints(strokes.map(|s| s.max_m)));
    let boom = if long.boom.angle() > short.boom.angle() { [short.boom, long.boom] } else { [long.boom, short.boom] };
    [
        JointRange::between(boom[0], boom[1]),
        JointRange::between(long.arm, short.arm),
        JointRange::between(long.bucket, short.bucket),
    ]
}

/// What a minute of random tip velocities does to a machine.
struct Minute {
    /// The farthest any joint came: 1 is its limit.
    farthest: f64,
    /// Ticks whose tip velocity was met in full, and the worst error of them, m/s.
    met: usize,
    off: f64,
    /// Ticks with a joint in the last quarter before its limit.
    near: usize,
}

/// 1 kHz, a new tip velocity of up to 0.15 of the reach a second each way every 3 s; rotors turned without trigonometry.
fn minute<T: Real>(g: &PinGeometry, seed: u64, limited: bool) -> Minute {
    const DT: f64 = 1e-3;
    let mut stream = Random::new(seed);
    let reach = g.reach_m();
    let ranges = ranges::<T>(g);
    let machine = Machine::<T>::new(g).unwrap();
    let parameters = RedundancyParameters {
        ranges: if limited { ranges } else { [None; 3] },
        mobility: [T::ONE; 3],
        trusted_m: T::from_f64(0.06 * reach),
        retreat_rad_s: T::from_f64(0.05),
    };
    let redundancy = Redundancy::new(PlanarChain::from(machine.chain()), parameters).unwrap();
    let middle = [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| T::from_f64(0.5 * (s.min_m + s.max_m)));
    let [boom, arm, bucket] = middle;
    let start = machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap();
    let mut joints = [start.boom, start.arm, start.bucket];
    let mut out = Minute { farthest: 0.0, met: 0, off: 0.0, near: 0 };
    let mut velocity = Vec2::new(T::ZERO, T::ZERO);
    for tick in 0..60_000 {
        if tick % 3_000 == 0 {
            let [x, z] = [0; 2].map(|_| T::from_f64(0.3 * (stream.unit() - 0.5) * reach));
            velocity = Vec2::new(x, z);
        }
        let rates = redundancy.rates(&joints, velocity, &[T::ZERO; 3]);
        let [x, z] = redundancy.chain().jacobian(&joints).map(|row| dot(&row, &rates.joints));
        if rates.damping == T::ZERO {
            out.met += 1;
            out.off = out.off.max((x - velocity.x.to_f64()).abs() + (z - velocity.z.to_f64()).abs());
        }
        for (joint, rate) in joints.iter_mut().zip(rates.joints) {
            let turned = *joint * Rotor { cos: T::ONE, sin: rate * T::from_f64(DT) };
            *joint = turned.to_vec().direction().unwrap();
        }
        let shares = ranges.iter().zip(&joints).map(|(range, joint)| range.unwrap().place(*joint).share.to_f64());
        let share = shares.fold(0.0, f64::max);
        out.farthest = out.farthest.max(share);
        out.near += usize::from(share > 0.75);
    }
    out
}

fn limits_hold<T: Real>(within: f64) {
    for (name, g) in machines::all().unwrap() {
        let (mut unlimited, mut all_met, mut all_near) = (0.0f64, 0, 0);
        for seed in 0..6 {
            let Minute { farthest, met, off, near } = minute::<T>(&g, seed, true);
            println!("{name}: farthest {farthest}, met {met}, off {off:e}, near {near}");
            assert!(farthest <= 1.0 + within, "{name}: a joint passed its limit, {farthest}");
            assert!(off < within * g.reach_m(), "{name}: {off} m/s off where nothing is damped");
            (all_met, all_near) = (all_met + met, all_near + near);
            unlimited = unlimited.max(minute::<T>(&g, seed, false).farthest);
        }
        assert!(all_met > 60_000 && all_near > 60_000, "{name}: {all_met} met, {all_near} near a limit of 360000");
        assert!(unlimited > 1.1, "{name}: the same minute respects the limits anyway, {unlimited}");
    }
}

#[test]
fn joints_stay_within_their_limits_whatever_the_tip_is_told() {
    limits_hold::<f64>(1e-12);
    limits_hold::<f32>(1e-4);
}

#[test]
fn left_alone_the_joints_go_to_their_middle_as_far_as_the_tip_lets_them() {
    for (name, g) in machines::all().unwrap() {
        let parameters = RedundancyParameters {
            ranges: ranges::<f64>(&g),
            mobility: [1.0; 3],
            trusted_m: 0.01 * g.reach_m(),
            retreat_rad_s: 0.5,
        };
        let machine = Machine::<f64>::new(&g).unwrap();
        let redundancy = Redundancy::new(PlanarChain::from(machine.chain()), parameters).unwrap();
        let quarter = [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| s.min_m + 0.3 * (s.max_m - s.min_m));
        let [boom, arm, bucket] = quarter;
        let start = machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap();
        let mut joints = [start.boom, start.arm, start.bucket];
        let begin = redundancy.chain().tip(&joints);
        let limit = |joints: &[Rotor<f64>; 3]| -> f64 {
            parameters.ranges.iter().zip(joints).map(|(range, joint)| range.unwrap().place(*joint).share).sum()
        };
        let (first, mut last) = (limit(&joints), limit(&joints));
        for _ in 0..20_000 {
            let rates = redundancy.rates(&joints, Vec2::new(0.0, 0.0), &[0.0; 3]);
            for (joint, rate) in joints.iter_mut().zip(rates.joints) {
                *joint = (*joint * Rotor { cos: 1.0, sin: rate * 1e-3 }).to_vec().direction().unwrap();
            }
            let now = limit(&joints);
            assert!(now <= last + 1e-9, "{name}: the limit function grows, {last} to {now}");
            last = now;
        }
        assert!(last < first - 1e-3, "{name}: {first} to {last}");
        let tip = redundancy.chain().tip(&joints);
        // Euler's steps of 1 ms leave a little.
        assert!((tip - begin).norm() < 1e-3 * g.reach_m(), "{name}: the tip moved {} m", (tip - begin).norm());
    }
}

#[test]
fn a_range_is_one_at_both_limits_and_its_slope_is_the_derivative() {
    let mut stream = Random::new(9);
    for _ in 0..2_000 {
        let (lower, width) = (360.0 * stream.unit() - 180.0, 5.0 + 350.0 * stream.unit());
        let at = |degrees: f64| Rotor::<f64>::from_degrees(degrees);
        let range = JointRange::<f64>::between(at(lower), at(lower + width)).unwrap();
        for end in [lower, lower + width] {
            assert!((range.place(at(end)).share - 1.0).abs() < 1e-9);
        }
        assert!(range.place(at(lower + 0.5 * width)).share.abs() < 1e-9);
        let place = lower + width * stream.unit();
        let h = 1e-4f64;
        let slope = (range.place(at(place + h)).share - range.place(at(place - h)).share) / (2.0 * h.to_radians());
        let found = range.place(at(place)).slope;
        assert!((found - slope).abs() < 1e-6 * (1.0 + found.abs()), "{found}, by differences {slope}");
        // Outwards, the share grows.
        assert!((found > 0.0) == (place > lower + 0.5 * width));
    }
}

#[test]
fn a_range_without_width_or_without_numbers_is_none() {
    let nothing = Rotor { cos: f64::NAN, sin: 0.0 };
    for (lower, upper) in [
        (Rotor::IDENTITY, Rotor::IDENTITY),
        (nothing, Rotor::IDENTITY),
        (Rotor::IDENTITY, nothing),
        (Rotor { cos: 0.0, sin: 0.0 }, Rotor::IDENTITY),
    ] {
        assert_eq!(JointRange::<f32>::between(lower, upper), None, "{lower:?} to {upper:?}");
    }
}
