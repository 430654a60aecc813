//! `hil pose`, the real command: what it prints, and how it refuses.

mod hil;

use std::fs;
use std::path::PathBuf;

use hil::{hil_in, pose};
use kinematics_core::{Joints, Machine, PinGeometry, Rotor};
use serde_json::Value;

#[test]
fn all_three_descriptions_come_out_under_their_keys() {
    let args = ["--machine", "exact-mini", "--joints", "-15,-60,-30", "--swing", "90", "--precision", "f64", "--json"];
    let answer = pose(&args);
    assert_eq!((answer.code, answer.err.as_str()), (Some(0), ""));
    let json = answer.json();
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>().join(",");
    assert_eq!(keys(&json), "cylinders_m,joints_deg,swing_deg,tip,tip_from_boom_pin,within_stroke");
    assert_eq!(keys(&json["joints_deg"]), "arm,boom,bucket");
    assert_eq!(keys(&json["cylinders_m"]), "arm,boom,bucket");
    assert_eq!(keys(&json["tip"]), "pitch_deg,reach_m,x_m,y_m,z_m");
    assert_eq!(keys(&json["tip_from_boom_pin"]), "x_m,z_m");
    assert_eq!(json["within_stroke"], true);
    assert_eq!(json["swing_deg"], 90.0);
    // Swung to the left: all of the reach is y.
    assert_eq!(json["tip"]["x_m"], 0.0);
    assert_eq!(json["tip"]["y_m"], json["tip"]["reach_m"]);
}

#[test]
fn values_may_begin_with_a_minus() {
    let answer = pose(&["--machine", "exact-mini", "--joints", "-15,-60,-30", "--swing", "-30", "--json"]);
    let json = answer.json();
    assert_eq!(json["swing_deg"], -30.0);
    assert!(json["tip"]["y_m"].as_f64().unwrap() < 0.0);
    // A tip behind the swing axis has a negative reach.
    let joints = ["--machine", "zx120", "--joints", "100,-152,-130", "--json", "--allow-outside"];
    let tip = &pose(&joints).json()["tip"];
    assert!(tip["reach_m"].as_f64().unwrap() < 0.0, "{tip}");
    let given = format!("{},{},{}", tip["reach_m"], tip["z_m"], tip["pitch_deg"]);
    let back = pose(&["--machine", "zx120", "--tip", &given, "--json", "--allow-outside"]).json();
    assert_eq!(back["tip"]["reach_m"], tip["reach_m"]);
    assert!((back["joints_deg"]["boom"].as_f64().unwrap() - 100.0).abs() < 1e-3, "{back}");
}

