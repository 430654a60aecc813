//! Rates there and back, by both Jacobians and with the swing, at random poses of every machine; and the poses without an answer.

use cross_tests::machines;
use cross_tests::rates::{cylinder_rates, cylinders, joint_rates, rotor, twist};
use kinematics_core::jacobian::Twist;
use kinematics_core::swing_jacobian::MachineRates;
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinder, Joints, Machine, PinGeometry, Rotor, Singular};
use proptest::prelude::*;

/// A machine and a length inside each stroke.
fn any_pose() -> impl Strategy<Value = (PinGeometry, [f64; 3])> {
    (0..4usize, [0.0..=1.0, 0.0..=1.0, 0.0..=1.0]).prop_map(|(which, parts)| {
        let g = machines::all().unwrap()[which].1;
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        (g, [0, 1, 2].map(|i| strokes[i].min_m + parts[i] * (strokes[i].max_m - strokes[i].min_m)))
    })
}

fn three() -> impl Strategy<Value = [f64; 3]> {
    [-1.0..=1.0, -1.0..=1.0, -1.0..=1.0]
}

fn close(found: [f64; 3], exact: [f64; 3], within: f64) -> bool {
    let scale = exact.iter().fold(1.0f64, |l, x| l.max(x.abs()));
    found.iter().zip(exact).all(|(f, x)| (f - x).abs() <= within * scale)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn cylinder_rates_to_tip_twist_and_back_come_back((g, at) in any_pose(), rates in three()) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let (pose, jacobian) = machine.cylinders_to_tip_with_jacobian(&cylinders(at), Rotor::IDENTITY).unwrap();
        let arms = machine.moment_arms(&cylinders(at)).unwrap();
        let sent = cylinder_rates(rates);
        let tip = jacobian.twist(&sent);
        let back = jacobian.cylinder_rates(&tip).unwrap();
        prop_assert!(close([back.boom, back.arm, back.bucket], rates, 1e-11), "{back:?}");
        // By way of the joints.
        let joints = arms.joint_rates(&sent).unwrap();
        let joint_space = machine.chain().jacobian(&pose.joints);
        prop_assert!(close(twist(joint_space.twist(&joints)), twist(tip), 1e-12));
        let back = arms.cylinder_rates(&joint_space.joint_rates(&tip).unwrap());
        prop_assert!(close([back.boom, back.arm, back.bucket], rates, 1e-11), "{back:?}");
        // And both cylinder-space Jacobians are one.
        let divided = joint_space.per_cylinder(&arms).unwrap();
        for (one, other) in [(divided.reach, jacobian.reach), (divided.height, jacobian.height), (divided.pitch, jacobian.pitch)] {
            prop_assert!(close(one, other, 1e-12));
        }
    }

    #[test]
    fn pose_and_jacobian_together_have_the_bits_of_the_pose_alone((g, at) in any_pose(), swing in -180.0..180.0f64) {
        let machine = Machine::<f32>::new(&g).unwrap();
        let swing = rotor::<f32>(Rotor::from_degrees(swing));
        let (pose, _) = machine.cylinders_to_tip_with_jacobian(&cylinders(at), swing).unwrap();
        prop_assert_eq!(pose, machine.cylinders_to_tip(&cylinders(at), swing).unwrap());
    }

    #[test]
    fn moment_arms_of_lengths_and_of_joints_are_the_same((g, at) in any_pose()) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let measured = machine.moment_arms(&cylinders(at)).unwrap();
        let given = machine.moment_arms_at(&machine.cylinders_to_joints(&cylinders(at)).unwrap()).unwrap();
        for (one, other) in [(measured.boom, given.boom), (measured.arm, given.arm), (measured.bucket, given.bucket)] {
            prop_assert!((one - other).abs() <= 1e-12 * one.abs(), "{measured:?} {given:?}");
        }
        let moments = machine.moments(&cylinders(at)).unwrap();
        prop_assert!((moments.bucket.arm - measured.bucket).abs() < 1e-12);
        prop_assert!(measured.arm < 0.0 && measured.bucket < 0.0);
    }

    #[test]
    fn the_moment_arms_change_as_their_slopes_say((g, at) in any_pose(), rates in three()) {
        let machine = Machine::<f64>::new(&g).unwrap();
        // Clear of the ends, between which the difference is taken.
        let lengths = cylinders([0, 1, 2].map(|i| {
            let stroke = [g.boom.stroke, g.arm.stroke, g.bucket.stroke][i];
            stroke.min_m + 0.05 * (stroke.max_m - stroke.min_m) + 0.9 * (at[i] - stroke.min_m)
        }));
        let joints = machine.cylinders_to_joints(&lengths).unwrap();
        let told = machine.moments(&lengths).unwrap().rates(&joint_rates(rates));
        let arms = |time: f64| {
            let turned = |joint: Rotor<f64>, rate: f64| joint * Rotor::from_degrees((rate * time).to_degrees());
            machine.moment_arms_at(&Joints {
                boom: turned(joints.boom, rates[0]),
                arm: turned(joints.arm, rates[1]),
                bucket: turned(joints.bucket, rates[2]),
            })
        };
        const STEP_S: f64 = 1e-5;
        let (before, after) = (arms(-STEP_S).unwrap(), arms(STEP_S).unwrap());
        let slope = |before: f64, after: f64| (after - before) / (2.0 * STEP_S);
        let found = [
            slope(before.boom, after.boom),
            slope(before.arm, after.arm),
            slope(before.bucket, after.bucket),
        ];
        prop_assert!(close([told.boom, told.arm, told.bucket], found, 1e-5), "{told:?} {found:?}");
    }

    #[test]
    fn all_four_joints_to_tip_twist_and_back_come_back((g, at) in any_pose(), rates in three(), turning in -1.0..1.0, swing in -180.0..180.0) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let pose = machine.cylinders_to_tip(&cylinders(at), Rotor::from_degrees(swing)).unwrap();
        prop_assume!(pose.plane.reach.abs() > 0.01);
        let jacobian = machine.chain().swing_jacobian(&pose.joints, pose.swing);
        let sent = MachineRates { swing: turning, joints: joint_rates(rates) };
        let back = jacobian.rates(&jacobian.twist(&sent)).unwrap();
        prop_assert!((back.swing - turning).abs() < 1e-12);
        prop_assert!(close([back.joints.boom, back.joints.arm, back.joints.bucket], rates, 1e-11));
        // The product with the matrix is the same.
        let v = jacobian.twist(&sent);
        for (row, found) in jacobian.matrix().iter().zip([v.x, v.y, v.z, v.pitch]) {
            let product = row[0] * turning + row[1] * rates[0] + row[2] * rates[1] + row[3] * rates[2];
            prop_assert!((product - found).abs() < 1e-12);
        }
    }

    #[test]
    fn swing_and_heading_turn_velocities_and_change_nothing_in_the_plane(
        (g, at) in any_pose(), rates in three(), turning in -1.0..1.0, swing in -180.0..180.0, heading in -180.0..180.0,
    ) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
        let of = MachineRates { swing: turning, joints: joint_rates(rates) };
        let [swing, heading] = [swing, heading].map(Rotor::from_degrees);
        let ahead = machine.chain().swing_jacobian(&joints, Rotor::IDENTITY).twist(&of);
        let swung = machine.chain().swing_jacobian(&joints, swing).twist(&of);
        let also_headed = machine.chain().swing_jacobian(&joints, swing * heading).twist(&of);
        prop_assert!(close([swung.z, swung.pitch, also_headed.z], [ahead.z, ahead.pitch, ahead.z], 1e-14));
        // A velocity turns like a point.
        let turned = BasePlacement::level(swing, [0.0; 3]).to_world([ahead.x, ahead.y, ahead.z]);
        prop_assert!(close([swung.x, swung.y, swung.z], turned, 1e-14));
        let in_world = BasePlacement::level(heading, [0.0; 3]).to_world([swung.x, swung.y, swung.z]);
        prop_assert!(close([also_headed.x, also_headed.y, also_headed.z], in_world, 1e-13));
        // Ahead, the plane's own twist and the swing across it.
        let plane = machine.chain().jacobian(&joints).twist(&of.joints);
        prop_assert!(close([ahead.x, ahead.z, ahead.pitch], twist(plane), 1e-14));
        prop_assert!((ahead.y - turning * machine.chain().tip(&joints).reach).abs() < 1e-14);
    }

    #[test]
    fn the_determinant_is_that_of_the_matrix((g, at) in any_pose()) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let jacobian = machine.chain().jacobian(&machine.cylinders_to_joints(&cylinders(at)).unwrap());
        let [[a, b, c], [d, e, f], _] = jacobian.matrix();
        let product = a * (e - f) - b * (d - f) + c * (d - e);
        prop_assert!((jacobian.determinant() - product).abs() < 1e-12 * g.reach_m() * g.reach_m());
    }
}

