//! A geometry that cannot work is refused before anything moves, by the name of the field that is wrong.

use cross_tests::machines::{self, ZX120, ZX200, frankel_distances};
use kinematics_core::distances::FrankelDistances;
use kinematics_core::geometry::{Problem, Stroke, SwingPins};
use kinematics_core::{GeometryError, Machine, PinGeometry, Vec2};

type Field = (&'static str, fn(&mut PinGeometry) -> &mut f64);

const COORDINATES: [Field; 15] = [
    ("links.boom_pin_x_m", |g| &mut g.boom_pin_x_m),
    ("boom.base_x_m", |g| &mut g.boom.base.x),
    ("boom.base_z_m", |g| &mut g.boom.base.z),
    ("boom.rod_x_m", |g| &mut g.boom.rod.x),
    ("boom.rod_z_m", |g| &mut g.boom.rod.z),
    ("arm.base_x_m", |g| &mut g.arm.base.x),
    ("arm.base_z_m", |g| &mut g.arm.base.z),
    ("arm.rod_x_m", |g| &mut g.arm.rod.x),
    ("arm.rod_z_m", |g| &mut g.arm.rod.z),
    ("bucket.base_x_m", |g| &mut g.bucket.base.x),
    ("bucket.base_z_m", |g| &mut g.bucket.base.z),
    ("bucket.rocker_pivot_x_m", |g| &mut g.bucket.rocker_pivot.x),
    ("bucket.rocker_pivot_z_m", |g| &mut g.bucket.rocker_pivot.z),
    ("bucket.coupler_pin_x_m", |g| &mut g.bucket.coupler_pin.x),
    ("bucket.coupler_pin_z_m", |g| &mut g.bucket.coupler_pin.z),
];

const LENGTHS: [Field; 11] = [
    ("links.boom_m", |g| &mut g.boom_m),
    ("links.arm_m", |g| &mut g.arm_m),
    ("links.bucket_m", |g| &mut g.bucket_m),
    ("boom.min_m", |g| &mut g.boom.stroke.min_m),
    ("boom.max_m", |g| &mut g.boom.stroke.max_m),
    ("arm.min_m", |g| &mut g.arm.stroke.min_m),
    ("arm.max_m", |g| &mut g.arm.stroke.max_m),
    ("bucket.rocker_m", |g| &mut g.bucket.rocker_m),
    ("bucket.coupler_m", |g| &mut g.bucket.coupler_m),
    ("bucket.min_m", |g| &mut g.bucket.stroke.min_m),
    ("bucket.max_m", |g| &mut g.bucket.stroke.max_m),
];

fn swing(g: &mut PinGeometry) -> &mut SwingPins {
    g.swing.as_mut().unwrap()
}

/// Of a machine with a swing cylinder: coordinates, then lengths.
const SWING: [Field; 6] = [
    ("swing.base_x_m", |g| &mut swing(g).base.x),
    ("swing.base_y_m", |g| &mut swing(g).base.z),
    ("swing.rod_x_m", |g| &mut swing(g).rod.x),
    ("swing.rod_y_m", |g| &mut swing(g).rod.z),
    ("swing.min_m", |g| &mut swing(g).stroke.min_m),
    ("swing.max_m", |g| &mut swing(g).stroke.max_m),
];

fn refused(g: &PinGeometry) -> GeometryError {
    match (Machine::<f32>::new(g), Machine::<f64>::new(g)) {
        (Err(error), Err(again)) => {
            assert_eq!(error.field, again.field);
            error
        }
        _ => panic!("accepted: {g:?}"),
    }
}

fn with(mut g: PinGeometry, change: impl FnOnce(&mut PinGeometry)) -> PinGeometry {
    change(&mut g);
    g
}

#[test]
fn all_four_machines_are_accepted_in_both_precisions() {
    for (name, g) in machines::all().unwrap() {
        assert!(Machine::<f32>::new(&g).is_ok() && Machine::<f64>::new(&g).is_ok(), "{name}: {:?}", g.validate());
    }
}

#[test]
fn every_field_that_is_not_finite_is_named() {
    for (name, g) in machines::all().unwrap() {
        let of_swing: &[Field] = if g.swing.is_some() { &SWING } else { &[] };
        for (field, of) in COORDINATES.iter().chain(&LENGTHS).chain(of_swing) {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let error = refused(&with(g, |g| *of(g) = bad));
                assert_eq!((error.field, error.problem), (*field, Problem::NotFinite), "{name} with {bad}");
                assert!(error.to_string().contains(field) && error.to_string().contains("finite"), "{error}");
            }
        }
    }
}

