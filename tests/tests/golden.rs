//! The golden values: every row, both ways, in f64 to the digits the files carry, and in f32.

use cross_tests::golden::Golden;
use cross_tests::machines::{self, INCH_M};
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, PlaneTip, Real, Rotor};

/// One row in metres and degrees, the tip in the plane from the swing axis.
#[derive(Clone, Copy, Debug)]
struct Row {
    joints_deg: [f64; 3],
    cylinders_m: [f64; 3],
    reach_m: f64,
    height_m: f64,
    pitch_deg: f64,
}

/// Tolerances: lengths in m, rotors in rad.
#[derive(Clone, Copy, Debug)]
struct Within {
    lengths: f64,
    rotors: f64,
}

fn rotor<T: Real>(degrees: f64) -> Rotor<T> {
    let Rotor { cos, sin } = Rotor::<f64>::from_degrees(degrees);
    Rotor { cos: T::from_f64(cos), sin: T::from_f64(sin) }
}

fn joints<T: Real>(degrees: [f64; 3]) -> Joints<T> {
    let [boom, arm, bucket] = degrees.map(rotor);
    Joints { boom, arm, bucket }
}

fn lengths<T: Real>(cylinders: Cylinders<T>) -> [f64; 3] {
    [cylinders.boom, cylinders.arm, cylinders.bucket].map(T::to_f64)
}

#[track_caller]
fn lengths_agree(found: &[f64], exact: &[f64], within: f64, row: &Row, worst: &mut f64) {
    for (found, exact) in found.iter().zip(exact) {
        let error = (found - exact).abs();
        assert!(error <= within, "{found} m, not {exact} m: {row:?}");
        *worst = worst.max(error);
    }
}

#[track_caller]
fn rotors_agree<T: Real>(found: Joints<T>, degrees: [f64; 3], within: f64, row: &Row, worst: &mut f64) {
    for (found, degrees) in [found.boom, found.arm, found.bucket].into_iter().zip(degrees) {
        let exact = rotor::<f64>(degrees);
        let error = libm::hypot(found.cos.to_f64() - exact.cos, found.sin.to_f64() - exact.sin);
        assert!(error <= within, "{found:?}, not {degrees}° (off by {error:e}): {row:?}");
        *worst = worst.max(error);
    }
}

/// Every map on every row; rows outside the travel limits included, as Frankel's published dig has them.
fn agree<T: Real>(name: &str, geometry: &PinGeometry, rows: &[Row], within: Within) {
    let machine = Machine::<T>::new(geometry).unwrap();
    let mut worst = [0.0; 5];
    for row in rows {
        let sent = joints::<T>(row.joints_deg);
        let cylinders = machine.joints_to_cylinders_any_stroke(&sent).unwrap();
        lengths_agree(&lengths(cylinders), &row.cylinders_m, within.lengths, row, &mut worst[0]);

        let [boom, arm, bucket] = row.cylinders_m.map(T::from_f64);
        let found = machine.cylinders_to_joints_any_stroke(&Cylinders { boom, arm, bucket }).unwrap();
        rotors_agree(found, row.joints_deg, within.rotors, row, &mut worst[1]);

        let tip = machine.joints_to_tip(&sent, Rotor::IDENTITY).plane;
        let position = [tip.reach.to_f64(), tip.height.to_f64()];
        lengths_agree(&position, &[row.reach_m, row.height_m], within.lengths, row, &mut worst[2]);

        let tip = PlaneTip {
            reach: T::from_f64(row.reach_m),
            height: T::from_f64(row.height_m),
            pitch: rotor(row.pitch_deg),
        };
        let found = machine.tip_to_joints(&tip).unwrap();
        rotors_agree(found, row.joints_deg, within.rotors, row, &mut worst[3]);
        let cylinders = machine.joints_to_cylinders_any_stroke(&found).unwrap();
        lengths_agree(&lengths(cylinders), &row.cylinders_m, within.lengths, row, &mut worst[4]);
    }
    println!(
        "{name}, {} rows: joints → cylinders {:.1e} m, cylinders → joints {:.1e} rad, joints → tip {:.1e} m, \
         tip → joints {:.1e} rad, tip → cylinders {:.1e} m",
        rows.len(),
        worst[0],
        worst[1],
        worst[2],
        worst[3],
        worst[4]
    );
}

