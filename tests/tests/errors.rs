//! What has no answer says so: which cylinder, by how much, and never a NaN in an answer.

use cross_tests::machines::{self, Named, equal_links};
use cross_tests::oracle::{Oracle, apart};
use cross_tests::wide::Point;
use kinematics_core::four_bar::{FourBar, Gap};
use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinder, Cylinders, Joints, Machine, PinGeometry, PlaneTip, PoseError, Real, Rotor, Vec2};

const ORDER: [Cylinder; 3] = [Cylinder::Boom, Cylinder::Arm, Cylinder::Bucket];

fn strokes(g: &PinGeometry) -> [Stroke; 3] {
    [g.boom.stroke, g.arm.stroke, g.bucket.stroke]
}

fn cylinders<T: Real>(lengths: [f64; 3]) -> Cylinders<T> {
    let [boom, arm, bucket] = lengths.map(T::from_f64);
    Cylinders { boom, arm, bucket }
}

/// All cylinders in mid-stroke but one.
fn all_but<T: Real>(g: &PinGeometry, which: usize, length: f64) -> Cylinders<T> {
    let mut lengths = strokes(g).map(|s| 0.5 * (s.min_m + s.max_m));
    lengths[which] = length;
    cylinders(lengths)
}

fn machines() -> [Named; 4] {
    machines::all().unwrap()
}

#[test]
fn a_length_outside_the_stroke_names_its_cylinder_and_the_signed_excess() {
    for (name, g) in machines() {
        let machine = Machine::<f64>::new(&g).unwrap();
        for (which, stroke) in strokes(&g).into_iter().enumerate() {
            for (length, excess) in [(stroke.max_m + 0.01, 0.01), (stroke.min_m - 0.02, -0.02)] {
                match machine.cylinders_to_tip(&all_but(&g, which, length), Rotor::IDENTITY) {
                    Err(PoseError::OutOfStroke { cylinder, by }) => {
                        assert_eq!(cylinder, ORDER[which], "{name}");
                        assert!((by - excess).abs() < 1e-12, "{name} {cylinder}: {by}, not {excess}");
                    }
                    other => panic!("{name}, cylinder {which} at {length}: {other:?}"),
                }
            }
        }
    }
}

/// Lengths up to `inner` inside the tolerance are accepted, from `outer` outside it refused, m.
fn the_tolerance_is_a_micrometre<T: Real>(inner: f64, outer: f64) {
    for (name, g) in machines() {
        let machine = Machine::<T>::new(&g).unwrap();
        for (which, Stroke { min_m, max_m }) in strokes(&g).into_iter().enumerate() {
            let inside = |length| machine.cylinders_to_tip(&all_but(&g, which, length), Rotor::IDENTITY).is_ok();
            for (end, outwards) in [(min_m, -1.0), (max_m, 1.0)] {
                let beyond = |by: f64| end + outwards * by;
                assert!(inside(end) && inside(beyond(1e-6 - inner)), "{name}, cylinder {which} at {end}");
                assert!(!inside(beyond(1e-6 + outer)), "{name}, cylinder {which} at {end}");
            }
        }
    }
}

#[test]
fn within_a_micrometre_of_an_end_is_inside_the_stroke() {
    // The edge itself, whatever its decimal rounds to, is inside.
    the_tolerance_is_a_micrometre::<f64>(0.0, 2e-12);
    // f32 spaces lengths of 2…4 m by 0.24 µm.
    the_tolerance_is_a_micrometre::<f32>(0.24e-6, 0.24e-6);
}

#[test]
fn lengths_that_are_no_lengths_are_out_of_stroke_and_the_first_cylinder_is_named() {
    let bad =
        [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -0.0, 0.0, f32::MIN_POSITIVE, 1e30, f32::MAX];
    for (name, g) in machines() {
        let machine = Machine::<f32>::new(&g).unwrap();
        for length in bad {
            for (which, named) in ORDER.into_iter().enumerate() {
                let mut lengths = all_but::<f32>(&g, which, 1.0);
                match which {
                    0 => lengths.boom = length,
                    1 => lengths.arm = length,
                    _ => lengths.bucket = length,
                }
                let found = machine.cylinders_to_tip(&lengths, Rotor::IDENTITY);
                match found {
                    Err(PoseError::OutOfStroke { cylinder, by }) => {
                        assert_eq!(cylinder, named, "{name}");
                        assert!(length.is_nan() || (by < 0.0) == (length < 1.0), "{name}: {length} is off by {by}");
                    }
                    other => panic!("{name}, {length}: {other:?}"),
                }
            }
            let all = Cylinders { boom: length, arm: length, bucket: length };
            let found = machine.cylinders_to_tip(&all, Rotor::IDENTITY);
            assert!(matches!(found, Err(PoseError::OutOfStroke { cylinder: Cylinder::Boom, .. })), "{name}: {found:?}");
        }
    }
}