#[test]
fn frankels_swing_cylinder_has_the_moment_arm_of_its_differences() {
    let g = machines::frankel_distances().to_pins().unwrap();
    let stroke = g.swing.unwrap().stroke;
    let machine = Machine::<f64>::new(&g).unwrap();
    let cylinder = machine.swing_cylinder().unwrap();
    for n in 1..100 {
        let (length, h) = (stroke.min_m + f64::from(n) / 100.0 * (stroke.max_m - stroke.min_m), 1e-6);
        let turned = cylinder.rotor(length + h).unwrap() * cylinder.rotor(length - h).unwrap().inverse();
        let exact = 2.0 * h / turned.angle();
        let found = cylinder.moment_arm(length).unwrap();
        assert!((found - exact).abs() < 1e-7 * exact.abs(), "{found} {exact}");
    }
    assert!(cylinder.moment_arm(stroke.max_m + 0.01).is_err());
}

#[test]
fn a_dead_point_is_named_and_the_other_way_still_answers() {
    let mut g = machines::frankel_distances().to_pins().unwrap();
    let straight = g.boom.base.norm() + g.boom.rod.norm();
    g.boom.stroke.max_m = straight - 2e-6;
    let machine = Machine::<f64>::new(&g).unwrap();
    let at = [straight, g.arm.stroke.max_m, g.bucket.stroke.max_m];
    // Rounding may put the sum of two roots to either side of the dead point.
    let found = [-1e-15, 0.0, 1e-15].map(|by| machine.moment_arms(&cylinders([at[0] + by, at[1], at[2]])));
    let arms = found.into_iter().find_map(Result::ok).unwrap();
    assert!(arms.boom.abs() < 1e-7, "{arms:?}");
    let dead = Singular::DeadPoint { cylinder: Cylinder::Boom };
    assert_eq!(arms.joint_rates(&cylinder_rates([0.1, 0.1, 0.1])), Err(dead));
    assert_eq!(arms.transmissions(), Err(dead));
    assert!(arms.cylinder_rates(&joint_rates([1.0, 1.0, 1.0])).boom.abs() < 1e-7);
    assert_eq!(dead.to_string(), "the boom cylinder is at a dead point of its linkage");
}

