//! The hydraulic plant under the controller, and the words of what is wrong with a file of it.

use std::path::Path;

use cross_tests::rig::scenario;
use hil_sim::machine_file::MachineFile;
use hil_sim::place::Host;
use hil_sim::run::{Outcome, Run, Summary};
use hil_sim::scenario::Scenario;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

fn text(file: &str) -> String {
    std::fs::read_to_string(Path::new(FOLDER).join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

#[test]
fn the_levers_move_the_hydraulic_machine_without_a_fault() {
    let scenario = scenario("levers-zx200-hydraulic");
    let mut host = Host::new(&scenario.parameters).expect("accepted parameters");
    let log =
        Run::new(&scenario, 1).expect("a start within the strokes").complete(&mut host, |_, _| {}).expect("a run");
    let summary = Summary::of(&scenario, "host", 1, &log, None);
    assert_eq!(summary.outcome(), Outcome::Done, "{summary:?}");
    let (first, half) = (log.rows[0].lengths, log.rows[5500].lengths);
    println!(
        "boom {:+.3} m, arm {:+.3} m, bucket {:+.3} m",
        half.boom - first.boom,
        half.arm - first.arm,
        half.bucket - first.bucket
    );
    // Lever 0.5 of 0.3 m/s for 3 s, −0.6 and −0.5 for 2 s: the load takes its part.
    assert!((0.2..0.6).contains(&(half.boom - first.boom)));
    assert!(half.arm < first.arm - 0.2 && half.bucket < first.bucket - 0.1);
}

#[test]
fn what_the_machine_file_says_must_not_stand_in_a_hydraulic_plant() {
    let with = |line: &str| {
        let text = text("scenarios/levers-zx200-hydraulic.toml")
            .replace("model = \"hydraulic\"", &format!("model = \"hydraulic\"\n{line}"));
        Scenario::from_toml(&text, Path::new("mine.toml")).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(with("payload_kg = 300.0"), Ok(()));
    assert_eq!(with("soil = \"loam\""), Ok(()));
    assert!(with("dead_time_s = 0.1").unwrap_err().contains("`plant.dead_time_s` must be left out"));
    assert!(with("payload_kg = -1.0").unwrap_err().contains("`plant.payload_kg` is -1 but must be within 0…20000"));
    assert!(with("soil = \"mud\"").unwrap_err().contains("plant.soil"));
}

#[test]
fn every_number_of_the_hydraulics_is_checked_by_its_name() {
    let whole = text("machines/zx200.toml");
    let (before, table) = whole.split_at(whole.find("[hydraulics]").unwrap());
    let lines: Vec<&str> = table.lines().collect();
    let mut seen = 0;
    for (i, line) in lines.iter().enumerate() {
        let Some((key, _)) = line.split_once(" = ").filter(|(key, _)| !key.starts_with('#')) else { continue };
        for value in ["-1.0", "1e9"] {
            let mut spoilt = lines.clone();
            let new = format!("{key} = {value}");
            spoilt[i] = &new;
            let error = MachineFile::from_toml(&(before.to_owned() + &spoilt.join("\n")), "mine.toml").unwrap_err();
            assert!(error.to_string().contains(key), "{key} = {value}: {error}");
            seen += 1;
        }
    }
    println!("{seen} faults named");
    assert!(seen > 150, "{seen}");
}

#[test]
fn a_machine_without_hydraulics_says_so() {
    let text = text("scenarios/levers-zx200-hydraulic.toml").replace("machine = \"zx200\"", "machine = \"exact-mini\"");
    let text = text
        .replace("boom_m = 2.3", "boom_m = 1.1")
        .replace("arm_m = 2.6", "arm_m = 1.3")
        .replace("bucket_m = 2.2", "bucket_m = 1.0");
    let error = Scenario::from_toml(&text, Path::new("mine.toml")).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("machine `exact-mini` has no `[hydraulics]`"), "{error}");
}
