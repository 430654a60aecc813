//! When the application ran, when it faulted, when a stop held: the same marks in every panel over time.

use firmware::State;
use plotters::style::text_anchor::{HPos, VPos};

use super::{Axis, Beside, Key, Look, Mark, colours};
use crate::run::Log;

/// The span of `Running`.
pub(super) const RUNNING: Look = Look::Filled(colours::GREY, 0.13);
/// Entry of [`running`] in a legend.
pub(super) const RUNNING_KEY: Key = Key { look: RUNNING, text: "running" };
/// More words than these would cover the panel.
const MOST_WORDS: usize = 8;

/// Spans of the state `Running`, over the whole height of the axis.
pub(super) fn running(log: &Log, y: &Axis) -> Vec<Mark> {
    let stretches =
        log.rows.chunk_by(|a, b| (a.outputs.state == State::Running) == (b.outputs.state == State::Running));
    stretches
        .filter_map(|rows| {
            let (first, last) = (rows.first()?, rows.last()?);
            (first.outputs.state == State::Running)
                .then_some(Mark::Area([(first.time_s, y.from), (last.time_s, y.until)], RUNNING))
        })
        .collect()
}

/// A line at every fault and at every stop hit, with its name if `named`.
pub(super) fn moments(log: &Log, y: &Axis, named: bool) -> Vec<Mark> {
    let faults = log.faults.iter().map(|f| (f.at_s, f.fault.name().to_owned()));
    let hits = log.stop_hits.iter().map(|h| (h.at_s, format!("{} stop", h.cylinder)));
    let end_s = log.rows.last().map_or(0.0, |row| row.time_s);
    let mut marks = Vec::new();
    for (i, (at_s, name)) in faults.chain(hits).enumerate() {
        marks.push(Mark::Lines(vec![vec![(at_s, y.from), (at_s, y.until)]], Look::Line(colours::RED, 1.5)));
        if named && i < MOST_WORDS {
            // One below the other; with room for it after its moment, where the current is zero, else before.
            let height = y.part(0.92 - 0.12 * i as f64);
            let side = if at_s < 0.65 * end_s { HPos::Left } else { HPos::Right };
            marks.push(Mark::Text((at_s, height), Beside(side, VPos::Center), colours::RED, name));
        }
    }
    marks
}

/// Entry of [`moments`] in a legend, if there are any.
pub(super) fn moments_key(log: &Log) -> Option<Key> {
    let any = !(log.faults.is_empty() && log.stop_hits.is_empty());
    any.then_some(Key { look: Look::Line(colours::RED, 1.5), text: "fault or stop hit" })
}
