//! Isotropy: Hareesha's conditions, all eight configurations of his chain, and the points of all four machines' strokes.

use std::f64::consts::{PI, TAU};

use cross_tests::jacobians::jacobian;
use cross_tests::machines;
use cross_tests::sweep::Random;
use hil_sim::machine_report::isotropic::{ArmPose, isotropy};
use kinematics_core::isotropic_configurations::{IsotropicConfiguration, isotropic_configurations};
use kinematics_core::isotropy::{condition_number, hareesha_18, hareesha_20, row_equality, row_orthogonality};
use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};

/// The chain of Hareesha 2015, section IV.
const SQRT_2: f64 = std::f64::consts::SQRT_2;
const HAREESHA: [f64; 3] = [SQRT_2, SQRT_2, 1.0];

/// (17) and half of (19) as the two parts of one number, by the trigonometric Jacobian.
fn conditions(lengths: [f64; 3], t3: f64, t4: f64) -> [f64; 2] {
    let [x, z] = jacobian(lengths, [0.0, t3, t4]);
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    [dot(x, z), 0.5 * (dot(x, x) - dot(z, z))]
}

#[test]
fn hareeshas_18_and_20_are_17_and_19_with_angles_from_the_boom_line() {
    let mut random = Random::new(17);
    let (mut by_relative, mut by_printed_19) = (0.0f64, 0.0f64);
    for _ in 0..2_000 {
        let lengths = [0.5 + random.unit(), 0.5 + random.unit(), 0.5 + random.unit()];
        let [t3, t4] = [TAU * random.unit(), TAU * random.unit()];
        let j = jacobian(lengths, [0.0, t3, t4]);
        let (arm, bucket) = (Rotor::from_angle(t3), Rotor::from_angle(t3 + t4));
        assert!((hareesha_18(lengths, arm, bucket) - row_orthogonality(&j)).abs() < 1e-13);
        assert!((hareesha_20(lengths, arm, bucket) - row_equality(&j)).abs() < 1e-13);
        // Read with θ4 relative to the arm, (18) is another equation.
        let relative = Rotor::from_angle(t4);
        by_relative = by_relative.max((hareesha_18(lengths, arm, relative) - row_orthogonality(&j)).abs());
        // (19) as printed, with an entry J33 that a 2 × 3 matrix does not have, taken as zero or as a pitch row's one.
        let [x, z] = j;
        let printed = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - z[0] * z[0] - z[1] * z[1];
        let worst = (printed - row_equality(&j)).abs().min((printed - 1.0 - row_equality(&j)).abs());
        by_printed_19 = by_printed_19.max(worst);
    }
    assert!(by_relative > 1.0 && by_printed_19 > 0.4, "{by_relative}, {by_printed_19}");
}

#[test]
fn a_chain_is_as_isotropic_at_any_boom_angle() {
    for t2 in [-1.0, 0.3, 2.5] {
        for found in isotropic_configurations(HAREESHA).into_iter().flatten() {
            let j = jacobian(HAREESHA, [t2, found.arm.angle(), found.bucket.angle()]);
            assert!((condition_number(&j).unwrap() - 1.0).abs() < 1e-14);
        }
    }
}

/// The wanted eight, by θ3 in degrees: (θ3, θ4, σ²), each with its mirror image.
const EIGHT: [[f64; 3]; 4] = [
    [94.199144430, 117.200570380, 1.853553391],
    [115.263174354, 163.157883764, 1.146446609],
    [124.975303851, 142.226659917, 1.048815536],
    [157.937808842, 128.592218308, 1.284517797],
];

#[test]
fn hareeshas_chain_has_eight_isotropic_configurations_where_jjt_is_sigma_squared_times_one() {
    let mut found: Vec<IsotropicConfiguration> = isotropic_configurations(HAREESHA).into_iter().flatten().collect();
    assert_eq!(found.len(), 8);
    found.sort_by(|l, r| l.arm.angle().total_cmp(&r.arm.angle()));
    let mirrored = EIGHT.iter().rev().map(|[t3, t4, square]| [-t3, -t4, *square]);
    for (found, [t3, t4, square]) in found.iter().zip(mirrored.chain(EIGHT)) {
        assert!((found.arm.angle().to_degrees() - t3).abs() < 1e-8, "{found:?}, not {t3}");
        assert!((found.bucket.angle().to_degrees() - t4).abs() < 1e-8, "{found:?}, not {t4}");
        assert!((found.sigma * found.sigma - square).abs() < 1e-8, "{found:?}, not {square}");
        let [x, z] = jacobian(HAREESHA, [0.7, found.arm.angle(), found.bucket.angle()]);
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let sigma_square = found.sigma * found.sigma;
        let off = [dot(x, x) - sigma_square, dot(z, z) - sigma_square, dot(x, z)];
        assert!(off.iter().all(|off| off.abs() < 1e-12), "{off:?}");
        // Hareesha (16), JJᵀ = I, holds at none of them.
        assert!((sigma_square - 1.0).abs() > 0.04);
    }
}

