//! Park 2008's Figures 5 and 6, on the chosen arm and beside it.

use cross_tests::papers::park::figure;
use cross_tests::papers::{agree, all_agree};
use cross_tests::rig::workspace;
use hil_sim::planar_arm::PlanarArm;
use hil_sim::planar_arm::run::{CaseSummary, Summary, cases};
use kinematics_core::Rotor;
use kinematics_core::planning::obstacle::nearest;
use kinematics_core::planning::planner::Outcome;

/// Random numbers in 0…1, the same on every run.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
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
fn the_scenario_is_the_arm_of_the_references() {
    let (arm, figure) = (scenario(), figure());
    assert_eq!((arm.chain, arm.start_rad, arm.target), (figure.chain, figure.start_rad, figure.target));
    assert_eq!((arm.obstacle, arm.parameters, arm.iterations), (figure.obstacle, figure.parameters, figure.iterations));
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
        arm.start_rad = core::array::from_fn(|_| random.between(-2.0, 2.0));
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
