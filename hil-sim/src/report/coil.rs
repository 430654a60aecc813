//! The page of the coil current loop.

use std::fs;
use std::io;
use std::path::Path;

use super::figures::{Axis, Figure, Height, Key, Look, Mark, Panel, colours, svg, values};
use super::html::Page;
use super::series::{Piece, over_time};
use crate::coil_trial::{CoilReport, STEP_HEADS, Sample, StepRow, ms};

const WANTED: Look = Look::Dashed(colours::GREY, 1.5);
const CURRENT: Look = Look::Line(colours::BLUE, 1.6);
const DUTY: Look = Look::Line(colours::ORANGE, 1.3);
const OVERSHOOT: Look = Look::Line(colours::PURPLE, 1.8);

/// Writes `coil.html` and `coil.json` into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_coil(report: &CoilReport, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("coil.json"), serde_json::to_string_pretty(report)? + "\n")?;
    let mut page = Page::new("Coil current loop");
    page.note(super::SIMULATION);
    let figures = [
        course("Step of the current", "From 0.3 to 1.0 A at 24 V and 20 °C.", &report.step_samples, 0.1),
        course(
            "Ramp and dither",
            "The jump over the dead band, a ramp of 2 A/s up and 4 A/s down, and 62.5 Hz of dither that fades with the current.",
            &report.dither_samples,
            f64::INFINITY,
        ),
        sweep(
            "Temperature",
            "The step from −40 to 120 °C of the winding at 24 V.",
            "winding [°C]",
            &report.temperatures,
            |row| row.temperature_c,
        ),
        sweep("Supply", "The step from 9 to 32 V at 20 °C.", "supply [V]", &report.supplies, |row| row.supply_v),
    ];
    for figure in figures {
        page.figure(figure.title, &figure.caption, &svg(&figure)?);
    }
    let steps: Vec<Vec<String>> = report
        .temperatures
        .iter()
        .chain(&report.supplies)
        .map(|row| {
            let place = [format!("{:.0}", row.supply_v), format!("{:.0}", row.temperature_c)];
            place.into_iter().chain(row.step.cells()).collect()
        })
        .collect();
    page.table(&[&["supply, V", "winding, °C"], &STEP_HEADS[..]].concat(), &steps);
    let dither: Vec<Vec<String>> = report
        .dither
        .iter()
        .map(|row| {
            let error = format!("{:+.1} mA", row.mean_error_a * 1e3);
            vec![row.frequency_hz.to_string(), format!("{:.3} A", row.reached_a), error]
        })
        .collect();
    page.table(&["dither of 0.05 A, Hz", "reached", "mean error"], &dither);
    let faults: Vec<Vec<String>> = report
        .faults
        .iter()
        .map(|row| {
            let name = row.named.clone().unwrap_or_else(|| "nothing".to_owned());
            vec![row.case.to_owned(), ms(row.time_s), format!("{:.2} A", row.peak_a), name]
        })
        .collect();
    page.table(&["fault", "named after", "largest current until then", "named"], &faults);
    fs::write(folder.join("coil.html"), page.finish())
}

/// Current and duty of the extending solenoid, from its beginning for `seconds`.
fn course(title: &'static str, caption: &str, samples: &[Sample], seconds: f64) -> Figure {
    let begin = samples.first().map_or(0.0, |sample| sample.time_s);
    let shown: Vec<&Sample> = samples.iter().filter(|sample| sample.time_s - begin < seconds).collect();
    let line = |of: fn(&Sample) -> f64| -> Vec<Piece> {
        over_time(shown.iter().map(|sample| (sample.time_s - begin, Some(of(sample)))))
    };
    let (wanted, current) = (line(|s| s.wanted_a[0]), line(|s| s.currents_a[0]));
    let duty = line(|s| f64::from(s.duties[0]) / 655.35);
    let until = shown.last().map_or(1.0, |sample| sample.time_s - begin);
    let currents = Panel {
        title: "Current".to_owned(),
        x: Axis::new("", 0.0, until),
        y: Axis::around("current [A]", values(&wanted).chain(values(&current))),
        height: Height::Pixels(200.0),
        marks: vec![Mark::Lines(wanted, WANTED), Mark::Lines(current, CURRENT)],
    };
    let duties = Panel {
        title: "Duty".to_owned(),
        x: Axis::new("time [s]", 0.0, until),
        y: Axis::new("duty [%]", 0.0, 102.0),
        height: Height::Pixels(110.0),
        marks: vec![Mark::Lines(duty, DUTY)],
    };
    Figure {
        title,
        caption: caption.to_owned(),
        legend: vec![
            Key { look: WANTED, text: "wanted, without dither" },
            Key { look: CURRENT, text: "current" },
            Key { look: DUTY, text: "duty" },
        ],
        panels: vec![currents, duties],
    }
}

/// Rise time and overshoot over something.
fn sweep(title: &'static str, caption: &str, axis: &'static str, rows: &[StepRow], of: fn(&StepRow) -> f64) -> Figure {
    let panel = |title: &str, axis: &'static str, name: &'static str, look: Look, value: fn(&StepRow) -> f64| {
        let line: Piece = rows.iter().map(|row| (of(row), value(row))).collect();
        let ends = line.first().zip(line.last()).map_or((0.0, 1.0), |(first, last)| (first.0, last.0));
        Panel {
            title: title.to_owned(),
            x: Axis::new(axis, ends.0, ends.1),
            y: Axis::around(name, line.iter().map(|point| point.1).chain([0.0])),
            height: Height::Pixels(110.0),
            marks: vec![Mark::Lines(vec![line], look)],
        }
    };
    let panels = vec![
        panel("Rise, 10 to 90 %", "", "rise [ms]", CURRENT, |row| row.step.rise_s * 1e3),
        panel("Overshoot", axis, "overshoot [%]", OVERSHOOT, |row| row.step.overshoot * 1e2),
    ];
    let legend = vec![Key { look: CURRENT, text: "rise time" }, Key { look: OVERSHOOT, text: "overshoot" }];
    Figure { title, caption: caption.to_owned(), legend, panels }
}
