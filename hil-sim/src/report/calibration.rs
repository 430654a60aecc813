//! The page of a calibration by command.

use std::fs;
use std::io;
use std::path::Path;

use super::figures::{Axis, Figure, Height, Key, Look, Mark, Panel, colours, svg, values};
use super::html::Page;
use super::series::{Piece, over_time};
use crate::service::calibrate::{Calibration, Sample, Search};

const CURRENT: Look = Look::Line(colours::BLUE, 1.4);
const SPEED: Look = Look::Line(colours::GREEN, 1.4);

/// Writes `calibration.html`, `calibration.json` and an SVG a spool into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_calibration(calibration: &Calibration, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("calibration.json"), serde_json::to_string_pretty(calibration)? + "\n")?;
    let mut page = Page::new("Valve calibration by command");
    page.note(super::SIMULATION);
    let rows: Vec<Vec<String>> = calibration
        .searches
        .iter()
        .flat_map(|search| &search.rows)
        .map(|row| {
            vec![
                row.spool.to_owned(),
                row.direction.to_owned(),
                format!("{:.2} %", 100.0 * row.dead_band),
                format!("{:.2} %", 100.0 * row.found_dead_band),
                format!("{:.3}", row.gain),
                format!("{:.3}", row.found_gain),
                format!("{:+.2} %", 100.0 * row.gain_error()),
            ]
        })
        .collect();
    page.table(&["spool", "direction", "dead band", "found", "gain", "found", "off"], &rows);
    for search in &calibration.searches {
        let figure = course(search);
        let drawn = svg(&figure)?;
        fs::write(folder.join(format!("{}.svg", search.spool)), &drawn)?;
        page.figure(figure.title, &figure.caption, &drawn);
    }
    fs::write(folder.join("calibration.html"), page.finish())
}

/// Current and speed of one search.
fn course(search: &Search) -> Figure {
    let line = |of: fn(&Sample) -> f64| -> Vec<Piece> {
        over_time(search.samples.iter().map(|sample| (sample.time_s, Some(of(sample)))))
    };
    let (current, speed) = (line(|s| s.current_a), line(|s| s.speed));
    let panel = |title: &str, x, y, line, look| Panel {
        title: title.to_owned(),
        x: Axis::new(x, 0.0, search.duration_s),
        y: Axis::around(y, values(line)),
        height: Height::Pixels(150.0),
        marks: vec![Mark::Lines(line.to_vec(), look)],
    };
    let unit = if search.spool == "swing" { "speed [rad/s or m/s]" } else { "speed [m/s]" };
    Figure {
        title: search.spool,
        caption: format!(
            "Current through the solenoids, extending positive, and the actuator's true speed; {}.",
            search.phase
        ),
        legend: vec![Key { look: CURRENT, text: "current" }, Key { look: SPEED, text: "speed" }],
        panels: vec![
            panel("Current", "", "current [A]", &current, CURRENT),
            panel("Speed", "time [s]", unit, &speed, SPEED),
        ],
    }
}
