//! Park 2008 on the planar chain: the terms do what they say, and what cannot be reached is a value.

use cross_tests::papers::park::figure;
use cross_tests::papers::{agree, all_agree, rate};
use kinematics_core::chain_n::PlanarChain;
use kinematics_core::planning::obstacle::Obstacle;
use kinematics_core::planning::park::{Direction, link_jacobian, link_velocities, magnification, moved, null_term};
use kinematics_core::planning::planner::{Outcome, Planner, PlannerError, PlannerParameters};
use kinematics_core::redundancy::{null_projector, pseudo_inverse};
use kinematics_core::svd::SingularValues;
use kinematics_core::{Rotor, Vec2};

type Angles = [f64; 4];

/// Random numbers in 0…1, the same on every run.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn pose(&mut self) -> Angles {
        core::array::from_fn(|_| self.between(-2.0, 2.0))
    }
}

fn chain() -> PlanarChain<f64, 4> {
    PlanarChain::new([1.0, 0.8, 0.6, 0.4])
}

fn rotors(angles: Angles) -> [Rotor<f64>; 4] {
    angles.map(Rotor::from_angle)
}

/// Random poses whose tip moves well in every direction.
fn poses() -> Vec<Angles> {
    let mut random = Random(1);
    let all = (0..300).map(|_| random.pose());
    all.filter(|&pose| SingularValues::of(&chain().jacobian(&rotors(pose))).smallest > 0.2).collect()
}

/// Those of Figure 6.
fn parameters() -> PlannerParameters<f64, 4> {
    figure().parameters
}

#[test]
fn with_no_gain_but_the_end_effectors_a_step_is_the_minimum_norm_solution() {
    let only = PlannerParameters { obstacle: 0.0, links: [0.0; 4], ..parameters() };
    let planner = Planner::new(chain(), only).unwrap();
    for pose in poses() {
        let joints = rotors(pose);
        let (tip, jacobian) = chain().tip_and_jacobian(&joints);
        let way = Vec2::new(0.03, -0.02);
        let obstacle = Obstacle { position: tip + way, keep_m: 0.2, acts_m: 0.4 };
        let step = planner.step(&joints, tip + way, Some(&obstacle));
        let expected = pseudo_inverse(&jacobian).unwrap().map(|[x, z]| 0.3 * (x * way.x + z * way.z));
        all_agree("s_e·J_e⁺ẋ_e", &step.change, &expected, 1e-12);
        for (k, joint) in step.joints.iter().enumerate() {
            let turned = Rotor::from_angle(pose[k] + step.change[k]);
            all_agree("the pose after it", &[joint.cos, joint.sin], &[turned.cos, turned.sin], 1e-12);
        }
    }
}

#[test]
fn a_null_space_term_leaves_the_tip_at_rest_and_does_its_own_task() {
    let mut done = 0;
    for pose in poses() {
        let ends = chain().ends(&rotors(pose));
        let jacobian = chain().jacobian(&rotors(pose));
        let projector = null_projector(&jacobian).unwrap();
        let own = pseudo_inverse(&jacobian).unwrap().map(|[x, z]| 0.1 * x - 0.2 * z);
        for k in 0..4 {
            let task = link_jacobian(&ends, k, ends[k]);
            let wish = Vec2::new(0.05, 0.2);
            let term = null_term(&task, wish, &projector, &own, 1e-2);
            let tip = moved(&jacobian, &term);
            let size = term.iter().map(|t| t.abs()).fold(1.0, f64::max);
            all_agree("the tip", &[tip.x, tip.z], &[0.0; 2], 1e-11 * size);
            assert!(size < 1e3, "{pose:?} {k}: {term:?}");
            // Of rank two for the second link alone: the first turns about the base, the third about the tip.
            if k == 1 && SingularValues::of(&rows_through(&projector, &task)).smallest > 1e-2 {
                let both = core::array::from_fn(|i| own[i] + term[i]);
                let end = moved(&task, &both);
                all_agree("the link's end", &[end.x, end.z], &[wish.x, wish.z], 1e-9);
                done += 1;
            }
            if k == 3 {
                // The projector's rounding, over the square of 1e-2.
                all_agree("nothing left for the tip itself", &term, &[0.0; 4], 1e-8);
            }
        }
    }
    assert!(done > 100, "{done}");
}

/// J(I − J_e⁺J_e).
fn rows_through(projector: &[[f64; 4]; 4], jacobian: &[[f64; 4]; 2]) -> [[f64; 4]; 2] {
    jacobian.map(|row| core::array::from_fn(|i| (0..4).map(|j| row[j] * projector[j][i]).sum()))
}

#[test]
fn the_links_jacobian_is_the_derivative_of_its_end() {
    for pose in poses() {
        for k in 0..4 {
            let ends = chain().ends(&rotors(pose));
            let jacobian = link_jacobian(&ends, k, ends[k]);
            for l in 0..4 {
                let exact = rate(
                    |t| {
                        let mut turned = pose;
                        turned[l] += t;
                        let end = chain().ends(&rotors(turned))[k];
                        [end.x, end.z]
                    },
                    0.0,
                );
                all_agree("(6)", &[jacobian[0][l], jacobian[1][l]], &exact, 1e-8);
            }
        }
        let ends = chain().ends(&rotors(pose));
        assert_eq!(link_jacobian(&ends, 3, ends[3])[0].len(), 4);
    }
}

