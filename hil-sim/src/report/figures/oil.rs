//! Pressures and flows of a hydraulic machine.

use firmware::io::SPOOLS;

use super::events::{RUNNING_KEY, moments, moments_key, running};
use super::lengths::capital;
use super::{Axis, Figure, Height, Key, Look, Mark, Panel, colours, values};
use crate::report::series::{Piece, over_time};
use crate::run::{Log, OilSeen};

const HEAD: Look = Look::Line(colours::BLUE, 1.5);
const ROD: Look = Look::Line(colours::ORANGE, 1.5);
const PUMP: Look = Look::Line(colours::GREY, 1.2);
/// Swing, boom, arm, bucket; a cylinder as in the tracking error.
const FUNCTIONS: [Look; 4] = [
    Look::Line(colours::PURPLE, 1.5),
    Look::Line(colours::BLUE, 1.5),
    Look::Line(colours::ORANGE, 1.5),
    Look::Line(colours::GREEN, 1.5),
];
const FUNCTION_NAMES: [&str; 4] = ["swing", "boom", "arm", "bucket"];
const DELIVERY: Look = Look::Line(colours::GREY, 1.5);

/// The figures of pressures and of flows, over the whole run from 0 until `until_s`; none of a plant without oil.
pub(in crate::report) fn figures(log: &Log, until_s: f64) -> Vec<Figure> {
    if log.inside.iter().any(|inside| inside.oil.is_some()) {
        vec![pressures(log, until_s), flows(log, until_s)]
    } else {
        Vec::new()
    }
}

fn line(log: &Log, of: impl Fn(&OilSeen) -> f64) -> Vec<Piece> {
    over_time(log.inside.iter().map(|inside| (inside.time_s, inside.oil.as_ref().map(&of))))
}

/// Functions that ever move; the cylinders always.
fn used(log: &Log) -> Vec<usize> {
    let moves =
        |i: &usize| log.inside.iter().filter_map(|inside| inside.oil).any(|oil| oil.flows_m3ps[*i].abs() > 1e-5);
    (0..4).filter(|i| *i > 0 || moves(i)).collect()
}

fn pressures(log: &Log, until_s: f64) -> Figure {
    let pump = line(log, |oil| oil.pump_pa * 1e-6);
    let mut panels: Vec<Panel> = used(log)
        .into_iter()
        .map(|i| {
            let [head, rod] = [0, 1].map(|side| line(log, |oil| oil.pressures_pa[i][side] * 1e-6));
            let y = Axis::around("[MPa]", values(&pump).chain(values(&head)).chain(values(&rod)).chain([0.0]));
            let mut marks = running(log, &y);
            marks.extend(moments(log, &y, false));
            marks.extend([Mark::Lines(pump.clone(), PUMP), Mark::Lines(rod, ROD), Mark::Lines(head, HEAD)]);
            let title = if i == 0 { "Swing motor".to_owned() } else { format!("{} cylinder", capital(SPOOLS[i])) };
            Panel { title, x: Axis::new("", 0.0, until_s), y, height: Height::Pixels(110.0), marks }
        })
        .collect();
    if let Some(last) = panels.last_mut() {
        last.x.name = "time [s]";
    }
    Figure {
        title: "Pressures",
        caption: "True pressures of the simulated machine, above the atmosphere: both sides of each function and the pump's gallery. A \
                  swing motor's sides are those that turn it to the left and to the right."
            .to_owned(),
        legend: [
            Key { look: HEAD, text: "head side (left)" },
            Key { look: ROD, text: "rod side (right)" },
            Key { look: PUMP, text: "pump" },
            RUNNING_KEY,
        ]
        .into_iter()
        .chain(moments_key(log))
        .collect(),
        panels,
    }
}

fn flows(log: &Log, until_s: f64) -> Figure {
    /// L/min in a m³/s.
    const LPM: f64 = 60e3;
    let used = used(log);
    let delivery = line(log, |oil| oil.pump_m3ps * LPM);
    let lines: Vec<(usize, Vec<Piece>)> = used.iter().map(|&i| (i, line(log, |oil| oil.flows_m3ps[i] * LPM))).collect();
    let taken = lines.iter().flat_map(|(_, line)| values(line));
    let y = Axis::around("flow [L/min]", values(&delivery).chain(taken).chain([0.0]));
    let mut marks = running(log, &y);
    marks.extend(moments(log, &y, true));
    marks.push(Mark::Lines(delivery, DELIVERY));
    marks.extend(lines.into_iter().map(|(i, line)| Mark::Lines(line, FUNCTIONS[i])));
    let keys = used.iter().map(|&i| Key { look: FUNCTIONS[i], text: FUNCTION_NAMES[i] });
    Figure {
        title: "Flows",
        caption: "What each function's filling side takes by its motion, extending (swing: to the left) upwards, and what the pump \
                  delivers."
            .to_owned(),
        legend: keys.chain([Key { look: DELIVERY, text: "delivery of the pump" }]).chain(moments_key(log)).collect(),
        panels: vec![Panel {
            title: String::new(),
            x: Axis::new("time [s]", 0.0, until_s),
            y,
            height: Height::Pixels(200.0),
            marks,
        }],
    }
}