/// Zeros of the two conditions by Newton's method with differences, from a dense grid of starts: (θ3, θ4) in (−π, π].
fn by_newton(lengths: [f64; 3]) -> Vec<[f64; 2]> {
    const STARTS: u32 = 48;
    let mut roots: Vec<[f64; 2]> = Vec::new();
    for start in 0..STARTS * STARTS {
        let mut at = [start / STARTS, start % STARTS].map(|n| TAU * f64::from(n) / f64::from(STARTS));
        for _ in 0..40 {
            let [f, g] = conditions(lengths, at[0], at[1]);
            let h = 1e-6;
            let slope = |k: usize| {
                let (mut up, mut down) = (at, at);
                (up[k], down[k]) = (at[k] + h, at[k] - h);
                let (up, down) = (conditions(lengths, up[0], up[1]), conditions(lengths, down[0], down[1]));
                [(up[0] - down[0]) / (2.0 * h), (up[1] - down[1]) / (2.0 * h)]
            };
            let ([a, c], [b, d]) = (slope(0), slope(1));
            let det = a * d - b * c;
            at = [at[0] - (d * f - b * g) / det, at[1] - (a * g - c * f) / det];
        }
        let [f, g] = conditions(lengths, at[0], at[1]);
        let at = at.map(|x| x - TAU * ((x - PI) / TAU).ceil());
        let known =
            |known: &[f64; 2]| known.iter().zip(at).all(|(k, x)| ((k - x + PI).rem_euclid(TAU) - PI).abs() < 1e-7);
        if f.abs() + g.abs() < 1e-11 && !roots.iter().any(known) {
            roots.push(at);
        }
    }
    roots
}

/// How often the two conditions turn about zero along the border of each cell of a grid over all angles: the cells
/// where they do, that is those with a zero inside, counted with the turn.
fn turning_cells(lengths: [f64; 3]) -> (usize, i32) {
    const CELLS: i32 = 90;
    const STEPS: i32 = 16;
    // The grid starts off the zeros.
    let angle = |n: f64| 0.0123 + TAU * n / f64::from(CELLS);
    let (mut cells, mut sum) = (0, 0);
    for i in 0..CELLS {
        for k in 0..CELLS {
            let (i, k) = (f64::from(i), f64::from(k));
            let mut border = Vec::new();
            for step in 0..STEPS {
                let t = f64::from(step) / f64::from(STEPS);
                border.push((t, [i + t, k]));
                border.push((1.0 + t, [i + 1.0, k + t]));
                border.push((2.0 + t, [i + 1.0 - t, k + 1.0]));
                border.push((3.0 + t, [i, k + 1.0 - t]));
            }
            border.sort_by(|l, r| l.0.total_cmp(&r.0));
            let values: Vec<[f64; 2]> =
                border.iter().map(|(_, [x, y])| conditions(lengths, angle(*x), angle(*y))).collect();
            let turned: f64 = values
                .iter()
                .zip(values.iter().cycle().skip(1))
                .map(|(a, b)| libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]))
                .sum();
            let turns = (turned / TAU).round() as i32;
            if turns != 0 {
                cells += 1;
                sum += turns;
            }
        }
    }
    (cells, sum)
}

fn same_as_newton(lengths: [f64; 3]) -> usize {
    let found: Vec<[f64; 2]> =
        isotropic_configurations(lengths).into_iter().flatten().map(|c| [c.arm.angle(), c.bucket.angle()]).collect();
    let searched = by_newton(lengths);
    assert_eq!(found.len(), searched.len(), "{lengths:?}: {found:?}, by Newton {searched:?}");
    for one in &searched {
        let near =
            |other: &&[f64; 2]| one.iter().zip(**other).all(|(a, b)| ((a - b + PI).rem_euclid(TAU) - PI).abs() < 1e-7);
        assert!(found.iter().find(near).is_some(), "{lengths:?}: {one:?} is not among {found:?}");
    }
    found.len()
}

#[test]
fn newton_from_2304_starts_and_turning_numbers_over_all_angles_count_the_same_eight() {
    assert_eq!(same_as_newton(HAREESHA), 8);
    // Each zero turns once, half of them backwards: on a torus the turns add up to nothing.
    assert_eq!(turning_cells(HAREESHA), (8, 0));
}

#[test]
fn newton_finds_the_same_configurations_of_random_chains_and_of_all_machines() {
    let mut random = Random::new(19);
    let mut counts = [0; 9];
    for _ in 0..30 {
        let lengths = [0.3 + random.unit(), 0.3 + random.unit(), 0.3 + random.unit()];
        counts[same_as_newton(lengths)] += 1;
    }
    assert!(counts[0] > 0 && counts[4] > 0 && counts[8] > 0, "the random chains show too little: {counts:?}");
    for (name, g) in machines::all().unwrap() {
        println!("{name}: {} isotropic configurations", same_as_newton([g.boom_m, g.arm_m, g.bucket_m]));
    }
}

#[test]
fn lengths_that_are_no_lengths_have_no_configurations() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for place in 0..3 {
            let mut lengths = HAREESHA;
            lengths[place] = bad;
            assert!(isotropic_configurations(lengths).iter().all(Option::is_none), "{lengths:?}");
        }
    }
}

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