#[test]
fn without_the_stroke_check_an_open_triangle_says_by_how_much_it_gapes() {
    for (name, g) in machines() {
        let machine = Machine::<f64>::new(&g).unwrap();
        let arm_base = g.arm.base - Vec2::new(g.boom_m, 0.0);
        let rocker = g.bucket.base - g.bucket.rocker_pivot;
        let sides = [
            (g.boom.base.norm(), g.boom.rod.norm()),
            (arm_base.norm(), g.arm.rod.norm()),
            (rocker.norm(), g.bucket.rocker_m),
        ];
        for (which, (a, b)) in sides.into_iter().enumerate() {
            for (length, gap) in [(a + b + 0.25, 0.25), ((a - b).abs() - 0.125, 0.125)] {
                match machine.cylinders_to_joints_any_stroke(&all_but(&g, which, length)) {
                    Err(PoseError::NoAssembly { cylinder, by }) => {
                        assert_eq!(cylinder, ORDER[which], "{name}");
                        assert!((by - gap).abs() < 1e-12, "{name} {cylinder}: {by}, not {gap}");
                    }
                    other => panic!("{name}, cylinder {which} at {length}: {other:?}"),
                }
            }
        }
    }
}

#[test]
fn without_the_stroke_check_an_open_four_bar_says_by_how_much_it_gapes() {
    // Of the four machines only exact-mini's rocker can carry J where coupler and bucket do not follow: too near the pin.
    let g = PinGeometry::EXACT_MINI;
    let machine = Machine::<f64>::new(&g).unwrap();
    let oracle = Oracle::new(&g);
    let (pin, coupler) = (g.bucket.coupler_pin.norm(), g.bucket.coupler_m);
    let rocker_base = (g.bucket.base - g.bucket.rocker_pivot).norm();
    let mut open = 0;
    for n in 1..2000 {
        let length = rocker_base - g.bucket.rocker_m + 2.0 * g.bucket.rocker_m * f64::from(n) / 2000.0;
        let gap = coupler - pin - apart(oracle.common_pin(length), Point::new(g.arm_m, 0.0));
        match machine.cylinders_to_joints_any_stroke(&all_but(&g, 2, length)) {
            Err(PoseError::NoAssembly { cylinder: Cylinder::Bucket, by }) => {
                assert!((by - gap).abs() < 1e-12 && gap > 0.0, "{length}: {by}, not {gap}");
                open += 1;
            }
            Ok(_) => assert!(gap <= 0.0, "{length} gapes by {gap}"),
            other => panic!("{length}: {other:?}"),
        }
    }
    assert!((10..1900).contains(&open), "{open}");
}

#[test]
fn a_four_bar_too_short_for_an_angle_says_by_how_much_both_ways() {
    // exact-mini's bucket on a rocker and a coupler too short to go round.
    let b = PinGeometry::EXACT_MINI.bucket;
    let (rocker, coupler) = (0.1, 0.05);
    let pin = Vec2::new(PinGeometry::EXACT_MINI.arm_m, 0.0);
    let linkage = FourBar::<f64>::new(b.base, b.rocker_pivot, pin, b.coupler_pin, rocker, coupler);
    let gap = |distance: f64, one: f64, other: f64| {
        if distance > one + other { distance - (one + other) } else { (one - other).abs() - distance }
    };
    // By how much the rocker's pivot lies beyond the cylinder's line or the bucket pin beyond the coupler's, on either side of K − I.
    let beyond = |from_pivot: Vec2<f64>, by: f64| {
        let side = from_pivot.norm();
        let cos = (side * side + rocker * rocker - coupler * coupler) / (2.0 * side * rocker);
        [1.0, -1.0].into_iter().any(|sense| {
            let turn = Vec2::new(cos, sense * libm::sqrt(1.0 - cos * cos));
            let common = turn.complex_mul(from_pivot).scale(rocker / side);
            let cylinder = common + b.rocker_pivot - b.base;
            let of_pivot = common.cross(cylinder).abs() / cylinder.norm();
            let along = common - from_pivot;
            let of_pin = along.cross(pin - b.rocker_pivot - from_pivot).abs() / coupler;
            by > 0.0 && ((by - of_pivot).abs() < 1e-9 || (by - of_pin).abs() < 1e-9)
        })
    };
    let (mut open, mut closed) = ([0; 2], [0; 2]);
    for n in 0..3600 {
        let rotor = Rotor::<f64>::from_degrees(0.1 * f64::from(n));
        let from_pivot = pin + rotor.rotate(b.coupler_pin) - b.rocker_pivot;
        match linkage.length(rotor) {
            Ok(length) => {
                assert!(length.is_finite() && gap(from_pivot.norm(), rocker, coupler) <= 1e-12);
                closed[0] += 1;
            }
            Err(Gap(by)) => {
                let exact = gap(from_pivot.norm(), rocker, coupler);
                // Where it closes, it is a dead point that the angle is beyond.
                let fits = if exact > 0.0 { (by - exact).abs() < 1e-12 } else { beyond(from_pivot, by) };
                assert!(fits, "{n}: {by}, not {exact}");
                open[0] += u32::from(exact > 0.0);
            }
        }
    }
    let base = (b.base - b.rocker_pivot).norm();
    for n in 1..1000 {
        let length = base - rocker + 2.0 * rocker * f64::from(n) / 1000.0;
        let towards_base = (b.base - b.rocker_pivot).direction().unwrap();
        let cos = (base * base + rocker * rocker - length * length) / (2.0 * base * rocker);
        let turn = Rotor { cos, sin: -libm::sqrt(1.0 - cos * cos) };
        let common = b.rocker_pivot + (towards_base * turn).to_vec().scale(rocker);
        let exact = gap((common - pin).norm(), b.coupler_pin.norm(), coupler);
        match linkage.rotor(length) {
            Ok(_) => {
                assert!(exact <= 1e-12, "{length}");
                closed[1] += 1;
            }
            Err(Gap(by)) => {
                assert!((by - exact).abs() < 1e-12, "{length}: {by}, not {exact}");
                open[1] += 1;
            }
        }
    }
    assert!(open.iter().chain(&closed).all(|n| *n > 10), "{open:?} open, {closed:?} closed");
}

