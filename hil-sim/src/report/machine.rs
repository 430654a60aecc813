//! The page of a machine: workspace, moment arms, transmission, and its table.

use std::fs;
use std::io;
use std::path::Path;

use super::figures::{Axis, Figure, Height, Key, Look, Mark, Panel, colours, svg};
use super::html::Page;
use super::series::Point;
use crate::machine_file::MachineFile;
use crate::machine_report::MachineReport;
use crate::machine_report::levers::{Lever, Levers};

const EDGE: Look = Look::Line(colours::BLUE, 2.0);
const GROUND: Look = Look::Line(colours::EARTH, 2.0);
const PIN: Look = Look::Dot(colours::BLACK, 4.0);
const CURVE: Look = Look::Line(colours::BLUE, 1.8);

/// Writes `machine.html`, `workspace.svg` (its first figure alone) and `machine.json` into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_machine(file: &MachineFile, report: &MachineReport, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("machine.json"), serde_json::to_string_pretty(report)? + "\n")?;
    let mut page = Page::new(&format!("Machine: {}", report.machine));
    page.paragraph(&report.description);
    page.note("Computed from the machine file; nothing here was measured on a machine.");
    facts(&mut page, report);
    let first = workspace(file, report);
    let drawing = svg(&first)?;
    fs::write(folder.join("workspace.svg"), &drawing)?;
    page.figure(first.title, &first.caption, &drawing);
    let arms = curves(
        "Moment arms",
        "dL/dθ of each cylinder over its stroke, with its sign: force times moment arm is the joint's torque.",
        "dL/dθ [m/rad]",
        &report.levers,
        |lever| lever.moment_arm_m,
    );
    page.figure(arms.title, &arms.caption, &svg(&arms)?);
    let transmission = curves(
        "Transmission",
        "dθ/dL of each joint over its cylinder's stroke: cylinder speed times transmission is the joint's speed. It grows \
         without limit towards a dead point.",
        "dθ/dL [rad/m]",
        &report.levers,
        |lever| lever.transmission_rad_per_m,
    );
    page.figure(transmission.title, &transmission.caption, &svg(&transmission)?);
    fs::write(folder.join("machine.html"), page.finish())
}

fn facts(page: &mut Page, report: &MachineReport) {
    let table = report.to_table();
    let lines = table.lines().skip(1).map(str::trim);
    // Columns of the plain table stand two blanks apart; lines of prose have no second column.
    let rows: Vec<Vec<String>> = lines
        .map(|line| match line.split_once("  ") {
            Some((name, value)) => vec![name.to_owned(), value.trim().to_owned()],
            None => line.split_once(": ").map_or_else(
                || vec![String::new(), line.to_owned()],
                |(name, value)| vec![name.to_owned(), value.trim().to_owned()],
            ),
        })
        .collect();
    page.table(&["Of the machine", "Value"], &rows);
}

fn workspace(file: &MachineFile, report: &MachineReport) -> Figure {
    let closed: Vec<Point> =
        report.workspace.points_m.iter().chain(report.workspace.points_m.first()).map(|&[x, z]| (x, z)).collect();
    let pin = (file.geometry.boom_pin_x_m, 0.0);
    let ground = -file.boom_pin_height_m;
    let x = Axis::around("x, reach from the swing axis [m]", closed.iter().map(|p| p.0).chain([0.0, pin.0]));
    let y = Axis::around("z, height above the boom pin [m]", closed.iter().map(|p| p.1).chain([ground, 0.0]));
    let marks = vec![
        Mark::Lines(vec![vec![(x.from, ground), (x.until, ground)]], GROUND),
        Mark::Lines(vec![closed], EDGE),
        Mark::Dots(vec![pin], PIN),
    ];
    Figure {
        title: "Workspace of the tip",
        caption: "Everything the bucket tip reaches in the boom's vertical plane over the whole stroke of all three \
                  cylinders, whatever the bucket's pitch. Both axes have the same scale."
            .to_owned(),
        legend: vec![
            Key { look: EDGE, text: "outline" },
            Key { look: GROUND, text: "ground" },
            Key { look: PIN, text: "boom pin" },
        ],
        panels: vec![Panel { title: String::new(), x, y, height: Height::EqualScale, marks }],
    }
}

/// One panel a cylinder.
fn curves(title: &'static str, caption: &str, name: &'static str, all: &[Levers; 3], of: fn(&Lever) -> f64) -> Figure {
    let panels = all
        .iter()
        .map(|levers| {
            let line: Vec<Point> = levers.points.iter().map(|p| (p.length_m, of(p))).collect();
            let ends = line.first().zip(line.last()).map_or((0.0, 1.0), |(a, b)| (a.0, b.0));
            Panel {
                title: format!("{} cylinder", levers.cylinder),
                x: Axis::new("length [m]", ends.0, ends.1),
                y: Axis::around(name, line.iter().map(|p| p.1)),
                height: Height::Pixels(150.0),
                marks: vec![Mark::Lines(vec![line], CURVE)],
            }
        })
        .collect();
    Figure { title, caption: caption.to_owned(), legend: vec![Key { look: CURVE, text: title }], panels }
}
