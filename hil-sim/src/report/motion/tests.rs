//! What the page shows against the run it shows.

use std::path::Path;

use kinematics_core::Machine;
use serde_json::Value;

use super::stage;
use crate::place::Host;
use crate::run::{Log, Run};
use crate::scenario::Scenario;

fn scenario(name: &str) -> Scenario {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name);
    Scenario::load(&file).expect("the scenario is valid")
}

fn run(scenario: &Scenario) -> Log {
    let mut host = Host::new(&scenario.parameters).expect("valid parameters");
    Run::new(scenario, 1).expect("inside the limits").complete(&mut host, |_, _| {}).expect("the host stays")
}

fn machine(scenario: &Scenario) -> Machine<f64> {
    Machine::new(&scenario.machine.geometry).expect("checked geometry")
}

/// The element, its data, and its points: of every moment every point, mm.
fn shown(scenario: &Scenario, log: &Log) -> (String, Value, Vec<Vec<[f64; 2]>>) {
    let element = stage(scenario, &machine(scenario), log).expect("an outline").expect("a run");
    let (_, rest) = element.split_once("type=\"application/json\">").expect("data");
    let (data, _) = rest.split_once("</script>").expect("the data ends");
    let data: Value = serde_json::from_str(data).expect("JSON");
    let width = data["width"].as_u64().expect("a width") as usize;
    let numbers: Vec<i64> = data["points"].as_array().expect("points").iter().filter_map(Value::as_i64).collect();
    let mut now = vec![0; width];
    let moments = numbers.chunks(width).map(|differences| {
        now.iter_mut().zip(differences).for_each(|(now, difference)| *now += difference);
        now.chunks(2).map(|place| [place[0] as f64, place[1] as f64]).collect()
    });
    let moments = moments.collect();
    (element, data, moments)
}

/// The points a part of this class hangs on.
fn through(element: &str, class: &str) -> Vec<usize> {
    let (_, rest) = element.split_once(&format!("class=\"{class}\" data-through=\"")).expect("the part is drawn");
    let (points, _) = rest.split_once('"').expect("quoted");
    points.split(' ').map(|point| point.parse().expect("a number")).collect()
}

#[test]
fn every_cylinder_drawn_is_as_long_as_it_was_and_holds_its_rod() {
    let scenario = scenario("levers-zx200-hydraulic.toml");
    let log = run(&scenario);
    let (element, data, moments) = shown(&scenario, &log);
    let step = (data["step_s"].as_f64().expect("a step") * 1e3) as usize;
    assert_eq!((step, moments.len()), (25, 400), "40 moments a second");
    // Rods come in the order boom, arm, bucket.
    let rods: Vec<Vec<usize>> =
        element.split("class=\"rod\" ").skip(1).map(|rest| through(&format!("class=\"rod\" {rest}"), "rod")).collect();
    assert_eq!(rods.len(), 3);
    let strokes = [
        scenario.machine.geometry.boom.stroke,
        scenario.machine.geometry.arm.stroke,
        scenario.machine.geometry.bucket.stroke,
    ];
    for (moment, row) in moments.iter().zip(log.rows.iter().step_by(step)) {
        let lengths = [row.lengths.boom, row.lengths.arm, row.lengths.bucket];
        let barrels = ["barrel of-boom", "barrel of-arm", "barrel of-bucket"].map(|class| through(&element, class));
        for i in 0..3 {
            let apart = |a: usize, b: usize| libm::hypot(moment[a][0] - moment[b][0], moment[a][1] - moment[b][1]);
            // Both ends are rounded to a millimetre.
            assert!((apart(rods[i][0], rods[i][1]) - 1e3 * lengths[i]).abs() < 1.5, "cylinder {i} at {} s", row.time_s);
            let barrel = apart(barrels[i][0], barrels[i][1]);
            assert!(barrel < 1e3 * strokes[i].min_m && barrel > 1e3 * (strokes[i].max_m - strokes[i].min_m) - 1.5);
        }
    }
}

