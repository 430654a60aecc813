//! `hil run` of a planar arm as people and scripts meet it: summary, report, figures of the documentation, bad input.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn run(scenario: &Path, arguments: &[&str], report: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hil"));
    command.arg("run").arg(scenario).args(arguments).arg("--report").arg(report);
    command.output().expect("the command starts")
}

fn example() -> PathBuf {
    root().join("scenarios/obstacle-park.toml")
}

#[test]
fn the_paper_s_three_runs_are_summed_up_and_drawn_as_the_documentation_shows_them() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(&example(), &["--json", "-"], folder.path());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(summary["kind"], "planar_arm");
    let cases = summary["cases"].as_array().unwrap();
    let reached: Vec<&Value> = cases.iter().map(|case| &case["reached"]).collect();
    assert_eq!(reached, [true, false, true]);
    assert_eq!(cases[1]["settled_at_iteration"], Value::Null);
    assert_eq!(cases[2]["settled_at_iteration"], 25);
    let page = std::fs::read_to_string(root().join("docs/planning.md")).unwrap();
    for (case, row) in cases.iter().zip(["| obstacle ignored", "| without the scheme", "| with the scheme"]) {
        let row = page.lines().find(|line| line.starts_with(row)).unwrap();
        let nearest = format!("{:.3} m |", case["smallest_obstacle_distance_m"].as_f64().unwrap());
        assert!(row.ends_with(&nearest), "{row}: {nearest}");
        let end = match case["settled_at_iteration"].as_u64() {
            Some(iteration) => format!("settled at iteration {iteration} |"),
            None => format!("{:.3} m away |", case["final_distance_m"].as_f64().unwrap()),
        };
        assert!(row.contains(&end), "{row}: {end}");
    }

    let file = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&file("summary.json")).unwrap(), summary);
    assert_eq!(file("log.csv").lines().count(), 1 + 3 * 101);
    assert!(file("report.html").matches("<svg").count() >= 9, "three figures of two");
    for name in ["arm.svg", "joints.svg", "distance.svg"] {
        let committed = root().join("docs").join(format!("park-{name}"));
        let text = std::fs::read_to_string(&committed).unwrap();
        assert!(text == file(name), "copy it again from the report: {}", committed.display());
    }
}

#[test]
fn a_table_says_it_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(&example(), &[], folder.path());
    let text = String::from_utf8(output.stdout).unwrap();
    for part in ["not reached", "settled at iteration 25", "kept free"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn bad_input_is_refused_by_field_and_range() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(example()).unwrap();
    let cases = [
        ("iterations = 100", "iterations = 0", "`iterations`"),
        ("link_m = [1.0, 1.0,", "link_m = [1.0, nan,", "`arm.link_m`"),
        ("link_m = [1.0, 1.0,", "link_m = [1.0,", "arm.link_m"),
        ("tolerance_m = 0.01", "tolerance_m = 2.0", "`target.tolerance_m`"),
        ("acts_m = 0.5", "acts_m = 0.1", "`obstacle.acts_m`"),
        ("keep_m = 0.25", "keep_m = 0.4\nheep_m = 1.0", "heep_m"),
        ("keep_m = 0.25\nacts_m = 0.5", "keep_m = 0.8\nacts_m = 0.9", "`arm.start_deg`"),
        ("x_m = 0.05\nz_m = 3.0", "x_m = 1.05\nz_m = 2.5", "`target.x_m`"),
        ("end_effector = 0.3", "end_effector = 1.5", "`gains.end_effector`"),
        ("links = [0.01,", "links = [-0.01,", "`gains.links`"),
        ("\"hold\"", "\"keep\"", "`gains.direction`"),
        ("turn_rad = 0.2\n", "", "turn_rad"),
        ("name = \"obstacle-park\"", "name = \"../x\"", "`name`"),
    ];
    for (old, new, field) in cases {
        assert!(text.contains(old), "{old}");
        let file = folder.path().join("spoilt.toml");
        std::fs::write(&file, text.replace(old, new)).unwrap();
        let output = run(&file, &[], &folder.path().join("report"));
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{new}: {error}");
        assert!(error.contains(field) && error.contains("spoilt.toml"), "{new}: {error}");
    }
    assert!(!folder.path().join("report").exists());
}

#[test]
fn what_needs_a_machine_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [&["--on", "emulator"][..], &["--draw-only"]] {
        let output = run(&example(), arguments, folder.path());
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(arguments[0]) && error.contains("machine"), "{error}");
    }
}
