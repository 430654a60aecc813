//! Moment arms and second derivatives against finite differences of the oracle, over whole strokes.
//!
//! Errors are relative to the largest entry of the matrix row they stand in; a moment arm stands alone in its row, so its error
//! is relative to itself. In f64 1e-9 holds by orders of magnitude. In f32 2e-6 holds for moment arms (of lengths and of
//! joints) and their slopes. The Jacobians are in `rates_jacobians.rs`, the properties at all poses in `rates_properties.rs`.
//!
//! Nothing is left out near dead points: the sweeps run from end to end of every stroke, tolerance included, and crowd at the
//! ends. Dead points themselves lie outside every stroke (validation sees to it); the nearest is frankel's boom, 0.1 mm beyond
//! its longest length, where sin α is 0.032. The sensor's own rounding is not counted: lengths are what T holds, exactly.
//!
//! `cargo test -p cross-tests --test rates -- --nocapture` prints every number.

use cross_tests::differences;
use cross_tests::golden::Golden;
use cross_tests::machines;
use cross_tests::oracle::{Oracle, direction};
use cross_tests::rates::{
    Worst, cylinder_rates, cylinders, joint_rates, matrix_error, poses, rotor, row_error, sweep, twist,
};
use cross_tests::sweep::Random;
use cross_tests::wide::{Point, Wide};
use kinematics_core::rates::{MomentArms, SMALLEST_MOMENT_ARM_M};
use kinematics_core::swing_jacobian::MachineRates;
use kinematics_core::{Cylinder, Joints, Machine, PinGeometry, Real, Rotor, Singular};

fn middle(g: &PinGeometry) -> [f64; 3] {
    [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| 0.5 * (s.min_m + s.max_m))
}

/// Moment arms and slopes over each stroke from lengths; moment arms from joints, the exact ones rounded to T.
fn measure_moments<T: Real>(name: &str, g: &PinGeometry, bound: f64) {
    let (machine, oracle) = (Machine::<T>::new(g).unwrap(), Oracle::new(g));
    let (mut arm, mut slope, mut given) = (Worst::default(), Worst::default(), Worst::default());
    let joints_at_middle = machine.cylinders_to_joints(&cylinders(middle(g))).unwrap();
    for which in 0..3 {
        for length in sweep::<T>(g, which, &mut Random::new(11)) {
            let mut at = middle(g);
            at[which] = length;
            let [exact, exact_slope] = differences::moment(&oracle, which, length);
            let arms = machine.moment_arms(&cylinders(at)).unwrap();
            arm.see(row_error([[arms.boom, arms.arm, arms.bucket][which]], [exact]), at);
            let rounded = differences::joint(&oracle, which, length);
            let rounded = Rotor { cos: T::from_f64(rounded.x.to_f64()), sin: T::from_f64(rounded.z.to_f64()) };
            let mut joints = joints_at_middle;
            *[&mut joints.boom, &mut joints.arm, &mut joints.bucket][which] = rounded;
            let arms = machine.moment_arms_at(&joints).unwrap();
            given.see(row_error([[arms.boom, arms.arm, arms.bucket][which]], [exact]), at);
            let moments = machine.moments(&cylinders(at)).unwrap();
            let moment = [moments.boom, moments.arm, moments.bucket][which];
            slope.see(row_error([moment.arm, moment.slope], [exact, exact_slope]), at);
        }
    }
    arm.hold(name, "moment arms dL/dθ", bound);
    slope.hold(name, "rows (dL/dθ, d²L/dθ²)", bound);
    given.hold(name, "moment arms of joints given, their rounding included", bound);
}

/// The promise, relative to the row's largest entry.
const F64: f64 = 1e-9;
const F32: f64 = 2e-6;

#[test]
fn moment_arms_and_their_slopes_in_f64_agree_with_differences_over_every_stroke() {
    for (name, g) in machines::all().unwrap() {
        measure_moments::<f64>(&format!("{name} f64"), &g, F64);
    }
}

#[test]
fn moment_arms_and_their_slopes_in_f32_agree_with_differences_over_every_stroke() {
    for (name, g) in machines::all().unwrap() {
        measure_moments::<f32>(&format!("{name} f32"), &g, F32);
    }
}

