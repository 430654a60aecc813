//! The report of a planar arm's runs: Park 2008's Figures 5 and 6 beside each other.

use std::fmt::Write;
use std::fs;
use std::io;
use std::path::Path;

use super::figures::{Axis, Beside, Figure, Height, Key, Look, Mark, Panel, beside, colours};
use super::html::Page;
use super::series::Point;
use crate::planar_arm::PlanarArm;
use crate::planar_arm::run::{Case, CaseSummary, Pose, Summary};

const LINK: Look = Look::Line(colours::GREY, 1.0);
const END_LINK: Look = Look::Line(colours::BLACK, 2.2);
const END_PIN: Look = Look::Dot(colours::BLACK, 3.5);
const TIP: Look = Look::Line(colours::SKY, 3.5);
const KEPT: Look = Look::Line(colours::RED, 1.5);
const OBSTACLE: Look = Look::Dot(colours::RED, 4.0);
const TARGET: Look = Look::Dot(colours::GREEN, 5.0);
const JOINTS: [(Look, &str); 4] = [
    (Look::Line(colours::BLUE, 2.0), "θ1"),
    (Look::Line(colours::ORANGE, 2.0), "θ2"),
    (Look::Line(colours::GREEN, 2.0), "θ3"),
    (Look::Line(colours::PURPLE, 2.0), "θ4"),
];
const DISTANCE: Look = Look::Line(colours::BLUE, 2.0);
const LEFT: Look = Look::Line(colours::GREEN, 2.0);

/// A figure of a case, with axes that hold every case.
type Draw = fn(&PlanarArm, &Case, &[&Case]) -> Figure;
/// What a line shows of a pose.
type Value = fn(&Pose) -> f64;

/// The arm is drawn after each so many iterations.
const EVERY: usize = 3;

/// Writes `report.html`, its figures `arm.svg`, `joints.svg` and `distance.svg`, `log.csv` and `summary.json` into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_planar_arm(scenario: &PlanarArm, cases: &[Case; 3], summary: &Summary, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("summary.json"), serde_json::to_string_pretty(summary)? + "\n")?;
    write_log(cases, &folder.join("log.csv"))?;
    let mut page = Page::new(&format!("Planar arm: {}", scenario.name));
    page.paragraph(&scenario.description);
    page.note(super::SIMULATION);
    let header = ["Run", "s_e, s_o, s_k", "Target", "Last distance", "Nearest to the obstacle"];
    page.table(&header, &summary.cases.iter().map(row).collect::<Vec<_>>());
    let [_, without, with] = cases;
    let drawn: [(&str, Draw); 3] = [("arm.svg", arm), ("joints.svg", joints), ("distance.svg", distance)];
    for (file, draw) in drawn {
        // Both with the axes that hold both.
        let both = [without, with];
        let (left, right) = (draw(scenario, without, &both), draw(scenario, with, &both));
        let svg = beside(&left, &right)?;
        fs::write(folder.join(file), &svg)?;
        page.figure(left.title, &left.caption, &svg);
    }
    fs::write(folder.join("report.html"), page.finish())
}

fn row(case: &CaseSummary) -> Vec<String> {
    let [s1, s2, s3, s4] = case.link_gains;
    vec![
        case.case.to_owned(),
        format!("{}; {}; {s1}, {s2}, {s3}, {s4}", case.end_effector_gain, case.obstacle_gain),
        said(case),
        format!("{:.3} m", case.final_distance_m),
        format!("{:.3} m", case.smallest_obstacle_distance_m),
    ]
}

fn said(case: &CaseSummary) -> String {
    case.settled_at_iteration.map_or_else(|| "not reached".to_owned(), |n| format!("reached, settled at iteration {n}"))
}

/// The summary as a table for people, and where the report is.
pub fn planar_arm_table(summary: &Summary, folder: &Path) -> String {
    let mut out = format!(
        "{}: {} iterations a run, {} m round the obstacle kept free\n",
        summary.scenario, summary.iterations, summary.keep_m
    );
    for case in &summary.cases {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "  {:<20} {:<32} {:.3} m from the target at the end, nearest to the obstacle {:.3} m",
            case.case,
            said(case),
            case.final_distance_m,
            case.smallest_obstacle_distance_m
        );
    }
    let _ = writeln!(out, "  {:<20} {}", "report", folder.display());
    out
}

/// A row an iteration of every run; the start is iteration 0.
fn write_log(cases: &[Case; 3], file: &Path) -> io::Result<()> {
    let mut csv = csv::Writer::from_path(file)?;
    let header = "case iteration theta1_rad theta2_rad theta3_rad theta4_rad tip_x_m tip_z_m obstacle_m target_m";
    csv.write_record(header.split(' '))?;
    for case in cases {
        for (iteration, pose) in case.poses.iter().enumerate() {
            let tip = pose.ends[3];
            let numbers = pose.joints_rad.into_iter().chain([tip.x, tip.z, pose.obstacle_m, pose.target_m]);
            let cells = [case.name.to_owned(), iteration.to_string()].into_iter();
            csv.write_record(cells.chain(numbers.map(|x| format!("{x:.9}"))))?;
        }
    }
    csv.flush()
}

fn title(case: &Case) -> String {
    let [s1, s2, ..] = case.parameters.links;
    format!("{}: s1 = {s1}, s2 = {s2}, s_o = {}", case.name, case.parameters.obstacle)
}

