//! The machine moving: two drawings, the positions of every moment as data, and the script that shows one after the other.
//!
//! - [`moments`] — which ticks are shown, and points over them;
//! - [`linkage`] — where the linkage is, from the recorded lengths; [`limits`] — the fence and obstacles as the swing's plane meets them;
//! - [`side`] and [`above`] — the two drawings, with what does not move already drawn;
//! - [`data`] — everything the script needs, as JSON; `player.js` only draws it.

mod above;
mod data;
mod limits;
mod linkage;
mod moments;
mod shapes;
mod side;
#[cfg(test)]
mod tests;

use std::io;

use firmware::dig::Dig;
use kinematics_core::Machine;
use kinematics_core::planning::outline::Outline;

use super::series::Point;
use crate::run::Log;
use crate::scenario::Scenario;
use limits::Limits;
use linkage::Linkage;
use moments::{Moments, Tracks};

/// Draws what [`stage`] writes.
pub(super) const PLAYER: &str = include_str!("player.js");

/// The element that shows the run's motion, controls and data included; `None` where nothing was recorded.
///
/// # Errors
/// The machine's outline, which loading has checked.
pub(super) fn stage(scenario: &Scenario, machine: &Machine<f64>, log: &Log) -> io::Result<Option<String>> {
    let Some(moments) = Moments::of(log) else { return Ok(None) };
    let outline = Outline::new(&scenario.machine.geometry, &scenario.machine.outline).map_err(io::Error::other)?;
    let mut tracks = Tracks::new(&moments);
    let linkage = Linkage::new(&mut tracks, &moments, machine, &outline, scenario);
    let limits = Limits::of(scenario);
    let seen = Seen { scenario, log, moments: &moments, limits: &limits, asked: asked(scenario, log) };
    let side = side::draw(&seen, &linkage, &mut tracks);
    let above = above::draw(&seen, &linkage, &mut tracks);
    let data = data::json(&seen, &linkage, &tracks)?;
    let speeds: String = ["0.1", "0.25", "0.5", "1", "2", "5"]
        .iter()
        .map(|speed| {
            let chosen = if *speed == "1" { " selected" } else { "" };
            format!("<option value=\"{speed}\"{chosen}>{speed}×</option>")
        })
        .collect();
    let last = moments.rows.len() - 1;
    Ok(Some(format!(
        "<section class=\"stage\" aria-label=\"The machine moving\">\n{side}\
         <div class=\"controls\"><button id=\"play\" type=\"button\">Play</button>\
         <input id=\"moment\" type=\"range\" min=\"0\" max=\"{last}\" value=\"0\" aria-label=\"Moment of the run\">\
         <label>Speed <select id=\"speed\">{speeds}</select></label></div>\n<div class=\"under\">{readouts}{above}</div>\n\
         <noscript><p>The script of this page is switched off: the machine stays out of sight.</p></noscript>\n\
         <script id=\"motion\" type=\"application/json\">{data}</script>\n</section>\n",
        readouts = readouts(&seen)
    )))
}

/// What both drawings and the data are made from.
struct Seen<'a> {
    scenario: &'a Scenario,
    log: &'a Log,
    moments: &'a Moments<'a>,
    limits: &'a Limits,
    /// The tip's path as it is asked for, reach and height, m.
    asked: Vec<Option<Point>>,
}

/// The path the tip should take: a dig's whole, of anything else what was followed.
fn asked(scenario: &Scenario, log: &Log) -> Vec<Option<Point>> {
    match &scenario.parameters.dig {
        Some(dig) => super::run::reference(&Dig::new(dig)),
        None => log.rows.iter().map(|row| row.reference.map(|[x, z]| (x, z))).collect(),
    }
}

fn readouts(seen: &Seen<'_>) -> String {
    let mut shown = vec![("time", "time"), ("state", "state"), ("tip", "tip, reach and height"), ("swing", "swing")];
    if seen.log.rows.iter().any(|row| row.tip_error_m().is_some()) {
        shown.push(("error", "tip error"));
    }
    if !seen.log.ground.start.is_empty() {
        shown.push(("load", "soil in the bucket"));
    }
    let entries: String =
        shown.iter().map(|(id, name)| format!("<div><dt>{name}</dt><dd id=\"now-{id}\">–</dd></div>")).collect();
    format!("<dl class=\"now-shown\">{entries}</dl>\n")
}
