//! `hil run` as people and scripts meet it: exit status, summary, report folder.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios")
}

fn hil_run(scenario: &Path, arguments: &[&str], report: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hil"))
        .arg("run")
        .arg(scenario)
        .args(arguments)
        .arg("--report")
        .arg(report)
        .output()
        .expect("the command starts")
}

fn json(output: &Output) -> Value {
    let text = String::from_utf8_lossy(&output.stdout);
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

/// A copy of a scenario with one line changed, so that it is quick or broken.
fn changed(folder: &Path, name: &str, old: &str, new: &str) -> PathBuf {
    let text = std::fs::read_to_string(scenarios().join(name)).unwrap();
    assert!(text.contains(old), "{old}");
    let file = folder.join("changed.toml");
    std::fs::write(&file, text.replace(old, new)).unwrap();
    file
}

#[test]
fn a_dig_that_is_done_exits_with_zero_and_leaves_its_report() {
    let folder = tempfile::tempdir().unwrap();
    let output = hil_run(&scenarios().join("dig.toml"), &["--json", "-"], folder.path());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let summary = json(&output);
    assert_eq!(summary["ticks"], 22_000);
    assert_eq!(summary["output_hash"].as_str().unwrap().len(), 16);
    assert_eq!(summary["dig_completed"], true);
    assert_eq!(summary["faults"], Value::Array(vec![]));
    assert!(summary["tip_error_rms_m"].as_f64().unwrap() <= 0.030);
    assert!(summary["tip_error_max_m"].as_f64().unwrap() >= summary["tip_error_rms_m"].as_f64().unwrap());
    assert!(summary["real_time_factor"].as_f64().unwrap() > 0.0);
    let file = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&file("summary.json")).unwrap(), summary);
    assert_eq!(file("log.csv").lines().count(), 22_001);
    assert!(file("report.html").contains("<svg"));
}

#[test]
fn the_same_seed_gives_the_same_hash_and_another_seed_another() {
    let folder = tempfile::tempdir().unwrap();
    let short = changed(folder.path(), "dig.toml", "duration_s = 22.0", "duration_s = 1.5");
    let hash = |seed: &str| {
        let output = hil_run(&short, &["--seed", seed, "--json", "-"], folder.path());
        json(&output)["output_hash"].as_str().unwrap().to_owned()
    };
    assert_eq!(hash("5"), hash("5"));
    assert_ne!(hash("5"), hash("6"));
}

#[test]
fn a_fault_exits_with_three_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let output = hil_run(&scenarios().join("dig-emergency-stop.toml"), &["--json", "-"], folder.path());
    assert_eq!(output.status.code(), Some(3), "{output:?}");
    let summary = json(&output);
    assert_eq!(summary["faults"][0]["fault"], "emergency_stop");
    assert_eq!(summary["faults"][0]["at_s"], 9.0);
    assert_eq!(summary["dig_completed"], false);
}

#[test]
fn the_published_dig_is_refused_with_two_and_moves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let output = hil_run(&scenarios().join("dig-published.toml"), &["--json", "-"], folder.path());
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let summary = json(&output);
    assert_eq!(summary["ticks"], 0);
    let refused = summary["refused"].as_array().unwrap();
    assert_eq!(refused.len(), 2);
    for violation in refused {
        assert_eq!(violation["cylinder"], "arm");
        assert!(violation["by_m"].as_f64().unwrap() > 0.016);
        assert!(violation["worst_s"].is_number());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("arm") && said.contains("--draw-only"), "{said}");
}

#[test]
fn drawn_only_it_exits_with_zero_and_still_lists_its_violations() {
    let folder = tempfile::tempdir().unwrap();
    let output = hil_run(&scenarios().join("dig-published.toml"), &["--draw-only", "--json", "-"], folder.path());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert_eq!(json(&output)["refused"].as_array().unwrap().len(), 2);
    assert!(folder.path().join("report.html").is_file());
}

#[test]
fn a_bad_scenario_exits_with_two_and_names_the_field() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("reach_m = 2.286", "", "reach_m"),
        ("reach_m = 2.286", "reech_m = 2.286", "reech_m"),
        ("reach_m = 2.286", "reach_m = nan", "dig.reach_m"),
        ("plunge_m = 1.524", "plunge_m = -1.524", "dig.plunge_m"),
        ("machine = \"frankel\"", "machine = \"unheard-of\"", "unheard-of"),
    ];
    for (old, new, named) in cases {
        let file = changed(folder.path(), "dig.toml", old, new);
        let output = hil_run(&file, &[], folder.path());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(named), "{said}");
    }
    let output = hil_run(Path::new("no/such/scenario.toml"), &[], folder.path());
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("no/such/scenario.toml"));
}

#[test]
fn a_machine_file_is_found_from_the_scenarios_folder() {
    let folder = tempfile::tempdir().unwrap();
    let machines = scenarios().join("../machines");
    std::fs::copy(machines.join("frankel.toml"), folder.path().join("mine.toml")).unwrap();
    let file = changed(folder.path(), "dig.toml", "machine = \"frankel\"", "machine = \"mine.toml\"");
    let output = hil_run(&file, &["--draw-only"], &folder.path().join("report"));
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}

#[test]
fn the_pages_figures_of_runs_are_those_of_today() {
    let folder = tempfile::tempdir().unwrap();
    for (scenario, drawn, kept) in [
        ("dig.toml", "linkage.svg", "dig.svg"),
        ("fence-zx200.toml", "fence.svg", "fence.svg"),
        ("obstacle-over.toml", "avoidance.svg", "obstacle-over.svg"),
    ] {
        let output = hil_run(&scenarios().join(scenario), &[], folder.path());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let today = std::fs::read_to_string(folder.path().join(drawn)).unwrap();
        let kept = std::fs::read_to_string(scenarios().join("../docs").join(kept)).unwrap();
        assert!(
            today == kept,
            "docs/ has another figure than `cargo hil run scenarios/{scenario}` draws: copy {drawn}"
        );
    }
}

#[test]
fn a_fence_that_is_passed_exits_with_three_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    // A ceiling that the boom stands above from the start.
    let file = changed(folder.path(), "fence-zx200.toml", "ceiling_m = 7.0", "ceiling_m = 4.0");
    let output = hil_run(&file, &["--json", "-"], &folder.path().join("report"));
    assert_eq!(output.status.code(), Some(3), "{output:?}");
    assert!(json(&output)["fence_clearance_min_m"].as_f64().unwrap() < 0.0);
    assert!(String::from_utf8_lossy(&output.stderr).contains("FENCE VIOLATED"));
}
