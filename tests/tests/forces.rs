//! Forces: virtual work at every pose of every machine, both ways, and weights that are told from cylinder forces.

use cross_tests::machines;
use kinematics_core::forces::{JointTorques, Wrench};
use kinematics_core::payload::{LinkMass, Masses, level_gravity};
use kinematics_core::rates::{CylinderRates, JointRates};
use kinematics_core::swing_jacobian::{BaseWrench, MachineRates};
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, Rotor, Singular, Vec2};
use proptest::prelude::*;

fn any_pose() -> impl Strategy<Value = (PinGeometry, Cylinders<f64>)> {
    (0..4usize, [0.0..=1.0, 0.0..=1.0, 0.0..=1.0]).prop_map(|(which, parts)| {
        let g = machines::all().unwrap()[which].1;
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        let [boom, arm, bucket] =
            [0, 1, 2].map(|i| strokes[i].min_m + parts[i] * (strokes[i].max_m - strokes[i].min_m));
        (g, Cylinders { boom, arm, bucket })
    })
}

fn three(size: f64) -> impl Strategy<Value = [f64; 3]> {
    [-size..=size, -size..=size, -size..=size]
}

fn near(l: f64, r: f64, scale: f64) -> bool {
    (l - r).abs() <= 1e-11 * scale
}

