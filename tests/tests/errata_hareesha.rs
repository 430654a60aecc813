//! Hareesha and Umesh 2015: each equation of `docs/errata.md` as printed, which fails, and as corrected, which holds.

use core::f64::consts::{PI, SQRT_2, TAU};

use cross_tests::machines::ZX200;
use cross_tests::papers::plain::Matrix;
use cross_tests::papers::{agree, all_agree, deg, rad, rate, steps, turn_between};
use kinematics_core::matrix::denavit_hartenberg;
use kinematics_core::{Joints, Machine, Rotor};
use libm::{cos, hypot, sin, sqrt};

/// What the corrected forms have to keep to.
const EXACT: f64 = 1e-9;
/// l2, l3, l4 of the paper's isotropic excavator.
const ISOTROPIC: [f64; 3] = [SQRT_2, SQRT_2, 1.0];

/// (12), the planar Jacobian at θ2, θ3, θ4.
fn jacobian(l: [f64; 3], theta: [f64; 3]) -> [[f64; 3]; 2] {
    let [t2, t3, t4] = theta;
    let (x4, y4) = (l[2] * cos(t2 + t3 + t4), l[2] * sin(t2 + t3 + t4));
    let (x3, y3) = (x4 + l[1] * cos(t2 + t3), y4 + l[1] * sin(t2 + t3));
    let (x2, y2) = (x3 + l[0] * cos(t2), y3 + l[0] * sin(t2));
    [[-y2, -y3, -y4], [x2, x3, x4]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// (17) and the corrected (19).
fn conditions(j: [[f64; 3]; 2]) -> [f64; 2] {
    [dot(j[0], j[1]), dot(j[0], j[0]) - dot(j[1], j[1])]
}

/// (18) and (20) as printed, for whatever s3, c3, s4, c4 stand for.
fn expanded(l: [f64; 3], [s3, c3, s4, c4]: [f64; 4]) -> [f64; 2] {
    let [l2, l3, l4] = l;
    [
        -l2 * l3 * s3
            - l2 * l4 * s4
            - 2.0 * l3 * l3 * c3 * s3
            - 3.0 * l4 * l4 * c4 * s4
            - 2.0 * l3 * l4 * c3 * s4
            - 2.0 * l3 * l4 * c4 * s3,
        2.0 * l3 * l3 * s3 * s3 - 3.0 * l4 * l4 * c4 * c4 - 2.0 * l3 * l3 * c3 * c3 + 3.0 * l4 * l4 * s4 * s4
            - l2 * l2
            - 2.0 * l2 * l3 * c3
            - 2.0 * l2 * l4 * c4
            - 4.0 * l3 * l4 * c3 * c4
            + 4.0 * l3 * l4 * s3 * s4,
    ]
}

/// All (θ3, θ4) that satisfy both conditions, found by Newton's method from a grid.
fn isotropic(l: [f64; 3]) -> Vec<[f64; 2]> {
    let at = |t3: f64, t4: f64| conditions(jacobian(l, [0.0, t3, t4]));
    let mut found: Vec<[f64; 2]> = Vec::new();
    for start3 in steps(-PI, PI, 48) {
        for start4 in steps(-PI, PI, 48) {
            let [mut t3, mut t4] = [start3, start4];
            for _ in 0..60 {
                let f = at(t3, t4);
                let (d3, d4) = (rate(|t| at(t, t4), t3), rate(|t| at(t3, t), t4));
                let det = d3[0] * d4[1] - d3[1] * d4[0];
                t3 -= (f[0] * d4[1] - f[1] * d4[0]) / det;
                t4 -= (d3[0] * f[1] - d3[1] * f[0]) / det;
            }
            let f = at(t3, t4);
            let new = |old: &[f64; 2]| turn_between(old[0], t3) + turn_between(old[1], t4) > 1e-6;
            if hypot(f[0], f[1]) < 1e-12 && found.iter().all(new) {
                found.push([t3, t4].map(|t| t - TAU * libm::round(t / TAU)));
            }
        }
    }
    found
}

#[test]
fn hareesha_1_has_a_second_row_that_is_no_rotation() {
    let mut failed = 0;
    for (theta, twist) in [(30.0, 90.0), (30.0, 0.0), (-110.0, 0.0), (75.0, 90.0)] {
        let (c, s) = (cos(rad(theta)), sin(rad(theta)));
        let (ca, sa) = (cos(rad(twist)), sin(rad(twist)));
        let ours = denavit_hartenberg(Rotor::from_degrees(theta), Rotor::from_degrees(twist), 2.0, 0.0);
        let printed = [s, ca * s, sa * s, 2.0 * s];
        let corrected = [s, ca * c, -sa * c, 2.0 * s];
        all_agree("row 2", &corrected, &ours[1], EXACT);
        agree("a row of a rotation", dot([corrected[0], corrected[1], corrected[2]], [s, ca * c, -sa * c]), 1.0, EXACT);
        let off = printed.iter().zip(ours[1]).map(|(a, b)| (a - b).abs()).sum::<f64>();
        let length = sqrt(dot([printed[0], printed[1], printed[2]], [printed[0], printed[1], printed[2]]));
        println!("(1) at θ {theta}°, α {twist}°: row 2 {printed:.4?}, not {:.4?}; length {length:.4}", ours[1]);
        assert!(off > 0.1 && (length - 1.0).abs() > 0.1);
        failed += 1;
    }
    assert_eq!(failed, 4);
}

#[test]
fn hareesha_9_wants_the_rates_and_not_the_sum_of_the_angles() {
    let machine = Machine::<f64>::new(&ZX200).unwrap();
    let [_, l2, l3, l4] = machine.chain().lengths();
    let (theta, rates) = ([20.0, -80.0, -60.0].map(rad), [0.3, -0.2, 0.5]);
    let tip = |t: f64| {
        let [boom, arm, bucket] = core::array::from_fn(|i| Rotor::from_angle(theta[i] + rates[i] * t));
        let tip = machine.chain().tip(&Joints { boom, arm, bucket });
        [tip.reach, tip.height]
    };
    let j = jacobian([l2, l3, l4], theta);
    let exact = rate(tip, 0.0);
    all_agree("(9) with rates", &[dot(j[0], rates), dot(j[1], rates)], &exact, EXACT);
    // The sum of the angles is one number and no vector: the 2 × 3 Jacobian has no product with it.
    let matrix = Matrix(j.iter().map(|row| row.to_vec()).collect());
    assert_eq!(matrix.times(&Matrix::column(&[theta.iter().sum()])), None);
    // Nor are the angles themselves the rates.
    let printed = [dot(j[0], theta), dot(j[1], theta)];
    println!("(9) with angles {printed:.3?} m/s, not {exact:.3?}");
    assert!((printed[0] - exact[0]).abs() > 1.0 || (printed[1] - exact[1]).abs() > 1.0);
}

#[test]
fn hareesha_16_is_isotropy_only_up_to_a_factor() {
    let all = isotropic(ISOTROPIC);
    let mut factors = Vec::new();
    for [t3, t4] in &all {
        for t2 in [0.0, 1.0, -2.0] {
            let j = jacobian(ISOTROPIC, [t2, *t3, *t4]);
            let factor = dot(j[0], j[0]);
            agree("rows equally long", dot(j[1], j[1]), factor, EXACT);
            agree("rows at right angles", dot(j[0], j[1]), 0.0, EXACT);
            // As printed: JJᵀ = I, and JᵀJ = I, which has rank two of three.
            assert!((factor - 1.0).abs() > 0.04, "{factor}");
            let column = |k: usize| j[0][k] * j[0][k] + j[1][k] * j[1][k];
            let trace: f64 = (0..3).map(column).sum();
            agree("trace of JᵀJ", trace, 2.0 * factor, EXACT);
            factors.push(factor);
        }
        println!("θ3 {:.3}°, θ4 {:.3}°: σ² {:.4}", deg(*t3), deg(*t4), factors[factors.len() - 1]);
    }
    factors.sort_by(f64::total_cmp);
    println!("{} configurations, σ² {:.4}…{:.4}", all.len(), factors[0], factors[factors.len() - 1]);
    agree("smallest", factors[0], 1.0488, 5e-5);
    agree("largest", factors[factors.len() - 1], 1.8536, 5e-5);
    assert_eq!(all.len(), 8);
}

#[test]
fn hareesha_18_and_20_hold_for_absolute_angles_alone() {
    for t3 in steps(-3.0, 3.0, 20) {
        for t4 in steps(-3.0, 3.0, 20) {
            let exact = conditions(jacobian(ISOTROPIC, [0.0, t3, t4]));
            let absolute = expanded(ISOTROPIC, [sin(t3), cos(t3), sin(t3 + t4), cos(t3 + t4)]);
            all_agree("(18), (20) with angles from link 2", &absolute, &exact, EXACT);
        }
    }
    // S4 = sin θ4 is how (2) defines it.
    for [t3, t4] in isotropic(ISOTROPIC) {
        let relative = expanded(ISOTROPIC, [sin(t3), cos(t3), sin(t4), cos(t4)]);
        println!("(18), (20) with the angles of (2) at θ3 {:.2}°, θ4 {:.2}°: {relative:.3?}, not 0", deg(t3), deg(t4));
        assert!(hypot(relative[0], relative[1]) > 0.1);
    }
}

#[test]
fn hareesha_19_names_an_element_that_does_not_exist() {
    // J has two rows. Left out, J33 leaves the condition unmet where the arm is isotropic.
    for [t3, t4] in isotropic(ISOTROPIC) {
        let j = jacobian(ISOTROPIC, [0.0, t3, t4]);
        let corrected = dot(j[0], j[0]) - dot(j[1], j[1]);
        let without = dot(j[0], j[0]) - j[1][0] * j[1][0] - j[1][1] * j[1][1];
        agree("(19) with J23", corrected, 0.0, EXACT);
        println!("(19) without J23 at θ3 {:.2}°, θ4 {:.2}°: {without:.4}", deg(t3), deg(t4));
        assert!(without > 1e-3);
    }
    let matrix = Matrix(jacobian(ISOTROPIC, [0.0; 3]).iter().map(|row| row.to_vec()).collect());
    assert_eq!(matrix.shape(), (2, 3));
    assert!(matrix.0.get(2).is_none(), "there is no third row");
}

#[test]
fn hareesha_equal_singular_values_do_not_make_equal_eigenvalues() {
    // The isotropic two-link arm: l1 = √2, l2 = 1, the second joint at 135°.
    let (s, c) = (sin(rad(135.0)), cos(rad(135.0)));
    let j = [[-s, -s], [SQRT_2 + c, c]];
    let gram = |a: usize, b: usize| j[a][0] * j[b][0] + j[a][1] * j[b][1];
    agree("σ1²", gram(0, 0), 1.0, EXACT);
    agree("σ2²", gram(1, 1), 1.0, EXACT);
    agree("at right angles", gram(0, 1), 0.0, EXACT);
    let (trace, determinant) = (j[0][0] + j[1][1], j[0][0] * j[1][1] - j[0][1] * j[1][0]);
    let discriminant = trace * trace / 4.0 - determinant;
    println!("eigenvalues {:.4} ± {:.4}i", trace / 2.0, sqrt(-discriminant));
    assert!(discriminant < -0.4, "two different, conjugate eigenvalues");
}

#[test]
fn hareesha_checked_equations_are_right() {
    let machine = Machine::<f64>::new(&ZX200).unwrap();
    let l = machine.chain().lengths();
    for part in steps(0.0, 1.0, 20) {
        let theta = [-40.0 + 100.0 * part, -150.0 + 110.0 * part, -130.0 + 160.0 * part].map(rad);
        let tip = |t: [f64; 3]| {
            let [boom, arm, bucket] = t.map(Rotor::from_angle);
            machine.chain().tip(&Joints { boom, arm, bucket })
        };
        let [t2, t3, t4] = theta;
        // (5), (6), (8), (11)
        let x = l[1] * cos(t2) + l[2] * cos(t2 + t3) + l[3] * cos(t2 + t3 + t4);
        let y = l[1] * sin(t2) + l[2] * sin(t2 + t3) + l[3] * sin(t2 + t3 + t4);
        agree("X", x + l[0], tip(theta).reach, EXACT);
        agree("Y", y, tip(theta).height, EXACT);
        // (10), (12)
        let j = jacobian([l[1], l[2], l[3]], theta);
        for k in 0..3 {
            let column = rate(
                |t| {
                    let mut moved = theta;
                    moved[k] += t;
                    [tip(moved).reach, tip(moved).height]
                },
                0.0,
            );
            all_agree("(12)", &[j[0][k], j[1][k]], &column, EXACT);
        }
        // (14), (15): J⁺ is a right inverse, the null space does not move the tip.
        let matrix = Matrix(j.iter().map(|row| row.to_vec()).collect());
        let inverse = matrix.right_inverse().unwrap();
        let unit = matrix.times(&inverse).unwrap().plus(-1.0, &Matrix::identity(2)).unwrap();
        assert!(unit.largest() < EXACT);
        let null = Matrix::identity(3).plus(-1.0, &inverse.times(&matrix).unwrap()).unwrap();
        let (v, b) = (Matrix::column(&[0.3, -0.2]), Matrix::column(&[1.0, -2.0, 0.5]));
        let rates = inverse.times(&v).unwrap().plus(1.0, &null.times(&b).unwrap()).unwrap();
        all_agree("(15)", &matrix.times(&rates).unwrap().entries(), &v.entries(), EXACT);
        // (21): the torques do the work of the force.
        let force = [120.0, -340.0];
        let torques: [f64; 3] = core::array::from_fn(|k| j[0][k] * force[0] + j[1][k] * force[1]);
        let velocity = matrix.times(&rates).unwrap().entries();
        let work: f64 = torques.iter().zip(rates.entries()).map(|(t, w)| t * w).sum();
        agree("(21)", work, force[0] * velocity[0] + force[1] * velocity[1], 1e-9);
    }
}
