//! Levers: each moves its own actuator at the speed it asks for, the swing included, and nothing else.

use cross_tests::rig::{Rig, drives, is_safe, scenario};
use firmware::{Fault, Request};
use hil_sim::place::Host;
use hil_sim::run::{Log, Outcome, Run, Summary};
use hil_sim::scenario::{LeverMove, Scenario, Start, Task};

fn run(scenario: &Scenario) -> (Log, Summary) {
    let mut host = Host::new(&scenario.parameters).expect("accepted parameters");
    let log = Run::new(scenario, 1).expect("a start within the strokes").complete(&mut host, |_, _| {});
    let log = log.expect("a host run");
    let summary = Summary::of(scenario, "host", 1, &log, None);
    (log, summary)
}

/// One lever held for a second on the 20 t machine.
fn one_lever(deflections: [f64; 4]) -> Scenario {
    let mut scenario = scenario("levers-zx200");
    let [swing, boom, arm, bucket] = deflections;
    scenario.task = Task::Levers {
        start: Start { swing_deg: 170.0, boom_m: 2.3, arm_m: 2.6, bucket_m: 2.0 },
        moves: vec![LeverMove { at_s: 1.0, until_s: 2.0, swing, boom, arm, bucket }],
    };
    (scenario.duration_s, scenario.sensor_noise_m) = (4.0, 0.0);
    scenario
}

/// Travel at full speed 1 through a spool of first order with a dead band, in closed form: run-up, a second less it, run-down.
fn held_for_a_second(fraction: f64, dead_band: f64, lag_s: f64) -> f64 {
    let opened = dead_band + (1.0 - dead_band) * fraction;
    let starts_s = -lag_s * (1.0 - dead_band / opened).ln();
    let closing = dead_band * lag_s * (opened / dead_band).ln();
    ((opened - dead_band) * (1.0 - starts_s) - closing) / (1.0 - dead_band)
}

#[test]
fn each_lever_moves_its_own_actuator_at_the_speed_asked_for() {
    for actuator in 0..4 {
        for deflection in [1.0, -0.5] {
            let mut deflections = [0.0; 4];
            deflections[actuator] = deflection;
            let scenario = one_lever(deflections);
            let (log, summary) = run(&scenario);
            assert_eq!(summary.outcome(), Outcome::Done, "{summary:?}");
            let (first, last) = (log.rows.first().unwrap(), log.rows.last().unwrap());
            let turned = (first.swing.unwrap().inverse() * last.swing.unwrap()).angle();
            let (a, b) = (first.lengths, last.lengths);
            let moved = [turned, b.boom - a.boom, b.arm - a.arm, b.bucket - a.bucket];
            let direction = usize::from(deflection < 0.0);
            let model = &scenario.plant[actuator];
            let full_speed = deflection.signum() * model.full_speed[direction];
            // The swing turns on past half a turn.
            let expected =
                full_speed * held_for_a_second(deflection.abs(), model.dead_band[direction], model.spool_lag_s);
            println!("{actuator} {deflection}: {moved:?}, {expected}");
            for (i, moved) in moved.into_iter().enumerate() {
                let expected = if i == actuator { expected } else { 0.0 };
                // The bus carries flows in steps of 0.4 %, and the current takes some milliseconds to come and to go.
                assert!((moved - expected).abs() <= 12e-3 * expected.abs() + 1e-12, "{i}: {moved} for {expected}");
            }
        }
    }
}

#[test]
fn the_backhoes_swing_cylinder_swings_it() {
    let mut scenario = scenario("dig");
    scenario.parameters.dig = None;
    scenario.task = Task::Levers {
        start: Start { swing_deg: 0.0, boom_m: 0.95, arm_m: 0.9, bucket_m: 0.8 },
        moves: vec![LeverMove { at_s: 1.0, until_s: 1.5, swing: 1.0, boom: 0.0, arm: 0.0, bucket: 0.0 }],
    };
    scenario.duration_s = 3.0;
    let (log, summary) = run(&scenario);
    assert_eq!(summary.outcome(), Outcome::Done, "{summary:?}");
    assert_eq!(summary.dig_completed, None);
    let last = log.rows.last().unwrap();
    let (turned, estimated) = (last.swing.unwrap().angle(), last.outputs.pose.swing.angle());
    println!("turned {turned} rad, measured {estimated} rad");
    assert!(turned > 0.2 && (turned - f64::from(estimated)).abs() < 0.005);
}

#[test]
fn no_command_no_motion_whatever_the_levers_say() {
    let mut rig = Rig::new();
    rig.start();
    rig.levers = [i16::MAX, 0, i16::MIN, 0];
    assert_eq!(rig.ticks(5).duties, [[0; 2]; 4], "the levers count only when they are asked for");
    rig.request = Request::Levers;
    assert!(drives(&rig.tick()));
    rig.sending = false;
    let outputs = rig.ticks(200);
    assert_eq!(outputs.fault, Some(Fault::CommandStale));
    assert!(is_safe(&outputs));
}

#[test]
fn a_dig_without_a_dig_in_the_parameters_is_a_fault_that_says_so() {
    let scenario = scenario("levers-zx200");
    let mut rig = Rig::standing(&scenario.parameters, &[2.3, 2.6, 2.2]);
    rig.start();
    rig.request = Request::Dig;
    let outputs = rig.tick();
    assert_eq!(outputs.fault, Some(Fault::NotConfigured));
    assert!(is_safe(&outputs));
}

#[test]
fn changing_from_the_dig_to_the_levers_and_back_starts_the_dig_over() {
    let mut rig = Rig::new();
    rig.dig(500);
    rig.request = Request::Levers;
    let outputs = rig.tick();
    assert_eq!((outputs.dig_tick, outputs.speeds.to_array()), (0, [0.0; 4]));
    rig.request = Request::Dig;
    assert_eq!(rig.tick().dig_tick, 1);
}
