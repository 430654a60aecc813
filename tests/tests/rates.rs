//! Every rate and second derivative against finite differences of the oracle, over whole strokes, and properties at all poses.
//!
//! Errors are relative to the largest entry of the matrix row they stand in; a moment arm stands alone in its row, so its error
//! is relative to itself. In f64 1e-9 holds by orders of magnitude. In f32 2e-6 holds for moment arms (of lengths and of
//! joints), their slopes and the joint Jacobian of every machine. Where a whole row of the cylinder-space Jacobian nearly vanishes (levers
//! about level with the tip), f32 leaves more: up to 5e-6 of that row, in 30 of a million random poses of frankel, 134 of
//! exact-mini, 11 of zx200, none of zx120. Relative to the matrix's largest velocity entry 2e-6 holds everywhere.
//!
//! Nothing is left out near dead points: the sweeps run from end to end of every stroke, tolerance included, and crowd at the
//! ends. Dead points themselves lie outside every stroke (validation sees to it); the nearest is frankel's boom, 0.1 mm beyond
//! its longest length, where sin α is 0.032. The sensor's own rounding is not counted: lengths are what T holds, exactly.
//!
//! `cargo test -p cross-tests --test rates -- --nocapture` prints every number.

use cross_tests::differences::{self, on_grid};
use cross_tests::golden::Golden;
use cross_tests::machines;
use cross_tests::oracle::{Oracle, direction};
use cross_tests::sweep::{Random, lengths};
use cross_tests::wide::{Point, Wide};
use kinematics_core::jacobian::Twist;
use kinematics_core::rates::{CylinderRates, JointRates};
use kinematics_core::swing_jacobian::MachineRates;
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinder, Cylinders, Joints, Machine, PinGeometry, Real, Rotor, STROKE_TOLERANCE_M, Singular};
use proptest::prelude::*;

fn cylinders<T: Real>(lengths: [f64; 3]) -> Cylinders<T> {
    let [boom, arm, bucket] = lengths.map(T::from_f64);
    Cylinders { boom, arm, bucket }
}

fn joint_rates<T: Real>(rates: [f64; 3]) -> JointRates<T> {
    let [boom, arm, bucket] = rates.map(T::from_f64);
    JointRates { boom, arm, bucket }
}

fn cylinder_rates<T: Real>(rates: [f64; 3]) -> CylinderRates<T> {
    let [boom, arm, bucket] = rates.map(T::from_f64);
    CylinderRates { boom, arm, bucket }
}

fn twist<T: Real>(t: Twist<T>) -> [f64; 3] {
    [t.reach, t.height, t.pitch].map(T::to_f64)
}

fn rotor<T: Real>(r: Rotor<f64>) -> Rotor<T> {
    Rotor { cos: T::from_f64(r.cos), sin: T::from_f64(r.sin) }
}

/// The largest error relative to the largest entry of `exact`.
fn row_error<const N: usize, T: Real>(found: [T; N], exact: [f64; N]) -> f64 {
    let largest = exact.iter().fold(0.0f64, |l, x| l.max(x.abs()));
    let error = found.iter().zip(exact).fold(0.0f64, |e, (f, x)| e.max((f.to_f64() - x).abs()));
    assert!(error.is_finite() && largest > 0.0, "{found:?} {exact:?}");
    error / largest
}

/// The worst error seen and where.
#[derive(Clone, Copy, Debug, Default)]
struct Worst(f64, [f64; 3]);

impl Worst {
    fn see(&mut self, error: f64, at: [f64; 3]) {
        if error > self.0 {
            *self = Self(error, at);
        }
    }

    #[track_caller]
    fn hold(self, name: &str, what: &str, bound: f64) {
        println!("{name} {what}: {:.2e} at cylinders {:?} m (at most {bound:.0e})", self.0, self.1);
        assert!(self.0 <= bound, "{name} {what}: {:e} at {:?}", self.0, self.1);
    }
}

/// Lengths over one stroke that differences can be taken at.
fn sweep<T: Real>(g: &PinGeometry, which: usize, random: &mut Random) -> Vec<f64> {
    let stroke = [g.boom.stroke, g.arm.stroke, g.bucket.stroke][which];
    let mut all: Vec<f64> = lengths::<T>(stroke, random).into_iter().map(|l| on_grid(l.to_f64())).collect();
    let (lowest, highest) = (stroke.min_m - STROKE_TOLERANCE_M, stroke.max_m + STROKE_TOLERANCE_M);
    all.retain(|l| T::from_f64(*l).to_f64() == *l && *l >= lowest && *l <= highest);
    all.dedup();
    // A sweep that lost its lengths would prove nothing.
    assert!(all.len() > 5000, "{}", all.len());
    all
}

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

