//! A run before its fence: the linkage's outline from the side and from above, how near it came, what was asked and what passed.

use firmware::fence::FenceParameters;
use firmware::io::{SPOOLS, Speeds};
use kinematics_core::Rotor;

use super::events::{RUNNING_KEY, moments, moments_key, running};
use super::lengths::capital;
use super::{Axis, Beside, Figure, Height, Key, Look, Mark, Panel, circle, colours, values};
use crate::fence::Watch;
use crate::report::series::{Piece, Point, over_time};
use crate::run::{Log, Row};

const STRIP: Look = Look::Line(colours::GREY, 1.0);
const END_STRIP: Look = Look::Line(colours::BLACK, 1.6);
const TEETH: Look = Look::Line(colours::SKY, 3.0);
const LIMIT: Look = Look::Line(colours::RED, 2.0);
const TRUE_DISTANCE: Look = Look::Line(colours::BLACK, 1.6);
const OWN_DISTANCE: Look = Look::Line(colours::BLUE, 1.2);
const ASKED: Look = Look::Line(colours::ORANGE, 2.2);
const PASSED: Look = Look::Line(colours::BLUE, 1.2);
/// Snapshots of the linkage.
const SNAPSHOTS: usize = 10;

/// A moment of the run that is drawn: the outline's strips in the swing plane, and the swing.
struct Snapshot {
    strips: Vec<[Point; 2]>,
    swing: Rotor<f64>,
}

/// Views and distances.
pub(in crate::report) fn figure(watch: &Watch, fence: &FenceParameters, log: &Log, until_s: f64) -> Figure {
    let height = fence.boom_pin_height_m;
    let shot = |row: &Row| {
        let placed = watch.placed(row)?;
        let strips = placed.strips.map(|strip| strip.ends.map(|end| (end.at.x, end.at.z + height)));
        Some(Snapshot { strips: strips.to_vec(), swing: row.swing? })
    };
    let shots: Vec<Snapshot> = log.rows.iter().step_by((log.rows.len() / SNAPSHOTS).max(1)).filter_map(shot).collect();
    let teeth: Vec<(Point, Rotor<f64>)> = log.rows.iter().step_by(20).filter_map(|row| teeth(row, height)).collect();
    Figure {
        title: "Before the fence",
        caption: "The linkage's outline at even steps of time (the last in black) and the path of the teeth. From the side, \
                  turning with the swing, stand level planes and the balls at their distance from the swing axis, which the \
                  linkage meets only while the swing points at them; from above stand upright planes, balls and the ends of \
                  the swing's range. Below, the smallest clearance from planes and balls: of the true linkage, and as the \
                  controller's fence knows it."
            .to_owned(),
        legend: vec![
            Key { look: STRIP, text: "outline on the way" },
            Key { look: TEETH, text: "bucket teeth" },
            Key { look: LIMIT, text: "fence" },
            Key { look: TRUE_DISTANCE, text: "true clearance" },
            Key { look: OWN_DISTANCE, text: "the controller's" },
        ],
        panels: vec![side(fence, &shots, &teeth), above(fence, &shots, &teeth), distance(watch, log, until_s)],
    }
}

/// The true tip in the swing plane, z from the ground.
fn teeth(row: &Row, height: f64) -> Option<(Point, Rotor<f64>)> {
    let [reach, z] = row.tip?;
    Some(((reach, z + height), row.swing?))
}

/// Marks of the outline: all but the last thin, the last bold, then the teeth.
fn outline(shots: Vec<Vec<Piece>>, teeth: Piece) -> Vec<Mark> {
    let mut shots = shots;
    let last = shots.pop().unwrap_or_default();
    vec![
        Mark::Lines(shots.into_iter().flatten().collect(), STRIP),
        Mark::Lines(last, END_STRIP),
        Mark::Lines(vec![teeth], TEETH),
    ]
}

fn side(fence: &FenceParameters, shots: &[Snapshot], teeth: &[(Point, Rotor<f64>)]) -> Panel {
    let strips: Vec<Vec<Piece>> = shots.iter().map(|shot| shot.strips.iter().map(|s| s.to_vec()).collect()).collect();
    let path: Piece = teeth.iter().map(|(point, _)| *point).collect();
    let balls: Vec<Piece> = fence
        .balls
        .iter()
        .flatten()
        .map(|ball| {
            let [x, y, z] = ball.centre_m;
            circle((libm::hypot(x, y), z), ball.radius_m)
        })
        .collect();
    let levels: Vec<f64> = fence
        .planes
        .iter()
        .flatten()
        .filter(|plane| plane.normal[2].abs() > 0.9)
        .map(|plane| plane.offset_m / plane.normal[2])
        .collect();
    let all = || strips.iter().flatten().flatten().chain(&path).chain(balls.iter().flatten());
    let x = Axis::around("reach from the swing axis [m]", all().map(|p| p.0).chain([0.0]));
    let y =
        Axis::around("z, height above the ground [m]", all().map(|p| p.1).chain(levels.iter().copied()).chain([0.0]));
    let planes = levels.iter().map(|&z| vec![(x.from, z), (x.until, z)]).collect();
    let mut marks = outline(strips, path);
    marks.extend([Mark::Lines(planes, LIMIT), Mark::Lines(balls, LIMIT)]);
    Panel { title: "From the side, turning with the swing".to_owned(), x, y, height: Height::EqualScale, marks }
}

