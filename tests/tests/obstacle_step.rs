//! The hull of capsules, and the step past obstacles: straight where nothing is in the way, and giving way no more than it must.

use cross_tests::machines;
use cross_tests::obstacle_kit::{Kit, SPEEDS_RAD_S, rotors, wrapped};
use cross_tests::sweep::Random;
use kinematics_core::planning::avoid::{Avoid, AvoidError, AvoidParameters};
use kinematics_core::planning::hull::{Flesh, Hull, Near};
use kinematics_core::{PinGeometry, Rotor, Vec2};
use libm::{cos, hypot, sin};

fn kits() -> [Kit; 2] {
    [Kit::new(&PinGeometry::EXACT_MINI), Kit::new(&machines::ZX200)]
}

fn turned(v: Vec2<f64>, angle: f64) -> [f64; 2] {
    [v.x * cos(angle) - v.z * sin(angle), v.x * sin(angle) + v.z * cos(angle)]
}

fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn between(a: [f64; 2], b: [f64; 2], share: f64) -> [f64; 2] {
    core::array::from_fn(|i| a[i] + share * (b[i] - a[i]))
}

/// The rocker's pin in the arm's frame, where two circles meet, at a share of the bucket cylinder's stroke.
fn rocker_pin(g: &PinGeometry, share: f64) -> Vec2<f64> {
    let b = g.bucket;
    let length = b.stroke.min_m + share * (b.stroke.max_m - b.stroke.min_m);
    let to_base = b.base - b.rocker_pivot;
    let (side, angle) = (to_base.norm(), libm::atan2(to_base.z, to_base.x));
    let corner = libm::acos((side * side + b.rocker_m * b.rocker_m - length * length) / (2.0 * side * b.rocker_m));
    // Clockwise of the line to the cylinder's base.
    let [x, z] = turned(Vec2::new(b.rocker_m, 0.0), angle - corner);
    b.rocker_pivot + Vec2::new(x, z)
}

fn mean_rocker_pin(g: &PinGeometry) -> Vec2<f64> {
    (0..=16).fold(Vec2::new(0.0, 0.0), |sum, i| sum + rocker_pin(g, f64::from(i) / 16.0).scale(1.0 / 17.0))
}