#[test]
fn a_stretched_arm_and_a_tip_on_the_swing_axis_are_named() {
    let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI).unwrap();
    let chain = machine.chain();
    let stretched = Joints { boom: rotor(Rotor::from_degrees(20.0)), arm: Rotor::IDENTITY, bucket: Rotor::IDENTITY };
    let twist = Twist { reach: 1.0, height: 0.0, pitch: 0.0 };
    assert_eq!(chain.jacobian(&stretched).joint_rates(&twist), Err(Singular::ArmStretched));
    // Straight up, exact-mini's tip stands on the axis.
    let up = Joints { boom: Rotor { cos: 0.0, sin: 1.0 }, ..stretched };
    let base = chain.swing_jacobian(&up, Rotor::IDENTITY);
    let wanted = base.twist(&MachineRates { swing: 1.0, joints: joint_rates([1.0, 0.0, 0.0]) });
    assert_eq!(base.rates(&wanted), Err(Singular::TipOnSwingAxis));
}

#[test]
fn a_linkage_that_does_not_close_has_no_moment_arm() {
    let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI).unwrap();
    let g = PinGeometry::EXACT_MINI;
    let inside = [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| 0.5 * (s.min_m + s.max_m));
    for which in 0..3 {
        for bad in [0.0, 9.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut at = inside;
            at[which] = bad;
            assert!(machine.moment_arms(&cylinders(at)).is_err(), "{at:?}");
            assert!(machine.moments(&cylinders(at)).is_err(), "{at:?}");
            let quick = machine.cylinders_to_tip_with_jacobian(&cylinders(at), Rotor::IDENTITY);
            assert!(quick.is_err(), "{at:?}");
            let fine = machine.cylinders_to_tip_with_fine_jacobian(&cylinders(at), Rotor::IDENTITY);
            // A length that is not a number is not equal to itself, nor is what is said of it.
            assert!(fine.is_err() && (at[which].is_nan() || fine == quick), "{at:?}");
        }
    }
}