/// Lengths the strict inverse gives for joint angle `which` at `degrees`, the others in mid-stroke, and the joints asked for.
fn lengths_at(g: &PinGeometry, which: usize, degrees: f64) -> (Joints<f64>, Result<Cylinders<f64>, PoseError<f64>>) {
    let machine = Machine::<f64>::new(g).unwrap();
    let middle = strokes(g).map(|s| 0.5 * (s.min_m + s.max_m));
    let mut joints = machine.cylinders_to_joints(&cylinders(middle)).unwrap();
    let turned = Rotor::from_degrees(degrees);
    match which {
        0 => joints.boom = turned,
        1 => joints.arm = turned,
        _ => joints.bucket = turned,
    }
    (joints, machine.joints_to_cylinders(&joints))
}

#[test]
fn an_angle_gets_the_cylinder_that_makes_this_angle_or_none() {
    // Beyond a dead point the same length belongs to another angle: half of all angles with a length in the stroke.
    for (name, g) in machines() {
        let machine = Machine::<f64>::new(&g).unwrap();
        for which in [0, 1, 2] {
            let (mut answered, mut beyond) = (0, 0);
            for n in 0..3600 {
                match lengths_at(&g, which, 0.1 * f64::from(n)) {
                    (asked, Ok(found)) => {
                        let back = machine.cylinders_to_joints(&found).unwrap();
                        let pairs = [(back.boom, asked.boom), (back.arm, asked.arm), (back.bucket, asked.bucket)];
                        for (back, asked) in pairs {
                            let off = (back * asked.inverse()).angle().abs();
                            assert!(off < 1e-9, "{name}: {asked:?} came back as {back:?}, by {found:?}");
                        }
                        answered += 1;
                    }
                    (_, Err(PoseError::NoAssembly { cylinder, by })) => {
                        assert!(cylinder == ORDER[which] && by > 0.0, "{name}, {cylinder} at {n}: {by}");
                        beyond += 1;
                    }
                    (_, Err(PoseError::OutOfStroke { cylinder, .. })) => assert_eq!(cylinder, ORDER[which], "{name}"),
                    (_, Err(other)) => panic!("{name}, cylinder {which} at {n}: {other:?}"),
                }
            }
            assert!(answered > 300 && beyond > 300, "{name}, cylinder {which}: {answered}, {beyond}");
        }
    }
}

#[test]
fn an_angle_beyond_the_dead_point_says_how_far_the_pin_is_beyond_the_cylinder() {
    // exact-mini's boom at 141.3° needs the length that holds it at 62.5°; the boom pin would lie beyond the cylinder.
    let g = PinGeometry::EXACT_MINI;
    let boom = Rotor::from_degrees(141.3);
    let rod_eye = boom.rotate(g.boom.rod);
    let exact = -g.boom.base.cross(rod_eye) / (rod_eye - g.boom.base).norm();
    match lengths_at(&g, 0, 141.3).1 {
        Err(PoseError::NoAssembly { cylinder: Cylinder::Boom, by }) => {
            assert!((by - exact).abs() < 1e-12 && exact > 0.1, "{by}, not {exact}");
        }
        other => panic!("{other:?}"),
    }
}

