//! The report of a run.

use std::fs;
use std::io;
use std::path::Path;

use firmware::dig::Dig;
use kinematics_core::Machine;

use super::csv::{lengths, write_log};
use super::figures::linkage::Motion;
use super::figures::{self, Figure, avoidance, fence, linkage, oil, svg, svg_with_cursors, timing, tracking, valves};
use super::html::Page;
use super::motion;
use super::series::{Point, over_time};
use crate::fence::Watch;
use crate::run::{Log, ReachSeen, Summary};
use crate::scenario::Scenario;

/// Writes `report.html`, `linkage.svg` (that figure alone; with a target also `avoidance.svg`), `log.csv` and `summary.json` into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write(scenario: &Scenario, log: &Log, summary: &Summary, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("summary.json"), serde_json::to_string_pretty(summary)? + "\n")?;
    write_log(log, &folder.join("log.csv"))?;

    let mut page = Page::new(&format!("Simulated run: {}", scenario.name));
    page.paragraph(&scenario.description);
    page.note(super::SIMULATION);
    alarms(&mut page, summary);
    // Loading the scenario has checked the geometry.
    let machine = Machine::new(&scenario.machine.geometry).map_err(io::Error::other)?;
    if let Some(stage) = motion::stage(scenario, &machine, log)? {
        page.beside(&stage, motion::PLAYER);
    }
    page.facts(&facts(scenario, summary));
    for (name, figure) in figures(scenario, &machine, log) {
        if let Some(name) = name {
            fs::write(folder.join(name), svg(&figure)?)?;
        }
        page.figure(figure.title, &figure.caption, &svg_with_cursors(&figure)?);
    }
    fs::write(folder.join("report.html"), page.finish())
}

/// The figures, each with the name of the file it also gets.
fn figures(scenario: &Scenario, machine: &Machine<f64>, log: &Log) -> Vec<(Option<&'static str>, Figure)> {
    let until_s = scenario.duration_s;
    let mut all = Vec::new();
    // A run in which no path was followed has no error to draw.
    if log.rows.iter().any(|row| row.tip_error_m().is_some()) {
        all.push((None, tracking::figure(log, until_s)));
    }
    all.extend(oil::figures(log, until_s).into_iter().map(|figure| (None, figure)));
    all.push((None, valves::figure(log, until_s)));
    if let Some(seen) = ReachSeen::of(scenario, log) {
        let drawn = avoidance::Drawn {
            chain: machine.chain(),
            samples: &seen.samples,
            obstacles: &seen.obstacles,
            target: seen.target,
        };
        all.push((Some("avoidance.svg"), avoidance::figure(&drawn)));
    }
    if let (Some(watch), Some(fence)) = (Watch::of(scenario), &scenario.parameters.fence) {
        all.push((Some("fence.svg"), fence::figure(&watch, fence, log, until_s)));
        all.push((None, fence::speeds(log, until_s)));
    }
    all.extend([(None, lengths_figure(scenario, log)), (Some("linkage.svg"), linkage_figure(scenario, machine, log))]);
    all.extend(timing::figure(log, until_s).map(|figure| (None, figure)));
    all
}

fn linkage_figure(scenario: &Scenario, machine: &Machine<f64>, log: &Log) -> Figure {
    let dig = scenario.parameters.dig.as_ref().map(Dig::new);
    // Standing still before and after the dig adds nothing to a path.
    let digging = log.rows.iter().filter(|row| row.outputs.dig_tick > 0).map(|row| row.joints);
    let mut joints: Vec<_> = digging.collect();
    if joints.is_empty() {
        joints = log.rows.iter().map(|row| row.joints).collect();
    }
    linkage::figure(&Motion {
        machine,
        ground_z_m: -scenario.machine.boom_pin_height_m,
        reference: dig.as_ref().map_or_else(Vec::new, reference),
        joints,
        outside: Vec::new(),
        caption: "Paths of elbow, wrist and bucket tip of the simulated machine in the boom's vertical plane while \
                  digging, or all of the run where there is no dig, the linkage at even steps of time (first and last in \
                  black), and the path the tip of a dig should take. Both axes have the same scale."
            .to_owned(),
    })
}