/// The files carry twelve digits: 1e-9 of a length of metres, an angle of degrees.
const F64: Within = Within { lengths: 1e-9, rotors: 1e-9 };
const F32: Within = Within { lengths: 1.5e-6, rotors: 3e-6 };

fn metric_machine(name: &str, geometry: &PinGeometry) {
    let golden = Golden::read(name);
    let columns = golden.columns([
        "boom_deg",
        "arm_deg",
        "bucket_deg",
        "boom_m",
        "arm_m",
        "bucket_m",
        "tip_x_from_boom_pin_m",
        "tip_z_from_boom_pin_m",
    ]);
    let rows: Vec<Row> = columns
        .into_iter()
        .map(|[boom, arm, bucket, l_boom, l_arm, l_bucket, x, z]| Row {
            joints_deg: [boom, arm, bucket],
            cylinders_m: [l_boom, l_arm, l_bucket],
            reach_m: geometry.boom_pin_x_m + x,
            height_m: z,
            pitch_deg: boom + arm + bucket,
        })
        .collect();
    assert_eq!(rows.len(), 40, "{name}");
    agree::<f64>(&format!("{name} f64"), geometry, &rows, F64);
    agree::<f32>(&format!("{name} f32"), geometry, &rows, F32);
}

#[test]
fn exact_minis_golden_values_are_met_in_every_row() {
    metric_machine("exact-mini", &PinGeometry::EXACT_MINI);
}

#[test]
fn zx120s_golden_values_are_met_in_every_row() {
    metric_machine("zx120", &machines::ZX120);
}

#[test]
fn zx200s_golden_values_are_met_in_every_row() {
    metric_machine("zx200", &machines::ZX200);
}

fn frankel_rows() -> Vec<Row> {
    let columns = Golden::read("frankel_dig").columns([
        "boom_deg",
        "arm_deg",
        "bucket_deg",
        "boom_cyl_in",
        "arm_cyl_in",
        "bucket_cyl_in",
        "tip_x_in",
        "tip_z_in",
        "phi_seed_deg",
    ]);
    let rows = columns.into_iter().map(|[boom, arm, bucket, l_boom, l_arm, l_bucket, x, z, phi]| Row {
        joints_deg: [boom, arm, bucket],
        cylinders_m: [l_boom, l_arm, l_bucket].map(|inches| inches * INCH_M),
        reach_m: x * INCH_M,
        height_m: z * INCH_M,
        // The seed measures from tip to bucket pin.
        pitch_deg: phi + 180.0,
    });
    rows.collect()
}

#[test]
fn frankels_published_dig_is_met_in_every_row() {
    let frankel = machines::frankel_distances().to_pins().unwrap();
    let rows = frankel_rows();
    assert_eq!(rows.len(), 200);
    // 1e-9 in of 40 in: what twelve digits leave.
    agree::<f64>("frankel f64", &frankel, &rows, Within { lengths: 1e-9 * INCH_M, rotors: 1e-9 });
    agree::<f32>("frankel f32", &frankel, &rows, F32);
}

#[test]
fn the_seeds_bucket_angle_is_our_pitch_less_half_a_turn() {
    for row in frankel_rows() {
        let sum = row.joints_deg.iter().sum::<f64>();
        let turns = (sum - row.pitch_deg) / 360.0;
        assert!((turns - turns.round()).abs() < 1e-9, "{row:?}");
    }
}

