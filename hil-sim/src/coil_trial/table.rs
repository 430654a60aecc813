//! The report as a table for people.

use super::{CoilReport, Step};

/// Milliseconds, or a dash.
pub(crate) fn ms(time_s: Option<f64>) -> String {
    time_s.map_or_else(|| "–".to_owned(), |time_s| format!("{:.0} ms", time_s * 1e3))
}

impl Step {
    /// Rise, overshoot, settling, steady error, as words.
    pub(crate) fn cells(&self) -> [String; 4] {
        [
            format!("{:.1} ms", self.rise_s * 1e3),
            format!("{:.1} %", self.overshoot * 1e2),
            format!("{:.0} ms", self.settling_s * 1e3),
            format!("{:+.1} mA", self.steady_error_a * 1e3),
        ]
    }
}

/// Heads of [`Step::cells`].
pub(crate) const STEP_HEADS: [&str; 4] = ["rise 10–90 %", "overshoot", "settled to 5 %", "steady error"];

impl CoilReport {
    /// Every figure, a line each.
    pub fn to_table(&self) -> String {
        let mut lines = vec![line(&[&["step of 0.3 → 1.0 A"], &STEP_HEADS[..]].concat())];
        for row in self.temperatures.iter().chain(&self.supplies) {
            let place = format!("{:.0} V {:.0} °C", row.supply_v, row.temperature_c);
            let [rise, overshoot, settled, steady] = row.step.cells();
            lines.push(line(&[&place, &rise, &overshoot, &settled, &steady]));
        }
        lines.push(line(&["dither of 0.05 A", "reached", "mean error"]));
        for row in &self.dither {
            let reached = format!("{:.3} A", row.reached_a);
            lines.push(line(&[
                &format!("{} Hz", row.frequency_hz),
                &reached,
                &format!("{:+.1} mA", row.mean_error_a * 1e3),
            ]));
        }
        lines.push(line(&["fault", "named after", "largest", "as"]));
        for row in &self.faults {
            let name = row.named.as_deref().unwrap_or("nothing");
            lines.push(line(&[row.case, &ms(row.time_s), &format!("{:.2} A", row.peak_a), name]));
        }
        lines.concat()
    }
}

/// The first cell wide, the others less.
fn line(cells: &[&str]) -> String {
    let rest: String = cells.iter().skip(1).map(|cell| format!("  {cell:<14}")).collect();
    let text = format!("{:<42}{rest}", cells.first().copied().unwrap_or_default());
    text.trim_end().to_owned() + "\n"
}