/// The golden columns are central differences, good to about 1e-9 m/rad.
fn golden_moment_arms<T: Real>(name: &str, g: &PinGeometry, bound: f64) {
    let machine = Machine::<T>::new(g).unwrap();
    let rows = Golden::read(name).columns([
        "boom_deg",
        "arm_deg",
        "bucket_deg",
        "boom_m",
        "arm_m",
        "bucket_m",
        "dboom_drad",
        "darm_drad",
        "dbucket_drad",
    ]);
    assert_eq!(rows.len(), 40);
    let mut worst = 0.0f64;
    for [boom, arm, bucket, l_boom, l_arm, l_bucket, d_boom, d_arm, d_bucket] in rows {
        let [boom, arm, bucket] = [boom, arm, bucket].map(|degrees| rotor(Rotor::from_degrees(degrees)));
        let given = machine.moment_arms_at(&Joints { boom, arm, bucket }).unwrap();
        let measured = machine.moment_arms(&cylinders([l_boom, l_arm, l_bucket])).unwrap();
        for found in [given, measured] {
            for (found, exact) in [found.boom, found.arm, found.bucket].into_iter().zip([d_boom, d_arm, d_bucket]) {
                worst = worst.max((found.to_f64() - exact).abs());
            }
        }
    }
    println!("{name}: golden dL/dθ, worst error {worst:.1e} m/rad");
    assert!(worst <= bound, "{name}: {worst:e}");
}

#[test]
fn the_golden_moment_arms_are_met_in_every_row() {
    for (name, g) in machines::all().unwrap() {
        // Frankel's golden file has no such columns.
        if name != "frankel" {
            golden_moment_arms::<f64>(name, &g, 1e-9);
            golden_moment_arms::<f32>(name, &g, 2e-6);
        }
    }
}

/// Tip accelerations at constant joint rates and at constant cylinder rates, relative to the largest of the sums' terms.
fn measure_bias<T: Real>(name: &str, g: &PinGeometry, joint_bound: f64, cylinder_bound: f64) {
    let (machine, oracle) = (Machine::<T>::new(g).unwrap(), Oracle::new(g));
    let (mut joint, mut cylinder, mut fine) = (Worst::default(), Worst::default(), Worst::default());
    let mut random = Random::new(13);
    let mut some = move || (random.index(129) as f64 - 64.0) / 64.0;
    for at in poses::<T>(g).into_iter().step_by(4) {
        let pose = machine.cylinders_to_tip(&cylinders(at), Rotor::IDENTITY).unwrap();
        let jacobian = machine.chain().jacobian(&pose.joints);
        let directions = [0, 1, 2].map(|which| differences::joint(&oracle, which, at[which]));

        let rates = [some(), some(), some()];
        let exact = differences::joint_bias(&oracle, directions, rates);
        let found = twist(jacobian.bias(&joint_rates(rates)));
        let [w2, w3, w4] = rates;
        let scale = [w2, w2 + w3, w2 + w3 + w4].iter().fold(0.0f64, |l, w| l.max(w * w)) * g.arm_m;
        if scale > 1e-3 {
            joint.see((0..3).fold(0.0, |e: f64, i| e.max((found[i] - exact[i]).abs())) / scale, at);
        }

        let exact = differences::cylinder_bias(&oracle, at, rates);
        let moments = machine.moments(&cylinders(at)).unwrap();
        let speeds = moments.arms().joint_rates(&cylinder_rates(rates)).unwrap();
        let accelerations = moments.joint_accelerations(&speeds, &cylinder_rates([0.0; 3])).unwrap();
        let (direct, through) = (twist(jacobian.bias(&speeds)), twist(jacobian.twist(&accelerations)));
        let scale = direct.iter().chain(&through).chain(&exact).fold(0.0f64, |l, x| l.max(x.abs()));
        let error = (0..3).fold(0.0f64, |e, i| e.max((direct[i] + through[i] - exact[i]).abs()));
        if scale > 1e-3 {
            cylinder.see(error / scale, at);
            let found = twist(machine.cylinder_bias(&cylinders(at), &cylinder_rates(rates)).unwrap());
            fine.see((0..3).fold(0.0f64, |e, i| e.max((found[i] - exact[i]).abs())) / scale, at);
        }
    }
    assert!(joint.0 > 0.0 && cylinder.0 > 0.0);
    joint.hold(name, "J̇·θ̇", joint_bound);
    cylinder.hold(name, "tip acceleration at constant cylinder rates, by way of moments", cylinder_bound);
    fine.hold(name, "tip acceleration at constant cylinder rates, cylinder_bias", joint_bound);
}

