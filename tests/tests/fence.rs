//! The fence: it only reduces, and leaves what recedes alone.

use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::planning::clearance::HalfSpace;
use kinematics_core::planning::fence::{Fence, Nearby, Scene, Stopping};
use kinematics_core::planning::limits::{Limits, SwingRange};
use kinematics_core::planning::outline::{Outline, OutlineShape, Strip};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Machine, Rotor};

/// What passes of a wish at a place, of actuators that recede as far as told.
fn let_through(
    fence: &Fence<f64>,
    strips: &[Strip<f64>],
    (swing, transmissions): (Rotor<f64>, [f64; 4]),
    wish: [f64; 4],
    receding: [f64; 4],
) -> [f64; 4] {
    let base = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
    let mut nearby = Nearby::none();
    fence.weigh_all(strips, &Scene { swing, base, transmissions, wish, spare: [0.0; 4] }, &mut nearby);
    fence.limit(&nearby, &wish, &receding, &[0.0; 4])
}

const STOPPING: Stopping<f64> = Stopping { deceleration: 2.0, reaction_s: 0.1, margin: 0.05 };

#[test]
fn what_is_let_through_lies_between_nothing_and_what_was_wanted_and_keeps_every_bound() {
    let mut r = Random::new(5);
    let mut slowed = 0;
    for (name, g) in machines::all().unwrap() {
        let machine = Machine::<f64>::new(&g).unwrap();
        let outline = Outline::<f64>::new(&g, &OutlineShape::of(&g)).unwrap();
        for _ in 0..300 {
            let mut within = |low: f64, high: f64| low + (high - low) * r.unit();
            let [boom, arm, bucket] =
                [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| within(s.min_m + 1e-3, s.max_m - 1e-3));
            let lengths = Cylinders { boom, arm, bucket };
            let placed = outline.place(&machine, &machine.cylinders_to_joints(&lengths).unwrap()).unwrap();
            let [b, a, k] = machine.moment_arms(&lengths).unwrap().transmissions().unwrap();
            let swing = Rotor::from_degrees(within(-180.0, 180.0));
            let base = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
            let mut limits = Limits::NONE;
            for (slot, normal) in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]].into_iter().enumerate() {
                limits.half_spaces[slot] = Some(HalfSpace { normal, offset: within(-0.2, 1.2) * g.reach_m() });
            }
            let fence = Fence { limits, stopping: STOPPING, turning: STOPPING };
            let transmissions = [1.0, b, a, k];
            let wanted = [within(-1.0, 1.0), within(-0.3, 0.3), within(-0.4, 0.4), within(-0.5, 0.5)];
            let through = let_through(&fence, &placed.strips, (swing, transmissions), wanted, [1.0; 4]);
            for (let_through, wanted) in through.into_iter().zip(wanted) {
                let part = let_through / wanted;
                assert!((0.0..=1.0).contains(&part), "{name}: {let_through} of {wanted}");
            }
            slowed += usize::from(through != wanted);
            let rates: [f64; 4] = std::array::from_fn(|i| through[i] * transmissions[i]);
            for space in limits.half_spaces.iter().flatten() {
                for end in placed.strips.iter().flat_map(|strip| strip.to_half_space(&space.seen(&base, swing))) {
                    let (speed, fastest) = (end.approach_speed(&rates), STOPPING.speed(end.distance));
                    assert!(speed <= fastest + 1e-12, "{name}: {speed} at {} m", end.distance);
                }
            }
        }
    }
    assert!(slowed > 300, "{slowed}");
}

#[test]
fn inside_a_limit_the_way_out_is_free_and_the_way_in_is_closed() {
    let [_, (_, g), ..] = machines::all().unwrap();
    let machine = Machine::<f64>::new(&g).unwrap();
    let outline = Outline::<f64>::new(&g, &OutlineShape::of(&g)).unwrap();
    let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 }).unwrap();
    let placed = outline.place(&machine, &joints).unwrap();
    let mut limits = Limits::NONE;
    limits.half_spaces[0] = Some(HalfSpace { normal: [0.0, 0.0, 1.0], offset: 0.5 });
    let fence = Fence { limits, stopping: STOPPING, turning: STOPPING };
    let boom =
        |rate: f64| let_through(&fence, &placed.strips, (Rotor::IDENTITY, [1.0; 4]), [0.2, rate, 0.0, 0.0], [1.0; 4]);
    assert_eq!(boom(0.1), [0.2, 0.0, 0.0, 0.0]);
    assert_eq!(boom(-0.1), [0.2, -0.1, 0.0, 0.0]);
}

#[test]
fn an_actuator_at_its_stop_makes_up_for_no_other() {
    let [_, (_, g), ..] = machines::all().unwrap();
    let machine = Machine::<f64>::new(&g).unwrap();
    let outline = Outline::<f64>::new(&g, &OutlineShape::of(&g)).unwrap();
    let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 }).unwrap();
    let tip = outline.place(&machine, &joints).unwrap().tip();
    let mut limits = Limits::NONE;
    limits.half_spaces[0] = Some(HalfSpace { normal: [0.0, 0.0, -1.0], offset: -tip.ends[0].at.z });
    let fence = Fence { limits, stopping: STOPPING, turning: STOPPING };
    // The arm lowers the tip as fast as the boom lifts it.
    let [per_boom, per_arm, _] = tip.ends[0].per_joint.map(|v| v.z);
    let wanted = [0.0, 0.1, -0.1 * per_boom / per_arm * 0.999, 0.0];
    let limit = |receding| let_through(&fence, &[tip], (Rotor::IDENTITY, [1.0; 4]), wanted, receding);
    assert_eq!(limit([1.0; 4]), wanted);
    assert_eq!(limit([1.0, 0.0, 1.0, 1.0]), [0.0, 0.1, 0.0, 0.0]);
}

#[test]
fn the_swing_s_range_may_lie_anywhere_and_its_room_is_never_told_too_large() {
    for (right, left) in [(-60.0, 60.0), (-170.0, 170.0), (100.0, 179.0), (-179.0, -20.0)] {
        let mut limits = Limits::<f64>::NONE;
        limits.swing = Some(SwingRange::new(right, left));
        for step in 0..=3580 {
            let at = -179.0 + f64::from(step) * 0.1;
            let room = limits.swing_room(Rotor::from_degrees(at)).unwrap().to_degrees();
            let (to_right, to_left) = (at - right, left - at);
            let really = if to_right < to_left { to_right } else { to_left };
            if really >= 0.0 {
                assert!(
                    room <= really + 1e-9 && room > 0.63 * really - 1e-9,
                    "{room} of {really} at {at} in {right}…{left}"
                );
            } else if really > -90.0 {
                assert!(room < 0.0, "{room} beyond by {really} at {at} in {right}…{left}");
            }
        }
    }
}