fn line(pose: &Pose) -> Vec<Point> {
    [(0.0, 0.0)].into_iter().chain(pose.ends.map(|end| (end.x, end.z))).collect()
}

fn arm(scenario: &PlanarArm, case: &Case, both: &[&Case]) -> Figure {
    let all = || {
        both.iter().flat_map(|case| case.poses.iter()).flat_map(line).chain([(scenario.target.x, scenario.target.z)])
    };
    let x = Axis::around("x [m]", all().map(|p| p.0));
    let y = Axis::around("z [m]", all().map(|p| p.1));
    let obstacle = scenario.obstacle.position;
    let circle: Vec<Point> = (0..=72)
        .map(|i| libm::sincos(f64::from(i) * core::f64::consts::TAU / 72.0))
        .map(|(sin, cos)| (obstacle.x + scenario.obstacle.keep_m * cos, obstacle.z + scenario.obstacle.keep_m * sin))
        .collect();
    let between = case.poses.iter().step_by(EVERY).map(line).collect();
    let ends: Vec<Vec<Point>> = case.poses.first().into_iter().chain(case.poses.last()).map(line).collect();
    let word = |at: &[Vec<Point>], last: bool| {
        let pose = if last { at.last() } else { at.first() };
        let tip = pose.and_then(|pose| pose.last()).copied().unwrap_or_default();
        Mark::Text(tip, Beside::BELOW, colours::BLACK, if last { "end" } else { "start" }.to_owned())
    };
    let marks = vec![
        Mark::Lines(between, LINK),
        Mark::Lines(ends.clone(), END_LINK),
        Mark::Dots(ends.iter().flatten().copied().collect(), END_PIN),
        Mark::Lines(vec![case.poses.iter().map(|pose| (pose.ends[3].x, pose.ends[3].z)).collect()], TIP),
        Mark::Lines(vec![circle], KEPT),
        Mark::Dots(vec![(obstacle.x, obstacle.z)], OBSTACLE),
        Mark::Dots(vec![(scenario.target.x, scenario.target.z)], TARGET),
        word(&ends, false),
        word(&ends, true),
    ];
    Figure {
        title: "The arm",
        caption: format!(
            "The arm after every {EVERY} iterations, the first and the last pose in black, and the tip's way. Left Park's Figure 5, \
             right Figure 6."
        ),
        legend: vec![
            Key { look: LINK, text: "arm" },
            Key { look: TIP, text: "way of the tip" },
            Key { look: TARGET, text: "target" },
            Key { look: OBSTACLE, text: "obstacle" },
            Key { look: KEPT, text: "kept free" },
        ],
        panels: vec![Panel { title: title(case), x, y, height: Height::EqualScale, marks }],
    }
}

/// A figure over the iterations; `of` gives each line.
fn history(case: &Case, both: &[&Case], name: &'static str, of: &[(Value, Look)], also: &[f64]) -> Panel {
    let all = both.iter().flat_map(|case| &case.poses).flat_map(|pose| of.iter().map(|(value, _)| value(pose)));
    let y = Axis::around(name, all.chain(also.iter().copied()));
    let x = Axis::new("iteration", 0.0, case.poses.len().saturating_sub(1) as f64);
    let lines = of.iter().map(|(value, look)| {
        let points = case.poses.iter().enumerate().map(|(i, pose)| (i as f64, value(pose))).collect();
        Mark::Lines(vec![points], *look)
    });
    Panel { title: title(case), x, y, height: Height::Pixels(260.0), marks: lines.collect() }
}

fn joints(_: &PlanarArm, case: &Case, both: &[&Case]) -> Figure {
    let angles: [Value; 4] = [
        |pose| pose.joints_rad[0].to_degrees(),
        |pose| pose.joints_rad[1].to_degrees(),
        |pose| pose.joints_rad[2].to_degrees(),
        |pose| pose.joints_rad[3].to_degrees(),
    ];
    let lines: Vec<_> = angles.into_iter().zip(JOINTS).map(|(of, (look, _))| (of, look)).collect();
    Figure {
        title: "Joint angles",
        caption: "Every joint's angle relative to the link before it, over the iterations.".to_owned(),
        legend: JOINTS.map(|(look, text)| Key { look, text }).to_vec(),
        panels: vec![history(case, both, "angle [°]", &lines, &[])],
    }
}

fn distance(scenario: &PlanarArm, case: &Case, both: &[&Case]) -> Figure {
    let lines: [(Value, Look); 2] = [(|pose| pose.obstacle_m, DISTANCE), (|pose| pose.target_m, LEFT)];
    let keep = scenario.obstacle.keep_m;
    let mut panel = history(case, both, "distance [m]", &lines, &[0.0]);
    panel.marks.push(Mark::Lines(vec![vec![(panel.x.from, keep), (panel.x.until, keep)]], KEPT));
    Figure {
        title: "Distances",
        caption: "The whole arm's distance from the obstacle, and the tip's from the target, over the iterations."
            .to_owned(),
        legend: vec![
            Key { look: DISTANCE, text: "arm to obstacle" },
            Key { look: LEFT, text: "tip to target" },
            Key { look: KEPT, text: "kept free" },
        ],
        panels: vec![panel],
    }
}
