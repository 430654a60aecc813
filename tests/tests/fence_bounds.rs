//! The fence's bounds one by one: balls, planes, the swing's range, on the way from where they were weighed, and no more than they need.

use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::planning::clearance::{Clearance, HalfSpace, Sphere};
use kinematics_core::planning::fence::{Fence, LIMITS, NEAR, Nearby, Scene, Stopping};
use kinematics_core::planning::limits::{Limits, SwingRange};
use kinematics_core::planning::outline::{Outline, OutlineShape, Strip};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};

const STOPPING: Stopping<f64> = Stopping { deceleration: 1.5, reaction_s: 0.12, margin: 0.04 };
const TURNING: Stopping<f64> = Stopping { deceleration: 0.8, reaction_s: 0.2, margin: 0.01 };
const SPARE: [f64; 4] = [0.02, 0.01, 0.015, 0.02];

/// Somewhere a machine stands, with what it wishes.
struct Stand {
    strips: Vec<Strip<f64>>,
    tip: Strip<f64>,
    scene: Scene<f64>,
    moved: [f64; 4],
    reach_m: f64,
}

fn stands(seed: u64, each: usize) -> Vec<Stand> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for (_, g) in machines::all().unwrap() {
        let machine = Machine::<f64>::new(&g).unwrap();
        let outline = Outline::<f64>::new(&g, &OutlineShape::of(&g)).unwrap();
        all.extend((0..each).map(|_| stand(&g, &machine, &outline, &mut random)));
    }
    all
}

fn stand(g: &PinGeometry, machine: &Machine<f64>, outline: &Outline<f64>, random: &mut Random) -> Stand {
    let mut within = |low: f64, high: f64| low + (high - low) * random.unit();
    let [boom, arm, bucket] =
        [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| within(s.min_m + 1e-3, s.max_m - 1e-3));
    let lengths = Cylinders { boom, arm, bucket };
    let placed = outline.place(machine, &machine.cylinders_to_joints(&lengths).unwrap()).unwrap();
    let [b, a, k] = machine.moment_arms(&lengths).unwrap().transmissions().unwrap();
    let scene = Scene {
        swing: Rotor::from_degrees(within(-180.0, 180.0)),
        base: BasePlacement::level(Rotor::from_degrees(within(-180.0, 180.0)), [within(-1.0, 1.0), 2.0, 0.3]),
        transmissions: [1.0, b, a, k],
        wish: [within(-1.0, 1.0), within(-0.3, 0.3), within(-0.4, 0.4), within(-0.5, 0.5)],
        spare: SPARE,
    };
    let moved = SPARE.map(|spare| within(-spare, spare));
    Stand { tip: placed.tip(), strips: placed.strips.to_vec(), scene, moved, reach_m: g.reach_m() }
}

/// Planes and balls about the machine.
fn limits(stand: &Stand, random: &mut Random) -> Limits<f64> {
    let mut within = |low: f64, high: f64| low + (high - low) * random.unit();
    let mut limits = Limits::NONE;
    for slot in 0..2 {
        let angle = Rotor::from_degrees(within(-180.0, 180.0));
        let normal = if slot == 0 { [0.0, 0.6 * angle.cos.signum(), 0.8] } else { [angle.cos, angle.sin, 0.0] };
        limits.half_spaces[slot] = Some(HalfSpace { normal, offset: within(0.2, 1.5) * stand.reach_m });
    }
    for slot in 0..2 {
        let r = stand.reach_m;
        let centre = stand.scene.base.origin;
        let centre = [centre[0] + within(-r, r), centre[1] + within(-r, r), centre[2] + within(-r, r)];
        limits.spheres[slot] = Some(Sphere { centre, radius: within(0.02, 0.2) * r });
    }
    limits
}

/// Every clearance of these strips.
fn clearances(limits: &Limits<f64>, strips: &[Strip<f64>], scene: &Scene<f64>) -> Vec<Clearance<f64>> {
    let spaces = limits.half_spaces.iter().flatten().map(|space| space.seen(&scene.base, scene.swing));
    let planes = spaces.flat_map(|space| strips.iter().flat_map(move |strip| strip.to_half_space(&space)));
    let balls = limits.spheres.iter().flatten().map(|ball| ball.seen(&scene.base, scene.swing));
    let balls = balls.flat_map(|ball| strips.iter().map(move |strip| strip.to_sphere(&ball)));
    planes.chain(balls).collect()
}