/// Lengths of all three cylinders: every combination of those next to the ends, and random ones.
fn poses<T: Real>(g: &PinGeometry) -> Vec<[f64; 3]> {
    let mut random = Random::new(12);
    let all = [0, 1, 2].map(|which| sweep::<T>(g, which, &mut random));
    let ends = all.each_ref().map(|of| {
        let mut some = vec![of[0], of[1], of[of.len() / 2], of[of.len() - 2], of[of.len() - 1]];
        some.extend((0..3).map(|_| of[random.index(of.len())]));
        some
    });
    let mut poses = Vec::new();
    for &boom in &ends[0] {
        for &arm in &ends[1] {
            poses.extend(ends[2].iter().map(|&bucket| [boom, arm, bucket]));
        }
    }
    poses.extend((0..20_000).map(|_| [0, 1, 2].map(|which| all[which][random.index(all[which].len())])));
    poses
}

/// In f32: the worst error relative to a row's largest entry of the cylinder-space Jacobian, where it is more than 2e-6: found by
/// [`a_random_search_in_f32_finds_no_worse_cylinder_space_jacobian`].
fn worst_row(name: &str) -> f64 {
    match name {
        "frankel" => 5e-6,
        "exact-mini" => 5e-6,
        "zx200" => 3e-6,
        _ => F32,
    }
}

/// The largest error of the first rows (those of velocities), relative to their largest entry.
fn matrix_error<const N: usize, T: Real>(found: &[[T; N]], exact: &[[f64; N]]) -> f64 {
    let largest = exact.iter().flatten().fold(0.0f64, |l, x| l.max(x.abs()));
    let pairs = found.iter().flatten().zip(exact.iter().flatten());
    pairs.fold(0.0f64, |e, (f, x)| e.max((f.to_f64() - x).abs())) / largest
}