fn tip<T: Real>(g: &PinGeometry, wrist_x: f64, wrist_z: f64, pitch: Rotor<f64>) -> PlaneTip<T> {
    PlaneTip {
        reach: T::from_f64(g.boom_pin_x_m + wrist_x + g.bucket_m * pitch.cos),
        height: T::from_f64(wrist_z + g.bucket_m * pitch.sin),
        pitch: Rotor { cos: T::from_f64(pitch.cos), sin: T::from_f64(pitch.sin) },
    }
}

fn unreachable_by<T: Real>(machine: &Machine<T>, tip: &PlaneTip<T>) -> f64 {
    match (machine.tip_to_joints(tip), machine.tip_to_cylinders(tip)) {
        (Err(PoseError::Unreachable { by }), Err(PoseError::Unreachable { by: again })) => {
            assert!(by == again || by.to_f64().is_nan());
            by.to_f64()
        }
        other => panic!("{tip:?}: {other:?}"),
    }
}

#[test]
fn a_tip_out_of_reach_says_by_how_much_outside_and_inside() {
    for (name, g) in machines() {
        let machine = Machine::<f64>::new(&g).unwrap();
        let (outer, inner) = (g.boom_m + g.arm_m, g.boom_m - g.arm_m);
        for direction in 0..24 {
            let ray = Rotor::from_degrees(15.0 * f64::from(direction));
            let pitch = Rotor::from_degrees(-70.0 + 3.0 * f64::from(direction));
            for (distance, by) in
                [(outer + 0.25, 0.25), (outer + 1e-6, 1e-6), (inner - 0.125, -0.125), (1e-3, 1e-3 - inner)]
            {
                let found = unreachable_by(&machine, &tip(&g, distance * ray.cos, distance * ray.sin, pitch));
                assert!((found - by).abs() < 1e-12, "{name}: {found}, not {by}");
            }
        }
    }
}

#[test]
fn tips_that_are_no_numbers_or_beyond_all_numbers_are_unreachable() {
    for (name, g) in machines() {
        let machine = Machine::<f32>::new(&g).unwrap();
        let good = tip::<f32>(&g, 0.7 * (g.boom_m + g.arm_m), -0.5, Rotor::from_degrees(-80.0));
        assert!(machine.tip_to_joints(&good).is_ok(), "{name}");
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -1e30, 1e20] {
            let no_pitch = |cos, sin| Rotor { cos, sin };
            let tips = [
                PlaneTip { reach: bad, ..good },
                PlaneTip { height: bad, ..good },
                PlaneTip { pitch: no_pitch(bad, good.pitch.sin), ..good },
                PlaneTip { pitch: no_pitch(good.pitch.cos, bad), ..good },
            ];
            for tip in tips {
                let by = unreachable_by(&machine, &tip);
                assert!(by > 0.0 || by.is_nan(), "{name}: {tip:?} is off by {by}");
            }
        }
    }
}

fn the_wrist_on_the_boom_pin_is_unreachable<T: Real>() {
    let g = equal_links();
    let machine = Machine::<T>::new(&g).unwrap();
    for offset in [0.0, 1e-38, 1e-30, 1e-25, 1e-22, 1e-20, 1e-18, 1e-12, 1e-9, 1e-7] {
        for (x, z) in [(offset, 0.0), (0.0, offset), (-offset, offset)] {
            // Pitch 90°: the bucket adds nothing to the reach, so the offset survives rounding.
            let pitch = Rotor { cos: T::ZERO, sin: T::ONE };
            let bucket = T::from_f64(g.bucket_m);
            let at = PlaneTip { reach: T::from_f64(x), height: bucket + T::from_f64(z), pitch };
            match machine.tip_to_joints(&at) {
                Err(PoseError::Unreachable { by }) => assert!(by.to_f64().abs() < 1e-5, "{offset}: {by:?}"),
                Ok(found) => panic!("{offset}: {found:?}"),
                Err(other) => panic!("{offset}: {other:?}"),
            }
            assert!(machine.tip_to_cylinders(&at).is_err());
        }
    }
}

#[test]
fn a_wrist_on_the_boom_pin_is_unreachable_where_boom_and_arm_are_equally_long() {
    the_wrist_on_the_boom_pin_is_unreachable::<f32>();
    the_wrist_on_the_boom_pin_is_unreachable::<f64>();
}

#[test]
fn messages_name_the_cylinder_and_the_side() {
    let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
    let message = |lengths| match machine.cylinders_to_tip(&cylinders(lengths), Rotor::IDENTITY) {
        Err(error) => (error.kind(), error.to_string()),
        Ok(pose) => panic!("{pose:?}"),
    };
    let (kind, long) = message([1.5, 1.3, 1.0]);
    assert_eq!(kind, "out_of_stroke");
    assert!(long.contains("boom") && long.contains("above the maximum"), "{long}");
    let (_, short) = message([1.1, 1.3, 0.5]);
    assert!(short.contains("bucket") && short.contains("below the minimum"), "{short}");
}
