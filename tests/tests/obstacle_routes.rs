//! Ways round obstacles: the quickest clear pose is gone to, nothing is touched on the way, and a scene mirrored or turned about the
//! swing axis is solved alike.

use cross_tests::machines;
use cross_tests::obstacle_kit::{Kit, SPEEDS_RAD_S, rotors, wrapped};
use cross_tests::sweep::Random;
use kinematics_core::planning::avoid::advanced;
use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::reach::{GRID, PITCHES, Progress, Reach, Target};
use kinematics_core::{Joints, PinGeometry, PlaneTip, Rotor};
use libm::{cos, hypot, sin};

const TICK_S: f64 = 0.004;
const TOLERANCE_M: f64 = 0.01;
/// Pieces of planning before the first rehearsal: poses before the swing axis and behind it, postures of one obstacle, routes.
const ROUTES: usize = 90;

struct Played {
    ended: Progress,
    /// Ticks before it moved, and while it did.
    planning: usize,
    moving: usize,
    joints: [Rotor<f64>; 4],
    clearance_m: f64,
    /// How far the swing went to the left and to the right of its start, rad.
    swung: [f64; 2],
}

fn play<const N: usize>(kit: &Kit, start: [f64; 4], target: Target<f64>, balls: [Sphere<f64>; N]) -> Played {
    let mut reach = Reach::new(kit.avoid, *kit.machine.chain(), target, balls, TOLERANCE_M);
    let mut joints = rotors(start);
    let (mut planning, mut moving, mut clearance_m, mut swung) = (0, 0, f64::INFINITY, [0.0f64; 2]);
    let (mut swing, mut before) = (0.0, [joints; 2]);
    loop {
        let told = reach.tick(&joints, TICK_S);
        for (rate, speed) in told.rates.iter().zip(SPEEDS_RAD_S) {
            assert!(rate.abs() <= speed * (1.0 + 1e-9), "{told:?}");
        }
        match told.progress {
            Progress::Planning => {
                assert_eq!((told.rates, told.clearance), ([0.0; 4], None));
                planning += 1;
            }
            Progress::Moving => {
                moving += 1;
                if let Some(found) = told.clearance {
                    // A step takes three ticks; where everything is was seen in the first.
                    assert_eq!(found, kit.avoid.clearance(&before[0], &balls));
                }
            }
            ended => {
                assert_eq!(told.rates, [0.0; 4]);
                assert_eq!(reach.tick(&joints, TICK_S).progress, ended, "an end is kept");
                return Played { ended, planning, moving, joints, clearance_m, swung };
            }
        }
        before = [before[1], joints];
        joints = advanced(&joints, &told.rates, TICK_S);
        swing += told.rates[0] * TICK_S;
        swung = [swung[0].max(swing), swung[1].min(swing)];
        clearance_m = clearance_m.min(kit.avoid.clearance(&joints, &balls));
        assert!(planning + moving < 40_000, "{told:?}");
    }
}

/// Where the tip is, by trigonometry.
fn tip(kit: &Kit, [swing, boom, arm, bucket]: [f64; 4]) -> Target<f64> {
    let g = &kit.geometry;
    let links = [(g.boom_m, boom), (g.arm_m, boom + arm), (g.bucket_m, boom + arm + bucket)];
    let out = g.boom_pin_x_m + links.iter().map(|(length, angle)| length * cos(*angle)).sum::<f64>();
    let z = links.iter().map(|(length, angle)| length * sin(*angle)).sum();
    Target { x: out * cos(swing), y: out * sin(swing), z }
}

fn angles_of(joints: &[Rotor<f64>; 4]) -> [f64; 4] {
    joints.map(|joint| joint.angle())
}

/// Counted on from the middle of the travel, for times; swing as it is.
fn along_travel(kit: &Kit, angles: [f64; 4]) -> [f64; 4] {
    let middle = kit.angles([0.5; 3]);
    core::array::from_fn(|i| if i == 0 { angles[0] } else { middle[i - 1] + wrapped(angles[i] - middle[i - 1]) })
}

fn time(kit: &Kit, from: [f64; 4], to: [f64; 4]) -> f64 {
    let (from, to) = (along_travel(kit, from), along_travel(kit, to));
    let way = |i: usize| if i == 0 { wrapped(to[0] - from[0]) } else { to[i] - from[i] };
    (0..4).map(|i| way(i).abs() / SPEEDS_RAD_S[i]).fold(0.0, f64::max)
}

