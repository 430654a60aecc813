//! Isotropy over the strokes of all four machines: the report's search finds the isotropic points and the best and worst poses.

use cross_tests::jacobians::jacobian;
use cross_tests::machines;
use cross_tests::sweep::Random;
use hil_sim::machine_report::isotropic::{ArmPose, isotropy};
use kinematics_core::isotropy::condition_number;
use kinematics_core::{Cylinders, Machine, PinGeometry};

/// Conditions at random cylinder lengths and along the edges of both strokes, by the trigonometric Jacobian.
fn sampled(g: &PinGeometry, random: &mut Random) -> [f64; 2] {
    let machine = Machine::<f64>::new(g).unwrap();
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for round in 0..100_000 {
        let edge = |x: f64| if round % 4 == 0 { x.round() } else { x };
        let parts = [random.unit(), random.unit()];
        let parts = if round % 8 == 0 { [edge(parts[0]), parts[1]] } else { [parts[0], edge(parts[1])] };
        let [arm, bucket] = [(g.arm.stroke, parts[0]), (g.bucket.stroke, parts[1])]
            .map(|(s, part)| s.min_m + (s.max_m - s.min_m) * part);
        let joints = machine.cylinders_to_joints(&Cylinders { boom: g.boom.stroke.min_m, arm, bucket }).unwrap();
        let j = jacobian([g.boom_m, g.arm_m, g.bucket_m], [0.2, joints.arm.angle(), joints.bucket.angle()]);
        let condition = condition_number(&j).unwrap();
        (least, most) = (least.min(condition), most.max(condition));
    }
    [least, most]
}

fn condition_of(g: &PinGeometry, pose: &ArmPose) -> f64 {
    let angles = [0.4, pose.arm_deg.to_radians(), pose.bucket_deg.to_radians()];
    condition_number(&jacobian([g.boom_m, g.arm_m, g.bucket_m], angles)).unwrap()
}

fn within_stroke(g: &PinGeometry, pose: &ArmPose) {
    let machine = Machine::<f64>::new(g).unwrap();
    let cylinders = Cylinders { boom: g.boom.stroke.max_m, arm: pose.arm_m, bucket: pose.bucket_m };
    let joints = machine.cylinders_to_joints(&cylinders).unwrap();
    assert!((joints.arm.angle().to_degrees() - pose.arm_deg).abs() < 1e-10, "{pose}");
    assert!((joints.bucket.angle().to_degrees() - pose.bucket_deg).abs() < 1e-10, "{pose}");
}

fn search_holds(name: &str, g: &PinGeometry, random: &mut Random) -> usize {
    let found = isotropy(g).unwrap();
    println!("{name}\n{found}");
    for pose in found.isotropic.iter().chain([&found.best, &found.worst]) {
        within_stroke(g, pose);
        assert!((condition_of(g, pose) - pose.condition.unwrap()).abs() < 1e-9, "{pose}");
    }
    for pose in &found.isotropic {
        assert!((pose.condition.unwrap() - 1.0).abs() < 1e-14, "{pose}");
        assert!((pose.largest_m - pose.smallest_m).abs() < 1e-12, "{pose}");
    }
    let [least, most] = sampled(g, random);
    let (best, worst) = (found.best.condition.unwrap(), found.worst.condition.unwrap());
    assert!(best <= least + 1e-12 && best > least * 0.97, "{name}: {best}, sampled {least}");
    assert!(worst >= most - 1e-12 * most && worst < most * 1.03, "{name}: {worst}, sampled {most}");
    assert_eq!(found.isotropic.is_empty(), found.to_string().contains("none"));
    found.isotropic.len()
}

/// θ3, θ4 [degrees] and σ [m] of the one isotropic point of each machine's stroke.
const OF_THE_MACHINES: [(&str, [f64; 3]); 4] = [
    ("frankel", [-109.11, -108.35, 0.947]),
    ("exact-mini", [-114.79, -51.00, 1.551]),
    ("zx120", [-114.01, -58.59, 3.454]),
    ("zx200", [-116.02, -48.71, 4.254]),
];

#[test]
fn every_machine_has_one_isotropic_point_in_its_stroke_and_no_random_pose_beats_the_search() {
    let mut random = Random::new(29);
    for ((name, g), (expected_name, [arm, bucket, sigma])) in machines::all().unwrap().iter().zip(OF_THE_MACHINES) {
        assert_eq!(*name, expected_name);
        assert_eq!(search_holds(name, g, &mut random), 1);
        let best = isotropy(g).unwrap().best;
        assert!((best.arm_deg - arm).abs() < 0.005 && (best.bucket_deg - bucket).abs() < 0.005, "{name}: {best}");
        assert!((best.largest_m - sigma).abs() < 5e-4, "{name}: {best}");
    }
}

#[test]
fn a_stroke_without_isotropic_points_says_none_and_names_the_best_pose() {
    let mut random = Random::new(31);
    let mut short = PinGeometry::EXACT_MINI;
    // The isotropic point needs 1.4415 m.
    short.arm.stroke.max_m = 1.3;
    assert_eq!(search_holds("arm stroke cut short", &short, &mut random), 0);
    let found = isotropy(&short).unwrap();
    assert_eq!(found.of_the_links, 4);
    assert!(
        found.to_string().starts_with("isotropic points within the stroke: none (4 of the links alone)"),
        "{found}"
    );
    assert!((found.best.arm_m - 1.3).abs() < 1e-12, "the best pose lies at the end nearest to it, {}", found.best);

    let mut long = PinGeometry::EXACT_MINI;
    long.boom_m += 1.0;
    long.arm.base.x += 1.0;
    assert_eq!(search_holds("long boom", &long, &mut random), 0);
    let found = isotropy(&long).unwrap();
    assert_eq!(found.of_the_links, 0);
    assert!(found.best.condition.is_some_and(|condition| condition > 1.01), "{found}");
}

#[test]
fn a_search_of_a_broken_machine_names_the_fault() {
    let mut g = PinGeometry::EXACT_MINI;
    g.arm.stroke.max_m = 9.0;
    assert_eq!(isotropy(&g).unwrap_err().field, "arm.max_m");
}
