//! The fence: it only reduces, leaves what recedes alone, and no random operator carries any part of the linkage past a limit.

use cross_tests::machines;
use cross_tests::sweep::Random;
use hil_sim::fence::{Kind, campaign};
use hil_sim::machine_file::MachineFile;
use kinematics_core::planning::clearance::HalfSpace;
use kinematics_core::planning::fence::{Fence, Limits, Stopping, SwingRange};
use kinematics_core::planning::outline::{Outline, OutlineShape};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Machine, Rotor};

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
            let through = fence.limit(&placed.strips, swing, &base, &transmissions, &wanted, [1.0; 4]);
            for (let_through, wanted) in through.rates.into_iter().zip(wanted) {
                let part = let_through / wanted;
                assert!((0.0..=1.0).contains(&part), "{name}: {let_through} of {wanted}");
            }
            slowed += usize::from(through.rates != wanted);
            let rates: [f64; 4] = std::array::from_fn(|i| through.rates[i] * transmissions[i]);
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
    let base = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
    let boom = |rate: f64| {
        let wanted = [0.2, rate, 0.0, 0.0];
        fence.limit(&placed.strips, Rotor::IDENTITY, &base, &[1.0; 4], &wanted, [1.0; 4]).rates
    };
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
    let base = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
    // The arm lowers the tip as fast as the boom lifts it.
    let [per_boom, per_arm, _] = tip.ends[0].per_joint.map(|v| v.z);
    let wanted = [0.0, 0.1, -0.1 * per_boom / per_arm * 0.999, 0.0];
    let limit = |receding| fence.limit(&[tip], Rotor::IDENTITY, &base, &[1.0; 4], &wanted, receding).rates;
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

#[test]
fn sixty_random_operators_never_carry_the_linkage_past_a_limit_and_a_fence_of_the_tip_alone_lets_them() {
    for name in ["zx200", "frankel"] {
        let machine = MachineFile::load(name).unwrap();
        let [linkage, tip, none] = campaign(&machine, 60, 1, || {}).unwrap();
        assert_eq!((linkage.fence, tip.fence, none.fence), (Kind::Linkage, Kind::Tip, Kind::None));
        assert_eq!(linkage.violated, 0, "{name}: {linkage:?}");
        assert!(linkage.closest_mm > 0.0 && linkage.let_through > 0.3, "{name}: {linkage:?}");
        assert!(tip.violated > 20 && none.violated >= tip.violated, "{name}: {tip:?} {none:?}");
        assert_eq!([linkage.faults, tip.faults, none.faults], [0; 3], "{name}");
        assert_eq!(none.let_through, 1.0, "{name}");
    }
}