#[test]
fn the_tip_drawn_is_the_true_tip() {
    let scenario = scenario("dig.toml");
    let log = run(&scenario);
    let (_, data, moments) = shown(&scenario, &log);
    let tip = data["tip"].as_u64().expect("the tip") as usize;
    for (moment, row) in moments.iter().zip(log.rows.iter().step_by(25)) {
        let [x, z] = row.tip.expect("a pose");
        assert!(
            (moment[tip][0] - 1e3 * x).abs() < 0.6 && (moment[tip][1] - 1e3 * z).abs() < 0.6,
            "at {} s",
            row.time_s
        );
    }
    // Where no soil is modelled the ground stays.
    assert_eq!(data["cuts"], Value::Array(Vec::new()));
}

#[test]
fn soil_is_cut_where_the_tip_went_and_no_deeper() {
    let scenario = scenario("soil-dig-zx200.toml");
    let log = run(&scenario);
    let (_, data, _) = shown(&scenario, &log);
    let cuts = data["cuts"].as_array().expect("cuts");
    assert!(cuts.len() > 20, "{} cuts", cuts.len());
    let ground = data["ground"].as_array().expect("ground");
    let deepest =
        log.rows.iter().filter_map(|row| row.tip).map(|[_, z]| z).fold(0.0, |a: f64, b| if b < a { b } else { a });
    for cut in cuts {
        let [moment, sample, height] = [0, 1, 2].map(|i| cut[i].as_i64().expect("a number"));
        let reach = ground[sample as usize][0].as_i64().expect("a reach") as f64 * 1e-3;
        // The tip has passed there by then: within the ground's cell, and what it moves in a moment.
        let passed =
            log.rows[..=25 * moment as usize].iter().filter_map(|row| row.tip).any(|[x, _]| (x - reach).abs() < 0.06);
        assert!(passed && height as f64 >= 1e3 * deepest - 1.0, "{cut}");
    }
    assert!(data["load"].as_array().expect("loads").iter().any(|load| load.as_i64() > Some(200)), "the bucket fills");
}

#[test]
fn a_wall_is_seen_where_the_swing_points_at_it() {
    let scenario = scenario("fence-zx200.toml");
    let log = run(&scenario);
    let (element, data, moments) = shown(&scenario, &log);
    let planes = element.matches("class=\"limit\" data-through=").count();
    let fence = scenario.parameters.fence.as_ref().expect("a fence");
    assert_eq!(planes, fence.planes.iter().flatten().count());
    let wall = fence.planes.iter().flatten().position(|plane| plane.normal[2].abs() < 0.1).expect("a wall");
    let of_wall = element.split("class=\"limit\" data-through=\"").nth(wall + 1).expect("the wall is drawn");
    let end: usize = of_wall.split([' ', '"']).next().and_then(|number| number.parse().ok()).expect("a point");
    let plane = fence.planes.iter().flatten().nth(wall).expect("the wall");
    for (moment, row) in moments.iter().zip(log.rows.iter().step_by(25)) {
        let swing = row.swing.expect("a swing");
        let along = plane.normal[0] * swing.cos + plane.normal[1] * swing.sin;
        assert!((moment[end][0] * along - 1e3 * plane.offset_m).abs() < 1.0, "at {} s", row.time_s);
    }
    let turned =
        data["swing"].as_array().expect("angles").iter().filter_map(Value::as_i64).any(|angle| angle.abs() > 1000);
    assert!(turned && element.contains("class=\"above\""), "a run that swings is seen from above too");
}

#[test]
fn a_long_run_is_shown_in_longer_steps_and_an_empty_one_not_at_all() {
    let scenario = scenario("dig.toml");
    let mut log = run(&scenario);
    let row = log.rows[0].clone();
    log.rows = vec![row; 162_000];
    let (_, data, moments) = shown(&scenario, &log);
    assert!(moments.len() <= 4000 && data["step_s"].as_f64() == Some(0.041), "{} moments", moments.len());
    log.rows.clear();
    assert!(stage(&scenario, &machine(&scenario), &log).expect("an outline").is_none());
}
