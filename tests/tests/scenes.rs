//! Obstacle avoidance in random scenes: nearly all that can be reached is, and nothing is ever touched.

use cross_tests::rig::scenario;
use hil_sim::machine_file::MachineFile;
use hil_sim::place::Host;
use hil_sim::run::{Outcome as Ending, Run, Summary};
use hil_sim::scenes::{Ended, Kit, Outcome, Tally};

const SCENES: u64 = 150;

fn play(machine: &str) -> Tally {
    let file = MachineFile::load(machine).unwrap_or_else(|error| panic!("{error}"));
    let kit = Kit::new(&file.geometry).unwrap_or_else(|error| panic!("{error}"));
    let outcomes: Vec<Outcome> = (0..SCENES).map(|number| kit.play(&kit.scene(1, number), |_| {})).collect();
    Tally::of(machine, &outcomes)
}

#[test]
fn on_every_machine_nearly_every_target_is_reached_and_nothing_is_touched() {
    for machine in ["frankel", "exact-mini", "zx120", "zx200"] {
        let tally = play(machine);
        println!("{}", tally.to_table());
        assert_eq!(tally.collisions, 0, "{tally:?}");
        assert!(tally.rate >= 0.99, "{tally:?}");
        assert_eq!(tally.blocked_wrongly, 0, "{tally:?}");
        assert!(tally.smallest_clearance_m > 0.0, "{tally:?}");
        // The scenes are worth the name: straight and blind half of them collide, and without routes many get stuck.
        assert!(tally.blind_collisions * 3 > SCENES as usize, "{tally:?}");
        assert!(tally.step_alone_stuck * 20 > SCENES as usize, "{tally:?}");
    }
}

#[test]
fn a_scene_is_the_same_every_time_and_another_seed_gives_another() {
    let file = MachineFile::load("zx200").unwrap_or_else(|error| panic!("{error}"));
    let kit = Kit::new(&file.geometry).unwrap_or_else(|error| panic!("{error}"));
    let [once, again, other] = [(1, 7), (1, 7), (2, 7)].map(|(seed, number)| kit.scene(seed, number));
    assert_eq!((once.start, &once.obstacles), (again.start, &again.obstacles));
    assert_ne!(once.start, other.start);
}

#[test]
fn a_target_inside_an_obstacle_is_blocked_and_proved_to_be() {
    let file = MachineFile::load("zx200").unwrap_or_else(|error| panic!("{error}"));
    let kit = Kit::new(&file.geometry).unwrap_or_else(|error| panic!("{error}"));
    let mut scene = kit.scene(1, 0);
    let [x, y, z] = kit.tip(&scene.pose);
    scene.obstacles = vec![kinematics_core::planning::hull::Sphere { x, y, z, radius: 0.5 }];
    let outcome = kit.play(&scene, |_| panic!("it must not move"));
    assert_eq!(outcome.ended, Ended::Blocked);
    assert_eq!(outcome.proof, Some(hil_sim::scenes::Proof::NoClearPose));
}

#[test]
fn the_controller_reaches_past_the_obstacle_through_valves_that_lag() {
    for name in ["obstacle-over", "obstacle-plane"] {
        let scenario = scenario(name);
        let mut host = Host::new(&scenario.parameters).unwrap_or_else(|error| panic!("{error}"));
        let run = Run::new(&scenario, 1).unwrap_or_else(|error| panic!("{error}"));
        let log = run.complete(&mut host, |_, _| {}).unwrap_or_else(|error| panic!("{error}"));
        let summary = Summary::of(&scenario, "host", 1, &log, None);
        let tolerance_m = scenario.parameters.reach.map_or(0.0, |reach| reach.tolerance_m);
        assert_eq!(summary.outcome(), Ending::Done, "{summary:?}");
        assert!(summary.target_error_m.is_some_and(|error| error <= tolerance_m), "{summary:?}");
        assert!(summary.smallest_clearance_m.is_some_and(|clearance| clearance > 0.02), "{summary:?}");
    }
}

#[test]
fn where_no_route_is_found_a_look_says_whether_one_aim_on_the_way_would_have_done() {
    let file = MachineFile::load("frankel").unwrap_or_else(|error| panic!("{error}"));
    let kit = Kit::new(&file.geometry).unwrap_or_else(|error| panic!("{error}"));
    let outcome = kit.play(&kit.scene(1, 4869), |_| {});
    assert_eq!(outcome.ended, Ended::NoRoute);
    let look = outcome.look.unwrap_or_else(|| panic!("{outcome:?}"));
    assert!(!look.about_the_axis && look.arrived > 0 && look.arrived < look.tried, "{look:?}");
    // A scene that is reached needs none.
    assert!(kit.play(&kit.scene(1, 0), |_| {}).look.is_none());
}
