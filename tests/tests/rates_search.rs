//! Every map of rates in f32 at poses crowding towards the ends of the strokes, against the same map in f64 of the same numbers.
//!
//! The f64 maps stand within 1e-11 of finite differences (`rates.rs`, `rates_jacobians.rs`), so that a million poses are affordable.
//! What a map is given (lengths, or joints as f32 rotors) is taken for exact: a rotor stands for its direction. Errors are relative
//! to the row's largest entry, or to what the bound names where a row is smaller than that; of accelerations to their sums' largest
//! term.
//!
//! `cargo test -p cross-tests --test rates_search -- --nocapture` prints every number.

use cross_tests::machines;
use cross_tests::rates::{Worst, crowding, cylinder_rates, cylinders, exactly, matrix_error, row_error, twist};
use cross_tests::sweep::Random;
use kinematics_core::rates::{JointRates, MomentArms};
use kinematics_core::{Joints, Machine, PinGeometry, Real, Rotor};

const POSES: u32 = 1_000_000;

/// The promise, relative to the row's largest entry.
const F32: f64 = 2e-6;

fn arms<T>(of: MomentArms<T>) -> [T; 3] {
    [of.boom, of.arm, of.bucket]
}

fn pair<T: Real>(name: &str, g: &PinGeometry) -> Machine<T> {
    Machine::new(g).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn each_machine(seed: u64, mut see: impl FnMut(&str, &PinGeometry, &mut dyn FnMut() -> [f64; 3])) {
    for (name, g) in machines::all().unwrap() {
        let mut random = Random::new(seed);
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        see(name, &g, &mut || strokes.map(|stroke| crowding(stroke, &mut random)));
    }
}

#[test]
fn moment_arms_their_slopes_and_the_rates_they_give_keep_2e_6_of_themselves() {
    each_machine(21, |name, g, pose| {
        let (single, double) = (pair::<f32>(name, g), pair::<f64>(name, g));
        let mut worst = [Worst::default(); 5];
        for _ in 0..POSES {
            let at = pose();
            let (found, exact) = (single.moments(&cylinders(at)).unwrap(), double.moments(&cylinders(at)).unwrap());
            let found_arms = arms(single.moment_arms(&cylinders(at)).unwrap());
            for ((found, arm), exact) in [found.boom, found.arm, found.bucket].into_iter().zip(found_arms).zip([
                exact.boom,
                exact.arm,
                exact.bucket,
            ]) {
                worst[0].see(row_error([arm], [exact.arm]), at);
                worst[1].see(row_error([found.arm, found.slope], [exact.arm, exact.slope]), at);
            }
            // Rates there and back: each entry by itself.
            let sent = cylinder_rates([0.37, -0.23, 0.11]);
            let exact_joints = exact.arms().joint_rates(&cylinder_rates([0.37, -0.23, 0.11])).unwrap();
            let [found_joints, exact_joints] = [
                single
                    .moment_arms(&cylinders(at))
                    .unwrap()
                    .joint_rates(&sent)
                    .map(|r| [r.boom, r.arm, r.bucket].map(f64::from))
                    .unwrap(),
                [exact_joints.boom, exact_joints.arm, exact_joints.bucket],
            ];
            for (found, exact) in found_joints.into_iter().zip(exact_joints) {
                worst[2].see(((found - exact) / exact).abs(), at);
            }
            let joints = JointRates { boom: 0.37, arm: -0.23, bucket: 0.11 };
            let back = single.moment_arms(&cylinders(at)).unwrap().cylinder_rates(&joints);
            let narrow = [joints.boom, joints.arm, joints.bucket].map(f64::from);
            for ((found, exact), rate) in
                [back.boom, back.arm, back.bucket].into_iter().zip(arms(exact.arms())).zip(narrow)
            {
                worst[3].see(row_error([found], [exact * rate]), at);
            }
            let joints = single.cylinders_to_joints(&cylinders(at)).unwrap();
            let given = arms(single.moment_arms_at(&joints).unwrap());
            for (found, exact) in given.into_iter().zip(arms(double.moment_arms_at(&exactly(&joints)).unwrap())) {
                worst[4].see(row_error([found], [exact]), at);
            }
        }
        let [arm, slope, joints, back, given] = worst;
        arm.hold(name, "moment arms of lengths", F32);
        slope.hold(name, "rows (dL/dθ, d²L/dθ²)", F32);
        joints.hold(name, "cylinder rates → joint rates", F32);
        back.hold(name, "joint rates → cylinder rates", F32);
        given.hold(name, "moment arms of joints", F32);
    });
}

/// Joints whose rotors are rounded to f32, by way of the lengths.
fn joints_at(machine: &Machine<f32>, at: [f64; 3]) -> Joints<f32> {
    machine.cylinders_to_joints(&cylinders(at)).unwrap()
}

#[test]
fn the_planar_jacobians_of_joints_keep_their_rows() {
    each_machine(22, |name, g, pose| {
        let (single, double) = (pair::<f32>(name, g), pair::<f64>(name, g));
        let (mut tip, mut wrist, mut whole) = (Worst::default(), Worst::default(), Worst::default());
        let (mut through, mut through_fine) = (Worst::default(), Worst::default());
        for _ in 0..POSES {
            let at = pose();
            let joints = joints_at(&single, at);
            let exact = double.chain().jacobian(&exactly(&joints)).matrix();
            let found = single.chain().jacobian(&joints).matrix();
            whole.see(matrix_error(&found[..2], &exact[..2]), at);
            for (found, exact) in found.into_iter().zip(exact) {
                tip.see(row_error(found, exact), at);
            }
            let exact = double.chain().jacobian(&double.cylinders_to_joints(&cylinders(at)).unwrap()).matrix();
            let (pose, _) = single.cylinders_to_tip_with_fine_jacobian(&cylinders(at), Rotor::IDENTITY).unwrap();
            for (joints, worst) in [(&joints, &mut through), (&pose.joints, &mut through_fine)] {
                for (found, exact) in single.chain().jacobian(joints).matrix().into_iter().zip(exact) {
                    worst.see(row_error(found, exact), at);
                }
            }
            let exact = double.chain().wrist_jacobian(&exactly(&joints)).matrix();
            for (found, exact) in single.chain().wrist_jacobian(&joints).matrix().into_iter().zip(exact) {
                wrist.see(row_error(found, exact), at);
            }
        }
        tip.hold(name, "planar Jacobian of the tip", F32);
        wrist.hold(name, "planar Jacobian of the wrist", F32);
        through.hold(name, "planar Jacobian of the tip, by way of lengths", 5e-6);
        through_fine.hold(name, "planar Jacobian of the tip, by way of lengths and the fine kernel's joints", F32);
        whole.hold(name, "planar Jacobian, of its largest velocity", F32);
    });
}

/// A swing, half of them close to a quarter of a turn.
fn any_swing(random: &mut Random) -> Rotor<f32> {
    let near = if random.bits() & 1 == 0 { 1.0 } else { random.unit().powi(6) };
    let quarters = (random.bits() & 3) as f64;
    Rotor::from_turns((0.25 * (quarters + near * (random.unit() - 0.5))) as f32)
}

#[test]
fn the_four_joint_jacobians_keep_their_rows_close_to_the_swing_axis_too() {
    each_machine(23, |name, g, pose| {
        let (single, double) = (pair::<f32>(name, g), pair::<f64>(name, g));
        let (mut random, mut quick, mut fine) = (Random::new(24), Worst::default(), Worst::default());
        let (mut whole, mut row) = (Worst::default(), Worst::default());
        for _ in 0..POSES {
            let at = pose();
            let swing = any_swing(&mut random);
            let wide_swing = Rotor { cos: f64::from(swing.cos), sin: f64::from(swing.sin) };
            let joints = joints_at(&single, at);
            let (one, all) = (single.chain(), double.chain());
            for (quickly, finely, exact) in [
                (
                    one.swing_jacobian(&joints, swing),
                    one.fine_swing_jacobian(&joints, swing),
                    all.swing_jacobian(&exactly(&joints), wide_swing),
                ),
                (
                    one.swing_wrist_jacobian(&joints, swing),
                    one.fine_swing_wrist_jacobian(&joints, swing),
                    all.swing_wrist_jacobian(&exactly(&joints), wide_swing),
                ),
            ] {
                let (quickly, finely) = (quickly.matrix_with_omega_y(), finely.matrix_with_omega_y());
                let exact = exact.matrix_with_omega_y();
                whole.see(matrix_error(&quickly[..3], &exact[..3]), at);
                for ((quickly, finely), exact) in quickly.into_iter().zip(finely).zip(exact) {
                    // At a swing of exactly a quarter turn the last row is none.
                    if exact == [0.0; 4] {
                        assert_eq!((quickly, finely), ([0.0; 4], [0.0; 4]));
                        continue;
                    }
                    // What a few steps of 2⁻³⁰ leave of a row still smaller has no bound relative to it.
                    let largest = exact.iter().fold(0.0f64, |l, x| l.max(x.abs()));
                    let (quickly, finely) = (row_error(quickly, exact), row_error(finely, exact));
                    fine.see(finely * largest / largest.max(g.reach_m() / 500.0), at);
                    quick.see(quickly * largest / largest.max(g.reach_m() / 5.0), at);
                    row.see(quickly, at);
                }
            }
        }
        fine.hold(name, "four-joint Jacobian, fine, of its row or of reach/500", F32);
        whole.hold(name, "four-joint Jacobian, quick, of its largest velocity", F32);
        quick.hold(name, "four-joint Jacobian, quick, of its row or of reach/5", F32);
        println!("{name} four-joint Jacobian, quick, of its row: {:.2e} at cylinders {:?} m", row.0, row.1);
    });
}

/// The acceleration at constant cylinder rates by way of the joints, and the largest term of each row's sum: links' centripetal
/// accelerations, levers turned by their joints' accelerations, and those themselves.
fn by_moments<T: Real>(machine: &Machine<T>, at: [f64; 3], rates: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let moments = machine.moments(&cylinders(at)).unwrap();
    let jacobian = machine.chain().jacobian(&machine.cylinders_to_joints(&cylinders(at)).unwrap());
    let speeds = moments.arms().joint_rates(&cylinder_rates(rates)).unwrap();
    let accelerations = moments.joint_accelerations(&speeds, &cylinder_rates([0.0; 3])).unwrap();
    let (direct, through) = (twist(jacobian.bias(&speeds)), twist(jacobian.twist(&accelerations)));
    let levers = jacobian.levers().map(|lever| [lever.x, lever.z].map(T::to_f64));
    let turning = [accelerations.boom, accelerations.arm, accelerations.bucket].map(T::to_f64);
    let (boom, arm, bucket) = (speeds.boom, speeds.boom + speeds.arm, speeds.boom + speeds.arm + speeds.bucket);
    let square = [boom, arm, bucket].map(|rate| (rate * rate).to_f64());
    let mut largest = [0.0f64; 3];
    for i in 0..3 {
        let next = levers.get(i + 1).copied().unwrap_or_default();
        let link = [levers[i][0] - next[0], levers[i][1] - next[1]];
        let terms = [
            (link[0] * square[i]).abs().max((levers[i][1] * turning[i]).abs()),
            (link[1] * square[i]).abs().max((levers[i][0] * turning[i]).abs()),
            turning[i].abs(),
        ];
        largest = [0, 1, 2].map(|row| largest[row].max(terms[row]));
    }
    ([0, 1, 2].map(|row| direct[row] + through[row]), largest)
}

#[test]
fn accelerations_at_constant_cylinder_rates_keep_2e_6_of_their_largest_term() {
    each_machine(25, |name, g, pose| {
        let (single, double) = (pair::<f32>(name, g), pair::<f64>(name, g));
        let (mut random, mut quick, mut fine) = (Random::new(26), Worst::default(), Worst::default());
        for _ in 0..POSES {
            let at = pose();
            let rates = [0, 1, 2].map(|_| (random.index(129) as f64 - 64.0) / 64.0);
            let exact = twist(double.cylinder_bias(&cylinders(at), &cylinder_rates(rates)).unwrap());
            let (_, largest) = by_moments(&double, at, rates);
            let finely = twist(single.cylinder_bias(&cylinders(at), &cylinder_rates(rates)).unwrap());
            let (quickly, _) = by_moments(&single, at, rates);
            let largest = largest.iter().fold(0.0f64, |l, x| l.max(*x));
            if largest > 0.0 {
                for row in 0..3 {
                    fine.see((finely[row] - exact[row]).abs() / largest, at);
                    quick.see((quickly[row] - exact[row]).abs() / largest, at);
                }
            }
        }
        fine.hold(name, "acceleration at constant cylinder rates, cylinder_bias", F32);
        quick.hold(name, "acceleration at constant cylinder rates, by way of moments", 5e-6);
    });
}
