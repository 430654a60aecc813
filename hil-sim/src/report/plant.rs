//! The page of a hydraulic plant, and its figure alone.

use std::fs;
use std::io;
use std::path::Path;

use super::figures::{Axis, Figure, Height, Key, Look, Mark, Panel, colours, svg, values};
use super::html::Page;
use super::series::{Piece, over_time};
use crate::plant_trial::{PlantReport, Sample, Stroke};

const LENGTH: Look = Look::Line(colours::BLUE, 1.8);
const HEAD: Look = Look::Line(colours::RED, 1.5);
const ROD: Look = Look::Line(colours::SKY, 1.5);
const GALLERY: Look = Look::Dashed(colours::GREY, 1.5);
const FLOW: Look = Look::Line(colours::ORANGE, 1.6);

/// Writes `plant.html`, `plant.json` and an SVG a cylinder into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_plant(report: &PlantReport, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("plant.json"), serde_json::to_string_pretty(report)? + "\n")?;
    let mut page = Page::new(&format!("Hydraulic plant of {}", report.machine));
    page.note(super::SIMULATION);
    for stroke in &report.strokes {
        let figure = course(stroke);
        let drawn = svg(&figure)?;
        let way = if stroke.extending { "extend" } else { "retract" };
        fs::write(folder.join(format!("{}-{way}.svg", stroke.cylinder)), &drawn)?;
        page.figure(&format!("{} {way}s at full lever", stroke.cylinder), &figure.caption, &drawn);
    }
    fs::write(folder.join("plant.html"), page.finish())
}

/// Length, pressures and flow of one stroke.
fn course(stroke: &Stroke) -> Figure {
    let samples = &stroke.samples;
    let line = |of: &dyn Fn(&Sample) -> f64| -> Vec<Piece> {
        over_time(samples.iter().map(|sample| (sample.time_s, Some(of(sample)))))
    };
    let until = samples.last().map_or(1.0, |sample| sample.time_s);
    let panel = |title: &str, x: &'static str, y: &'static str, height: f64, lines: Vec<(Vec<Piece>, Look)>| Panel {
        title: title.to_owned(),
        x: Axis::new(x, 0.0, until),
        y: Axis::around(y, lines.iter().flat_map(|(pieces, _)| values(pieces))),
        height: Height::Pixels(height),
        marks: lines.into_iter().map(|(pieces, look)| Mark::Lines(pieces, look)).collect(),
    };
    let pressure = |i: usize| line(&|sample: &Sample| sample.pressures_pa[i] * 1e-6);
    Figure {
        title: "A stroke at full lever",
        caption: "From the lever on: the cylinder's length, the pressures of its two sides and of the pump, and what the pump delivers."
            .to_owned(),
        legend: vec![
            Key { look: LENGTH, text: "length" },
            Key { look: HEAD, text: "head side" },
            Key { look: ROD, text: "rod side" },
            Key { look: GALLERY, text: "pump" },
            Key { look: FLOW, text: "delivery" },
        ],
        panels: vec![
            panel("Length", "", "length [m]", 130.0, vec![(line(&|sample| sample.position_m), LENGTH)]),
            panel(
                "Pressures",
                "",
                "pressure [MPa]",
                170.0,
                vec![(pressure(2), GALLERY), (pressure(0), HEAD), (pressure(1), ROD)],
            ),
            panel("Pump", "time [s]", "delivery [L/min]", 110.0, vec![(line(&|sample| sample.flow_m3ps * 6e4), FLOW)]),
        ],
    }
}