#[test]
fn every_length_that_is_not_above_zero_is_named_with_its_value() {
    for (name, g) in machines::all().unwrap() {
        let of_swing: &[Field] = if g.swing.is_some() { &SWING[4..] } else { &[] };
        for (field, of) in LENGTHS.iter().chain(of_swing) {
            for bad in [-1.25, -0.0, 0.0, -1e-300] {
                let error = refused(&with(g, |g| *of(g) = bad));
                assert_eq!((error.field, error.problem), (*field, Problem::NotPositive(bad)), "{name}");
                assert!(error.to_string().contains(&bad.to_string()), "{error}");
            }
        }
    }
}

#[test]
fn coordinates_may_be_negative() {
    let negative = COORDINATES.iter().filter(|(_, of)| *of(&mut ZX200.clone()) < 0.0);
    assert!(negative.count() > 0 && ZX200.validate().is_ok());
    assert!(with(ZX200, |g| g.boom_pin_x_m = -0.3).validate().is_ok());
}

#[test]
fn a_minimum_that_is_not_below_its_maximum_is_named() {
    type Of = fn(&mut PinGeometry) -> &mut Stroke;
    let strokes: [(&str, Of); 3] = [
        ("boom.min_m", |g| &mut g.boom.stroke),
        ("arm.min_m", |g| &mut g.arm.stroke),
        ("bucket.min_m", |g| &mut g.bucket.stroke),
    ];
    for (name, g) in machines::all().unwrap() {
        for (field, of) in strokes {
            for longer in [0.0, 0.1] {
                let changed = with(g, |g| of(g).min_m = of(g).max_m + longer);
                let error = refused(&changed);
                assert_eq!(error.field, field, "{name}");
                assert!(matches!(error.problem, Problem::MinNotBelowMax { .. }), "{name}: {error:?}");
            }
        }
    }
}

#[test]
fn a_triangle_that_does_not_close_names_the_end_of_the_stroke() {
    for (name, g) in machines::all().unwrap() {
        let arm_base = g.arm.base - Vec2::new(g.boom_m, 0.0);
        let cases: [(&str, PinGeometry); 6] = [
            ("boom.max_m", with(g, |g| g.boom.stroke.max_m = g.boom.base.norm() + g.boom.rod.norm())),
            ("boom.min_m", with(g, |g| g.boom.stroke.min_m = (g.boom.base.norm() - g.boom.rod.norm()).abs())),
            ("arm.max_m", with(g, |g| g.arm.stroke.max_m = arm_base.norm() + g.arm.rod.norm() + 0.1)),
            ("arm.min_m", with(g, |g| g.arm.stroke.min_m = (arm_base.norm() - g.arm.rod.norm()).abs() - 0.001)),
            ("bucket.max_m", with(g, |g| g.bucket.stroke.max_m = 4.0)),
            ("bucket.min_m", with(g, |g| g.bucket.stroke.min_m = 0.01)),
        ];
        for (field, changed) in cases {
            let error = refused(&changed);
            assert_eq!(error.field, field, "{name}");
            assert!(matches!(error.problem, Problem::DoesNotClose { .. }), "{name}: {error:?}");
        }
    }
}

#[test]
fn a_bucket_stroke_over_the_fold_is_refused_at_its_minimum() {
    // The rocker comes in line with the cylinder's base at 1.5729 m on zx200, at 1.3106 m on zx120.
    for (name, g, too_short, fold) in [("zx200", ZX200, 1.56, 1.5729), ("zx120", ZX120, 1.30, 1.3106)] {
        let error = refused(&with(g, |g| g.bucket.stroke.min_m = too_short));
        assert_eq!(error.field, "bucket.min_m", "{name}");
        assert!(matches!(error.problem, Problem::Folds { .. } | Problem::DoesNotClose { .. }), "{name}: {error:?}");
        println!("{name} with bucket.min_m = {too_short}: {error}");
        let refused_at = |min_m: f64| with(g, |g| g.bucket.stroke.min_m = min_m).validate().is_err();
        assert!(refused_at(fold - 1e-4), "{name} folds at {fold} m");
        assert!(!refused_at(fold + 1e-4), "{name} does not fold at {} m", fold + 1e-4);
    }
}

