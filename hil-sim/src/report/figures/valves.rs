//! What the coils are asked to carry and what their windings carry, and in which state.

use firmware::io::SPOOLS;

use super::events::{RUNNING_KEY, moments, moments_key, running};
use super::lengths::capital;
use super::{Axis, Figure, Height, Key, Look, Mark, Panel, colours, values};
use crate::report::series::over_time;
use crate::run::{Log, Row};

const CURRENT: Look = Look::Line(colours::BLUE, 2.4);
const WINDING: Look = Look::Line(colours::ORANGE, 1.0);

/// The figure, over the whole run from 0 until `until_s`; spools that never get any current are left out.
pub(in crate::report) fn figure(log: &Log, until_s: f64) -> Figure {
    let used = |spool: &usize| log.rows.iter().any(|row| signed_current_a(row, *spool) != 0.0);
    let mut spools: Vec<usize> = (0..SPOOLS.len()).filter(used).collect();
    if spools.is_empty() {
        // Three flat lines say so better than no figure.
        spools = vec![1, 2, 3];
    }
    let mut panels: Vec<Panel> =
        spools.iter().enumerate().map(|(place, &spool)| panel(log, until_s, spool, place == 0)).collect();
    if let Some(last) = panels.last_mut() {
        last.x.name = "time [s]";
    }
    let idle: Vec<&str> = (0..SPOOLS.len()).filter(|s| !spools.contains(s)).map(|s| SPOOLS[s]).collect();
    let idle = if idle.is_empty() { String::new() } else { format!(" No current at any time: {}.", idle.join(", ")) };
    Figure {
        title: "Coil currents",
        caption: format!(
            "Currents of each spool, the extending solenoid upwards, the retracting one downwards: what the controller asks \
             for, and what truly flows in the simulated windings, looked at every 5 ms. Current flows only while the supervisor \
             is in the state running.{idle}"
        ),
        legend: [Key { look: CURRENT, text: "asked" }, Key { look: WINDING, text: "in the windings" }, RUNNING_KEY]
            .into_iter()
            .chain(moments_key(log))
            .collect(),
        panels,
    }
}

/// Extend − retract, A; at most one of them is not zero.
fn signed_current_a(row: &Row, spool: usize) -> f64 {
    let [extend, retract] = row.outputs.currents[spool];
    f64::from(extend) - f64::from(retract)
}

fn panel(log: &Log, until_s: f64, spool: usize, named: bool) -> Panel {
    let current = over_time(log.rows.iter().map(|row| (row.time_s, Some(signed_current_a(row, spool)))));
    let winding = over_time(log.inside.iter().map(|inside| {
        let [extend, retract] = inside.coils_a[spool];
        (inside.time_s, Some(extend - retract))
    }));
    let y = Axis::around("current [A]", values(&current).chain(values(&winding)).chain([0.0]));
    let mut marks = running(log, &y);
    marks.extend(moments(log, &y, named));
    let zero = vec![vec![(0.0, 0.0), (until_s, 0.0)]];
    marks.push(Mark::Lines(zero, Look::Line(colours::GREY, 1.0)));
    marks.push(Mark::Lines(current, CURRENT));
    marks.push(Mark::Lines(winding, WINDING));
    let title = format!("{} spool", capital(SPOOLS[spool]));
    Panel { title, x: Axis::new("", 0.0, until_s), y, height: Height::Pixels(120.0), marks }
}
