//! Park et al. 2008: each equation of `docs/errata.md` as printed, which fails, and as corrected, on a planar arm of four links
//! (the paper does not give its own) in random poses.

use cross_tests::papers::park::{Figure, figure};
use cross_tests::papers::plain::Matrix;
use cross_tests::papers::{agree, all_agree, rate};
use kinematics_core::chain_n::PlanarChain;
use kinematics_core::planning::obstacle::{Obstacle, nearest};
use kinematics_core::planning::park::{Direction, link_jacobian, link_velocities, null_term, swept_angle};
use kinematics_core::planning::planner::{Outcome, Planner, PlannerParameters};
use kinematics_core::redundancy::{null_projector, pseudo_inverse};
use kinematics_core::svd::{SingularValues, trusted_inverse};
use kinematics_core::{Rotor, Vec2};
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

fn vector(v: [f64; 2]) -> Vec2<f64> {
    Vec2::new(v[0], v[1])
}

/// The corrected terms of (12), from the library: J_e⁺ẋ_e, H_o for a point of link 3, H_1.
fn terms(theta: [f64; 4], speed: [f64; 2]) -> [[f64; 4]; 3] {
    let chain = PlanarChain::new(LINKS);
    let joints = theta.map(Rotor::from_angle);
    let (jacobian, ends) = (chain.jacobian(&joints), chain.ends(&joints));
    let projector = null_projector(&jacobian).unwrap();
    let own = pseudo_inverse(&jacobian).unwrap().map(|[x, z]| x * speed[0] + z * speed[1]);
    let middle = (ends[1] + ends[2]).scale(0.5);
    let obstacle = null_term(&link_jacobian(&ends, 2, middle), Vec2::new(0.3, 0.2), &projector, &own, 1e-3);
    let velocities = link_velocities(&ends, vector(speed), &own, &[Direction::Hold; 4]);
    let link = null_term(&link_jacobian(&ends, 0, ends[0]), velocities[0], &projector, &own, 1e-3);
    [own, obstacle, link]
}

#[test]
fn park_12_alone_takes_the_tip_through_the_obstacle() {
    // Every term but the first leaves the tip where it is: no s_o and no s_k can turn it aside.
    let speed = [0.03, -0.01];
    for theta in poses() {
        let [own, obstacle, link] = terms(theta, speed);
        for gain in [0.2, 1.0, 5.0] {
            let rates = Matrix::column(&core::array::from_fn::<f64, 4, _>(|i| own[i] + gain * (obstacle[i] + link[i])));
            let within = 1e-9 * (1.0 + rates.largest());
            all_agree("the tip", &jacobian(theta, 4).times(&rates).unwrap().entries(), &speed, within);
        }
    }
    // The same in Figure 5's own scenario: straight through as printed, kept away with the obstacle first.
    let arm = figure();
    let planner = Planner::new(arm.chain, PlannerParameters { links: [0.0; 4], ..arm.parameters }).unwrap();
    let ring = Obstacle { keep_m: 1e-6, ..arm.obstacle };
    let nearest_of = |obstacle: &Obstacle<f64>| {
        let mut nearest = f64::INFINITY;
        planner.run(&arm.start(), arm.target, Some(obstacle), arm.iterations, |_, step| {
            let tip = arm.chain.tip(&step.joints) - arm.obstacle.position;
            nearest = if tip.norm() < nearest { tip.norm() } else { nearest };
        });
        nearest
    };
    // With nothing kept free there is (12) alone, s_o = 0.2 at work.
    let (printed, corrected) = (nearest_of(&ring), nearest_of(&arm.obstacle));
    println!("(12): the tip comes within {printed:.3} m of the obstacle, with the obstacle first {corrected:.3} m");
    assert!(printed < 0.5 * arm.obstacle.keep_m && corrected >= arm.obstacle.keep_m);
}

