//! Properties that hold at every pose of every machine: the maps undo each other and agree with the papers' matrices.

use cross_tests::machines;
use kinematics_core::chain::{digging_angle, pitch_from_digging_angle};
use kinematics_core::swing::plane_through;
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, PlaneTip, PoseError, Real, Rotor, Vec2};
use proptest::prelude::*;

/// A machine and a length inside each stroke.
fn poses() -> impl Strategy<Value = (PinGeometry, [f64; 3])> {
    (0..4usize, [0.0..=1.0, 0.0..=1.0, 0.0..=1.0]).prop_map(|(which, parts)| {
        let g = machines::all().unwrap()[which].1;
        let [boom, arm, bucket] = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        let at = |part: f64, min: f64, max: f64| min + part * (max - min);
        let [p, q, r] = parts;
        (g, [at(p, boom.min_m, boom.max_m), at(q, arm.min_m, arm.max_m), at(r, bucket.min_m, bucket.max_m)])
    })
}

fn rotors() -> impl Strategy<Value = Rotor<f64>> {
    (-180.0..=180.0).prop_map(Rotor::from_degrees)
}

fn cylinders<T: Real>(lengths: [f64; 3]) -> Cylinders<T> {
    let [boom, arm, bucket] = lengths.map(T::from_f64);
    Cylinders { boom, arm, bucket }
}

fn lengths<T: Real>(c: Cylinders<T>) -> [f64; 3] {
    [c.boom, c.arm, c.bucket].map(T::to_f64)
}

fn narrow(r: Rotor<f64>) -> Rotor<f32> {
    Rotor { cos: r.cos as f32, sin: r.sin as f32 }
}

/// The distance between two rotors: the angle, for small ones.
fn between<T: Real>(l: Rotor<T>, r: Rotor<T>) -> f64 {
    libm::hypot(l.cos.to_f64() - r.cos.to_f64(), l.sin.to_f64() - r.sin.to_f64())
}

fn joints_between<T: Real>(l: &Joints<T>, r: &Joints<T>) -> f64 {
    between(l.boom, r.boom).max(between(l.arm, r.arm)).max(between(l.bucket, r.bucket))
}

fn cylinders_come_back<T: Real>(g: &PinGeometry, at: [f64; 3], within: f64) {
    let machine = Machine::<T>::new(g).unwrap();
    let sent = cylinders::<T>(at);
    let joints = machine.cylinders_to_joints(&sent).unwrap();
    let back = lengths(machine.joints_to_cylinders_any_stroke(&joints).unwrap());
    for (back, sent) in back.iter().zip(lengths(sent)) {
        assert!((back - sent).abs() <= within, "{back} m, sent {sent} m");
    }
}

fn joints_come_back<T: Real>(g: &PinGeometry, at: [f64; 3], within: f64) {
    let machine = Machine::<T>::new(g).unwrap();
    let sent = machine.cylinders_to_joints(&cylinders::<T>(at)).unwrap();
    let tip = machine.joints_to_tip(&sent, Rotor::IDENTITY).plane;
    let back = machine.tip_to_joints(&tip).unwrap();
    let error = joints_between(&back, &sent);
    assert!(error <= within, "off by {error:e} rad: {sent:?}, {back:?}");
    // The same from the wrist.
    let from_wrist = machine.chain().joints_from_wrist(machine.chain().wrist(&sent), sent.pitch()).unwrap();
    let error = joints_between(&from_wrist, &sent);
    assert!(error <= within, "off by {error:e} rad from the wrist: {sent:?}, {from_wrist:?}");
}

