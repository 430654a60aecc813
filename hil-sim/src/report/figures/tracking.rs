//! How well a dig, move or path is followed: tip and cylinders.

use super::events::{RUNNING_KEY, moments, moments_key, running};
use super::lengths::capital;
use super::{Axis, Figure, Height, Look, Mark, Panel, colours, values};
use crate::report::csv::lengths;
use crate::report::series::over_time;
use crate::run::{Log, Row};

const TIP: Look = Look::Line(colours::BLACK, 1.5);
/// Boom, arm, bucket.
const CYLINDERS: [Look; 3] =
    [Look::Line(colours::BLUE, 1.5), Look::Line(colours::ORANGE, 1.5), Look::Line(colours::GREEN, 1.5)];

/// The figure, over the whole run from 0 until `until_s`.
pub(in crate::report) fn figure(log: &Log, until_s: f64) -> Figure {
    let tip = over_time(log.rows.iter().map(|row| (row.time_s, row.tip_error_m().map(|e| e * 1e3))));
    let mut y = Axis::around("error [mm]", values(&tip).chain([0.0]));
    y.from = 0.0;
    let mut panels =
        vec![panel("Bucket tip, |reference − true tip|".to_owned(), log, until_s, y, Mark::Lines(tip, TIP))];
    for (i, (cylinder, look)) in ["boom", "arm", "bucket"].into_iter().zip(CYLINDERS).enumerate() {
        let error = over_time(log.rows.iter().map(|row| (row.time_s, cylinder_error_mm(row, i))));
        let y = Axis::around("error [mm]", values(&error).chain([0.0]));
        let title = format!("{} cylinder, reference − true length", capital(cylinder));
        panels.push(panel(title, log, until_s, y, Mark::Lines(error, look)));
    }
    if let Some(last) = panels.last_mut() {
        last.x.name = "time [s]";
    }
    Figure {
        title: "Tracking error",
        caption:
            "While a dig, move or path is followed: distance of the simulated machine's true tip from where it should be at \
                  that moment, and each cylinder's true length against its reference. Each panel has its own scale."
                .to_owned(),
        legend: [RUNNING_KEY].into_iter().chain(moments_key(log)).collect(),
        panels,
    }
}

fn panel(title: String, log: &Log, until_s: f64, y: Axis, line: Mark) -> Panel {
    let mut marks = running(log, &y);
    marks.extend(moments(log, &y, false));
    marks.push(line);
    Panel { title, x: Axis::new("", 0.0, until_s), y, height: Height::Pixels(105.0), marks }
}

/// Reference − true length of cylinder `i`, mm; `None` when not digging.
fn cylinder_error_mm(row: &Row, i: usize) -> Option<f64> {
    let outputs = &row.outputs;
    (outputs.dig_tick > 0).then(|| (f64::from(lengths(&outputs.reference)[i]) - lengths(&row.lengths)[i]) * 1e3)
}