fn by_joints(scene: &Scene<f64>, of_actuators: [f64; 4]) -> [f64; 4] {
    core::array::from_fn(|i| of_actuators[i] * scene.transmissions[i])
}

/// By how much an approach is too fast, m/s, at the place it has moved to.
fn too_fast(clearance: &Clearance<f64>, stand: &Stand, rates: [f64; 4]) -> f64 {
    let way = clearance.approach_speed(&by_joints(&stand.scene, stand.moved));
    clearance.approach_speed(&by_joints(&stand.scene, rates)) - STOPPING.speed(clearance.distance - way)
}

#[test]
fn planes_and_balls_are_kept_from_wherever_the_actuators_have_moved_to_since_they_were_weighed() {
    let mut random = Random::new(47);
    let (mut slowed, mut whole) = (0, 0);
    for stand in stands(53, 150) {
        let limits = limits(&stand, &mut random);
        let fence = Fence { limits, stopping: STOPPING, turning: TURNING };
        let mut nearby = Nearby::none();
        fence.weigh_all(&stand.strips, &stand.scene, &mut nearby);
        let wish = stand.scene.wish;
        let through = fence.limit(&nearby, &wish, &[1.0; 4], &stand.moved);
        let all = clearances(&limits, &stand.strips, &stand.scene);
        for clearance in &all {
            assert!(too_fast(clearance, &stand, through) <= 1e-12, "{clearance:?}");
        }
        let closest = all.iter().map(|clearance| clearance.distance).fold(f64::INFINITY, f64::min);
        assert!((nearby.closest - closest).abs() < 1e-12);
        assert_eq!(limits.closest(&stand.strips, stand.scene.swing, &stand.scene.base).unwrap(), closest);
        // The approaches alone, since what recedes may be late.
        let approaches = |c: &Clearance<f64>| {
            let rates = by_joints(&stand.scene, wish);
            let towards: f64 = (0..4).map(|i| (c.approach[i] * rates[i]).max(0.0)).sum();
            let way: f64 = (0..4).map(|i| (c.approach[i] * SPARE[i] * stand.scene.transmissions[i]).abs()).sum();
            towards > STOPPING.speed(c.distance - way)
        };
        if all.iter().all(|c| !approaches(c)) {
            assert_eq!(through, wish, "nothing is near");
            whole += 1;
        }
        slowed += u32::from(through != wish);
    }
    println!("{slowed} slowed, {whole} free");
    assert!(slowed > 100 && whole > 30, "{slowed} {whole}");
}

#[test]
fn the_teeth_alone_before_one_plane_are_slowed_to_the_bound_and_no_further() {
    let mut random = Random::new(59);
    let mut met = 0;
    for stand in stands(61, 150) {
        let mut limits = limits(&stand, &mut random);
        (limits.half_spaces[1], limits.spheres) = (None, Limits::NONE.spheres);
        let fence = Fence { limits, stopping: STOPPING, turning: TURNING };
        let mut nearby = Nearby::none();
        fence.weigh_all(&[stand.tip], &stand.scene, &mut nearby);
        let wish = stand.scene.wish;
        let through = fence.limit(&nearby, &wish, &[1.0; 4], &stand.moved);
        let [clearance, _] = clearances(&limits, &[stand.tip], &stand.scene)[..] else { panic!("two ends") };
        if too_fast(&clearance, &stand, wish) <= 0.0 {
            assert_eq!(through, wish);
            continue;
        }
        assert!(too_fast(&clearance, &stand, through).abs() < 1e-9, "{clearance:?} {through:?}");
        let way = clearance.approach_speed(&by_joints(&stand.scene, stand.moved));
        if clearance.distance - way < STOPPING.margin {
            // No approach is left, and rounding may take what recedes with it.
            continue;
        }
        // What approaches is slowed by one factor, what recedes not at all.
        let parts: Vec<f64> = (0..4).map(|i| through[i] / wish[i]).collect();
        let towards = by_joints(&stand.scene, wish);
        let factor = parts.iter().copied().fold(1.0, f64::min);
        for i in 0..4 {
            let expected = if clearance.approach[i] * towards[i] > 0.0 { factor } else { 1.0 };
            assert!((parts[i] - expected).abs() < 1e-9, "{parts:?}");
        }
        met += 1;
    }
    assert!(met > 30, "{met}");
}

