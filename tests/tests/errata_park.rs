//! Park et al. 2008: each equation of `docs/errata.md` as printed, which fails, and as corrected, on a planar arm of four links
//! (the paper does not give its own) in random poses.

use cross_tests::papers::plain::Matrix;
use cross_tests::papers::{agree, all_agree, rate};
use libm::{atan2, cos, hypot, sin};

/// What the corrected forms have to keep to.
const EXACT: f64 = 1e-9;
const LINKS: [f64; 4] = [1.0, 0.8, 0.6, 0.4];

/// Random poses, the same on every run.
fn poses() -> Vec<[f64; 4]> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 4.0 - 2.0
    };
    let all = (0..300).map(|_| core::array::from_fn(|_| next()));
    // Away from singular arms, where no pseudo-inverse is exact to nine digits.
    all.filter(|pose: &[f64; 4]| pose[1..].iter().all(|t| t.abs() > 0.3)).collect()
}

/// P_k, the end of link `k` (1…4); P_0 is the origin.
fn point(theta: [f64; 4], k: usize) -> [f64; 2] {
    let (mut angle, mut p) = (0.0, [0.0; 2]);
    for i in 0..k {
        angle += theta[i];
        p = [p[0] + LINKS[i] * cos(angle), p[1] + LINKS[i] * sin(angle)];
    }
    p
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn length(v: [f64; 2]) -> f64 {
    hypot(v[0], v[1])
}

/// (6): ∂P_k/∂θ, 2 × 4. A joint beyond the link does not move it.
fn jacobian(theta: [f64; 4], k: usize) -> Matrix {
    let end = point(theta, k);
    let column = |l: usize| {
        let arm = minus(end, point(theta, l));
        if l < k { [-arm[1], arm[0]] } else { [0.0; 2] }
    };
    Matrix((0..2).map(|row| (0..4).map(|l| column(l)[row]).collect()).collect())
}

/// I − J⁺J.
fn null_space(j: &Matrix) -> Matrix {
    Matrix::identity(4).plus(-1.0, &j.right_inverse().unwrap().times(j).unwrap()).unwrap()
}

#[test]
fn park_4_5_10_and_11_multiply_what_does_not_fit() {
    let (speed, away) = (Matrix::column(&[0.3, -0.1]), Matrix::column(&[0.05, 0.2]));
    for theta in poses() {
        // The obstacle at the end of link 2; J_k in (10) and (11) is the same with k for o.
        let (je, jo) = (jacobian(theta, 4), jacobian(theta, 2));
        let (je_inverse, jo_inverse) = (je.right_inverse().unwrap(), jo.right_inverse().unwrap());
        // J_o⁺J_e is 4 × 4 and ẋ_e has two entries.
        let printed = jo_inverse.times(&je).unwrap();
        assert_eq!((printed.shape(), speed.shape()), ((4, 4), (2, 1)));
        assert_eq!(printed.times(&speed), None);
        // J_o·J_e⁺·ẋ_e: what the smallest rates already do to the obstacle's point.
        let carried = jo.times(&je_inverse).unwrap().times(&speed).unwrap();
        let null = null_space(&je);
        let z = jo.times(&null).unwrap().right_inverse().unwrap().times(&away.plus(-1.0, &carried).unwrap()).unwrap();
        let rates = je_inverse.times(&speed).unwrap().plus(1.0, &null.times(&z).unwrap()).unwrap();
        let within = 1e-9 * (1.0 + rates.largest());
        all_agree("the tip", &je.times(&rates).unwrap().entries(), &speed.entries(), within);
        all_agree("the obstacle's point", &jo.times(&rates).unwrap().entries(), &away.entries(), within);
    }
}

#[test]
fn park_7_moves_a_link_by_joints_beyond_it() {
    for theta in poses() {
        for (k, l) in [(1, 1), (1, 3), (2, 2), (3, 3)] {
            let turned = |t: f64, k: usize| {
                let mut moved = theta;
                moved[l] += t;
                point(moved, k)
            };
            // P_e + P_k^e written in the joint angles is P_k: the column is zero, as the paper wants to avoid.
            let exact = rate(|t| turned(t, k), 0.0);
            all_agree("the end of link k stands still", &exact, &[0.0; 2], EXACT);
            let corrected = jacobian(theta, k);
            all_agree("(6) without (7)", &[corrected.0[0][l], corrected.0[1][l]], &exact, EXACT);
            // P_k^e held while P_e moves: a column that is not zero, and not the velocity of P_k.
            let held = minus(point(theta, k), point(theta, 4));
            let printed = rate(
                |t| {
                    let e = turned(t, 4);
                    [e[0] + held[0], e[1] + held[1]]
                },
                0.0,
            );
            assert!(length(minus(printed, exact)) > 0.1, "{theta:?} {k} {l}: {printed:?}");
        }
    }
}

/// Δθ'_ke, (14), for a displacement of the tip seen from P_k.
fn swept(seen: [f64; 2], step: [f64; 2]) -> f64 {
    let to = [seen[0] + step[0], seen[1] + step[1]];
    let cross = (seen[0] * to[1] - seen[1] * to[0]).abs();
    atan2(cross, seen[0] * to[0] + seen[1] * to[1])
}

#[test]
fn park_13_moves_the_end_of_a_link_along_the_link() {
    let turn = 1e-3;
    for theta in poses() {
        for k in 1..=3 {
            let link = minus(point(theta, k), point(theta, k - 1));
            let stretched = |step: [f64; 2]| length([link[0] + step[0], link[1] + step[1]]) / length(link) - 1.0;
            // Joint k − 1 at rest, D = −1, M = 1: the step of (13) along the link and turned by 90°.
            let printed = stretched([turn * link[0], turn * link[1]]);
            let corrected = stretched([-turn * link[1], turn * link[0]]);
            agree("a rigid link would grow", printed, turn, 1e-12);
            assert!(corrected > 0.0 && corrected < 0.51 * turn * turn, "{corrected}");
            // The velocity of P_k at a unit rate of joint k is the turned link.
            let j = jacobian(theta, k);
            all_agree("(6)", &[j.0[0][k - 1], j.0[1][k - 1]], &[-link[1], link[0]], EXACT);
        }
    }
}

#[test]
fn park_13_with_18_contradicts_16() {
    let mut far = 0;
    for theta in poses() {
        // Link 1, whose joint rests: ‖ẋ_k‖ should be ‖ẋ_e‖.
        let (seen, link) = (minus(point(theta, 4), point(theta, 1)), point(theta, 1));
        let m = length(seen) / length(link);
        let small = 1e-7;
        let step = [-seen[1] * small, seen[0] * small];
        let angle = swept(seen, step);
        let printed = angle / m * length(link) / length(step);
        let corrected = angle * m * length(link) / length(step);
        agree("‖ẋ_k‖/‖ẋ_e‖ with M", corrected, 1.0, 1e-8);
        agree("‖ẋ_k‖/‖ẋ_e‖ with 1/M", printed, 1.0 / (m * m), 1e-6);
        far += u32::from((printed - 1.0).abs() > 0.1);
    }
    println!("(13), (16), (18): off by more than 10 % in {far} of {} poses", poses().len());
    assert!(far as usize * 2 > poses().len());
}

/// How fast link `k` turns in the plane under the smallest rates that move the tip as told.
fn link_rate(theta: [f64; 4], speed: [f64; 2], k: usize) -> f64 {
    let rates = jacobian(theta, 4).right_inverse().unwrap().times(&Matrix::column(&speed)).unwrap().entries();
    rates[..k].iter().sum()
}

#[test]
fn park_13_takes_the_sense_of_the_turn_from_the_wrong_sign() {
    let (mut wrong, mut all) = (0, 0);
    for theta in poses() {
        let speed = [0.3, -0.1];
        // The same arm and command in a mirror: every link turns the other way round.
        let (mirrored, mirrored_speed) = (theta.map(|t| -t), [0.3, 0.1]);
        for k in 1..=3 {
            let outward = |theta: [f64; 4], v: [f64; 2]| {
                let seen = minus(point(theta, 4), point(theta, k));
                seen[0] * v[0] + seen[1] * v[1]
            };
            // −sgn[P_e^k·ẋ_e]: outward is clockwise.
            let printed = [-outward(theta, speed), -outward(mirrored, mirrored_speed)];
            agree("the printed sign is that of its mirror image", printed[0], printed[1], EXACT);
            let corrected = [link_rate(theta, speed, k), link_rate(mirrored, mirrored_speed, k)];
            agree("the turn is not", corrected[0], -corrected[1], 1e-9 * (1.0 + corrected[0].abs()));
            wrong += printed.iter().zip(corrected).filter(|(p, c)| *p * c < 0.0).count();
            all += 2;
        }
    }
    println!("(13) has the wrong sense in {wrong} of {all} cases");
    assert_eq!(2 * wrong, all, "one of each pair");
}

#[test]
fn park_17_is_a_limit_of_small_steps_and_not_of_small_angles() {
    for theta in poses() {
        let seen = minus(point(theta, 4), point(theta, 1));
        // Straight away from the joint: no angle at all, whatever the step.
        for outward in [0.1, 0.5, 2.0] {
            let step = [outward * seen[0], outward * seen[1]];
            agree("Δθ'", swept(seen, step), 0.0, EXACT);
            let ratio = length([seen[0] + step[0], seen[1] + step[1]]) / length(seen);
            agree("‖ẋ_e + P_e^k‖/‖P_e^k‖", ratio, 1.0 + outward, EXACT);
        }
        let step = [1e-10 * seen[1], 1e-10 * seen[0]];
        let ratio = length([seen[0] + step[0], seen[1] + step[1]]) / length(seen);
        agree("of small steps", ratio, 1.0, EXACT);
    }
}

#[test]
fn park_checked_3_moves_the_tip_as_commanded() {
    let speed = Matrix::column(&[0.3, -0.1]);
    for theta in poses() {
        let je = jacobian(theta, 4);
        let z = Matrix::column(&[1.0, -2.0, 0.5, 3.0]);
        let own = je.right_inverse().unwrap().times(&speed).unwrap();
        let rates = own.plus(1.0, &null_space(&je).times(&z).unwrap()).unwrap();
        all_agree("(2), (3)", &je.times(&rates).unwrap().entries(), &speed.entries(), EXACT);
        // (2), (6), (8) against differences.
        let along = rates.entries();
        let moved = |t: f64, k: usize| point(core::array::from_fn(|i| theta[i] + t * along[i]), k);
        for k in 1..=4 {
            let exact = rate(|t| moved(t, k), 0.0);
            all_agree("(8)", &jacobian(theta, k).times(&rates).unwrap().entries(), &exact, 1e-7);
        }
    }
}