#[test]
fn second_derivatives_in_f64_agree_with_second_differences() {
    for (name, g) in machines::all().unwrap() {
        measure_bias::<f64>(&format!("{name} f64"), &g, F64, F64);
    }
}

#[test]
fn second_derivatives_in_f32_agree_with_second_differences() {
    for (name, g) in machines::all().unwrap() {
        // At constant cylinder rates by way of the slopes: two quotients more.
        measure_bias::<f32>(&format!("{name} f32"), &g, F32, 3e-6);
    }
}

/// A point of the bucket (tip or wrist) in the base frame, and the bucket's axes there, all in wide numbers.
fn in_space(oracle: &Oracle, wrist_back_m: f64, joints: [Point; 3], swing: Point) -> ([Wide; 3], [[Wide; 3]; 3]) {
    let mut placed = oracle.place(joints);
    placed.tip = placed.tip - placed.pitch.scale(Wide::from_f64(wrist_back_m));
    let (p, zero) = (placed.pitch, Wide::from_f64(0.0));
    let axes =
        [[p.x * swing.x, p.x * swing.z, p.z], [-(p.z * swing.x), -(p.z * swing.z), p.x], [swing.z, -swing.x, zero]];
    (differences::swung(&placed, swing), axes)
}

/// Of joints as T has them, taken for exact directions. A row smaller than a part of the reach is measured against that: there is
/// no bound relative to a row that vanishes with the tip's reach.
fn measure_swing_jacobian<T: Real>(name: &str, g: &PinGeometry, bound: f64) {
    let (machine, oracle) = (Machine::<T>::new(g).unwrap(), Oracle::new(g));
    let mut random = Random::new(14);
    let (mut quick, mut fine) = (Worst::default(), Worst::default());
    let (mut whole, mut bias) = (Worst::default(), Worst::default());
    for at in poses::<T>(g).into_iter().step_by(8) {
        let swing = Rotor::<f64>::from_turns(random.unit());
        let narrow = rotor::<T>(swing);
        let joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
        let directions = [joints.boom, joints.arm, joints.bucket].map(|joint| direction(joint).unit());
        let wide_swing = direction(narrow).unit();
        let moved = |back: f64, angles: [f64; 4]| {
            let [s, b, a, k] = angles.map(differences::turn);
            let [boom, arm, bucket] = directions;
            in_space(&oracle, back, [boom.turned(b), arm.turned(a), bucket.turned(k)], wide_swing.turned(s))
        };
        let chain = machine.chain();
        let (tip, fine_tip) = (chain.swing_jacobian(&joints, narrow), chain.fine_swing_jacobian(&joints, narrow));
        let wrist = chain.swing_wrist_jacobian(&joints, narrow);
        let fine_wrist = chain.fine_swing_wrist_jacobian(&joints, narrow);
        for (back, jacobian, finely) in [(0.0, tip, fine_tip), (g.bucket_m, wrist, fine_wrist)] {
            let columns = [0, 1, 2, 3].map(|which| {
                let mut angles = [0.0; 4];
                angles[which] = differences::STEP;
                let ((before, axes_before), (after, axes_after)) =
                    (moved(back, angles.map(|a| -a)), moved(back, angles));
                let v = [0, 1, 2].map(|i| differences::first(before[i], after[i], differences::STEP));
                // 2ω = Σ axis × d(axis)/dt; its y.
                let about_y = (0..3).fold(0.0, |sum, n| {
                    let d =
                        [0, 1, 2].map(|i| differences::first(axes_before[n][i], axes_after[n][i], differences::STEP));
                    let e = axes_after[n].map(Wide::to_f64);
                    sum + 0.5 * (e[2] * d[0] - e[0] * d[2])
                });
                [v[0], v[1], v[2], about_y]
            });
            let found = jacobian.matrix_with_omega_y();
            let exact = [0, 1, 2].map(|row| columns.map(|column| column[row]));
            whole.see(matrix_error(&found[..3], &exact), at);
            for (row, (found, finely)) in found.into_iter().zip(finely.matrix_with_omega_y()).enumerate() {
                let exact = columns.map(|column| column[row]);
                let largest = exact.iter().fold(0.0f64, |l, x| l.max(x.abs()));
                quick.see(row_error(found, exact) * largest / largest.max(g.reach_m() / 5.0), at);
                fine.see(row_error(finely, exact) * largest / largest.max(g.reach_m() / 500.0), at);
            }
            assert_eq!(jacobian.matrix()[3].map(T::to_f64), [0.0, 1.0, 1.0, 1.0]);
        }
        // J̇·θ̇ with the swing.
        let rates = [0.7, -0.4, 0.9, -1.1];
        let h = differences::SECOND_STEP;
        let [before, now, after] = [-h, 0.0, h].map(|h| moved(0.0, rates.map(|rate| rate * h)).0);
        let exact = [0, 1, 2].map(|i| differences::second([before[i], now[i], after[i]], h));
        let of = MachineRates { swing: T::from_f64(rates[0]), joints: joint_rates([rates[1], rates[2], rates[3]]) };
        let found = chain.swing_jacobian(&joints, narrow).bias(&of);
        let error =
            [found.x, found.y, found.z].iter().zip(exact).fold(0.0f64, |e, (f, x)| e.max((f.to_f64() - x).abs()));
        bias.see(error / g.arm_m, at);
    }
    quick.hold(name, "four-joint Jacobian at tip and wrist, quick, of its row or of reach/5", bound);
    fine.hold(name, "four-joint Jacobian at tip and wrist, fine, of its row or of reach/500", bound);
    whole.hold(name, "four-joint Jacobian, of its largest velocity", bound);
    bias.hold(name, "four-joint J̇·θ̇", bound);
}

