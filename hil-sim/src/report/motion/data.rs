//! Everything the script needs, as JSON.

use std::io;

use serde::Serialize;

use super::Seen;
use super::linkage::Linkage;
use super::moments::{Tracks, mm};

/// See [`json`]. Lengths mm; lists are one entry a moment unless they say otherwise.
#[derive(Serialize)]
struct Data {
    step_s: f64,
    /// Numbers a moment in `points`.
    width: usize,
    /// x and z of every point, as differences to the moment before.
    points: Vec<i32>,
    /// The tip among the points.
    tip: usize,
    /// Where the tip should be: x, z.
    wanted: Vec<Option<[i32; 2]>>,
    /// |wanted − tip|, tenths of a millimetre.
    error: Vec<Option<i32>>,
    /// Hundredths of a degree.
    swing: Vec<Option<i32>>,
    /// From which moment on the supervisor is in which state.
    states: Vec<(usize, String)>,
    /// Soil in the bucket, kg.
    load: Vec<i32>,
    /// x, z at the beginning.
    ground: Vec<[i32; 2]>,
    /// Moment, place in `ground`, new z; in the order of time.
    cuts: Vec<(usize, usize, i32)>,
}

/// The data of the run as text that may stand in a script element.
pub(super) fn json(seen: &Seen<'_>, linkage: &Linkage, tracks: &Tracks) -> io::Result<String> {
    let rows = &seen.moments.rows;
    let data = Data {
        step_s: seen.moments.step_s,
        width: tracks.width(),
        points: tracks.differences(),
        tip: linkage.teeth,
        wanted: rows.iter().map(|row| row.reference.map(|place| place.map(mm))).collect(),
        error: rows.iter().map(|row| row.tip_error_m().map(|error| mm(10.0 * error))).collect(),
        swing: rows.iter().map(|row| row.swing.map(|s| libm::round(s.angle().to_degrees() * 100.0) as i32)).collect(),
        states: states(seen),
        load: load(seen),
        ground: ground(seen),
        cuts: seen.log.ground.cuts.iter().map(|c| (seen.moments.at(c.time_s), c.sample, mm(c.height_m))).collect(),
    };
    // No text in it can end the script element.
    Ok(serde_json::to_string(&data)?.replace('<', "\\u003c"))
}

fn states(seen: &Seen<'_>) -> Vec<(usize, String)> {
    let mut states: Vec<(usize, String)> = Vec::new();
    for (moment, row) in seen.moments.rows.iter().enumerate() {
        let fault = row.outputs.fault.map_or_else(String::new, |fault| format!(": {}", fault.name()));
        let now = format!("{}{fault}", row.outputs.state.name());
        if states.last().is_none_or(|(_, last)| *last != now) {
            states.push((moment, now));
        }
    }
    states
}

/// Empty for a plant without soil.
fn load(seen: &Seen<'_>) -> Vec<i32> {
    if seen.log.ground.start.is_empty() {
        return Vec::new();
    }
    let mut inside = seen.log.inside.iter().peekable();
    let mut load_kg = 0.0;
    let at = |row: &&crate::run::Row| {
        while let Some(now) = inside.next_if(|now| now.time_s <= row.time_s) {
            load_kg = now.oil.map_or(0.0, |oil| oil.load_kg);
        }
        libm::round(load_kg) as i32
    };
    seen.moments.rows.iter().map(at).collect()
}

/// Level where the plant has no soil.
fn ground(seen: &Seen<'_>) -> Vec<[i32; 2]> {
    let level = mm(-seen.scenario.machine.boom_pin_height_m);
    let far = mm(3.0 * seen.scenario.machine.geometry.reach_m());
    let start = &seen.log.ground.start;
    let first = start.first().map_or(level, |[_, height]| mm(*height));
    let last = start.last().map_or(level, |[_, height]| mm(*height));
    // What the plant knows, from the swing axis outwards: the first sample shall be the first of `cuts`, so the left end comes last.
    let known = start.iter().map(|place| place.map(mm));
    known.chain([[far, last], [-far, first]]).collect()
}