#[test]
fn the_magnification_is_the_way_to_the_tip_over_the_links_length_and_none_without_a_link() {
    let seen = Vec2::new(-1.5, 2.0);
    for length in [0.5, 1.0, 2.0, 5.0] {
        let link = Rotor::from_degrees(70.0).to_vec().scale(length);
        agree("(18)", magnification(seen, link), 2.5 / length, 1e-12);
    }
    assert_eq!(magnification(seen, Vec2::new(0.0, 0.0)), 0.0);
}

#[test]
fn the_first_links_end_moves_as_fast_as_the_tip_across_its_line_of_sight() {
    for pose in poses() {
        let ends = chain().ends(&rotors(pose));
        let seen = ends[3] - ends[0];
        let step = Vec2::new(-seen.z, seen.x).scale(1e-6);
        for sense in [1.0, -1.0] {
            let own = [sense, 0.0, 0.0, 0.0];
            let [add, ..] = link_velocities(&ends, step, &own, &[Direction::Add; 4]);
            agree("(16)", add.norm() / step.norm(), 1.0, 1e-9);
            agree("turns on", add.dot(Vec2::new(-ends[0].z, ends[0].x)).signum(), sense, 0.0);
            let [hold, ..] = link_velocities(&ends, step, &own, &[Direction::Hold; 4]);
            all_agree("turns back", &[hold.x, hold.z], &[-add.x, -add.z], 0.0);
        }
        let rest = link_velocities(&ends, step, &[0.0; 4], &[Direction::Add; 4]);
        assert_eq!(rest, [Vec2::new(0.0, 0.0); 4], "no turn has no sense");
    }
}

#[test]
fn single_precision_gives_the_same_two_figures() {
    let arm = figure();
    let single = |x: f64| x as f32;
    let place = |v: Vec2<f64>| Vec2::new(single(v.x), single(v.z));
    let p = arm.parameters;
    let obstacle = Obstacle {
        position: place(arm.obstacle.position),
        keep_m: single(arm.obstacle.keep_m),
        acts_m: single(arm.obstacle.acts_m),
    };
    let run = |links: [f32; 4]| {
        let parameters = PlannerParameters {
            end_effector: single(p.end_effector),
            obstacle: single(p.obstacle),
            links,
            directions: p.directions,
            trusted_m: single(p.trusted_m),
            turn_rad: single(p.turn_rad),
            tolerance_m: single(p.tolerance_m),
        };
        let planner = Planner::new(PlanarChain::new(arm.chain.lengths().map(single)), parameters).unwrap();
        let start = arm.start_rad.map(|angle| Rotor::from_angle(single(angle)));
        planner.run(&start, place(arm.target), Some(&obstacle), arm.iterations, |_, _| ())
    };
    assert!(matches!(run([0.0; 4]), Outcome::NotReached { distance_m } if distance_m > 1.0));
    assert_eq!(run(p.links.map(single)), Outcome::Reached { iterations: 25 });
}

#[test]
fn what_cannot_be_reached_is_a_value_and_the_arm_stays_finite() {
    let planner = Planner::new(chain(), parameters()).unwrap();
    let start = rotors([0.3, 0.4, -0.5, 0.6]);
    let run = |target, obstacle: Option<&Obstacle<f64>>| {
        planner.run(&start, target, obstacle, 100, |_, step| {
            assert!(step.change.iter().all(|c| c.is_finite() && c.abs() < 0.5), "{step:?}");
            assert!(step.joints.iter().all(|j| (j.to_vec().norm() - 1.0).abs() < 1e-12), "{step:?}");
        })
    };
    let Outcome::NotReached { distance_m } = run(Vec2::new(4.0, 0.0), None) else { panic!("beyond reach") };
    // Damped, the last of the way to the stretched pose is slow.
    agree("stretched towards it", distance_m, 1.2, 3e-2);
    assert!(matches!(run(Vec2::new(f64::NAN, 0.0), None), Outcome::NotReached { .. }));
    assert!(matches!(run(Vec2::new(f64::INFINITY, 0.0), None), Outcome::NotReached { .. }));
    let on_the_target = Obstacle { position: Vec2::new(1.0, 1.0), keep_m: 0.2, acts_m: 0.4 };
    let Outcome::NotReached { distance_m } = run(on_the_target.position, Some(&on_the_target)) else { panic!("kept") };
    assert!(distance_m >= 0.2);
    let nowhere = Obstacle { position: Vec2::new(f64::NAN, 0.0), keep_m: 0.2, acts_m: 0.4 };
    run(Vec2::new(1.0, 1.0), Some(&nowhere));
    let tip = chain().tip(&start);
    assert_eq!(run(tip, None), Outcome::Reached { iterations: 0 });
}

#[test]
fn every_parameter_out_of_its_range_is_named() {
    let good = parameters();
    let cases = [
        (PlannerParameters { end_effector: 0.0, ..good }, PlannerError::EndEffector, "end_effector"),
        (PlannerParameters { obstacle: -0.1, ..good }, PlannerError::Obstacle, "obstacle"),
        (PlannerParameters { links: [0.0, f64::NAN, 0.0, 0.0], ..good }, PlannerError::Links, "links"),
        (PlannerParameters { trusted_m: 0.0, ..good }, PlannerError::Trusted, "trusted_m"),
        (PlannerParameters { turn_rad: 2.0, ..good }, PlannerError::Turn, "turn_rad"),
        (PlannerParameters { tolerance_m: f64::INFINITY, ..good }, PlannerError::Tolerance, "tolerance_m"),
    ];
    for (parameters, error, field) in cases {
        assert_eq!(Planner::new(chain(), parameters).err(), Some(error));
        assert!(error.to_string().contains(&format!("`{field}`")), "{error}");
    }
}