#[test]
fn the_given_description_is_printed_as_given_in_f32_too() {
    let json = pose(&["--machine", "zx200", "--cylinders", "2.1,2.4,2.3", "--json"]).out;
    assert!(json.contains(r#""cylinders_m":{"boom":2.1,"arm":2.4,"bucket":2.3}"#), "{json}");
    let json = pose(&["--machine", "zx200", "--joints", "12.3,-81.7,-33.1", "--swing", "10.1", "--json"]).out;
    assert!(json.contains(r#""joints_deg":{"boom":12.3,"arm":-81.7,"bucket":-33.1}"#), "{json}");
    assert!(json.contains(r#""swing_deg":10.1,"#), "{json}");
    let json = pose(&["--machine", "zx200", "--tip", "6.7,-1.3,-95.3", "--json"]).out;
    assert!(json.contains(r#""z_m":-1.3,"pitch_deg":-95.3,"reach_m":6.7"#), "{json}");
}

#[test]
fn f32_is_the_default_and_prints_no_digits_of_another_type() {
    let args = ["--machine", "zx200", "--cylinders", "2.1,2.4,2.3", "--json"];
    let default = pose(&args).out;
    assert_eq!(default, pose(&[&args[..], &["--precision", "f32"]].concat()).out);
    assert_ne!(default, pose(&[&args[..], &["--precision", "f64"]].concat()).out);
    for text in default.split([':', ',', '{', '}']).filter(|text| text.contains('.')) {
        // The shortest text of an f32: as long as Rust's own.
        assert_eq!(text.parse::<f32>().unwrap(), text.parse::<f64>().unwrap() as f32);
        assert!(text.trim_start_matches('-').len() <= 11, "{text} in {default}");
    }
}

#[test]
fn angles_come_out_in_one_turn() {
    let json = pose(&["--machine", "exact-mini", "--joints", "380,280,-370", "--swing", "540", "--json"]).json();
    assert_eq!(json["joints_deg"]["boom"], 20.0);
    assert_eq!(json["joints_deg"]["arm"], -80.0);
    assert_eq!(json["joints_deg"]["bucket"], -10.0);
    assert_eq!(json["swing_deg"], 180.0);
    let json = pose(&["--machine", "exact-mini", "--tip", "2,-1,270", "--json"]).json();
    assert_eq!(json["tip"]["pitch_deg"], -90.0);
}

#[test]
fn a_swing_beyond_a_backhoes_swing_cylinder_is_no_error() {
    let answer = pose(&["--machine", "frankel", "--joints", "20,-80,-60", "--swing", "170", "--json"]);
    assert_eq!(answer.json()["swing_deg"], 170.0);
}

#[test]
fn out_of_stroke_names_cylinder_length_and_limits() {
    let args = ["--machine", "exact-mini", "--cylinders", "1.1,1.59,1.0"];
    let answer = pose(&args);
    let (kind, message) = answer.refusal();
    assert_eq!(kind, "out_of_stroke");
    assert_eq!(
        message,
        "arm cylinder: a length of 1.59 m is 0.034 m above its maximum; its stroke is 1.046 to 1.556 m"
    );
    assert!(answer.err.contains(&message), "people read it on standard error");
    assert_eq!(pose(&[&args[..], &["--json"]].concat()).err, "");

    let json = pose(&[&args[..], &["--json", "--allow-outside"]].concat()).json();
    assert_eq!((&json["within_stroke"], &json["cylinders_m"]["arm"]), (&Value::from(false), &Value::from(1.59)));

    for given in [["--joints", "10,-160,-30"], ["--tip", "0.5425,-0.169,180"]] {
        let args = [&["--machine", "exact-mini"][..], &given[..]].concat();
        assert_eq!(pose(&args).refusal().0, "out_of_stroke", "{given:?}");
        let json = pose(&[&args[..], &["--json", "--allow-outside"]].concat()).json();
        assert_eq!(json["within_stroke"], false, "{given:?}");
    }
}

#[test]
fn within_a_micrometre_of_an_end_is_inside() {
    for (length, code) in [("1.3050009", 0), ("1.3050022", 2), ("0.9049991", 0), ("0.904997", 2)] {
        for precision in ["f32", "f64"] {
            let given = format!("{length},1.3,1.0");
            let answer = pose(&["--machine", "exact-mini", "--cylinders", &given, "--precision", precision]);
            assert_eq!(answer.code, Some(code), "{length} {precision}");
        }
    }
}

#[test]
fn for_cylinders_the_stroke_comes_before_the_assembly() {
    let args = ["--machine", "exact-mini", "--cylinders", "2.4,1.3,1.0"];
    assert_eq!(pose(&args).refusal().0, "out_of_stroke");
    let (kind, message) = pose(&[&args[..], &["--allow-outside"]].concat()).refusal();
    assert_eq!(kind, "no_assembly");
    for part in ["boom cylinder", "2.4 m", "0.905 to 1.305 m"] {
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(pose(&["--machine", "exact-mini", "--cylinders", "0,1.3,1.0"]).refusal().0, "out_of_stroke");
    assert_eq!(pose(&["--machine", "exact-mini", "--cylinders", "1e300,1.3,1.0"]).refusal().0, "out_of_stroke");
}

#[test]
fn a_joint_beyond_a_dead_point_has_no_assembly_although_a_length_would_fit_its_mirror_image() {
    for allow in [&[][..], &["--allow-outside"][..]] {
        for precision in ["f32", "f64"] {
            for (machine, joints, cylinder) in [
                ("exact-mini", "150,-60,-30", "boom cylinder"),
                ("exact-mini", "-150,-60,-30", "boom cylinder"),
                ("exact-mini", "15,60,10", "arm cylinder"),
                ("zx200", "1,-60,56", "bucket cylinder"),
                ("zx200", "1,-60,70", "bucket cylinder"),
                ("zx120", "1,-60,45", "bucket cylinder"),
                ("frankel", "120,-60,-30", "boom cylinder"),
            ] {
                let args = [&["--machine", machine, "--joints", joints, "--precision", precision], allow].concat();
                let (kind, message) = pose(&args).refusal();
                assert_eq!(kind, "no_assembly", "{machine} {joints}: {message}");
                assert!(message.starts_with(cylinder) && message.contains("its stroke is"), "{machine}: {message}");
            }
        }
    }
    // Just inside the fold it is only outside the stroke.
    assert_eq!(pose(&["--machine", "zx200", "--joints", "1,-60,55"]).refusal().0, "out_of_stroke");
}

#[test]
fn a_tip_that_needs_a_joint_beyond_a_dead_point_has_no_assembly() {
    let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
    let [boom, arm, bucket] = [110.0, -60.0, -30.0].map(Rotor::from_degrees);
    let tip = machine.joints_to_tip(&Joints { boom, arm, bucket }, Rotor::IDENTITY).plane;
    let given = format!("{},{},20", tip.reach, tip.height);
    for precision in ["f32", "f64"] {
        let args = ["--machine", "exact-mini", "--tip", &given, "--precision", precision, "--allow-outside"];
        let (kind, message) = pose(&args).refusal();
        assert_eq!(kind, "no_assembly");
        assert!(message.starts_with("boom cylinder: no length puts the boom at 1"), "{message}");
    }
}

#[test]
fn a_tip_out_of_reach_says_by_how_much() {
    for (tip, part) in [("9,0,0", "too far"), ("0.6,0.1,0", "too near"), ("1e300,0,0", "1e300 m too far")] {
        for precision in ["f32", "f64"] {
            let args = ["--machine", "exact-mini", "--tip", tip, "--precision", precision, "--allow-outside"];
            let (kind, message) = pose(&args).refusal();
            assert_eq!(kind, "unreachable");
            assert!(message.contains(part) && message.contains("reach 1 to 3.1 m"), "{message}");
        }
    }
}

#[test]
fn invalid_input_names_the_value() {
    let mini = ["--machine", "exact-mini"];
    let cases: [(&[&str], &str); 22] = [
        (&["--cylinders", "1.1,-1.3,1.0"], "`arm_m`"),
        (&["--cylinders", "1.1,1.3,nan"], "`bucket_m`"),
        (&["--joints", "inf,0,0"], "`boom_deg`"),
        (&["--tip", "1,-inf,0"], "`z_m`"),
        (&["--tip", "1,1,NaN"], "`pitch_deg`"),
        (&["--tip", "1,1,0", "--swing", "nan"], "`swing_deg`"),
        (&["--joints", "1,2"], "three numbers"),
        (&["--joints", "1,2,3,4"], "three numbers"),
        (&["--joints", "1,2,x"], "`x` is not a number"),
        (&["--joints", ""], "--joints"),
        (&["--joints"], "--joints"),
        (&["--swing", "left", "--joints", "1,2,3"], "`left` is not a number"),
        (&[], "--cylinders"),
        (&["--joints", "1,2,3", "--tip", "1,2,3"], "--tip"),
        (&["--joints", "1,2,3", "--csv", "-"], "--csv"),
        (&["--joints", "1,2,3", "--joints", "1,2,3"], "--joints"),
        (&["--joints", "1,2,3", "--precision", "f16"], "f16"),
        (&["--joints", "1,2,3", "--bogus"], "--bogus"),
        (&["--joints", "1,2,3", "stray"], "stray"),
        (&["--joints", "1,2,3", "--machine", "zx200"], "--machine"),
        (&["--csv", "/nonexistent/poses.csv"], "/nonexistent/poses.csv"),
        (&["--csv", "."], "reading the CSV"),
    ];
    for (args, part) in cases {
        let args = [&mini, args].concat();
        let answer = pose(&args);
        let (kind, message) = answer.refusal();
        assert_eq!(kind, "invalid_input", "{args:?}");
        assert!(message.contains(part), "{args:?}: {message}");
        assert!(answer.err.contains(&message), "{args:?}: {}", answer.err);
        let quiet = pose(&[&args[..], &["--json"]].concat());
        assert_eq!((quiet.refusal().0.as_str(), quiet.err.as_str()), ("invalid_input", ""), "{args:?}");
    }
    let (kind, message) = pose(&["--joints", "1,2,3"]).refusal();
    assert!(kind == "invalid_input" && message.contains("--machine"), "{message}");
    let (kind, message) = pose(&["--machine", "zx2000", "--joints", "1,2,3"]).refusal();
    assert!(kind == "invalid_input" && message.contains("zx200,") | message.contains("zx200;"), "{message}");
}

#[test]
fn a_broken_machine_file_is_named_with_its_field() {
    let folder = tempfile::tempdir().unwrap();
    let mini = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../machines/exact-mini.toml");
    let file = folder.path().join("mine.toml");
    fs::write(&file, fs::read_to_string(mini).unwrap().replace("rocker_m = 0.240", "rocker_m = nan")).unwrap();
    let file = file.to_str().unwrap();
    let (kind, message) = pose(&["--machine", file, "--joints", "1,2,3"]).refusal();
    assert!(kind == "invalid_input" && message.contains(file) && message.contains("`bucket.rocker_m`"), "{message}");
}

#[test]
fn machines_of_the_current_directory_come_first() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("machines")).unwrap();
    let workspace = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../machines");
    fs::copy(workspace.join("zx200.toml"), folder.path().join("machines/exact-mini.toml")).unwrap();
    fs::copy(workspace.join("zx200.toml"), folder.path().join("machines/mine.toml")).unwrap();
    let here = |machine: &str| {
        hil_in(Some(folder.path()), &["--machine", machine, "--cylinders", "2.1,2.4,2.3", "--json"], b"")
    };
    let zx200 = pose(&["--machine", "zx200", "--cylinders", "2.1,2.4,2.3", "--json"]).out;
    for machine in ["exact-mini", "mine", "zx200", "machines/mine.toml", "./machines/mine.toml"] {
        assert_eq!(here(machine).out, zx200, "{machine}");
    }
    assert!(here("yours").refusal().1.contains("exact-mini, frankel, mine, zx120, zx200"));
}

#[test]
fn help_is_no_error_and_the_table_is_for_people() {
    let help = pose(&["--help"]);
    assert_eq!(help.code, Some(0));
    assert!(help.out.contains("--allow-outside"));
    let table = pose(&["--machine", "exact-mini", "--cylinders", "1.1,1.3,1.0"]);
    assert_eq!((table.code, table.err.as_str()), (Some(0), ""));
    for part in ["exact-mini, within the stroke", "cylinders", "joints", "11.378", "pitch"] {
        assert!(table.out.contains(part), "{}", table.out);
    }
    assert!(table.out.lines().count() < 10);
}