/// Every pose that reaches the target within the strokes and clear of the balls, on both sides of the swing axis, with its time.
fn clear_poses(kit: &Kit, start: [f64; 4], target: Target<f64>, balls: &[Sphere<f64>]) -> Vec<([f64; 4], f64)> {
    let mut found = Vec::new();
    for (ahead, way) in [(0.0, 1.0), (std::f64::consts::PI, -1.0)] {
        for i in 0..PITCHES {
            let pitch = Rotor::from_turns(i as f64 / PITCHES as f64);
            let plane = PlaneTip { reach: way * hypot(target.x, target.y), height: target.z, pitch };
            let Ok(joints) = kit.machine.chain().joints(&plane) else { continue };
            let Joints { boom, arm, bucket } = joints;
            let swing = wrapped(libm::atan2(target.y, target.x) + ahead);
            let pose = [swing, boom.angle(), arm.angle(), bucket.angle()];
            let near = |ball: &Sphere<f64>| kit.hull.place(&rotors(pose)).nearest(ball).distance;
            let clear = balls.iter().all(|ball| near(ball) > 1.02 * kit.parameters.stop_m);
            if kit.machine.joints_to_cylinders(&joints).is_ok() && clear {
                found.push((pose, time(kit, start, pose)));
            }
        }
    }
    found
}

fn kit() -> Kit {
    Kit::new(&PinGeometry::EXACT_MINI)
}

/// Straight ahead, well inside the strokes.
fn ready(kit: &Kit, swing: f64) -> [f64; 4] {
    let [boom, arm, bucket] = kit.angles([0.55, 0.4, 0.5]);
    [swing, boom, arm, bucket]
}

#[test]
fn the_quickest_clear_pose_is_gone_to_in_about_its_time() {
    let mut random = Random::new(17);
    let kit = kit();
    // Of postures five places of the boom, four of the arm, three of the bucket.
    assert_eq!((PITCHES, GRID), (64, 5 * 4 * 3));
    for _ in 0..6 {
        let (start, goal) = (kit.pose(&mut random), kit.pose(&mut random));
        let target = tip(&kit, goal);
        let poses = clear_poses(&kit, start, target, &[]);
        let Some(least) = poses.iter().map(|(_, time)| *time).min_by(f64::total_cmp) else { continue };
        let played = play(&kit, start, target, []);
        assert_eq!(played.ended, Progress::Reached);
        let end = angles_of(&played.joints);
        let found = tip(&kit, end);
        let miss = hypot(hypot(found.x - target.x, found.y - target.y), found.z - target.z);
        assert!(miss <= TOLERANCE_M, "{miss}");
        // It ends next to one of the quickest poses.
        let apart = |pose: [f64; 4]| (0..4).map(|i| wrapped(pose[i] - end[i]).abs()).fold(0.0, f64::max);
        let quick = poses.iter().filter(|(_, time)| *time < least + 0.02).map(|(pose, _)| apart(*pose));
        assert!(quick.fold(f64::INFINITY, f64::min) < 0.06, "{end:?} {poses:?}");
        // Exponentially over the last of the way.
        let took = played.moving as f64 * TICK_S;
        assert!(took > least - 0.1 && took < least + 2.0, "{took} {least}");
        assert!(played.planning >= 2 * PITCHES + GRID + ROUTES, "{}", played.planning);
    }
}

#[test]
fn a_target_within_a_ball_is_blocked_once_every_pitch_was_tried_in_both_rounds() {
    let kit = kit();
    let start = ready(&kit, 0.0);
    let target = tip(&kit, ready(&kit, 1.5));
    let around = Sphere { x: target.x, y: target.y, z: target.z, radius: 0.5 };
    let played = play(&kit, start, target, [around]);
    assert_eq!((played.ended, played.moving), (Progress::Blocked, 0));
    // 24 times as many pitches where none was clear; the last of them ends it.
    assert_eq!(played.planning, 2 * PITCHES * (1 + 24) - 1);
    let on_the_axis = Target { x: 0.0, y: 0.0, z: 1.0 };
    assert_eq!(play(&kit, start, on_the_axis, []).ended, Progress::Blocked);
    let far = Target { x: 99.0, ..target };
    assert_eq!(play(&kit, start, far, []).ended, Progress::Blocked);
}

fn mirrored(ball: Sphere<f64>) -> Sphere<f64> {
    Sphere { y: -ball.y, ..ball }
}

fn turned(ball: Sphere<f64>, by: f64) -> Sphere<f64> {
    Sphere { x: ball.x * cos(by) - ball.y * sin(by), y: ball.x * sin(by) + ball.y * cos(by), ..ball }
}

/// Balls in the way of a swing from straight ahead to the left.
fn scenes(kit: &Kit) -> Vec<Vec<Sphere<f64>>> {
    let reach = kit.geometry.reach_m();
    let at = |angle: f64, out: f64, z: f64, radius: f64| Sphere {
        x: out * reach * cos(angle),
        y: out * reach * sin(angle),
        z: z * reach,
        radius: radius * reach,
    };
    vec![
        vec![at(0.8, 0.7, 0.0, 0.1)],
        vec![at(0.7, 0.5, -0.1, 0.08)],
        vec![at(0.9, 0.6, 0.35, 0.08)],
        vec![at(0.6, 0.6, -0.2, 0.07), at(1.2, 0.7, 0.2, 0.07)],
    ]
}

