//! What f32 joints alone cost: exact joints rounded to f32, all else in f64. No map that hands on, or is given, joints as f32 rotors
//! can leave less, so that these numbers are why `docs/accuracy.md` promises no more of such maps.
//!
//! `cargo test -p cross-tests --test rates_floor -- --nocapture` prints them.

use cross_tests::machines;
use cross_tests::rates::{Worst, crowding, cylinders, exactly, row_error};
use cross_tests::sweep::Random;
use kinematics_core::{Joints, Machine, Rotor};

fn rounded(joints: &Joints<f64>) -> Joints<f64> {
    let narrow = |r: Rotor<f64>| Rotor { cos: r.cos as f32, sin: r.sin as f32 };
    exactly(&Joints { boom: narrow(joints.boom), arm: narrow(joints.arm), bucket: narrow(joints.bucket) })
}

#[test]
fn joints_rounded_to_f32_cost_more_than_2e_6_of_a_row_next_to_a_dead_point_and_to_the_swing_axis() {
    for (name, g) in machines::all().unwrap() {
        let machine = Machine::<f64>::new(&g).unwrap();
        let chain = machine.chain();
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        let mut random = Random::new(27);
        let (mut cylinder, mut joint, mut moved) = (Worst::default(), Worst::default(), Worst::default());
        let mut swung = Worst::default();
        for _ in 0..1_000_000 {
            let at = strokes.map(|stroke| crowding(stroke, &mut random));
            let exact_joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
            let joints = rounded(&exact_joints);
            let (rows, exact) = (chain.jacobian(&joints), chain.jacobian(&exact_joints));
            for (row, exact) in rows.matrix_2x3().into_iter().zip(exact.matrix_2x3()) {
                joint.see(row_error(row, exact), at);
            }
            let arms = machine.moment_arms(&cylinders(at)).unwrap();
            let (rows, exact) = (rows.per_cylinder(&arms).unwrap(), exact.per_cylinder(&arms).unwrap());
            cylinder.see(row_error(rows.reach, exact.reach), at);
            cylinder.see(row_error(rows.height, exact.height), at);
            // The row at right angles to the swing: its reach, the planar row times the cosine of the swing, here none.
            let (found, exact) = (chain.tip(&joints), chain.tip(&exact_joints));
            swung.see(row_error([found.reach], [exact.reach]), at);
            moved.see((found.reach - exact.reach).hypot(found.height - exact.height) / g.reach_m(), at);
        }
        // Exact-mini's tip keeps away from the swing axis; only frankel comes next to a dead point.
        let bounds = [if name == "frankel" { 2e-6 } else { 0.0 }, if name == "exact-mini" { 0.0 } else { 2e-6 }];
        for (worst, what, least) in [
            (cylinder, "rows of the cylinder-space Jacobian", bounds[0]),
            (joint, "rows of the planar Jacobian", 0.0),
            (swung, "the four-joint Jacobian's row at right angles to the swing", bounds[1]),
            (moved, "tip, of reach", 0.0),
        ] {
            println!("{name}: joints rounded to f32, {what}: {:.2e} at cylinders {:?} m", worst.0, worst.1);
            assert!(worst.0 > least, "{name}, {what}: {}", worst.0);
        }
        assert!(moved.0 < 1e-7, "{name}: {}", moved.0);
    }
}
