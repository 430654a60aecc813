//! The controller's planned move: followed to its end within every limit, refused with a reason where it has no plan.

use cross_tests::rig::scenario;
use firmware::moves::{Move, MoveError, Pitch};
use firmware::{Ecu, ParameterError};
use hil_sim::place::Host;
use hil_sim::run::{Log, Run};
use kinematics_core::planning::pitch_plan::PlanError;
use kinematics_core::{Cylinders, Machine};

const TICK_S: f64 = 0.001;

fn run() -> Log {
    let scenario = scenario("move-least-effort");
    let mut host = Host::new(&scenario.parameters).unwrap_or_else(|error| panic!("{error}"));
    let run = Run::new(&scenario, 1).unwrap_or_else(|error| panic!("{error}"));
    run.complete(&mut host, |_, _| ()).unwrap_or_else(|error| panic!("{error}"))
}

fn array(c: Cylinders<f32>) -> [f64; 3] {
    [c.boom, c.arm, c.bucket].map(f64::from)
}

#[test]
fn the_tip_follows_the_line_to_its_target_without_a_fault() {
    let planned = scenario("move-least-effort").parameters.planned_move.expect("a move");
    let log = run();
    assert!(log.faults.is_empty(), "{:?}", log.faults);
    assert!(log.stop_hits.is_empty());
    let following: Vec<_> = log.rows.iter().filter(|row| row.outputs.dig_tick > 0).collect();
    let (first, last) = (following.first().expect("it moves"), following.last().expect("it moves"));
    println!("{} ticks, tip at {:?}", following.len(), log.rows.last().and_then(|row| row.tip));
    assert!(last.time_s < log.rows.last().expect("rows").time_s - 0.5, "it ends before the scenario does");
    let away =
        |tip: Option<[f64; 2]>, from: [f64; 2]| tip.map(|[x, z]| libm::hypot(x - from[0], z - from[1])).expect("a tip");
    assert!(away(first.tip, planned.start_m) < 0.005);
    assert!(away(log.rows.last().expect("rows").tip, planned.target_m) < 0.03);
    // The line is level: the reference keeps to it between the knots too, the tip to the following error.
    for row in &following {
        let Some([_, height]) = row.reference else { continue };
        assert!((height - planned.start_m[1]).abs() < 0.002, "{height} at {} s", row.time_s);
        assert!((row.tip.expect("a tip")[1] - planned.start_m[1]).abs() < 0.05);
    }
}

#[test]
fn pitch_speeds_and_pump_flow_stay_within_their_limits() {
    let scenario = scenario("move-least-effort");
    let planned = scenario.parameters.planned_move.expect("a move");
    let machine = Machine::<f32>::new(&scenario.parameters.geometry).expect("valid pins");
    let plan = Move::new(&machine, &planned, TICK_S).unwrap_or_else(|error| panic!("{error}")).plan;
    let Pitch::Bounded { lower_deg, upper_deg } = planned.pitch else { panic!("a bounded pitch") };
    let degrees = plan.pitch_turns.map(|turns| f64::from(turns) * 360.0);
    println!("pitch at the knots: {degrees:.1?}");
    assert!(degrees.iter().all(|pitch| (lower_deg - 0.01..=upper_deg + 0.01).contains(pitch)));

    let log = run();
    let rows: Vec<_> = log.rows.iter().filter(|row| row.outputs.dig_tick > 0).collect();
    let (mut fastest, mut most_flow) = ([0.0_f64; 3], 0.0_f64);
    for pair in rows.windows(20) {
        let [from, to] = [pair[0], pair[19]].map(|row| array(row.outputs.reference));
        let mut flow = 0.0;
        for i in 0..3 {
            // Over 19 ms: of one tick an f32 length would show its rounding.
            let speed = (to[i] - from[i]) / (19.0 * TICK_S);
            let way = usize::from(speed < 0.0);
            fastest[i] = fastest[i].max(speed.abs() / planned.speed_mps[i][way]);
            flow += planned.areas_m2[i][way] * speed.abs();
        }
        most_flow = most_flow.max(flow / planned.flow_m3ps);
    }
    println!("largest share of speed: {fastest:.3?}, of flow: {most_flow:.3}");
    assert!(fastest.iter().all(|share| *share <= 1.001) && most_flow <= 1.001, "{fastest:?} {most_flow}");
    // It is as fast as one of them lets it be.
    assert!(fastest.iter().any(|share| *share > 0.9) || most_flow > 0.9);
}

#[test]
fn a_move_without_a_plan_is_refused_before_anything_moves() {
    let mut parameters = scenario("move-least-effort").parameters;
    parameters.planned_move.as_mut().expect("a move").target_m = [30.0, 0.0];
    let refused = Ecu::new(&parameters).map(drop);
    assert!(matches!(refused, Err(ParameterError::Move(MoveError::Plan(PlanError::NoWay { .. })))), "{refused:?}");
    parameters.planned_move.as_mut().expect("a move").flow_m3ps = -1.0;
    let refused = Ecu::new(&parameters).map(drop).expect_err("no flow");
    assert_eq!(refused.to_string(), "`move`: `flow_m3ps` must be within 1e-6…1e6");
}
