//! Frankel's second figure: cylinder lengths over time between their travel limits.

use kinematics_core::geometry::Stroke;
use plotters::style::text_anchor::{HPos, VPos};

use super::{Axis, Beside, Figure, Height, Key, Look, Mark, Panel, colours, values};
use crate::report::series::Piece;
use crate::travel::Violation;

const LIMIT: Look = Look::Line(colours::RED, 1.5);
const REFERENCE: Look = Look::Line(colours::ORANGE, 5.0);
const LENGTH: Look = Look::Line(colours::BLUE, 1.8);
const OUTSIDE: Look = Look::Filled(colours::RED, 0.22);

/// More amounts than these in a panel would stand in each other's way; the table has them all.
const MOST_AMOUNTS: usize = 6;

/// One cylinder over time, s and m.
#[derive(Clone, Debug)]
pub(in crate::report) struct Trace {
    /// Which.
    pub(in crate::report) cylinder: &'static str,
    /// Its travel limits.
    pub(in crate::report) stroke: Stroke,
    /// Its length.
    pub(in crate::report) length: Vec<Piece>,
    /// Where it should be.
    pub(in crate::report) reference: Vec<Piece>,
}

/// The figure of these cylinders from 0 until `until_s`, with every violation marked.
pub(in crate::report) fn figure(traces: &[Trace], until_s: f64, violations: &[Violation], caption: String) -> Figure {
    let mut legend = vec![Key { look: LENGTH, text: "length" }];
    if traces.iter().any(|trace| !trace.reference.is_empty()) {
        legend.push(Key { look: REFERENCE, text: "reference while digging" });
    }
    legend.push(Key { look: LIMIT, text: "travel limits" });
    if !violations.is_empty() {
        legend.push(Key { look: OUTSIDE, text: "outside" });
    }
    let last = traces.len().saturating_sub(1);
    let panels = traces.iter().enumerate().map(|(i, trace)| panel(trace, until_s, violations, i == last)).collect();
    Figure { title: "Cylinder lengths", caption, legend, panels }
}

fn panel(trace: &Trace, until_s: f64, violations: &[Violation], named: bool) -> Panel {
    let Stroke { min_m, max_m } = trace.stroke;
    let x = Axis::new(if named { "time [s]" } else { "" }, 0.0, until_s);
    // Room beyond the limits for a violation's amount.
    let room = if violations.is_empty() { 0.06 } else { 0.2 } * (max_m - min_m);
    let ends = [min_m - room, max_m + room];
    let y = Axis::around("length [m]", values(&trace.length).chain(values(&trace.reference)).chain(ends));

    let mut marks = Vec::new();
    for (i, violation) in violations.iter().filter(|v| v.cylinder == trace.cylinder).enumerate() {
        let [span, amount] = outside(violation, trace, &x, &y);
        marks.push(span);
        marks.extend((i < MOST_AMOUNTS).then_some(amount));
    }
    for limit in [min_m, max_m] {
        marks.push(Mark::Lines(vec![vec![(x.from, limit), (x.until, limit)]], LIMIT));
    }
    marks.push(Mark::Lines(trace.reference.clone(), REFERENCE));
    marks.push(Mark::Lines(trace.length.clone(), LENGTH));
    Panel {
        title: format!("{} cylinder, travel {min_m:.3}…{max_m:.3} m", capital(trace.cylinder)),
        x,
        y,
        height: Height::Pixels(150.0),
        marks,
    }
}

/// A violation: its span shaded, its amount beside it.
fn outside(violation: &Violation, trace: &Trace, x: &Axis, y: &Axis) -> [Mark; 2] {
    let Violation { from_s, until_s, by_m, .. } = *violation;
    // A short one must still be seen.
    let least = 0.004 * (x.until - x.from);
    let until_s = if until_s - from_s < least { from_s + least } else { until_s };
    let word = format!("{:+.1} mm", by_m * 1e3).replace('-', "−");
    let above = by_m > 0.0;
    let limit = if above { trace.stroke.max_m } else { trace.stroke.min_m };
    // Beside the span, towards the middle of the panel.
    let left = from_s + until_s < x.from + x.until;
    let beside = Beside(if left { HPos::Left } else { HPos::Right }, if above { VPos::Bottom } else { VPos::Top });
    let at = (if left { until_s } else { from_s }, limit);
    [Mark::Area([(from_s, y.from), (until_s, y.until)], OUTSIDE), Mark::Text(at, beside, colours::RED, word)]
}

/// With a capital letter, as headings have.
pub(super) fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
