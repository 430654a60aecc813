//! How long a tick takes: counted by the emulator, or by this computer's noisy clock.

use super::{Axis, Figure, Height, Key, Look, Mark, Numbers, Panel, colours, values};
use crate::place::Timing;
use crate::report::series::over_time;
use crate::run::Log;

const COUNT: Look = Look::Line(colours::BLUE, 1.2);
const TICKS: Look = Look::Filled(colours::SKY, 1.0);
const MOST_BINS: usize = 60;
/// A bar of one tick must be seen on an axis of logarithms, which has no zero.
const FLOOR: f64 = -0.3;
/// ns
const PERIOD_NS: f64 = 1e9 / firmware::TICKS_PER_S as f64;

/// The figure of the place the run was on, over the whole run from 0 until `until_s`; `None` without a tick.
pub(in crate::report) fn figure(log: &Log, until_s: f64) -> Option<Figure> {
    let mut host = Vec::new();
    let mut emulator = Vec::new();
    for timing in &log.timing {
        match *timing {
            Timing::Host { wall_ns } => host.push(wall_ns),
            Timing::Emulator { started_ns, instructions } => emulator.push((started_ns, instructions)),
        }
    }
    match (host.is_empty(), emulator.is_empty()) {
        (true, true) => None,
        (false, _) => Some(on_host(host)),
        (true, false) => Some(on_emulator(log, &emulator, until_s)),
    }
}

fn on_host(mut wall_ns: Vec<u32>) -> Figure {
    wall_ns.sort_unstable();
    // The slowest in two hundred are the computer's doing, and would leave the others a single bar.
    let shown = &wall_ns[..wall_ns.len() - wall_ns.len() / 200];
    let (median, longest) = (wall_ns[wall_ns.len() / 2], wall_ns[wall_ns.len() - 1]);
    let (left_out, most) = (wall_ns.len() - shown.len(), shown[shown.len() - 1]);
    let beyond = if left_out == 0 {
        String::new()
    } else {
        format!(" {left_out} ticks above {most} ns are not drawn; the longest took {:.1} µs.", f64::from(longest) / 1e3)
    };
    Figure {
        title: "Tick timing",
        caption: format!(
            "Wall clock of Ecu::tick on this computer: noisy, and nothing that holds for the ECU. Half the ticks \
             took no more than {median} ns.{beyond} Instruction counts of the ECU's processor come from a run with \
             --on emulator."
        ),
        legend: vec![Key { look: TICKS, text: "ticks" }],
        panels: vec![histogram("Wall clock of a tick on this computer (noisy)", "wall clock [ns]", shown)],
    }
}

fn on_emulator(log: &Log, measured: &[(u32, u32)], until_s: f64) -> Figure {
    let times = log.rows.iter().map(|row| row.time_s);
    let counts = over_time(times.clone().zip(measured).map(|(t, &(_, n))| (t, Some(f64::from(n)))));
    let over = |name, line: Vec<_>, title: &str, x: &'static str| {
        let y = Axis::around(name, values(&line));
        let marks = vec![Mark::Lines(line, COUNT)];
        Panel { title: title.to_owned(), x: Axis::new(x, 0.0, until_s), y, height: Height::Pixels(130.0), marks }
    };
    let mut sorted: Vec<u32> = measured.iter().map(|&(_, n)| n).collect();
    sorted.sort_unstable();
    let deviations = measured.windows(2).map(|pair| f64::from(pair[1].0.wrapping_sub(pair[0].0)) - PERIOD_NS);
    let deviations: Vec<f64> = deviations.collect();
    let period = over_time(times.skip(1).zip(&deviations).map(|(t, &d)| (t, Some(d))));
    let at_most = deviations.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let jitter = at_most - deviations.iter().copied().fold(f64::INFINITY, f64::min);
    let jitter =
        if jitter.is_finite() { format!(" The starts of ticks vary by {jitter:.0} ns.") } else { String::new() };
    Figure {
        title: "Tick timing",
        caption: format!(
            "Counted on the emulated Cortex-M4F, whose instructions take the same virtual time each: exact counts, \
             but no cycles of a real ECU. Half the ticks take no more than {} instructions, the longest {}.{jitter}",
            sorted[sorted.len() / 2],
            sorted[sorted.len() - 1]
        ),
        legend: vec![Key { look: COUNT, text: "each tick" }, Key { look: TICKS, text: "ticks" }],
        panels: vec![
            over("instructions", counts, "Instructions of a tick", ""),
            over("ns", period, "Distance from the tick before, beyond 1 ms", "time [s]"),
            histogram("How many ticks take how many instructions", "instructions", &sorted),
        ],
    }
}

/// How often each value occurs, on a logarithmic scale so that rare ones show; `sorted` has at least one.
fn histogram(title: &str, name: &'static str, sorted: &[u32]) -> Panel {
    let (low, high) = (sorted[0], sorted[sorted.len() - 1]);
    let width = (high - low) as usize / MOST_BINS + 1;
    let mut bins = vec![0_u32; (high - low) as usize / width + 1];
    for value in sorted {
        bins[(value - low) as usize / width] += 1;
    }
    let edge = |bin: usize| f64::from(low) + (bin * width) as f64 - 0.5;
    let bars = bins
        .iter()
        .enumerate()
        .filter(|(_, ticks)| **ticks > 0)
        .map(|(bin, &ticks)| Mark::Area([(edge(bin), FLOOR), (edge(bin + 1), libm::log10(ticks.into()))], TICKS));
    let most = bins.iter().copied().max().unwrap_or(1);
    let y = Axis {
        numbers: Numbers::PowersOfTen,
        ..Axis::new("number of ticks", FLOOR, libm::ceil(libm::log10(f64::from(most) * 1.2)))
    };
    let marks = bars.collect();
    Panel {
        title: title.to_owned(),
        x: Axis::around(name, [edge(0), edge(bins.len())].into_iter()),
        y,
        height: Height::Pixels(160.0),
        marks,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bars_of_a_histogram_count_every_value_once() {
        let sorted: Vec<u32> = (1000..3000).chain([3000; 8000]).collect();
        let panel = histogram("", "instructions", &sorted);
        let counted: f64 = panel
            .marks
            .iter()
            .map(|mark| match mark {
                Mark::Area([_, (_, top)], _) => libm::exp10(*top),
                _ => panic!("only bars"),
            })
            .sum();
        assert!((counted - 10_000.0).abs() < 1e-6 && panel.marks.len() <= MOST_BINS + 1);
    }
}