#[test]
fn koivos_31_with_omega_y_agrees_with_differences_at_tip_and_wrist() {
    for (name, g) in machines::all().unwrap() {
        measure_swing_jacobian::<f64>(&format!("{name} f64"), &g, F64);
        measure_swing_jacobian::<f32>(&format!("{name} f32"), &g, F32);
    }
}

/// Cylinder lengths within the strokes.
fn within_strokes(g: &PinGeometry, random: &mut Random) -> [f64; 3] {
    [g.boom.stroke, g.arm.stroke, g.bucket.stroke].map(|s| s.min_m + (s.max_m - s.min_m) * random.unit())
}

#[test]
fn lengths_and_moment_arms_taken_together_are_those_taken_apart() {
    let mut random = Random::new(19);
    for (name, g) in machines::all().unwrap() {
        let machine = Machine::<f64>::new(&g).unwrap();
        for _ in 0..100 {
            let joints = machine.cylinders_to_joints(&cylinders(within_strokes(&g, &mut random))).unwrap();
            let apart = (machine.joints_to_cylinders(&joints).unwrap(), machine.moment_arms_at(&joints).unwrap());
            assert_eq!(machine.joints_to_cylinders_with_arms(&joints).unwrap(), apart, "{name}");
        }
        // Out of the stroke both say so.
        let mut joints = machine.cylinders_to_joints(&cylinders(middle(&g))).unwrap();
        joints.arm = joints.arm * Rotor::from_degrees(120.0);
        let apart = machine.joints_to_cylinders(&joints).unwrap_err();
        assert_eq!(machine.joints_to_cylinders_with_arms(&joints).unwrap_err(), apart, "{name}");
    }
}

