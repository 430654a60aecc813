//! `hil pose --rates`, the real command: its numbers are the slopes of what `hil pose` itself prints.

mod hil;

use hil::{hil_in, pose};
use serde_json::Value;

const MINI: [&str; 4] = ["--machine", "exact-mini", "--precision", "f64"];

fn answer(input: [&str; 2], more: &[&str]) -> Value {
    pose(&[&MINI[..], &input, &["--json"], more].concat()).json()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Reach, height and pitch [rad], and joints [rad], of three cylinder lengths.
fn at(lengths: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let [boom, arm, bucket] = lengths;
    let json = answer(["--cylinders", &format!("{boom},{arm},{bucket}")], &[]);
    let tip = &json["tip"];
    let joints = ["boom", "arm", "bucket"].map(|link| number(&json["joints_deg"][link]).to_radians());
    ([number(&tip["reach_m"]), number(&tip["z_m"]), number(&tip["pitch_deg"]).to_radians()], joints)
}

#[test]
fn the_jacobians_are_the_slopes_of_the_poses_the_command_prints() {
    let lengths = [1.1, 1.3, 1.0];
    let rates = answer(["--cylinders", "1.1,1.3,1.0"], &["--rates"])["rates"].clone();
    let h = 1e-5;
    for (which, link) in ["boom", "arm", "bucket"].into_iter().enumerate() {
        let moved = |by: f64| {
            let mut lengths = lengths;
            lengths[which] += by;
            at(lengths)
        };
        let ((tip_before, joints_before), (tip_after, joints_after)) = (moved(-h), moved(h));
        let transmission = (joints_after[which] - joints_before[which]) / (2.0 * h);
        assert!((number(&rates["transmission_rad_per_m"][link]) - transmission).abs() < 1e-7);
        assert!((number(&rates["moment_arms_m_per_rad"][link]) * transmission - 1.0).abs() < 1e-7);
        let rows = [
            ("reach_m_per_m", "reach_m_per_rad"),
            ("height_m_per_m", "height_m_per_rad"),
            ("pitch_rad_per_m", "pitch_rad_per_rad"),
        ];
        for (i, (cylinder, joint)) in rows.into_iter().enumerate() {
            let slope = (tip_after[i] - tip_before[i]) / (2.0 * h);
            assert!((number(&rates["cylinder_jacobian"][cylinder][which]) - slope).abs() < 1e-7, "{cylinder} {link}");
            let per_joint = number(&rates["joint_jacobian"][joint][which]);
            assert!((per_joint * transmission - slope).abs() < 1e-6, "{joint} {link}");
        }
    }
}

#[test]
fn condition_and_ellipses_belong_to_the_printed_jacobian() {
    let rates = answer(["--joints", "10,-80,-40"], &["--rates"])["rates"].clone();
    let row = |name: &str| [0, 1, 2].map(|i| number(&rates["joint_jacobian"][name][i]));
    let (reach, height) = (row("reach_m_per_rad"), row("height_m_per_rad"));
    let dot = |l: [f64; 3], r: [f64; 3]| l.iter().zip(r).map(|(x, y)| x * y).sum::<f64>();
    let (p, q, r) = (dot(reach, reach), dot(reach, height), dot(height, height));
    let velocity = &rates["velocity_ellipse"];
    let (major, minor) = (number(&velocity["major_m_per_rad"]), number(&velocity["minor_m_per_rad"]));
    assert!((major * major + minor * minor - p - r).abs() < 1e-12);
    assert!((major * major * minor * minor - (p * r - q * q)).abs() < 1e-12);
    assert!((number(&rates["condition_number"]) - major / minor).abs() < 1e-12);
    // JJᵀ·(cos, sin) = σ1²·(cos, sin)
    let (sin, cos) = libm::sincos(number(&velocity["direction_deg"]).to_radians());
    assert!((p * cos + q * sin - major * major * cos).abs() < 1e-12);
    let force = &rates["force_ellipse"];
    assert!((number(&force["major_n_per_nm"]) * minor - 1.0).abs() < 1e-12);
    let apart = number(&force["direction_deg"]) - number(&velocity["direction_deg"]);
    assert!((apart.abs() - 90.0).abs() < 1e-9, "{apart}");
}

#[test]
fn rates_stand_under_their_own_key_and_only_where_asked_for() {
    let with = answer(["--joints", "-15,-60,-30"], &["--rates"]);
    let mut rest = with.as_object().unwrap().clone();
    let rates = rest.remove("rates").unwrap();
    assert_eq!(Value::Object(rest), answer(["--joints", "-15,-60,-30"], &[]));
    let keys = rates.as_object().unwrap().keys().cloned().collect::<Vec<_>>().join(",");
    assert_eq!(
        keys,
        "condition_number,cylinder_jacobian,force_ellipse,joint_jacobian,moment_arms_m_per_rad,transmission_rad_per_m,\
         velocity_ellipse"
    );
    assert_eq!(rates["joint_jacobian"]["pitch_rad_per_rad"], serde_json::json!([1.0, 1.0, 1.0]));
}

#[test]
fn the_table_names_every_line_with_its_unit() {
    let table = pose(&["--machine", "zx200", "--joints", "20,-80,-60", "--rates"]).out;
    for start in [
        "moment arms   m/rad",
        "transmission  rad/m",
        "reach/joint   m/rad",
        "height/joint  m/rad",
        "pitch/joint",
        "reach/cyl.    m/m",
        "height/cyl.   m/m",
        "pitch/cyl.    rad/m",
        "condition",
        "velocity      m/rad",
        "force         1/m",
    ] {
        assert!(table.lines().any(|line| line.starts_with(start)), "`{start}` in\n{table}");
    }
    assert!(!pose(&["--machine", "zx200", "--joints", "20,-80,-60"]).out.contains("moment arms"));
}

#[test]
fn three_links_in_line_are_named_and_what_still_is_is_printed() {
    // Outside its stroke the arm of frankel may stand stretched; its cylinder still moves it.
    let args = ["--machine", "frankel", "--joints", "0,0,0", "--rates", "--allow-outside", "--json"];
    let rates = pose(&args).json()["rates"].clone();
    assert_eq!(rates["singular"], serde_json::json!(["boom, arm and bucket are in line"]));
    assert_eq!(rates["condition_number"], Value::Null);
    assert_eq!(rates["force_ellipse"], Value::Null);
    assert!(number(&rates["moment_arms_m_per_rad"]["arm"]) < 0.0);
    let table = pose(&args[..6]).out;
    assert!(table.contains("singular: boom, arm and bucket are in line"), "{table}");
}

#[test]
fn rates_are_for_one_pose_not_for_a_csv() {
    let answer = hil_in(None, &["--machine", "exact-mini", "--csv", "-", "--rates"], b"boom_m,arm_m,bucket_m\n");
    let (kind, message) = answer.refusal();
    assert_eq!(kind, "invalid_input");
    assert_eq!(answer.err, format!("error: {message}\n"));
    assert!(message.contains("--rates") && message.contains("--csv"), "{message}");
}