#[test]
fn an_actuator_that_does_not_move_yet_makes_up_for_nothing() {
    let mut random = Random::new(67);
    let mut met = 0;
    for stand in stands(71, 150) {
        let limits = limits(&stand, &mut random);
        let fence = Fence { limits, stopping: STOPPING, turning: TURNING };
        let mut nearby = Nearby::none();
        fence.weigh_all(&stand.strips, &stand.scene, &mut nearby);
        let wish = stand.scene.wish;
        let through = fence.limit(&nearby, &wish, &[0.0; 4], &[0.0; 4]);
        for clearance in clearances(&limits, &stand.strips, &stand.scene) {
            let rates = by_joints(&stand.scene, through);
            let towards: f64 = (0..4).map(|i| (clearance.approach[i] * rates[i]).max(0.0)).sum();
            assert!(towards <= STOPPING.speed(clearance.distance) + 1e-12, "{clearance:?}");
        }
        met += u32::from(through != fence.limit(&nearby, &wish, &[1.0; 4], &[0.0; 4]));
    }
    assert!(met > 20, "{met}");
}

#[test]
fn limits_weighed_piece_by_piece_are_weighed_as_at_once() {
    let mut random = Random::new(73);
    for stand in stands(79, 30) {
        let limits = limits(&stand, &mut random);
        let fence = Fence { limits, stopping: STOPPING, turning: TURNING };
        let mut at_once = Nearby::none();
        fence.weigh_all(&stand.strips, &stand.scene, &mut at_once);
        let reaches = fence.reaches(&stand.strips, &stand.scene);
        let (mut in_pieces, mut pieces) = (Nearby::none(), 0);
        for number in 0..LIMITS {
            let mut from = 0;
            while let Some(next) =
                fence.weigh(number, (&stand.strips, &reaches), (from, NEAR), &stand.scene, &mut in_pieces)
            {
                assert!(next > from && next <= from + NEAR, "{from} {next}");
                (from, pieces) = (next, pieces + 1);
                if from == stand.strips.len() {
                    break;
                }
            }
        }
        assert_eq!(in_pieces, at_once);
        assert!(pieces > 8, "{pieces}");
        in_pieces.clear();
        assert!(in_pieces.is_clear() && in_pieces.closest == Nearby::<f64>::none().closest);
    }
}

#[test]
fn the_swing_may_turn_as_fast_as_it_can_stop_before_the_end_of_its_range() {
    let mut limits = Limits::NONE;
    limits.swing = Some(SwingRange::new(-80.0, 50.0));
    let fence = Fence { limits, stopping: STOPPING, turning: TURNING };
    let base = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
    for (at, rate) in [(40.0, 0.9), (49.0, 0.5), (-70.0, -0.9), (-79.5, -0.4), (40.0, -0.6), (-70.0, 0.7), (55.0, 0.3)]
    {
        let swing = Rotor::from_degrees(at);
        for per_swing in [1.0, -0.5] {
            for moved in [0.0, 0.03, -0.02] {
                let transmissions = [per_swing, 1.0, 1.0, 1.0];
                let wish = [rate / per_swing, 0.1, -0.2, 0.3];
                let scene = Scene { swing, base, transmissions, wish, spare: [0.0; 4] };
                let mut nearby = Nearby::none();
                fence.weigh_all(&[], &scene, &mut nearby);
                let [found, rest @ ..] = fence.limit(&nearby, &wish, &[1.0; 4], &[moved / per_swing, 0.0, 0.0, 0.0]);
                assert_eq!(rest, [0.1, -0.2, 0.3]);
                let end: f64 = if rate > 0.0 { 50.0 - at } else { at + 80.0 };
                let room = end.to_radians() - moved * rate.signum() - TURNING.margin;
                // v²/2a + v·t = room
                let (t, a) = (TURNING.reaction_s, TURNING.deceleration);
                let fastest = if room > 0.0 { a * (libm::sqrt(t * t + 2.0 * room / a) - t) } else { 0.0 };
                let expected = fastest.min(rate.abs());
                let turned = found * per_swing * rate.signum();
                // Never faster, and next to the end as fast: the room is told by its chord.
                let slack = if end < 15.0 { 2e-3 } else { 1.0 };
                assert!(turned <= expected + 1e-9 && turned >= expected - slack, "{at} {rate}: {turned} {expected}");
            }
        }
    }
}