#[test]
fn accelerations_of_cylinders_are_second_differences_and_come_back_from_the_joints() {
    let mut random = Random::new(23);
    let mut some = move || 2.0 * random.unit() - 1.0;
    for (name, g) in machines::all().unwrap() {
        let machine = Machine::<f64>::new(&g).unwrap();
        let at = middle(&g);
        let joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
        let moments = machine.moments(&cylinders(at)).unwrap();
        let (rates, accelerations) = (joint_rates([some(), some(), some()]), joint_rates([some(), some(), some()]));
        let found = moments.cylinder_accelerations(&rates, &accelerations);
        let h = 1e-3;
        let lengths_at = |t: f64| {
            let moved = |joint: Rotor<f64>, rate: f64, acceleration: f64| {
                joint * Rotor::from_angle(rate * t + 0.5 * acceleration * t * t)
            };
            let joints = Joints {
                boom: moved(joints.boom, rates.boom, accelerations.boom),
                arm: moved(joints.arm, rates.arm, accelerations.arm),
                bucket: moved(joints.bucket, rates.bucket, accelerations.bucket),
            };
            let lengths = machine.joints_to_cylinders_any_stroke(&joints).unwrap();
            [lengths.boom, lengths.arm, lengths.bucket]
        };
        let (before, here, after) = (lengths_at(-h), lengths_at(0.0), lengths_at(h));
        for (i, found) in [found.boom, found.arm, found.bucket].into_iter().enumerate() {
            let exact = (before[i] - 2.0 * here[i] + after[i]) / (h * h);
            assert!((found - exact).abs() < 1e-5, "{name} {i}: {found} {exact}");
        }
        let back = moments.joint_accelerations(&rates, &found).unwrap();
        for (back, given) in
            [(back.boom, accelerations.boom), (back.arm, accelerations.arm), (back.bucket, accelerations.bucket)]
        {
            assert!((back - given).abs() < 1e-12, "{name}: {back} {given}");
        }
    }
}

#[test]
fn a_moment_arm_of_a_micrometre_or_less_is_a_dead_points_and_named_by_its_cylinder() {
    let good = [0.3, -0.4, 0.2];
    let rates = cylinder_rates([0.1; 3]);
    for (which, cylinder) in [Cylinder::Boom, Cylinder::Arm, Cylinder::Bucket].into_iter().enumerate() {
        for (arm, dead) in [
            (0.0, true),
            (SMALLEST_MOMENT_ARM_M, true),
            (-SMALLEST_MOMENT_ARM_M, true),
            (1.01 * SMALLEST_MOMENT_ARM_M, false),
            (-1.01 * SMALLEST_MOMENT_ARM_M, false),
        ] {
            let mut arms = good;
            arms[which] = arm;
            let [boom, arm_arm, bucket] = arms;
            let found = MomentArms { boom, arm: arm_arm, bucket }.joint_rates(&rates);
            assert_eq!(found.err(), dead.then_some(Singular::DeadPoint { cylinder }), "{arms:?}");
        }
    }
}

#[test]
fn the_bucket_turns_by_the_sum_of_its_joints_rates_about_the_planes_normal_and_by_the_swing_about_z() {
    let mut random = Random::new(107);
    let g = PinGeometry::EXACT_MINI;
    let machine = Machine::<f64>::new(&g).unwrap();
    for _ in 0..50 {
        let joints = machine.cylinders_to_joints(&cylinders(within_strokes(&g, &mut random))).unwrap();
        let swing = 6.0 * random.unit() - 3.0;
        let jacobian = machine.chain().swing_jacobian(&joints, Rotor::from_angle(swing));
        let [boom, arm, bucket, turning] = [0; 4].map(|_| 2.0 * random.unit() - 1.0);
        let rates = MachineRates { swing: turning, joints: joint_rates([boom, arm, bucket]) };
        let found = jacobian.angular_velocity(&rates);
        let pitch = boom + arm + bucket;
        // Raising turns about the axis to the right of the plane.
        let exact = [pitch * libm::sin(swing), -pitch * libm::cos(swing), turning];
        assert!((0..3).all(|i| (found[i] - exact[i]).abs() < 1e-14), "{found:?} {exact:?}");
    }
}