/// Distance of a point from a line of points, by a fine sampling.
fn far_from(point: Vec2<f64>, line: &[Vec2<f64>]) -> f64 {
    let at = |v: Vec2<f64>| [v.x, v.z];
    let places = line
        .windows(2)
        .flat_map(|ends| (0..=2000).map(move |i| between(at(ends[0]), at(ends[1]), f64::from(i) / 2000.0)));
    places.map(|[x, z]| hypot(x - point.x, z - point.z)).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_hulls_segments_run_between_the_pins_and_are_as_thick_as_these_need() {
    for kit in kits() {
        let g = &kit.geometry;
        let zero = Vec2::new(0.0, 0.0);
        let knee = (g.boom.rod + g.arm.base).scale(0.5);
        let (arm_pin, bucket_pin) = (Vec2::new(g.boom_m, 0.0), Vec2::new(g.arm_m, 0.0));
        let arm_end = (bucket_pin + mean_rocker_pin(g)).scale(0.5);
        let most = |points: &[Vec2<f64>], line: &[Vec2<f64>]| {
            points.iter().map(|&point| far_from(point, line)).fold(0.0, f64::max)
        };
        let beam = most(&[g.boom.rod, g.arm.base], &[zero, knee, arm_pin]) + kit.flesh.beam_m;
        let rockers: Vec<_> = (0..=16).map(|i| rocker_pin(g, f64::from(i) / 16.0)).collect();
        let on_arm = [&rockers[..], &[zero, bucket_pin, g.bucket.base, g.bucket.rocker_pivot]].concat();
        let arm = most(&on_arm, &[g.arm.rod, arm_end]) + kit.flesh.beam_m;
        let teeth = Vec2::new(g.bucket_m, 0.0);
        let half_coupler = g.bucket.coupler_pin.scale(0.5);
        let bucket = most(&[zero, g.bucket.coupler_pin], &[half_coupler, teeth]) + kit.flesh.bucket_m;
        let thickness = [beam, beam, kit.flesh.beam_m, kit.flesh.beam_m, arm, bucket];

        let mut random = Random::new(3);
        for _ in 0..20 {
            let angles = kit.pose(&mut random);
            let [_, t2, t3, t4] = angles;
            let (on_boom, on_arm, on_bucket) = (t2, t2 + t3, t2 + t3 + t4);
            let elbow = turned(arm_pin, on_boom);
            let wrist = plus(elbow, turned(bucket_pin, on_arm));
            let of_boom = |v| turned(v, on_boom);
            let of_arm = |v| plus(elbow, turned(v, on_arm));
            let of_bucket = |v| plus(wrist, turned(v, on_bucket));
            let expected = [
                [[0.0; 2], of_boom(knee)],
                [of_boom(knee), elbow],
                [[g.boom.base.x, g.boom.base.z], of_boom(g.boom.rod)],
                [of_boom(g.arm.base), of_arm(g.arm.rod)],
                [of_arm(g.arm.rod), of_arm(arm_end)],
                [of_bucket(half_coupler), of_bucket(teeth)],
            ];
            let placed = kit.hull.place(&rotors(angles));
            for (i, (ends, radius)) in placed.capsules().enumerate() {
                for (found, wanted) in ends.iter().zip(expected[i]) {
                    assert!(hypot(found.x - wanted[0], found.z - wanted[1]) < 1e-9, "{i}: {found:?} {wanted:?}");
                }
                assert!((radius - thickness[i]).abs() < 1e-6 * g.reach_m(), "{i}: {radius} {}", thickness[i]);
            }
        }
    }
}

#[test]
fn a_bucket_is_no_thinner_than_the_beams() {
    let g = PinGeometry::EXACT_MINI;
    let thickness = |beam_m, bucket_m| {
        let hull = Hull::<f64>::new(&g, Flesh { beam_m, bucket_m }).unwrap();
        hull.place(&rotors([0.0; 4])).capsules().last().unwrap().1
    };
    assert_eq!(thickness(0.2, 0.1), thickness(0.1, 0.2));
    assert!((thickness(0.1, 0.3) - thickness(0.1, 0.2) - 0.1).abs() < 1e-12);
}

#[test]
fn each_segments_distance_is_the_one_sampling_it_in_space_finds_and_its_row_the_derivative() {
    let mut random = Random::new(5);
    for kit in kits() {
        for _ in 0..40 {
            let angles = kit.pose(&mut random);
            let ball = kit.ball_beside(angles, &mut random);
            let near_at = |angles: [f64; 4]| kit.hull.place(&rotors(angles)).near(&ball);
            let near = near_at(angles);
            let placed = kit.hull.place(&rotors(angles));
            for (i, ([from, to], radius)) in placed.capsules().enumerate() {
                let samples = 1000;
                let sampled = (0..=samples).map(|n| {
                    let [x, z] = between([from.x, from.z], [to.x, to.z], f64::from(n) / f64::from(samples));
                    let reach = x + kit.geometry.boom_pin_x_m;
                    let (dx, dy) = (reach * cos(angles[0]) - ball.x, reach * sin(angles[0]) - ball.y);
                    hypot(hypot(dx, dy), z - ball.z) - radius - ball.radius
                });
                let sampled = sampled.fold(f64::INFINITY, f64::min);
                assert!((sampled - near[i].distance).abs() < 1e-3 * kit.geometry.reach_m(), "{i}: {sampled}");
                for joint in 0..4 {
                    let step = 1e-6;
                    let at = |by: f64| {
                        let mut turned = angles;
                        turned[joint] += by;
                        near_at(turned)[i].distance
                    };
                    let slope = (at(step) - at(-step)) / (2.0 * step);
                    assert!((slope - near[i].row[joint]).abs() < 1e-5 * kit.geometry.reach_m(), "{i} {joint}");
                }
            }
            let least = near.iter().map(|near| near.distance).fold(f64::INFINITY, f64::min);
            assert_eq!(placed.nearest(&ball).distance, least);
            assert_eq!(kit.avoid.clearance(&rotors(angles), &[ball]), least);
        }
    }
}

/// What the joints lack of a goal, rad: the swing the short way, the others along their travel.
fn lack(from: [f64; 4], to: [f64; 4]) -> [f64; 4] {
    core::array::from_fn(|i| if i == 0 { wrapped(to[0] - from[0]) } else { to[i] - from[i] })
}

fn longest(ways: [f64; 4]) -> f64 {
    ways.iter().zip(SPEEDS_RAD_S).map(|(way, speed)| way.abs() / speed).fold(0.0, f64::max)
}

#[test]
fn with_nothing_in_the_way_all_joints_go_straight_and_arrive_together() {
    let mut random = Random::new(7);
    for kit in kits() {
        for _ in 0..200 {
            let (from, to) = (kit.pose(&mut random), kit.pose(&mut random));
            let way = lack(from, to);
            let time = longest(way);
            // The arc's polynomial is off by 0.026 rad at half a turn and by 2e-3 at a third.
            let off = if way[0].abs() > 2.0 { 0.03 } else { 3e-3 };
            if time < kit.parameters.approach_s {
                continue;
            }
            let step = kit.avoid.step(&rotors(from), &kit.avoid.aim(&rotors(to)), &[]);
            assert!((step.to_go_s - time).abs() < off / 0.45, "{} {time}", step.to_go_s);
            for i in 0..4 {
                assert!((step.rates[i] * time - way[i]).abs() < 4.0 * off, "{i}: {step:?} {way:?}");
            }
            assert!((step.pace - 1.0).abs() < 1e-9 && step.clearance == 1000.0, "{step:?}");
        }
    }
}

#[test]
fn next_to_its_aim_a_step_slows_down_over_the_time_to_settle() {
    let kit = &kits()[0];
    let [boom, arm, bucket] = kit.angles([0.5; 3]);
    let from = [0.3, boom, arm, bucket];
    let way = [0.02, -0.01, 0.015, -0.02];
    let to = core::array::from_fn(|i| from[i] + way[i]);
    let step = kit.avoid.step(&rotors(from), &kit.avoid.aim(&rotors(to)), &[]);
    for (rate, way) in step.rates.iter().zip(way) {
        assert!((rate - way / kit.parameters.settle_s).abs() < 1e-5, "{step:?}");
    }
    assert!((step.to_go_s - 0.01 / 0.45).abs() < 1e-4 && (step.pace - longest(step.rates)).abs() < 1e-12, "{step:?}");
}

fn dot(row: &[f64; 4], rates: &[f64; 4]) -> f64 {
    row.iter().zip(rates).map(|(a, b)| a * b).sum()
}

#[test]
fn no_step_is_too_fast_for_a_joint_a_stop_or_an_obstacle() {
    let mut random = Random::new(11);
    let mut gave_way = 0;
    for kit in kits() {
        let p: AvoidParameters = kit.parameters;
        let [low, high] = [kit.angles([0.0; 3]), kit.angles([1.0; 3])];
        for _ in 0..300 {
            let (from, to) = (kit.pose(&mut random), kit.pose(&mut random));
            let balls = [0; 2].map(|_| kit.ball_beside(from, &mut random));
            let joints = rotors(from);
            let aim = kit.avoid.aim(&rotors(to));
            let (step, free) = (kit.avoid.step(&joints, &aim, &balls), kit.avoid.step(&joints, &aim, &[]));
            let near: Vec<Near<f64>> = balls.iter().flat_map(|ball| kit.hull.place(&joints).near(ball)).collect();
            for near in &near {
                let allowed = (near.distance - p.stop_m) / p.approach_s;
                let closing = -dot(&near.row, &step.rates);
                assert!(closing <= allowed.max(0.0) + 1e-9, "{closing} {allowed}");
            }
            assert!(longest(step.rates) <= 1.0 + 1e-12, "{step:?}");
            for i in 0..3 {
                let (rate, at) = (step.rates[i + 1], from[i + 1]);
                let (first, last) = (low[i].min(high[i]), low[i].max(high[i]));
                assert!(rate * p.approach_s < last - at + 5e-3 && rate * p.approach_s > first - at - 5e-3, "{i}");
            }
            let least = near.iter().map(|near| near.distance).fold(f64::INFINITY, f64::min);
            assert_eq!(step.clearance, least);
            assert_eq!((step.to_go_s, longest(step.rates)), (free.to_go_s, step.pace));
            gave_way += u32::from(step.rates != free.rates);
        }
    }
    assert!(gave_way > 100, "{gave_way}");
}

#[test]
fn one_obstacle_changes_the_rates_by_as_little_as_can_be_in_shares_of_the_speed_limits() {
    let mut random = Random::new(13);
    let mut seen = 0;
    for kit in kits() {
        let p = kit.parameters;
        let [low, high] = [kit.angles([0.0; 3]), kit.angles([1.0; 3])];
        for _ in 0..800 {
            let (from, to) = (kit.pose(&mut random), kit.pose(&mut random));
            let ball = kit.ball_beside(from, &mut random);
            let joints = rotors(from);
            let aim = kit.avoid.aim(&rotors(to));
            let wish = kit.avoid.step(&joints, &aim, &[]).rates;
            let step = kit.avoid.step(&joints, &aim, &[ball]);
            let near = kit.hull.place(&joints).near(&ball);
            let allowed = |near: &Near<f64>| (near.distance - p.stop_m) / p.approach_s;
            let pressing: Vec<_> = near.iter().filter(|near| -dot(&near.row, &wish) > allowed(near)).collect();
            let [pressing] = pressing[..] else { continue };
            let moved: [f64; 4] = core::array::from_fn(|i| pressing.row[i] * SPEEDS_RAD_S[i] * SPEEDS_RAD_S[i]);
            let square = dot(&pressing.row, &moved);
            let missing = -allowed(pressing) - dot(&pressing.row, &wish);
            let expected: [f64; 4] = core::array::from_fn(|i| wish[i] + moved[i] * missing / square);
            let others_hold = near.iter().all(|near| -dot(&near.row, &expected) <= allowed(near) + 1e-9);
            let far_from_stops = (0..3).all(|i| {
                let room = (from[i + 1] - low[i]).abs().min((from[i + 1] - high[i]).abs());
                expected[i + 1].abs() * p.approach_s < room - 5e-3
            });
            if square < p.trusted_mps * p.trusted_mps || !others_hold || !far_from_stops || longest(expected) > 1.0 {
                continue;
            }
            for i in 0..4 {
                assert!((step.rates[i] - expected[i]).abs() < 1e-9, "{:?} {expected:?}", step.rates);
            }
            seen += 1;
        }
    }
    println!("one obstacle in the way: {seen}");
    assert!(seen > 20, "{seen}");
}

#[test]
fn a_pose_is_within_the_travel_as_far_as_the_cylinders_reach() {
    for kit in kits() {
        let [low, high] = [kit.angles([0.0; 3]), kit.angles([1.0; 3])];
        let [boom, arm, bucket] = kit.angles([0.5; 3]);
        let within = |angles: [f64; 4]| kit.avoid.within_travel(&kit.avoid.aim(&rotors(angles)));
        for which in 0..3 {
            for (end, other) in [(low[which], high[which]), (high[which], low[which])] {
                let outwards = (end - other).signum();
                let mut angles = [2.0, boom, arm, bucket];
                angles[which + 1] = end - 5e-3 * outwards;
                assert!(within(angles), "{which}");
                angles[which + 1] = end + 5e-3 * outwards;
                assert!(!within(angles), "{which}");
            }
        }
    }
}

#[test]
fn a_swing_cylinder_s_travel_is_kept_and_there_is_one_way_round_only() {
    let (_, g) = machines::all().unwrap()[0];
    let (kit, pins) = (Kit::new(&g), g.swing.unwrap());
    let swing = *kit.machine.swing_cylinder().unwrap();
    let [right, left] = [pins.stroke.min_m, pins.stroke.max_m].map(|length| swing.rotor(length).unwrap().angle());
    let planar = kit.angles([0.5; 3]);
    let at = |swing: f64| rotors([swing, planar[0], planar[1], planar[2]]);
    let within = |swing: f64| kit.avoid.within_travel(&kit.avoid.aim(&at(swing)));
    assert!(
        right < left && within(right + 0.01) && within(left - 0.01) && !within(right - 0.01) && !within(left + 0.01)
    );
    for (from, to) in [(right + 0.1, left - 0.1), (left - 0.1, right + 0.1), (0.0, left - 0.02)] {
        let step = kit.avoid.step(&at(from), &kit.avoid.aim(&at(to)), &[]);
        let time = (to - from).abs() / SPEEDS_RAD_S[0];
        assert!((step.to_go_s - time).abs() < 5e-3, "{step:?} {time}");
        assert!((step.rates[0] * time - (to - from)).abs() < 5e-3, "{step:?}");
    }
    // A hair before its stop it creeps, whatever it is told.
    let step = kit.avoid.step(&at(left - 0.01), &kit.avoid.aim(&at(left + 1.0)), &[]);
    assert!((step.rates[0] * kit.parameters.approach_s - 0.01).abs() < 2e-3, "{step:?}");
}

#[test]
fn joints_advance_by_their_rates_and_stay_of_unit_length() {
    let from = [0.3, -0.4, 1.5, -2.0];
    let rates = [0.7, -0.2, 1.0, 0.4];
    let after = kinematics_core::planning::avoid::advanced(&rotors(from), &rates, 0.01);
    for i in 0..4 {
        let exact = Rotor::from_angle(from[i] + 0.01 * rates[i]);
        assert!(hypot(after[i].cos - exact.cos, after[i].sin - exact.sin) < 1e-6, "{i}");
        assert!((hypot(after[i].cos, after[i].sin) - 1.0).abs() < 1e-12, "{i}");
    }
}

#[test]
fn parameters_by_rule_go_by_reach_and_by_delay_and_what_is_out_of_range_is_named() {
    let rule = AvoidParameters::of_reach(8.0, SPEEDS_RAD_S);
    assert_eq!((rule.speeds_rad_s, rule.approach_s, rule.settle_s), (SPEEDS_RAD_S, 0.3, 0.25));
    assert!((rule.stop_m - 0.08).abs() < 1e-12 && (rule.trusted_mps - 0.16).abs() < 1e-12);
    assert_eq!(rule.with_delay(0.1), rule);
    let late = rule.with_delay(0.25);
    assert_eq!(late, AvoidParameters { approach_s: 0.75, settle_s: 0.75, ..rule });

    let kit = &kits()[0];
    let refused = |p: AvoidParameters| Avoid::new(&kit.geometry, kit.hull, &p).unwrap_err();
    for bad in [0.0, -1.0, f64::NAN, 1e6] {
        for joint in 0..4 {
            let mut p = rule;
            p.speeds_rad_s[joint] = bad;
            assert_eq!(refused(p), AvoidError::Speed { joint });
        }
        for (p, field) in [
            (AvoidParameters { stop_m: bad, ..rule }, "stop_m"),
            (AvoidParameters { approach_s: bad, ..rule }, "approach_s"),
            (AvoidParameters { settle_s: bad, ..rule }, "settle_s"),
            (AvoidParameters { trusted_mps: bad, ..rule }, "trusted_mps"),
        ] {
            assert_eq!(refused(p), AvoidError::NotPositive { field });
            assert!(refused(p).to_string().contains(field));
        }
    }
}
