//! The report of a dig that is drawn, not run: where the machine would have to be.

use std::fs;
use std::io;
use std::path::Path;

use firmware::TICKS_PER_S;
use firmware::dig::{Dig, DigParameters};
use kinematics_core::{Joints, Machine};

use super::csv::{Moment, lengths, write_dig};
use super::figures::linkage::Motion;
use super::figures::{self, Figure, linkage, svg};
use super::html::Page;
use super::run::reference;
use super::series::over_time;
use crate::scenario::Scenario;
use crate::travel::{Violation, violations};

/// Draws the dig without running it: `report.html`, `linkage.svg` (its first figure alone), `dig.csv` in `folder`;
/// gives the travel violations found.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn draw_only(scenario: &Scenario, dig: &DigParameters, folder: &Path) -> io::Result<Vec<Violation>> {
    fs::create_dir_all(folder)?;
    let geometry = &scenario.machine.geometry;
    // Loading the scenario has checked the geometry.
    let machine = Machine::new(geometry).map_err(io::Error::other)?;
    let dig = Dig::new(dig);
    let found = violations(geometry, &machine, &dig);
    let (moments, joints): (Vec<_>, Vec<_>) = moments(&machine, &dig).unzip();
    write_dig(&moments, &folder.join("dig.csv"))?;

    let mut page = Page::new(&format!("Dig, drawn only: {}", scenario.name));
    page.paragraph(&scenario.description);
    page.note(&format!("Nothing has run: these are the poses the dig asks for. {}", super::SIMULATION));
    page.facts(&[
        ("Machine", format!("{}: {}", scenario.machine.name, scenario.machine.description)),
        ("Duration of the dig", format!("{} s", dig.duration())),
    ]);
    say(&mut page, &found);
    let first = linkage_figure(scenario, &machine, &dig, joints, &moments, &found);
    let drawing = svg(&first)?;
    fs::write(folder.join("linkage.svg"), &drawing)?;
    page.figure(first.title, &first.caption, &drawing);
    let second = lengths_figure(scenario, &moments, dig.duration(), &found);
    page.figure(second.title, &second.caption, &svg(&second)?);
    fs::write(folder.join("report.html"), page.finish())?;
    Ok(found)
}

/// Every control tick of the dig, whatever the strokes; `None` where there are no such joints.
fn moments(machine: &Machine<f64>, dig: &Dig<f64>) -> impl Iterator<Item = (Moment, Option<Joints<f64>>)> {
    let ticks = (dig.duration() * f64::from(TICKS_PER_S) + 0.5) as u32;
    (0..=ticks).map(|tick| {
        let time_s = f64::from(tick) / f64::from(TICKS_PER_S);
        let tip = dig.tip(time_s);
        let joints = machine.tip_to_joints(&tip).ok();
        let lengths = joints.and_then(|joints| machine.joints_to_cylinders_any_stroke(&joints).ok());
        let pitch_deg = tip.pitch.angle().to_degrees();
        (Moment { time_s, tip: [tip.reach, tip.height], pitch_deg, lengths }, joints)
    })
}

fn say(page: &mut Page, found: &[Violation]) {
    if found.is_empty() {
        page.paragraph("Every moment of the dig is within reach and inside the travel limits.");
        return;
    }
    let spans = if found.len() == 1 { "once".to_owned() } else { format!("{} times", found.len()) };
    page.alarm("A run of this dig is refused", &[format!("it leaves reach or travel limits {spans}")]);
    let rows: Vec<_> = found
        .iter()
        .map(|v| {
            let amount = format!("{:+.1}", v.by_m * 1e3).replace('-', "−");
            let seconds = [v.from_s, v.until_s, v.worst_s].map(|s| format!("{s:.3}"));
            [v.cylinder.replace('_', " ")].into_iter().chain(seconds).chain([amount]).collect()
        })
        .collect();
    page.table(&["What", "From [s]", "Until [s]", "Worst at [s]", "By at most [mm]"], &rows);
}

fn linkage_figure(
    scenario: &Scenario,
    machine: &Machine<f64>,
    dig: &Dig<f64>,
    joints: Vec<Option<Joints<f64>>>,
    moments: &[Moment],
    found: &[Violation],
) -> Figure {
    let outside = found
        .iter()
        .map(|v| {
            let span = moments.iter().filter(|m| m.time_s >= v.from_s && m.time_s <= v.until_s);
            span.map(|m| Some((m.tip[0], m.tip[1]))).collect()
        })
        .collect();
    linkage::figure(&Motion {
        machine,
        ground_z_m: -scenario.machine.boom_pin_height_m,
        reference: reference(dig),
        joints,
        outside,
        caption: "Paths of elbow, wrist and bucket tip in the boom's vertical plane that the dig asks for, whatever \
                  the travel limits, and the linkage at even steps of time (first and last in black). Where the \
                  machine cannot reach at all, only the reference goes on. Both axes have the same scale."
            .to_owned(),
    })
}

fn lengths_figure(scenario: &Scenario, moments: &[Moment], until_s: f64, found: &[Violation]) -> Figure {
    let strokes = scenario.parameters.cylinder_sensors.map(|sensor| sensor.stroke);
    let names = ["boom", "arm", "bucket"].into_iter().zip(strokes).enumerate();
    let traces: Vec<_> = names
        .map(|(i, (cylinder, stroke))| figures::lengths::Trace {
            cylinder,
            stroke,
            length: over_time(moments.iter().map(|m| (m.time_s, m.lengths.as_ref().map(|c| lengths(c)[i])))),
            reference: Vec::new(),
        })
        .collect();
    let caption = "Lengths between their pins that the dig asks of the cylinders, over the time of the dig. The red \
                   lines are the travel limits; spans outside them are shaded, with the largest amount beside them. \
                   A gap is a moment the machine cannot reach.";
    figures::lengths::figure(&traces, until_s, found, caption.to_owned())
}