/// exact-mini's published masses.
const MINI: Masses<f64> = Masses {
    boom: LinkMass { mass_kg: 227.343, centre: Vec2::new(1.025, 0.384) },
    arm: LinkMass { mass_kg: 130.123, centre: Vec2::new(0.225, 0.227) },
    bucket: LinkMass { mass_kg: 53.0, centre: Vec2::new(0.289, 0.166) },
};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_tip_the_joints_and_the_cylinders_do_the_same_work((g, at) in any_pose(), force in three(1e4), rates in three(1.0)) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let (pose, jacobian) = machine.cylinders_to_tip_with_jacobian(&at, Rotor::IDENTITY).unwrap();
        let joint_space = machine.chain().jacobian(&pose.joints);
        let arms = machine.moment_arms(&at).unwrap();
        let rates = CylinderRates { boom: rates[0], arm: rates[1], bucket: rates[2] };
        let tip = Wrench { reach: force[0], height: force[1], moment: force[2] };

        let joint_rates = arms.joint_rates(&rates).unwrap();
        let v = joint_space.twist(&joint_rates);
        let torques = joint_space.joint_torques(&tip);
        let forces = arms.cylinder_forces(&torques).unwrap();

        let at_tip = tip.reach * v.reach + tip.height * v.height + tip.moment * v.pitch;
        let parts = [torques.boom * joint_rates.boom, torques.arm * joint_rates.arm, torques.bucket * joint_rates.bucket];
        let at_joints: f64 = parts.iter().sum();
        let at_cylinders = forces.boom * rates.boom + forces.arm * rates.arm + forces.bucket * rates.bucket;
        let scale = 1.0 + parts.iter().fold(at_tip.abs(), |l, x| l + x.abs());
        prop_assert!(near(at_joints, at_tip, scale) && near(at_cylinders, at_tip, scale), "{at_tip} {at_joints} {at_cylinders}");

        // In one step from the tip.
        let direct = jacobian.cylinder_forces(&tip);
        let scale = 1.0 + forces.boom.abs() + forces.arm.abs() + forces.bucket.abs();
        prop_assert!(near(direct.boom, forces.boom, scale) && near(direct.arm, forces.arm, scale) && near(direct.bucket, forces.bucket, scale));
    }

    #[test]
    fn measured_cylinder_forces_tell_the_tip_force((g, at) in any_pose(), force in three(1e4)) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let (pose, jacobian) = machine.cylinders_to_tip_with_jacobian(&at, Rotor::IDENTITY).unwrap();
        let sent = Wrench { reach: force[0], height: force[1], moment: force[2] };
        let arms = machine.moment_arms(&at).unwrap();
        let joint_space = machine.chain().jacobian(&pose.joints);
        let measured = arms.cylinder_forces(&joint_space.joint_torques(&sent)).unwrap();
        for found in [jacobian.wrench(&measured).unwrap(), joint_space.wrench(&arms.joint_torques(&measured)).unwrap()] {
            let scale = 1e5;
            prop_assert!(near(found.reach, sent.reach, scale) && near(found.height, sent.height, scale) && near(found.moment, sent.moment, scale), "{found:?} {sent:?}");
        }
    }

    #[test]
    fn with_the_swing_the_work_is_the_same_at_any_swing((g, at) in any_pose(), force in three(1e4), rates in three(1.0), turning in -1.0..1.0, swing in -180.0..180.0) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let joints = machine.cylinders_to_joints(&at).unwrap();
        let work = |swing: f64| {
            let swing = Rotor::from_degrees(swing);
            let jacobian = machine.chain().swing_jacobian(&joints, swing);
            let [x, y] = { let v = swing.rotate(Vec2::new(force[0], force[1])); [v.x, v.z] };
            let tip = BaseWrench { x, y, z: force[2], moment: 100.0 };
            let of = MachineRates { swing: turning, joints: JointRates { boom: rates[0], arm: rates[1], bucket: rates[2] } };
            let v = jacobian.twist(&of);
            let (about_axis, torques) = jacobian.torques(&tip);
            let at_tip = tip.x * v.x + tip.y * v.y + tip.z * v.z + tip.moment * v.pitch;
            let at_joints = about_axis * turning + torques.boom * rates[0] + torques.arm * rates[1] + torques.bucket * rates[2];
            (at_tip, at_joints)
        };
        let (ahead, _) = work(0.0);
        let (at_tip, at_joints) = work(swing);
        prop_assert!(near(at_tip, at_joints, 1e6) && near(at_tip, ahead, 1e6), "{at_tip} {at_joints} {ahead}");
    }

    #[test]
    fn a_known_mass_is_told_by_boom_and_arm_cylinder_forces(
        (g, at) in any_pose(), mass in 0.0..3000.0f64, place in [0.0..0.6f64, -0.2..0.6f64], tilt in -20.0..20.0f64,
    ) {
        let machine = Machine::<f64>::new(&g).unwrap();
        let chain = machine.chain();
        let joints = machine.cylinders_to_joints(&at).unwrap();
        let arms = machine.moment_arms(&at).unwrap();
        let place = Vec2::new(place[0], place[1]);
        let gravity = Rotor::from_degrees(tilt).rotate(level_gravity());
        let loaded = MINI.with_payload(&LinkMass { mass_kg: mass, centre: place });
        let mut measured = arms.cylinder_forces(&chain.holding_torques(&joints, &loaded, gravity)).unwrap();
        // The bucket cylinder is not asked.
        measured.bucket = 12345.0;
        let torques = arms.joint_torques(&measured);
        let upright = joints.boom.to_vec().cross(gravity).abs() / 9.8;
        prop_assume!(upright > 0.05);
        let found = chain.payload(&joints, &MINI, &torques, gravity).unwrap();
        prop_assert!((found.mass_kg - mass).abs() < 1e-7, "{found:?}");
        let lever = machine.chain().jacobian_at(&joints, place).levers()[1];
        prop_assert!((found.moment_about_arm_nm - mass * lever.cross(gravity)).abs() < 1e-6);
        if let Ok(found) = chain.payload_at(&joints, &MINI, &torques, gravity, place) {
            prop_assert!((found.mass_kg - mass).abs() < 1e-6 && found.residual_nm < 1e-6, "{found:?}");
        }
    }
}

