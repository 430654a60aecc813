//! Joint-space and cylinder-space Jacobians against finite differences of the oracle, over whole strokes, and a random search.
//!
//! Errors are relative to the largest entry of the matrix row they stand in. In f32 the fine Jacobian keeps 2e-6 everywhere, dead
//! points included. The quick one leaves more where a whole row nearly vanishes (levers about level with the tip), most of all next to
//! a dead point: [`quick_row`]. Even exact joint rotors, once rounded to f32, leave more than 2e-6 of a row there
//! (`rates_floor.rs`), so that no kernel which hands f32 rotors on can do better: the fine one is in fixed point.
//!
//! `cargo test -p cross-tests --test rates_jacobians -- --nocapture` prints every number.

use cross_tests::differences;
use cross_tests::machines;
use cross_tests::oracle::Oracle;
use cross_tests::rates::{Worst, crowding, cylinders, matrix_error, poses, row_error};
use cross_tests::sweep::Random;
use kinematics_core::cylinder_jacobian::CylinderJacobian;
use kinematics_core::{Cylinders, Machine, PinGeometry, Pose, PoseError, Real, Rotor};

/// The promise, relative to the row's largest entry.
const F64: f64 = 1e-9;
const F32: f64 = 2e-6;

/// In f32: the worst error of a row of the quick cylinder-space Jacobian, ends of strokes searched most.
fn quick_row(name: &str) -> f64 {
    match name {
        "frankel" => 4e-5,
        "exact-mini" => 7e-6,
        "zx120" => 4e-6,
        _ => 5e-6,
    }
}

type Kernel<T> = fn(&Machine<T>, &Cylinders<T>, Rotor<T>) -> Result<(Pose<T>, CylinderJacobian<T>), PoseError<T>>;

fn rows<T: Real>(j: &CylinderJacobian<T>) -> [[T; 3]; 3] {
    [j.reach, j.height, j.pitch]
}

/// The Jacobians over poses: joint space from the joints the maps find, and cylinder space.
fn measure_jacobians<T: Real>(name: &str, g: &PinGeometry, bound: f64, quick_bound: f64) {
    let (machine, oracle) = (Machine::<T>::new(g).unwrap(), Oracle::new(g));
    let (mut joint, mut quick, mut fine) = (Worst::default(), Worst::default(), Worst::default());
    let kernels: [(Kernel<T>, &mut Worst); 2] = [
        (Machine::cylinders_to_tip_with_jacobian, &mut quick),
        (Machine::cylinders_to_tip_with_fine_jacobian, &mut fine),
    ];
    let poses = poses::<T>(g);
    for (kernel, worst) in kernels {
        for &at in &poses {
            let (_, found) = kernel(&machine, &cylinders(at), Rotor::IDENTITY).unwrap();
            for (found, exact) in rows(&found).into_iter().zip(differences::cylinder_jacobian(&oracle, at)) {
                worst.see(row_error(found, exact), at);
            }
        }
    }
    for &at in &poses {
        let joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
        let found = machine.chain().jacobian(&joints).matrix();
        let directions = [0, 1, 2].map(|which| differences::joint(&oracle, which, at[which]));
        for (found, exact) in found.into_iter().zip(differences::joint_jacobian(&oracle, directions)) {
            joint.see(row_error(found, exact), at);
        }
    }
    joint.hold(name, "joint Jacobian", bound);
    quick.hold(name, "cylinder-space Jacobian, quick", quick_bound);
    fine.hold(name, "cylinder-space Jacobian, fine", bound);
}

#[test]
fn jacobians_in_f64_agree_with_differences_over_every_stroke() {
    for (name, g) in machines::all().unwrap() {
        measure_jacobians::<f64>(&format!("{name} f64"), &g, F64, F64);
    }
}

#[test]
fn jacobians_in_f32_agree_with_differences_over_every_stroke() {
    for (name, g) in machines::all().unwrap() {
        measure_jacobians::<f32>(&format!("{name} f32"), &g, F32, quick_row(name));
    }
}

#[test]
fn a_random_search_in_f32_finds_no_worse_cylinder_space_jacobian() {
    // Against the f64 kernel, whose own error above is a millionth of f32's: cheap enough for a million poses a machine.
    for (name, g) in machines::all().unwrap() {
        let (single, double) = (Machine::<f32>::new(&g).unwrap(), Machine::<f64>::new(&g).unwrap());
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        let kernels: [(&str, Kernel<f32>, f64); 2] = [
            ("quick", Machine::cylinders_to_tip_with_jacobian, quick_row(name)),
            ("fine", Machine::cylinders_to_tip_with_fine_jacobian, F32),
        ];
        for (which, kernel, bound) in kernels {
            let mut random = Random::new(15);
            let (mut worst, mut whole, mut tip, mut above) = (Worst::default(), Worst::default(), Worst::default(), 0);
            for _ in 0..1_000_000 {
                let at = strokes.map(|stroke| crowding(stroke, &mut random));
                let (pose, found) = kernel(&single, &cylinders(at), Rotor::IDENTITY).unwrap();
                let (exact_pose, exact) =
                    double.cylinders_to_tip_with_jacobian(&cylinders(at), Rotor::IDENTITY).unwrap();
                let (found, exact) = (rows(&found), rows(&exact));
                let error = found.into_iter().zip(exact).fold(0.0f64, |e, (f, x)| e.max(row_error(f, x)));
                above += u32::from(error > F32);
                worst.see(error, at);
                whole.see(matrix_error(&found[..2], &exact[..2]), at);
                let off = (f64::from(pose.plane.reach) - exact_pose.plane.reach)
                    .hypot(f64::from(pose.plane.height) - exact_pose.plane.height);
                tip.see(off / g.reach_m(), at);
            }
            println!("{name} f32, {which}: {above} of 1,000,000 poses have a row worse than {F32:e}");
            worst.hold(name, &format!("cylinder-space Jacobian in f32, {which}, random search"), bound);
            whole.hold(name, &format!("cylinder-space Jacobian in f32, {which}, of its largest velocity"), F32);
            tip.hold(name, &format!("tip beside it, {which}, of reach"), if which == "fine" { 2e-7 } else { 1e-6 });
        }
    }
}

#[test]
fn every_machine_is_within_the_range_of_the_fine_jacobian() {
    // Out of its range it is the quick one, bit for bit (`rates_fallback.rs`); within, nearly every pose differs from that.
    for (name, g) in machines::all().unwrap() {
        let machine = Machine::<f32>::new(&g).unwrap();
        let mut random = Random::new(16);
        let differ = (0..1000).filter(|_| {
            let at = cylinders([g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| crowding(s, &mut random)));
            let quick = machine.cylinders_to_tip_with_jacobian(&at, Rotor::IDENTITY).unwrap();
            quick != machine.cylinders_to_tip_with_fine_jacobian(&at, Rotor::IDENTITY).unwrap()
        });
        assert!(differ.count() > 990, "{name}");
    }
}