#[test]
fn pins_that_coincide_are_refused() {
    let zero = Vec2::new(0.0, 0.0);
    for (name, g) in machines::all().unwrap() {
        let cases = [
            ("boom.base_x_m", with(g, |g| g.boom.base = zero)),
            ("boom.rod_x_m", with(g, |g| g.boom.rod = zero)),
            ("arm.base_x_m", with(g, |g| g.arm.base = Vec2::new(g.boom_m, 0.0))),
            ("arm.rod_x_m", with(g, |g| g.arm.rod = zero)),
            ("bucket.base_x_m", with(g, |g| g.bucket.base = g.bucket.rocker_pivot)),
            ("bucket.rocker_pivot_x_m", with(g, |g| g.bucket.rocker_pivot = Vec2::new(g.arm_m, 0.0))),
            ("bucket.coupler_pin_x_m", with(g, |g| g.bucket.coupler_pin = zero)),
        ];
        for (field, changed) in cases {
            let error = refused(&changed);
            assert_eq!((error.field, error.problem), (field, Problem::PinsCoincide), "{name}");
        }
    }
}

#[test]
fn a_swing_cylinder_that_does_not_close_is_refused() {
    let frankel = frankel_distances().to_pins().unwrap();
    let sum = |g: &mut PinGeometry| swing(g).base.norm() + swing(g).rod.norm();
    let error = refused(&with(frankel, |g| swing(g).stroke.max_m = sum(g) + 0.01));
    assert_eq!(error.field, "swing.max_m");
}

#[test]
fn every_distance_of_frankels_that_is_no_length_is_named() {
    type Distance = (&'static str, fn(&mut FrankelDistances) -> &mut f64);
    let fields: [Distance; 22] = [
        ("distances.r01_m", |d| &mut d.r01_m),
        ("distances.r0n_m", |d| &mut d.r0n_m),
        ("distances.ran_m", |d| &mut d.ran_m),
        ("distances.rjm_m", |d| &mut d.rjm_m),
        ("distances.r0m_m", |d| &mut d.r0m_m),
        ("distances.r0k_m", |d| &mut d.r0k_m),
        ("distances.r1c_m", |d| &mut d.r1c_m),
        ("distances.r12_m", |d| &mut d.r12_m),
        ("distances.r2c_m", |d| &mut d.r2c_m),
        ("distances.r1b_m", |d| &mut d.r1b_m),
        ("distances.r2b_m", |d| &mut d.r2b_m),
        ("distances.r2d_m", |d| &mut d.r2d_m),
        ("distances.rde_m", |d| &mut d.rde_m),
        ("distances.r23_m", |d| &mut d.r23_m),
        ("distances.r3d_m", |d| &mut d.r3d_m),
        ("distances.ref_m", |d| &mut d.ref_m),
        ("distances.r3f_m", |d| &mut d.r3f_m),
        ("distances.r34_m", |d| &mut d.r34_m),
        ("distances.r3g_m", |d| &mut d.r3g_m),
        ("distances.r4g_m", |d| &mut d.r4g_m),
        ("distances.rfh_m", |d| &mut d.rfh_m),
        ("distances.rgh_m", |d| &mut d.rgh_m),
    ];
    for (field, of) in fields {
        for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            let mut distances = frankel_distances();
            *of(&mut distances) = bad;
            assert_eq!(distances.to_pins().unwrap_err().field, field, "with {bad}");
        }
    }
    let mut distances = frankel_distances();
    distances.r2d_m = 5.0;
    let error = distances.to_pins().unwrap_err();
    assert_eq!(error.problem, Problem::NoTriangle);
    assert!(error.field.starts_with("distances."), "{error}");
}

#[test]
fn a_number_beyond_a_kilometre_is_refused_by_its_field_before_it_becomes_an_infinity_in_f32() {
    for (field, of) in COORDINATES.into_iter().chain(LENGTHS) {
        for huge in [1e4, 1e39, 1e300] {
            let mut g = PinGeometry::EXACT_MINI;
            *of(&mut g) = huge;
            assert_eq!(refused(&g), GeometryError { field, problem: Problem::TooLarge(huge) });
        }
    }
}