/// The Jacobians over poses: joint space from the joints the maps find, and cylinder space.
fn measure_jacobians<T: Real>(name: &str, g: &PinGeometry, bound: f64, cylinder_rows: f64) {
    let (machine, oracle) = (Machine::<T>::new(g).unwrap(), Oracle::new(g));
    let (mut joint, mut cylinder, mut whole) = (Worst::default(), Worst::default(), Worst::default());
    for at in poses::<T>(g) {
        let (pose, found) = machine.cylinders_to_tip_with_jacobian(&cylinders(at), Rotor::IDENTITY).unwrap();
        let exact = differences::cylinder_jacobian(&oracle, at);
        whole.see(matrix_error(&[found.reach, found.height], &exact[..2]), at);
        for (found, exact) in [found.reach, found.height, found.pitch].into_iter().zip(exact) {
            cylinder.see(row_error(found, exact), at);
        }
        let found = machine.chain().jacobian(&pose.joints).matrix();
        let directions = [0, 1, 2].map(|which| differences::joint(&oracle, which, at[which]));
        for (found, exact) in found.into_iter().zip(differences::joint_jacobian(&oracle, directions)) {
            joint.see(row_error(found, exact), at);
        }
    }
    joint.hold(name, "joint Jacobian", bound);
    cylinder.hold(name, "cylinder-space Jacobian", cylinder_rows);
    whole.hold(name, "cylinder-space Jacobian, of its largest velocity", bound);
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

#[test]
fn jacobians_in_f64_agree_with_differences_over_every_stroke() {
    for (name, g) in machines::all().unwrap() {
        measure_jacobians::<f64>(&format!("{name} f64"), &g, F64, F64);
    }
}

#[test]
fn jacobians_in_f32_agree_with_differences_over_every_stroke() {
    for (name, g) in machines::all().unwrap() {
        measure_jacobians::<f32>(&format!("{name} f32"), &g, F32, worst_row(name));
    }
}

#[test]
fn a_random_search_in_f32_finds_no_worse_cylinder_space_jacobian() {
    // Against the f64 kernel, whose own error above is a millionth of f32's: cheap enough for a million poses a machine.
    for (name, g) in machines::all().unwrap() {
        let (single, double) = (Machine::<f32>::new(&g).unwrap(), Machine::<f64>::new(&g).unwrap());
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        let mut random = Random::new(15);
        let (mut rows, mut whole, mut above) = (Worst::default(), Worst::default(), 0);
        for _ in 0..1_000_000 {
            let at = strokes.map(|s| f64::from((s.min_m + random.unit() * (s.max_m - s.min_m)) as f32));
            let (_, found) = single.cylinders_to_tip_with_jacobian(&cylinders(at), Rotor::IDENTITY).unwrap();
            let (_, exact) = double.cylinders_to_tip_with_jacobian(&cylinders(at), Rotor::IDENTITY).unwrap();
            whole.see(matrix_error(&[found.reach, found.height], &[exact.reach, exact.height]), at);
            let pairs = [(found.reach, exact.reach), (found.height, exact.height), (found.pitch, exact.pitch)];
            let error = pairs.into_iter().fold(0.0f64, |e, (f, x)| e.max(row_error(f, x)));
            above += u32::from(error > F32);
            rows.see(error, at);
        }
        println!("{name} f32: {above} of 1,000,000 poses have a row worse than {F32:e}");
        rows.hold(name, "cylinder-space Jacobian in f32, random search", worst_row(name));
        whole.hold(name, "cylinder-space Jacobian in f32, of its largest velocity, random search", F32);
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
    let (mut joint, mut cylinder) = (Worst::default(), Worst::default());
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
        }
    }
    assert!(joint.0 > 0.0 && cylinder.0 > 0.0);
    joint.hold(name, "J̇·θ̇", joint_bound);
    cylinder.hold(name, "tip acceleration at constant cylinder rates", cylinder_bound);
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

fn measure_swing_jacobian<T: Real>(name: &str, g: &PinGeometry, bound: f64, rows: f64) {
    let (machine, oracle) = (Machine::<T>::new(g).unwrap(), Oracle::new(g));
    let mut random = Random::new(14);
    let (mut worst, mut whole, mut bias) = (Worst::default(), Worst::default(), Worst::default());
    for at in poses::<T>(g).into_iter().step_by(8) {
        let swing = Rotor::<f64>::from_turns(random.unit());
        let narrow = rotor::<T>(swing);
        let joints = machine.cylinders_to_joints(&cylinders(at)).unwrap();
        let directions = [0, 1, 2].map(|which| differences::joint(&oracle, which, at[which]));
        let wide_swing = direction(narrow).unit();
        let moved = |back: f64, angles: [f64; 4]| {
            let [s, b, a, k] = angles.map(differences::turn);
            let [boom, arm, bucket] = directions;
            in_space(&oracle, back, [boom.turned(b), arm.turned(a), bucket.turned(k)], wide_swing.turned(s))
        };
        let chain = machine.chain();
        for (back, jacobian) in
            [(0.0, chain.swing_jacobian(&joints, narrow)), (g.bucket_m, chain.swing_wrist_jacobian(&joints, narrow))]
        {
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
            for (row, found) in found.into_iter().enumerate() {
                worst.see(row_error(found, columns.map(|column| column[row])), at);
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
    worst.hold(name, "four-joint Jacobian at tip and wrist", rows);
    whole.hold(name, "four-joint Jacobian, of its largest velocity", bound);
    bias.hold(name, "four-joint J̇·θ̇", bound);
}

#[test]
fn koivos_31_with_omega_y_agrees_with_differences_at_tip_and_wrist() {
    // With a tip near the swing axis a row vanishes altogether at some swing, so that relative to the row no bound is the last one.
    for (name, g) in machines::all().unwrap() {
        measure_swing_jacobian::<f64>(&format!("{name} f64"), &g, F64, F64);
        measure_swing_jacobian::<f32>(&format!("{name} f32"), &g, F32, 2e-5);
    }
}

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
    let inside = middle(&PinGeometry::EXACT_MINI);
    for which in 0..3 {
        for bad in [0.0, 9.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut at = inside;
            at[which] = bad;
            assert!(machine.moment_arms(&cylinders(at)).is_err(), "{at:?}");
            assert!(machine.moments(&cylinders(at)).is_err(), "{at:?}");
            assert!(machine.cylinders_to_tip_with_jacobian(&cylinders(at), Rotor::IDENTITY).is_err(), "{at:?}");
        }
    }
}