/// The tip's wanted path, in steps fine enough for a smooth line.
pub(super) fn reference(dig: &Dig<f64>) -> Vec<Option<Point>> {
    let steps = 4000;
    let at = |i: u32| dig.tip(dig.duration() * f64::from(i) / f64::from(steps));
    (0..=steps).map(at).map(|tip| Some((tip.reach, tip.height))).collect()
}

fn lengths_figure(scenario: &Scenario, log: &Log) -> Figure {
    let strokes = scenario.parameters.cylinder_sensors.map(|sensor| sensor.stroke);
    let names = ["boom", "arm", "bucket"].into_iter().zip(strokes).enumerate();
    let traces: Vec<_> = names
        .map(|(i, (cylinder, stroke))| figures::lengths::Trace {
            cylinder,
            stroke,
            length: over_time(log.rows.iter().map(|row| (row.time_s, Some(lengths(&row.lengths)[i])))),
            reference: over_time(log.rows.iter().map(|row| {
                let reference = f64::from(lengths(&row.outputs.reference)[i]);
                (row.time_s, (row.outputs.dig_tick > 0).then_some(reference))
            })),
        })
        .collect();
    let caption = "True lengths of the simulated cylinders between their pins, over the reference the controller \
                   follows while digging. The red lines are the travel limits.";
    figures::lengths::figure(&traces, scenario.duration_s, &[], caption.to_owned())
}

fn alarms(page: &mut Page, summary: &Summary) {
    let faults = summary.faults.iter().flatten();
    let faults: Vec<_> = faults.map(|f| format!("{} (code {}) at {:.3} s", f.fault, f.code, f.at_s)).collect();
    page.alarm("Faults", &faults);
    let hits = summary.stop_hits.iter().flatten();
    let hits: Vec<_> = hits.map(|h| format!("{} cylinder at {:.3} s", h.cylinder, h.at_s)).collect();
    page.alarm("Travel stops hit", &hits);
}

fn facts<'a>(scenario: &Scenario, summary: &Summary) -> Vec<(&'a str, String)> {
    let yes_no = |yes| if yes { "yes" } else { "no" }.to_owned();
    let millimetres = |metres: f64| format!("{:.1} mm", metres * 1e3);
    let place = match summary.on {
        "host" => "this computer (host)".to_owned(),
        "emulator" => "the emulated Cortex-M4F (emulator)".to_owned(),
        other => other.to_owned(),
    };
    let mut facts = vec![
        ("Machine", format!("{}: {}", scenario.machine.name, scenario.machine.description)),
        ("The controller ran on", place),
        ("Seed of the sensor noise", summary.seed.to_string()),
        ("Simulated", format!("{} s, {} ticks", scenario.duration_s, summary.ticks)),
    ];
    facts.extend(summary.dig_completed.map(|completed| ("Dig completed", yes_no(completed))));
    facts.extend(summary.tip_error_rms_m.map(|m| ("Tip error while digging, RMS", millimetres(m))));
    facts.extend(summary.tip_error_max_m.map(|m| ("Tip error while digging, largest", millimetres(m))));
    facts.extend(summary.target_error_m.map(|m| ("Tip from the target at the end", millimetres(m))));
    facts.extend(summary.smallest_clearance_m.map(|m| ("Smallest clearance to the obstacles", millimetres(m))));
    facts.extend(summary.real_time_factor.map(|f| ("Speed of the simulation", format!("{f:.0} × real time"))));
    facts.extend(summary.output_hash.clone().map(|hash| ("Hash of all outputs", hash)));
    if let Some(e) = &summary.emulator {
        let counts = e.instructions_per_tick;
        facts.push(("Instructions per tick", format!("{} median, {} largest", counts.median, counts.max)));
        facts.push(("Jitter of the tick's period", format!("{} ns", e.tick_period_jitter_ns)));
        facts.push(("Stack at its deepest", format!("{} bytes", e.stack_peak_bytes)));
        facts.push(("Image", format!("{} bytes flash, {} bytes static RAM", e.flash_bytes, e.ram_bytes)));
    }
    facts
}
