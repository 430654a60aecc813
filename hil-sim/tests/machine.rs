//! `hil machine`: the figures against what is published of the machines, the outline against random poses, the files.

use std::path::Path;
use std::process::{Command, Output};

use hil_sim::machine_file::MachineFile;
use hil_sim::machine_report::MachineReport;
use kinematics_core::{Cylinders, Machine, Rotor};
use serde_json::Value;

const MACHINES: [&str; 4] = ["frankel", "exact-mini", "zx120", "zx200"];

fn report(name: &str) -> (MachineFile, MachineReport) {
    let file = MachineFile::load(name).unwrap();
    let report = MachineReport::new(&file, 0.01, |_, _| {}).unwrap();
    (file, report)
}

fn hil_machine(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hil"))
        .arg("machine")
        .args(arguments)
        .arg("--report")
        .arg(folder)
        .output()
        .expect("the command starts")
}

#[test]
fn the_levers_of_zx200_are_those_published() {
    let (_, report) = report("zx200");
    let [boom, _, bucket] = &report.levers;
    // Boom: 0.759 m near −4°, 0.337 m at +70°; bucket from 0.49 to 0.10 m over the stroke.
    let most = boom.points.iter().max_by(|a, b| a.moment_arm_m.total_cmp(&b.moment_arm_m)).unwrap();
    assert!((most.moment_arm_m - 0.759).abs() < 5e-4 && (most.joint_deg + 4.0).abs() < 1.0, "{most:?}");
    assert!((boom.points.last().unwrap().moment_arm_m - 0.337).abs() < 5e-4);
    assert!((bucket.largest_m - 0.49).abs() < 5e-3 && (bucket.smallest_m - 0.10).abs() < 5e-3, "{bucket:?}");
    // 1 mm of boom stroke is 12 to 17 mm at the tip of a 20 t machine, 9 m out.
    let boom_mm = report.sweep.sensitivity[0].at_full_reach;
    assert!((12.0..17.0).contains(&boom_mm), "{boom_mm}");
}

#[test]
fn moment_arm_times_transmission_is_one_everywhere() {
    for name in MACHINES {
        for levers in &report(name).1.levers {
            assert_eq!(levers.points.len(), 201);
            for p in &levers.points {
                assert!((p.moment_arm_m * p.transmission_rad_per_m - 1.0).abs() < 1e-12, "{name}: {p:?}");
            }
        }
    }
}

/// Whether a point lies inside a polygon: crossings of a ray.
fn inside(polygon: &[[f64; 2]], [x, z]: [f64; 2]) -> bool {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    edges.filter(|([x1, z1], [x2, z2])| (*z1 > z) != (*z2 > z) && x < x1 + (z - z1) / (z2 - z1) * (x2 - x1)).count() % 2
        == 1
}

#[test]
fn every_tip_lies_inside_the_outline_or_within_a_bin_of_it() {
    for name in MACHINES {
        let (file, report) = report(name);
        let g = &file.geometry;
        let machine = Machine::<f64>::new(g).unwrap();
        let outline = &report.workspace;
        assert!(!outline.has_gaps, "{name}");
        // A bin of distance, and as much along the arc where the outline bends within a bin.
        let bin = 3.0 * (outline.farthest_m - outline.nearest_m) / 160.0;
        let near = |[x, z]: [f64; 2]| outline.points_m.iter().any(|p| libm::hypot(p[0] - x, p[1] - z) < bin);
        let part = |i: u32, stride: u32| f64::from(i * stride % 1009) / 1008.0;
        for i in 0..1009 {
            let at = |stroke: kinematics_core::geometry::Stroke, stride| {
                stroke.min_m + part(i, stride) * (stroke.max_m - stroke.min_m)
            };
            let lengths =
                Cylinders { boom: at(g.boom.stroke, 1), arm: at(g.arm.stroke, 37), bucket: at(g.bucket.stroke, 411) };
            let tip = machine.cylinders_to_tip(&lengths, Rotor::IDENTITY).unwrap().plane;
            let point = [tip.reach, tip.height];
            assert!(inside(&outline.points_m, point) || near(point), "{name}: {point:?} at {lengths:?}");
        }
        // And it is no larger than the farthest tip.
        let radius = |p: &[f64; 2]| libm::hypot(p[0] - g.boom_pin_x_m, p[1]);
        assert!(outline.points_m.iter().all(|p| radius(p) <= outline.farthest_m + 1e-9), "{name}");
        assert!(outline.farthest_m <= g.reach_m());
    }
}

#[test]
fn a_sensor_of_the_given_resolution_keeps_its_third_of_the_accuracy() {
    for name in MACHINES {
        let (_, report) = report(name);
        for one in &report.sweep.sensitivity {
            assert!((one.resolution_m * one.worst * 3.0 - 0.01).abs() < 1e-12, "{name}: {one:?}");
            assert!(one.at_full_reach <= one.worst && one.at_full_reach > 0.0);
        }
        assert!(report.sweep.single_precision.of_reach < 1e-6, "{name}");
        assert!(report.sweep.single_precision.worst_m > 0.0);
    }
}

#[test]
fn the_command_prints_draws_and_writes_json() {
    let folder = tempfile::tempdir().unwrap();
    let output = hil_machine(&["zx120", "--json", "-"], folder.path());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["machine"], "zx120");
    for key in ["workspace", "levers", "isotropy", "sensitivity", "single_precision", "wanted_accuracy_m"] {
        assert!(!json[key].is_null(), "{key}");
    }
    let page = std::fs::read_to_string(folder.path().join("machine.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 3);
    assert!(page.contains("<polyline") && !page.contains("NaN") && !page.contains("inf,"));
    assert!(folder.path().join("workspace.svg").is_file() && folder.path().join("machine.json").is_file());
    let people = hil_machine(&["zx120"], folder.path());
    assert!(String::from_utf8_lossy(&people.stdout).contains("1 mm of boom stroke"));
}

#[test]
fn an_unknown_machine_or_accuracy_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, named) in [
        (&["no-such"][..], "no-such"),
        (&["zx120", "--tip-accuracy", "0"][..], "--tip-accuracy"),
        (&["zx120", "--tip-accuracy", "nan"][..], "--tip-accuracy"),
    ] {
        let output = hil_machine(arguments, folder.path());
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        assert!(String::from_utf8_lossy(&output.stderr).contains(named));
    }
}
