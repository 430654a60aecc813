//! Park 2008 on the planar chain: the terms do what they say, and Figures 5 and 6 appear, on the chosen arm and beside it.

use cross_tests::papers::{agree, all_agree, rate};
use cross_tests::rig::workspace;
use hil_sim::planar_arm::PlanarArm;
use hil_sim::planar_arm::run::{CaseSummary, Summary, cases};
use kinematics_core::chain_n::PlanarChain;
use kinematics_core::planning::obstacle::{Obstacle, nearest};
use kinematics_core::planning::park::{Direction, link_jacobian, link_velocities, moved, null_term};
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

fn parameters() -> PlannerParameters<f64, 4> {
    PlannerParameters {
        end_effector: 0.3,
        obstacle: 0.2,
        links: [0.01, 0.01, 0.0, 0.0],
        directions: [Direction::Hold; 4],
        trusted_m: 0.1,
        turn_rad: 0.2,
        tolerance_m: 0.01,
    }
}

fn scenario() -> PlanarArm {
    let text = std::fs::read_to_string(workspace().join("scenarios/obstacle-park.toml")).unwrap();
    PlanarArm::from_toml(&text).unwrap()
}

/// The paper's runs: obstacle ignored, Figure 5, Figure 6.
fn three_runs(arm: &PlanarArm) -> [CaseSummary; 3] {
    Summary::of(arm, &cases(arm).unwrap()).cases.try_into().unwrap()
}

/// Whether they go as published: through the obstacle; held up by it; round it.
fn as_published(arm: &PlanarArm) -> Option<u32> {
    let [ignored, without, with] = three_runs(arm);
    let free = |case: &CaseSummary| case.smallest_obstacle_distance_m >= arm.obstacle.keep_m;
    let first = ignored.reached && ignored.smallest_obstacle_distance_m < 0.5 * arm.obstacle.keep_m;
    let second = !without.reached && without.final_distance_m > 0.1 && free(&without);
    with.settled_at_iteration.filter(|_| first && second && free(&with))
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
fn figures_5_and_6_appear_without_the_scheme_held_up_with_it_round_the_obstacle() {
    let arm = scenario();
    assert_eq!((arm.parameters.obstacle, arm.parameters.links), (0.2, [0.01, 0.01, 0.0, 0.0]), "the paper's gains");
    let [ignored, without, with] = three_runs(&arm);
    println!("{ignored:#?}\n{without:#?}\n{with:#?}");
    assert!(ignored.reached && ignored.smallest_obstacle_distance_m < 0.1 * arm.obstacle.keep_m);
    assert!(!without.reached && without.final_distance_m > 1.0);
    assert!(without.smallest_obstacle_distance_m >= arm.obstacle.keep_m);
    assert!(with.reached && with.smallest_obstacle_distance_m >= arm.obstacle.keep_m);
    assert_eq!(with.settled_at_iteration, Some(25));
}

#[test]
fn more_iterations_do_not_help_and_what_holds_the_arm_up_is_an_equilibrium() {
    let mut arm = scenario();
    arm.iterations = 2000;
    let [_, without, with] = cases(&arm).unwrap();
    let Outcome::NotReached { distance_m } = without.outcome else { panic!("{:?}", without.outcome) };
    assert!(distance_m > 1.0);
    // It comes to rest on the circle, with the tip nearest to the obstacle.
    let (last, before) = (without.poses[2000], without.poses[1900]);
    all_agree("at rest", &last.joints_rad, &before.joints_rad, 1e-9);
    agree("the tip on the circle", (last.ends[3] - arm.obstacle.position).norm(), last.obstacle_m, 1e-9);
    // No step was refused: every one of the first hundred moves the arm.
    assert!(without.poses[..60].windows(2).all(|pair| pair[0].joints_rad != pair[1].joints_rad));
    assert_eq!(with.outcome, Outcome::Reached { iterations: 25 });
}

#[test]
fn single_precision_gives_the_same_two_figures() {
    let arm = scenario();
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
fn neighbouring_obstacles_targets_and_gains_behave_alike() {
    let arm = scenario();
    let mut all: Vec<(String, PlanarArm)> = Vec::new();
    for eighth in 0..8 {
        for by in [0.02, 0.05] {
            let moved = Rotor::from_turns(f64::from(eighth) / 8.0).to_vec().scale(by);
            let mut other = arm.clone();
            other.obstacle.position = other.obstacle.position + moved;
            all.push((format!("obstacle moved by {moved:?}"), other));
            let mut other = arm.clone();
            other.target = other.target + moved;
            all.push((format!("target moved by {moved:?}"), other));
        }
    }
    for factor in [0.7, 0.85, 1.2, 1.4] {
        let mut add = |what: &str, change: &dyn Fn(&mut PlanarArm)| {
            let mut other = arm.clone();
            change(&mut other);
            all.push((format!("{what} times {factor}"), other));
        };
        add("s_o", &|arm| arm.parameters.obstacle *= factor);
        add("s_1 and s_2", &|arm| arm.parameters.links = arm.parameters.links.map(|s| s * factor));
        add("s_e", &|arm| arm.parameters.end_effector *= if factor < 1.0 { 0.9 } else { 1.1 });
        add("the reach of ẋ_o", &|arm| arm.obstacle.acts_m = arm.obstacle.keep_m * (1.0 + factor));
    }
    let (mut settled, mut other) = (Vec::new(), Vec::new());
    for (what, arm) in &all {
        match as_published(arm) {
            Some(iterations) => settled.push(iterations),
            None => other.push(what),
        }
    }
    settled.sort_unstable();
    println!("{} of {} as published, settled at iterations {settled:?}; not: {other:?}", settled.len(), all.len());
    assert!(settled.len() >= 47 && all.len() == 48, "{other:?}");
    assert!(settled[0] >= 20 && settled[settled.len() - 1] <= 37, "{settled:?}");
    assert!((24..=25).contains(&settled[settled.len() / 2]));
}

#[test]
fn on_random_arms_the_scheme_seldom_decides_and_hinders_as_well_as_helps() {
    let mut random = Random(7);
    let mut counts = [[0_u32; 2]; 2];
    while counts.iter().flatten().sum::<u32>() < 400 {
        let mut arm = scenario();
        arm.start_rad = random.pose();
        let tip = arm.chain.tip(&arm.start());
        arm.target = Rotor::from_angle(random.between(-3.0, 3.0)).to_vec().scale(random.between(1.0, 3.5));
        let (way, part) = (arm.target - tip, random.between(0.3, 0.8));
        arm.obstacle.position = tip + way.scale(part);
        let near = nearest(&arm.chain.ends(&arm.start()), arm.obstacle.position).distance_m;
        if near < arm.obstacle.acts_m || way.norm() * (1.0 - part) < arm.obstacle.acts_m {
            continue;
        }
        let [ignored, without, with] = three_runs(&arm);
        if ignored.reached {
            counts[usize::from(without.reached)][usize::from(with.reached)] += 1;
            for case in [without, with] {
                assert!(case.smallest_obstacle_distance_m >= arm.obstacle.keep_m, "{arm:?}");
            }
        }
    }
    let [[neither, only_with], [only_without, both]] = counts;
    println!(
        "reached: both {both}, with the scheme alone {only_with}, without it alone {only_without}, neither {neither}"
    );
    assert!(both > 200 && only_with > 0 && only_without > 0 && neither > 40, "{counts:?}");
    assert!(only_with + only_without < 40, "{counts:?}");
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