fn near(l: f64, r: f64) -> bool {
    (l - r).abs() <= 1e-14 * (1.0 + l.abs())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn cylinders_to_joints_to_cylinders_comes_back((g, at) in poses()) {
        cylinders_come_back::<f64>(&g, at, 4e-15);
        cylinders_come_back::<f32>(&g, at, 1e-6);
    }

    #[test]
    fn joints_to_tip_to_joints_comes_back((g, at) in poses()) {
        // Near the stretched arm a rounding of the tip turns the joints by its root.
        joints_come_back::<f64>(&g, at, 3e-14);
        joints_come_back::<f32>(&g, at, 6e-6);
    }

    #[test]
    fn a_tip_gets_the_cylinders_that_put_the_tip_there_or_none(
        which in 0..4usize,
        (radius, around) in (0.0..1.0, rotors()),
        pitch in rotors(),
    ) {
        let g = machines::all().unwrap()[which].1;
        let machine = Machine::<f64>::new(&g).unwrap();
        let at = around.to_vec().scale(radius * g.reach_m());
        let tip = PlaneTip { reach: g.boom_pin_x_m + at.x, height: at.z, pitch };
        if let Ok(found) = machine.tip_to_cylinders(&tip) {
            let back = machine.cylinders_to_tip(&found, Rotor::IDENTITY).unwrap().plane;
            let off = libm::hypot(back.reach - tip.reach, back.height - tip.height);
            prop_assert!(off < 1e-9 && between(back.pitch, tip.pitch) < 1e-9, "{tip:?} came back as {back:?}");
        }
    }

    #[test]
    fn koivos_matrix_product_is_the_chain((g, at) in poses(), swing in rotors()) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let pose = machine.cylinders_to_tip(&cylinders(at), swing).unwrap();
        let m = machine.chain().base_to_tip(swing, &pose.joints);
        prop_assert!(near(m[0][3], pose.x) && near(m[1][3], pose.y) && near(m[2][3], pose.z()), "{m:?}, {pose:?}");
        // The x axis points along the bucket, in the plane swung by θ1; the z axis stands across that plane.
        let pitch = pose.plane.pitch;
        for (row, exact) in m.iter().zip([pitch.cos * swing.cos, pitch.cos * swing.sin, pitch.sin, 0.0]) {
            prop_assert!(near(row[0], exact), "{m:?}");
        }
        for (row, exact) in m.iter().zip([swing.sin, -swing.cos, 0.0, 0.0]) {
            prop_assert!(near(row[2], exact), "{m:?}");
        }
        let wrist = machine.chain().wrist(&pose.joints);
        let m = machine.chain().base_to_wrist(swing, &pose.joints);
        prop_assert!(near(m[0][3], wrist.x * swing.cos) && near(m[1][3], wrist.x * swing.sin) && near(m[2][3], wrist.z));
    }

    #[test]
    fn swinging_moves_the_tip_on_a_circle_and_changes_nothing_in_the_plane((g, at) in poses(), swing in rotors()) {
        let machine = Machine::<f32>::new(&g).unwrap();
        let ahead = machine.cylinders_to_tip(&cylinders(at), Rotor::IDENTITY).unwrap();
        let swung = machine.cylinders_to_tip(&cylinders(at), narrow(swing)).unwrap();
        prop_assert_eq!(ahead.plane, swung.plane);
        prop_assert_eq!((ahead.x, ahead.y), (ahead.plane.reach, 0.0));
        let radius = libm::hypot(f64::from(swung.x), f64::from(swung.y));
        prop_assert!((radius - f64::from(ahead.x.abs())).abs() <= 2e-7 * g.reach_m());
    }

    #[test]
    fn the_wrist_and_the_bucket_along_the_pitch_make_the_tip((g, at) in poses()) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
        let [.., a4] = machine.chain().lengths();
        let tip = machine.chain().tip(&joints);
        let found = machine.chain().wrist(&joints) + joints.pitch().to_vec().scale(a4);
        prop_assert!(near(found.x, tip.reach) && near(found.z, tip.height));
        prop_assert_eq!(joints.pitch(), tip.pitch);
    }

    #[test]
    fn the_unchecked_kernel_gives_the_same_bits((g, at) in poses(), swing in rotors()) {
        let machine = Machine::<f32>::new(&g).unwrap();
        let checked = machine.cylinders_to_tip(&cylinders(at), narrow(swing)).unwrap();
        prop_assert_eq!(checked, machine.cylinders_to_tip_unchecked(&cylinders(at), narrow(swing)));
    }

    #[test]
    fn base_to_world_and_back_comes_back(
        (heading, pitch, roll) in (rotors(), rotors(), rotors()),
        origin in [-1e3..1e3, -1e3..1e3, -1e2..1e2],
        point in [-10.0..10.0, -10.0..10.0, -10.0..10.0],
    ) {
        let placement = BasePlacement { heading, pitch, roll, origin };
        let world = placement.to_world(point);
        for (back, sent) in placement.to_base(world).into_iter().zip(point) {
            prop_assert!((back - sent).abs() < 1e-12);
        }
        // A rigid motion keeps the distance to the origin.
        let norm = |v: [f64; 3]| libm::sqrt(v.iter().map(|x| x * x).sum());
        let away = [0, 1, 2].map(|i| world[i] - origin[i]);
        prop_assert!((norm(away) - norm(point)).abs() < 1e-12);
    }

    #[test]
    fn koivos_6_is_a_heading_of_90_degrees(point in [-10.0..10.0, -10.0..10.0, -10.0..10.0], origin in [-9.0..9.0, -9.0..9.0, -9.0..9.0]) {
        // (6): x0 along the world's y, y0 along its −x, z0 upright.
        let quarter = Rotor { cos: 0.0, sin: 1.0 };
        let [x, y, z] = point;
        let world = BasePlacement::level(quarter, origin).to_world(point);
        let exact = [origin[0] - y, origin[1] + x, origin[2] + z];
        for (found, exact) in world.into_iter().zip(exact) {
            prop_assert!(near(found, exact), "{found} {exact}");
        }
    }

    #[test]
    fn koivos_28_gives_the_digging_angle_both_ways(bottom in rotors(), digging in rotors(), (g, at) in poses()) {
        let pitch = pitch_from_digging_angle(bottom, digging);
        prop_assert!(between(digging_angle(bottom, pitch), digging) < 1e-15);
        // (28) itself: θ4 = θ_b + θ_dg − θ2 − θ3.
        let machine = Machine::<f64>::new(&g).unwrap();
        let joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
        let dug = digging_angle(bottom, joints.pitch());
        let bucket = bottom * dug * joints.boom.inverse() * joints.arm.inverse();
        prop_assert!(between(bucket, joints.bucket) < 1e-14);
    }

    #[test]
    fn a_point_in_space_has_its_plane_in_front_of_the_axis(x in -10.0..10.0, y in -10.0..10.0, z in -10.0..10.0, pitch in rotors()) {
        prop_assume!(libm::hypot(x, y) > 1e-9);
        let (swing, tip) = plane_through(x, y, z, pitch).unwrap();
        prop_assert!(tip.reach > 0.0 && tip.height == z && tip.pitch == pitch);
        prop_assert!(near(tip.reach * swing.cos, x) && near(tip.reach * swing.sin, y));
        prop_assert!(near(swing.to_vec().norm(), 1.0));
    }

    #[test]
    fn the_tip_in_space_leads_back_to_the_pose((g, at) in poses(), swing in rotors()) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let pose = machine.cylinders_to_tip(&cylinders(at), swing).unwrap();
        prop_assume!(pose.plane.reach > 1e-3);
        let (found, tip) = plane_through(pose.x, pose.y, pose.z(), pose.plane.pitch).unwrap();
        prop_assert!(between(found, swing) < 1e-12);
        let PlaneTip { reach, height, .. } = tip;
        prop_assert!(near(reach, pose.plane.reach) && height == pose.plane.height);
    }

    #[test]
    fn frankels_swing_cylinder_comes_back(part in 0.0..=1.0) {
        let g = machines::frankel_distances().to_pins().unwrap();
        let stroke = g.swing.unwrap().stroke;
        let length = stroke.min_m + part * (stroke.max_m - stroke.min_m);
        let machine = Machine::<f64>::new(&g).unwrap();
        let cylinder = machine.swing_cylinder().unwrap();
        let back = cylinder.length(cylinder.rotor(length).unwrap()).unwrap();
        prop_assert!(near(back, length), "{back} {length}");
    }
}

#[test]
fn a_point_on_the_swing_axis_has_no_plane() {
    for z in [-1.0, 0.0, 2.0] {
        let found = plane_through(0.0, -0.0, z, Rotor::<f64>::IDENTITY);
        assert!(matches!(found, Err(PoseError::Unreachable { .. })), "{found:?}");
    }
    for bad in [f64::NAN, f64::INFINITY, 1e200] {
        assert!(plane_through(bad, 1.0, 1.0, Rotor::IDENTITY).is_err(), "{bad}");
    }
}

#[test]
fn a_vector_without_a_direction_has_none() {
    assert_eq!(Vec2::new(0.0f32, -0.0).direction(), None);
    assert_eq!(Vec2::new(f32::NAN, 1.0).direction(), None);
    assert_eq!(Vec2::new(f32::INFINITY, 1.0).direction(), None);
    assert_eq!(Vec2::new(0.0f32, -3.0).direction(), Some(Rotor { cos: 0.0, sin: -1.0 }));
}