#[test]
fn a_bucket_stroke_over_the_fold_is_named_by_the_end_that_is_nearer_to_it() {
    // exact-mini's linkage folds nowhere from 0.84 to 1.26 m.
    let whole = PinGeometry::EXACT_MINI;
    let b = whole.bucket;
    let to_base = b.base - b.rocker_pivot;
    let side = to_base.norm();
    // Coupler and bucket fold up where the rocker's end comes too near to the bucket pin.
    let folded = |length: f64| {
        let cos = (side * side + b.rocker_m * b.rocker_m - length * length) / (2.0 * side * b.rocker_m);
        let turn = Vec2::new(cos, -libm::sqrt(1.0 - cos * cos));
        let common = b.rocker_pivot + turn.complex_mul(to_base).scale(b.rocker_m / side);
        (common - Vec2::new(whole.arm_m, 0.0)).norm() < b.coupler_m - b.coupler_pin.norm()
    };
    let fold = (0..5_000).map(|i| 1.26 + 1e-5 * f64::from(i)).find(|length| folded(*length)).unwrap();
    for (min_m, max_m) in [(0.84, 1.30), (0.84, 1.29), (1.2, 1.30), (1.275, 1.30)] {
        let mut g = whole;
        g.bucket.stroke = Stroke { min_m, max_m };
        let error = refused(&g);
        let Problem::DoesNotClose { length_m: at } = error.problem else { panic!("{min_m}…{max_m}: {error:?}") };
        assert!(at >= fold - 1e-5 && at < fold + 1e-3, "{at}, folds at {fold}");
        let nearer = if at <= 0.5 * (min_m + max_m) { "bucket.min_m" } else { "bucket.max_m" };
        assert_eq!(error.field, nearer, "{min_m}…{max_m}: {at}");
    }
}

#[test]
fn a_bucket_linkage_whose_rocker_and_coupler_come_in_line_within_the_stroke_is_refused() {
    let whole = PinGeometry::EXACT_MINI;
    let mut counts = [0; 2];
    for i in 0..40 {
        for j in 0..40 {
            let mut g = whole;
            (g.bucket.rocker_m, g.bucket.coupler_m) = (0.16 + 0.006 * f64::from(i), 0.1 + 0.005 * f64::from(j));
            g.bucket.stroke = Stroke { min_m: 0.95, max_m: 1.2 };
            let b = g.bucket;
            let to_base = b.base - b.rocker_pivot;
            let pin = Vec2::new(g.arm_m, 0.0);
            // Where a circle about one point meets that about another, clockwise of the line between them.
            let meet = |way: Vec2<f64>, one: f64, other: f64| {
                let side = way.norm();
                let cos = (side * side + one * one - other * other) / (2.0 * side * one);
                let turn = Vec2::new(cos, -libm::sqrt(1.0 - cos * cos));
                (cos * cos < 1.0).then(|| turn.complex_mul(way).scale(one / side))
            };
            // How far the coupler's pin stands off the rocker's line; `None` where nothing closes.
            let off = |length: f64| {
                let rocker = meet(to_base, b.rocker_m, length)?;
                let common = b.rocker_pivot + rocker;
                let coupler = meet(common - pin, b.coupler_pin.norm(), b.coupler_m)?;
                Some((pin + coupler - b.rocker_pivot).cross(rocker))
            };
            let all: Vec<Option<f64>> = (0..=500).map(|n| off(0.95 + 0.0005 * f64::from(n))).collect();
            // A hair's breadth is left to either answer.
            if all.iter().flatten().any(|off| off.abs() < 1e-4) {
                continue;
            }
            let sound = all.iter().all(|off| off.is_some_and(|off| off > 0.0));
            assert_eq!(g.validate().is_ok(), sound, "rocker {}, coupler {}", b.rocker_m, b.coupler_m);
            counts[usize::from(sound)] += usize::from(all.iter().all(Option::is_some));
        }
    }
    println!("{counts:?}");
    assert!(counts[0] > 0 && counts[1] > 100, "{counts:?}");
}
