//! The campaign's outcome as a figure: a line a fault, from the median to the largest, on logarithmic scales.

use std::fmt::Write;

use crate::faults::{KINDS, Report, Row, Spread};

const WIDTH: f64 = 1000.0;
const ROW: f64 = 19.0;
const TOP: f64 = 62.0;
const BOTTOM: f64 = 56.0;
/// Left ends of the two scales, and their length.
const PANELS: [f64; 2] = [190.0, 600.0];
const LENGTH: f64 = 370.0;
/// What both scales begin and end with, ms and mm; what is less stands at the beginning.
const FROM: f64 = 1.0;
const UNTIL: f64 = 10_000.0;
const SEEN: &str = "#0072B2";
const TRAVEL: &str = "#D55E00";
const LINES: &str = "#141414";

fn x(panel: usize, value: f64) -> f64 {
    let share = libm::log10(value.clamp(FROM, UNTIL) / FROM) / libm::log10(UNTIL / FROM);
    PANELS[panel] + share * LENGTH
}

/// The median as a dot, the way to the largest as a line.
fn measured(out: &mut String, panel: usize, y: f64, Spread { p50, max, .. }: Spread, colour: &str) {
    let (from, until) = (x(panel, p50), x(panel, max));
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "<path d=\"M{from:.1} {y} H{until:.1} m0 -4 v8\" stroke=\"{colour}\" stroke-width=\"2.5\" fill=\"none\"/>\n\
         <circle cx=\"{from:.1}\" cy=\"{y}\" r=\"4\" fill=\"{colour}\"/>"
    );
}

fn bound(out: &mut String, y: f64, row: &Row) {
    let Some(ms) = row.bound_ms else { return };
    let colour = if row.bound_held == Some(false) { "#CC0000" } else { LINES };
    let _ = writeln!(out, "<path d=\"M{:.1} {} v14\" stroke=\"{colour}\" stroke-width=\"2\"/>", x(0, ms), y - 7.0);
}

fn scale(out: &mut String, panel: usize, title: &str, bottom: f64) {
    let _ = writeln!(out, "<text x=\"{}\" y=\"24\" font-size=\"15\" font-weight=\"600\">{title}</text>", PANELS[panel]);
    for value in [1.0, 10.0, 100.0, 1000.0, 10_000.0] {
        let at = x(panel, value);
        let name = if value <= FROM { format!("≤ {value:.0}") } else { format!("{value:.0}") };
        let _ = writeln!(
            out,
            "<path d=\"M{at:.1} {} V{bottom}\" stroke=\"#CCCCCC\"/>\n\
             <text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{name}</text>",
            TOP - 12.0,
            TOP - 18.0
        );
    }
}

/// The figure.
pub fn drawing(report: &Report) -> String {
    let rows: Vec<&Row> = report.faults.iter().take(KINDS.len()).collect();
    let bottom = TOP + ROW * rows.len() as f64;
    let height = bottom + BOTTOM;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"Detection time and tip travel of every fault\" \
         width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n"
    );
    scale(&mut out, 0, "Detection, ms", bottom);
    scale(&mut out, 1, "Travel of the tip, mm", bottom);
    for (i, row) in rows.iter().enumerate() {
        let y = TOP + ROW * (i as f64 + 0.5);
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
            PANELS[0] - 14.0,
            y + 4.0,
            row.name.replace('_', " ")
        );
        bound(&mut out, y, row);
        if let Some(spread) = row.detect_ms {
            measured(&mut out, 0, y, spread, SEEN);
        }
        if let Some(spread) = row.tip_travel_mm {
            measured(&mut out, 1, y, spread, TRAVEL);
        }
        if row.undetected > 0 {
            let _ = writeln!(
                out,
                "<text x=\"{}\" y=\"{}\" fill=\"#CC0000\">missed {} of {}</text>",
                PANELS[1] + 8.0,
                y + 4.0,
                row.undetected,
                row.runs
            );
        }
    }
    let _ = writeln!(
        out,
        "<text x=\"{0}\" y=\"{1}\">Dot: median. Line: to the largest of all runs. Upright stroke: the promised bound (red: not held).</text>\n\
         <text x=\"{0}\" y=\"{2}\">{3}: {4} runs in simulation, {5} of them healthy, {6} false trips. No board was flashed.</text>",
        PANELS[0],
        bottom + 24.0,
        bottom + 42.0,
        report.machine,
        report.runs,
        report.healthy,
        report.false_trips
    );
    out.push_str("</svg>\n");
    out
}
