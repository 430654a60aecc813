//! The real `hil score` on a plant that no tuning has used, with everything it is compared with.

use std::process::Command;

use serde_json::Value;

fn score(args: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_hil")).arg("score").args(args).output().expect("the command starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON on standard output, alone")
}

#[test]
fn a_held_out_plant_is_named_and_on_it_ours_is_better_than_what_it_is_compared_with() {
    let report = score(&["--seeds", "1", "--json", "-"]);
    assert_eq!((&report["plants"], &report["plant_seeds"]), (&"held_out".into(), &serde_json::json!([0x5c0e_0000])));
    let rows = report["tasks"].as_array().expect("tasks");
    assert_eq!(rows.len(), 10);
    for row in rows {
        let m = |key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key} in {row}"));
        println!(
            "{} at {} m/s: ours {:.4} m, baseline {:.4}, uncalibrated {:.4}, half the flow {:.4}",
            row["name"],
            m("speed_mps"),
            m("rmse_m"),
            m("baseline_rmse_m"),
            m("uncalibrated_rmse_m"),
            m("half_flow_rmse_m")
        );
        assert_eq!((&row["completed"], &row["still_at_rest"]), (&1.into(), &1.into()), "{row}");
        assert!(m("rmse_m") < m("p95_m") && m("p95_m") < m("max_m"), "{row}");
        assert_eq!(m("baseline_rmse_m"), m("open_loop_rmse_m").min(m("proportional_rmse_m")));
        assert!(m("rmse_m") < 0.9 * m("baseline_rmse_m"), "{row}");
        // Less flow may cost time, not the path.
        assert!(m("half_flow_rmse_m") <= 1.1 * m("rmse_m") && m("half_flow_max_m") <= 1.1 * m("max_m"), "{row}");
        assert!(row["by_plant"][0]["half_flow_fault"].is_null(), "{row}");
        // A map of another plant costs something and ends nothing.
        assert!(m("uncalibrated_rmse_m") < 0.1 && m("uncalibrated_max_m") > m("uncalibrated_rmse_m"), "{row}");
    }
}

#[test]
fn a_part_of_a_score_of_ours_alone_on_plants_to_tune_on_says_so() {
    let report = score(&["--seeds", "1", "--tuning", "--alone", "--shard", "4/10", "--json", "-"]);
    assert_eq!((&report["plants"], &report["plant_seeds"]), (&"tuning".into(), &serde_json::json!([1])));
    let rows = report["tasks"].as_array().expect("tasks");
    let scored: Vec<&Value> = rows.iter().filter(|row| row["plants"] == 1).collect();
    let [row] = scored[..] else { panic!("{rows:?}") };
    assert_eq!((&row["name"], &row["speed_mps"]), (&"vertical_cut".into(), &0.3.into()));
    for key in ["baseline_rmse_m", "open_loop_rmse_m", "proportional_rmse_m", "uncalibrated_rmse_m", "half_flow_max_m"]
    {
        assert!(row[key].is_null(), "{key}: {row}");
    }
}