fn play_all(kit: &Kit, start: [f64; 4], target: Target<f64>, balls: &[Sphere<f64>]) -> Played {
    match *balls {
        [one] => play(kit, start, target, [one]),
        [one, two] => play(kit, start, target, [one, two]),
        _ => play(kit, start, target, []),
    }
}

#[test]
fn balls_in_the_way_are_passed_at_the_distance_kept_and_the_target_is_reached() {
    for kit in [kit(), Kit::new(&machines::ZX200)] {
        let (start, goal) = (ready(&kit, 0.0), ready(&kit, 1.7));
        let target = tip(&kit, goal);
        for balls in scenes(&kit) {
            let played = play_all(&kit, start, target, &balls);
            assert_eq!(played.ended, Progress::Reached, "{balls:?}");
            assert!(played.clearance_m > 0.9 * kit.parameters.stop_m, "{}", played.clearance_m);
            let found = tip(&kit, angles_of(&played.joints));
            assert!(hypot(hypot(found.x - target.x, found.y - target.y), found.z - target.z) <= TOLERANCE_M);
            println!("{} ticks of planning, {} of motion", played.planning, played.moving);
        }
    }
}

#[test]
fn a_scene_mirrored_at_the_swing_axis_or_turned_about_it_is_solved_alike() {
    let kit = kit();
    let (start, target) = (ready(&kit, 0.0), tip(&kit, ready(&kit, 1.7)));
    for balls in scenes(&kit) {
        let as_it_is = play_all(&kit, start, target, &balls);
        let other_side: Vec<_> = balls.iter().map(|ball| mirrored(*ball)).collect();
        let mirror = play_all(&kit, start, Target { y: -target.y, ..target }, &other_side);
        let by = 2.0;
        let elsewhere: Vec<_> = balls.iter().map(|ball| turned(*ball, by)).collect();
        let away = play_all(&kit, ready(&kit, by), tip(&kit, ready(&kit, 1.7 + by)), &elsewhere);
        let angles = angles_of(&as_it_is.joints);
        for (other, sign, offset) in [(mirror, -1.0, 0.0), (away, 1.0, by)] {
            assert_eq!(other.ended, as_it_is.ended);
            assert!(other.moving.abs_diff(as_it_is.moving) <= 3, "{} {}", other.moving, as_it_is.moving);
            let found = angles_of(&other.joints);
            assert!(wrapped(found[0] - sign * angles[0] - offset).abs() < 1e-3, "{found:?} {angles:?}");
            for i in 1..4 {
                assert!(wrapped(found[i] - angles[i]).abs() < 1e-3, "{found:?} {angles:?}");
            }
        }
    }
}

#[test]
fn a_wall_no_posture_passes_is_gone_round_the_other_way_unless_the_swing_has_stops() {
    let kit = kit();
    let reach = kit.geometry.reach_m();
    let (start, target) = (ready(&kit, 0.0), tip(&kit, ready(&kit, 2.8)));
    // So large and near that the boom touches it in any posture.
    let wall = Sphere { x: 0.35 * reach * cos(1.4), y: 0.35 * reach * sin(1.4), z: 0.1 * reach, radius: 0.16 * reach };
    let played = play(&kit, start, target, [wall]);
    assert_eq!(played.ended, Progress::Reached);
    assert!(played.swung[1] < -3.2 && played.swung[0] < 0.3, "{:?}", played.swung);
    assert!(played.clearance_m > 0.9 * kit.parameters.stop_m, "{}", played.clearance_m);

    let (_, g) = machines::all().unwrap()[0];
    let kit = Kit::new(&g);
    let reach = kit.geometry.reach_m();
    let (cylinder, stroke) = (kit.machine.swing_cylinder().unwrap(), g.swing.unwrap().stroke);
    let [right, left] = [stroke.min_m, stroke.max_m].map(|length| cylinder.rotor(length).unwrap().angle());
    let (start, target) = (ready(&kit, right + 0.05), tip(&kit, ready(&kit, left - 0.05)));
    assert_eq!(play(&kit, start, target, []).ended, Progress::Reached);
    let wall = [-0.15, 0.15].map(|z| {
        let ball = Sphere { x: 0.4 * reach, y: 0.0, z: z * reach, radius: 0.15 * reach };
        turned(ball, 0.5 * (right + left))
    });
    let played = play(&kit, start, target, wall);
    assert_eq!((played.ended, played.moving), (Progress::NoRoute, 0));
}

#[test]
fn from_the_target_there_is_nothing_left_to_do_and_a_restart_begins_anew() {
    let kit = kit();
    let start = ready(&kit, 0.4);
    let target = tip(&kit, start);
    let mut reach = Reach::new(kit.avoid, *kit.machine.chain(), target, [], TOLERANCE_M);
    let joints = rotors(start);
    let mut ticks_to_end = || {
        let ended = (1..5000).find(|_| reach.tick(&joints, TICK_S).progress == Progress::Reached);
        reach.restart();
        ended
    };
    let first = ticks_to_end();
    assert!(first.is_some());
    assert_eq!(ticks_to_end(), first);
}