#[test]
fn the_golden_moment_arms_are_the_slope_of_the_inverse_map() {
    const STEP_RAD: f64 = 1e-4;
    for (name, geometry) in
        [("exact-mini", PinGeometry::EXACT_MINI), ("zx120", machines::ZX120), ("zx200", machines::ZX200)]
    {
        let machine = Machine::<f64>::new(&geometry).unwrap();
        let columns = ["boom_deg", "arm_deg", "bucket_deg", "dboom_drad", "darm_drad", "dbucket_drad"];
        for [boom, arm, bucket, d_boom, d_arm, d_bucket] in Golden::read(name).columns(columns) {
            let at = |step: f64| {
                let [boom, arm, bucket] = [boom, arm, bucket].map(|x| Rotor::from_degrees(x) * Rotor::from_angle(step));
                lengths(machine.joints_to_cylinders_any_stroke(&Joints { boom, arm, bucket }).unwrap())
            };
            for ((ahead, behind), exact) in at(STEP_RAD).into_iter().zip(at(-STEP_RAD)).zip([d_boom, d_arm, d_bucket]) {
                let slope = (ahead - behind) / (2.0 * STEP_RAD);
                assert!((slope - exact).abs() < 1e-7, "{name}: {slope} m/rad, not {exact}");
            }
        }
    }
}

#[test]
fn frankels_travel_limits_give_the_listed_joint_angles() {
    let frankel = machines::frankel_distances().to_pins().unwrap();
    let machine = Machine::<f64>::new(&frankel).unwrap();
    let [boom, arm, bucket] = [frankel.boom.stroke, frankel.arm.stroke, frankel.bucket.stroke];
    let ends = [
        (Cylinders { boom: boom.min_m, arm: arm.min_m, bucket: bucket.min_m }, [49.629, -16.772, 27.180]),
        (Cylinders { boom: boom.max_m, arm: arm.max_m, bucket: bucket.max_m }, [-86.765, -120.833, -158.006]),
    ];
    for (cylinders, listed) in ends {
        let found = machine.cylinders_to_joints(&cylinders).unwrap();
        for (found, listed) in [found.boom, found.arm, found.bucket].into_iter().zip(listed) {
            let degrees = found.angle().to_degrees();
            println!("frankel: {degrees:.4}°, listed {listed}°");
            // One unit of the last digit.
            assert!((degrees - listed).abs() <= 0.001, "{degrees}°, listed {listed}°");
        }
    }
}

/// The published joint limits (at the shortest, at the longest cylinder) need cylinders `within_m` of the stroke's ends.
fn limits_stand_at_the_ends(name: &str, geometry: &PinGeometry, limits_deg: [[f64; 2]; 3], within_m: f64) {
    let machine = Machine::<f64>::new(geometry).unwrap();
    let strokes = [geometry.boom.stroke, geometry.arm.stroke, geometry.bucket.stroke];
    for (end, of) in [(0, "shortest"), (1, "longest")] {
        let at = joints(limits_deg.map(|limits| limits[end]));
        let found = lengths(machine.joints_to_cylinders_any_stroke(&at).unwrap());
        for (found, stroke) in found.iter().zip(strokes) {
            let length = [stroke.min_m, stroke.max_m][end];
            println!("{name}, {of}: published limit needs {found:.5} m, stroke ends at {length} m");
            assert!((found - length).abs() <= within_m, "{name}, {of}: {found} m, stroke ends at {length} m");
        }
    }
}

#[test]
fn exact_minis_published_joint_limits_need_its_stroke_ends_to_a_tenth_of_a_millimetre() {
    let limits = [[-27.14, 62.58], [-29.24, -148.10], [44.91, -164.20]];
    limits_stand_at_the_ends("exact-mini", &PinGeometry::EXACT_MINI, limits, 1e-4);
}

#[test]
fn the_published_joint_limits_of_zx120_and_zx200_need_their_stroke_ends_to_the_millimetre() {
    // The strokes were rounded to millimetres.
    let limits = [[-44.0, 70.0], [-30.0, -152.0], [33.0, -143.0]];
    limits_stand_at_the_ends("zx120", &machines::ZX120, limits, 0.5e-3);
    let limits = [[-44.0, 70.0], [-34.03, -153.95], [35.6, -135.9]];
    limits_stand_at_the_ends("zx200", &machines::ZX200, limits, 0.5e-3);
}