#[test]
fn the_holding_torques_are_the_slope_of_the_potential_energy() {
    let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
    let chain = machine.chain();
    let at = |angles: [f64; 3]| {
        let [boom, arm, bucket] = angles.map(Rotor::from_angle);
        Joints { boom, arm, bucket }
    };
    let height = |link: Rotor<f64>, centre: Vec2<f64>| link.rotate(centre).z;
    let energy = |angles: [f64; 3]| {
        let joints = at(angles);
        let (forearm, pitch) = (joints.boom * joints.arm, joints.pitch());
        let [_, a2, a3, _] = chain.lengths();
        let (elbow, wrist) = (a2 * joints.boom.sin, a2 * joints.boom.sin + a3 * forearm.sin);
        9.80665
            * (MINI.boom.mass_kg * height(joints.boom, MINI.boom.centre)
                + MINI.arm.mass_kg * (elbow + height(forearm, MINI.arm.centre))
                + MINI.bucket.mass_kg * (wrist + height(pitch, MINI.bucket.centre)))
    };
    for angles in [[0.2, -1.0, -0.5], [-0.4, -2.2, 0.6], [0.9, -0.7, -2.0]] {
        let torques = chain.holding_torques(&at(angles), &MINI, level_gravity());
        for (which, found) in [torques.boom, torques.arm, torques.bucket].into_iter().enumerate() {
            let moved = |by: f64| {
                let mut angles = angles;
                angles[which] += by;
                energy(angles)
            };
            let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((found - slope).abs() < 1e-4, "{found} {slope}");
        }
    }
}

#[test]
fn torques_that_no_payload_explains_leave_a_residual() {
    let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
    let joints = machine.cylinders_to_joints(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 }).unwrap();
    let chain = machine.chain();
    let empty = chain.holding_torques(&joints, &MINI, level_gravity());
    // Lifted at the boom pin alone, as by a bucket that rests on the ground.
    let lifted = JointTorques { boom: empty.boom - 3000.0, ..empty };
    let place = Vec2::new(0.3, 0.2);
    let found = chain.payload_at(&joints, &MINI, &lifted, level_gravity(), place).unwrap();
    assert!(found.residual_nm > 100.0, "{found:?}");
}

#[test]
fn an_upright_boom_tells_no_mass() {
    let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
    let [boom, arm, bucket] = [90.0, -90.0, -30.0].map(Rotor::from_degrees);
    let joints = Joints { boom, arm, bucket };
    let torques = machine.chain().holding_torques(&joints, &MINI, level_gravity());
    let found = machine.chain().payload(&joints, &MINI, &torques, level_gravity());
    assert_eq!(found, Err(Singular::NoLever));
    // But with its place known the arm still does.
    let found = machine.chain().payload_at(&joints, &MINI, &torques, level_gravity(), Vec2::new(0.3, 0.2)).unwrap();
    assert!(found.mass_kg.abs() < 1e-9);
    // Along gravity from both pins nothing does.
    let [boom, arm, bucket] = [90.0, 0.0, 0.0].map(Rotor::from_degrees);
    let joints = Joints { boom, arm, bucket };
    let found = machine.chain().payload_at(&joints, &MINI, &torques, level_gravity(), Vec2::new(0.3, 0.0));
    assert_eq!(found, Err(Singular::NoLever));
}

#[test]
fn a_stretched_arm_holds_any_force_along_it() {
    let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
    let stretched = Joints { boom: Rotor::IDENTITY, arm: Rotor::IDENTITY, bucket: Rotor::from_degrees(-90.0) };
    let jacobian = machine.chain().jacobian(&stretched);
    let torques = JointTorques { boom: 1.0, arm: 1.0, bucket: 1.0 };
    assert_eq!(jacobian.wrench(&torques), Err(Singular::ArmStretched));
    let held = jacobian.joint_torques(&Wrench { reach: 1e6, height: 0.0, moment: 0.0 });
    assert_eq!((held.boom - held.arm, held.arm - held.bucket), (0.0, 0.0));
}