fn above(fence: &FenceParameters, shots: &[Snapshot], teeth: &[(Point, Rotor<f64>)]) -> Panel {
    let turned = |(reach, _): Point, swing: Rotor<f64>| (reach * swing.cos, reach * swing.sin);
    let strips: Vec<Vec<Piece>> = shots
        .iter()
        .map(|shot| shot.strips.iter().map(|s| s.iter().map(|p| turned(*p, shot.swing)).collect()).collect())
        .collect();
    let path: Piece = teeth.iter().map(|(point, swing)| turned(*point, *swing)).collect();
    let balls: Vec<Piece> =
        fence.balls.iter().flatten().map(|b| circle((b.centre_m[0], b.centre_m[1]), b.radius_m)).collect();
    let all = || strips.iter().flatten().flatten().chain(&path).chain(balls.iter().flatten()).chain([&(0.0, 0.0)]);
    let far = all().fold(1.0, |far: f64, p| far.max(libm::hypot(p.0, p.1)));
    let upright = fence.planes.iter().flatten().filter(|plane| plane.normal[2].abs() <= 0.9).map(|plane| {
        let [x, y, _] = plane.normal;
        let foot = (plane.offset_m * x, plane.offset_m * y);
        vec![(foot.0 - far * y, foot.1 + far * x), (foot.0 + far * y, foot.1 - far * x)]
    });
    let ends = fence.swing.iter().flat_map(|range| [range.right_deg, range.left_deg]).map(|deg| {
        let end = Rotor::from_degrees(deg);
        vec![(0.0, 0.0), (far * end.cos, far * end.sin)]
    });
    let limits: Vec<Piece> = upright.chain(ends).collect();
    let x = Axis::around("x, forward [m]", all().map(|p| p.0).chain(limits.iter().flatten().map(|p| p.0)));
    let y = Axis::around("y, to the left [m]", all().map(|p| p.1).chain(limits.iter().flatten().map(|p| p.1)));
    let mut marks = outline(strips, path);
    marks.extend([Mark::Lines(limits, LIMIT), Mark::Lines(balls, LIMIT)]);
    marks.push(Mark::Text((0.0, 0.0), Beside::BELOW, colours::BLACK, "swing axis".to_owned()));
    Panel { title: "From above".to_owned(), x, y, height: Height::EqualScale, marks }
}

fn distance(watch: &Watch, log: &Log, until_s: f64) -> Panel {
    let finite = |m: f64| (m.is_finite() && m < 1e6).then_some(m);
    let truth =
        over_time(log.rows.iter().map(|row| (row.time_s, watch.at(row).and_then(|(closest, _)| finite(closest)))));
    let own = over_time(log.rows.iter().map(|row| (row.time_s, finite(f64::from(row.outputs.clearance_m)))));
    let y = Axis::around("clearance [m]", values(&truth).chain(values(&own)).chain([0.0]));
    let touch = vec![vec![(0.0, 0.0), (until_s, 0.0)]];
    let marks = vec![Mark::Lines(touch, LIMIT), Mark::Lines(own, OWN_DISTANCE), Mark::Lines(truth, TRUE_DISTANCE)];
    let x = Axis::new("time [s]", 0.0, until_s);
    Panel { title: "Smallest clearance".to_owned(), x, y, height: Height::Pixels(170.0), marks }
}

/// What was asked of each actuator, and what the fence let through.
pub(in crate::report) fn speeds(log: &Log, until_s: f64) -> Figure {
    let mut panels: Vec<Panel> = (0..SPOOLS.len()).map(|spool| actuator(log, until_s, spool)).collect();
    if let Some(last) = panels.last_mut() {
        last.x.name = "time [s]";
    }
    Figure {
        title: "Asked and let through",
        caption:
            "Speeds the operator asked of each actuator and what the fence let through: cylinders in m/s, extending \
                  upwards; a swing motor in rad/s, to the left upwards."
                .to_owned(),
        legend: [Key { look: ASKED, text: "asked" }, Key { look: PASSED, text: "let through" }, RUNNING_KEY]
            .into_iter()
            .chain(moments_key(log))
            .collect(),
        panels,
    }
}

fn actuator(log: &Log, until_s: f64, spool: usize) -> Panel {
    let line = |of: fn(&Row) -> Speeds| {
        over_time(log.rows.iter().map(|row| (row.time_s, Some(f64::from(of(row).to_array()[spool])))))
    };
    let (asked, passed) = (line(|row| row.outputs.asked), line(|row| row.outputs.speeds));
    let y = Axis::around("speed", values(&asked).chain(values(&passed)).chain([0.0]));
    let mut marks = running(log, &y);
    marks.extend(moments(log, &y, spool == 0));
    marks.extend([Mark::Lines(asked, ASKED), Mark::Lines(passed, PASSED)]);
    let title = format!("{} actuator", capital(SPOOLS[spool]));
    Panel { title, x: Axis::new("", 0.0, until_s), y, height: Height::Pixels(105.0), marks }
}