#[test]
fn park_11_inverts_what_has_no_inverse_for_the_first_and_the_last_link() {
    for theta in poses() {
        let null = null_space(&jacobian(theta, 4));
        for (k, rank) in [(1, 1), (2, 2), (4, 0)] {
            let product = jacobian(theta, k).times(&null).unwrap();
            let rows: [[f64; 4]; 2] = core::array::from_fn(|r| core::array::from_fn(|c| product.0[r][c]));
            let values = SingularValues::of(&rows);
            // As printed, J⁺ = Jᵀ(JJᵀ)⁻¹: what it inverts is zero up to rounding.
            let full = values.smallest > 1e-3;
            assert!(!full || rank == 2, "{theta:?} {k}: {values:?}");
            // Corrected: A·A⁺·A = A whatever the rank.
            let inverse = trusted_inverse(&rows, 1e-3);
            let inverse = Matrix(inverse.iter().map(|row| row.to_vec()).collect());
            let back = product.times(&inverse).unwrap().times(&product).unwrap();
            if full || rank == 0 || (rank == 1 && values.largest > 1e-3) {
                all_agree("A·A⁺·A", &back.entries(), &product.entries(), 1e-7);
            }
        }
    }
}

#[test]
fn park_14_divides_zero_by_zero_for_the_last_link() {
    // P_e^n is the tip seen from itself.
    let (seen, step) = ([0.0_f64, 0.0], [0.3, -0.1]);
    let printed = (seen[0] * step[0] + seen[1] * step[1]) / (length(seen) * length(step));
    assert!(printed.is_nan());
    assert_eq!(swept_angle(vector(seen), vector(step)), 0.0);
    for theta in poses() {
        let ends = PlanarChain::new(LINKS).ends(&theta.map(Rotor::from_angle));
        let velocities = link_velocities(&ends, vector(step), &[0.1; 4], &[Direction::Add; 4]);
        assert!(velocities.iter().all(|v| v.norm().is_finite()));
        assert_eq!(velocities[3], velocities[2], "the last link adds no turn of its own");
    }
}

#[test]
fn park_15_turns_a_link_back_where_it_says_hold() {
    let speed = [0.03, -0.01];
    for theta in poses() {
        let [own, _, link] = terms(theta, speed);
        // s_e = s_1 = 1, D = −1: link 1 is not held, it turns against J_e⁺ẋ_e (where the tip's motion turns it at all).
        let printed = own[0] + link[0];
        let seen = minus(point(theta, 4), point(theta, 1));
        let expected = -own[0].signum() * length(seen) / LINKS[0] * swept(seen, speed);
        agree("θ̇_1 with D = −1", printed, expected, 1e-6);
        // Held it would be with ẋ_k = 0, D = 0.
        let joints = theta.map(Rotor::from_angle);
        let chain = PlanarChain::new(LINKS);
        let (jacobian, ends) = (chain.jacobian(&joints), chain.ends(&joints));
        let at_rest = null_term(
            &link_jacobian(&ends, 0, ends[0]),
            Vec2::new(0.0, 0.0),
            &null_projector(&jacobian).unwrap(),
            &own,
            1e-3,
        );
        agree("θ̇_1 with ẋ_1 = 0", own[0] + at_rest[0], 0.0, 1e-6);
    }
}

#[test]
fn park_10_leaves_open_when_the_obstacle_acts_and_how_fast() {
    let away = |distance: f64| {
        let obstacle = Obstacle { position: Vec2::new(0.5, distance), keep_m: 0.2, acts_m: 0.4 };
        let critical = nearest(&[Vec2::new(1.0, 0.0), Vec2::new(1.0, -1.0)], obstacle.position);
        assert_eq!((critical.link, critical.point), (0, Vec2::new(0.5, 0.0)), "the arm's point nearest to it");
        obstacle.escape(&critical)
    };
    // Chosen: straight away from it, by what is missing to the distance from which on it acts.
    for (distance, expected) in [(0.5, 0.0), (0.4, 0.0), (0.3, -0.1), (0.1, -0.3)] {
        let escape = away(distance);
        all_agree("ẋ_o", &[escape.x, escape.z], &[0.0, expected], 1e-15);
    }
}

#[test]
fn park_figures_5_and_6_lack_arm_obstacle_target_and_s_e() {
    // On the chosen arm the published gains give both figures; with another s_e, which the paper does not say, other iterations.
    let mut arm = figure();
    let settled = |arm: &Figure| {
        let without = arm.run([0.0; 4]);
        assert!(matches!(without, Outcome::NotReached { .. }), "{without:?}");
        arm.run(arm.parameters.links)
    };
    assert_eq!(settled(&arm), Outcome::Reached { iterations: 25 });
    arm.parameters.end_effector = 0.2;
    let slower = settled(&arm);
    println!("s_e = 0.2: {slower:?}");
    assert!(matches!(slower, Outcome::Reached { iterations } if iterations > 28), "{slower:?}");
}
