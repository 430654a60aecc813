//! Frankel's first figure: paths of elbow, wrist and tip in the boom's plane, with the linkage at some moments.

use kinematics_core::{Joints, Machine, Vec2};

use plotters::style::text_anchor::{HPos, VPos};

use super::{Axis, Beside, Figure, Height, Key, Look, Mark, Panel, colours};
use crate::report::series::{Point, along_path};

const REFERENCE: Look = Look::Dashed(colours::BLACK, 1.5);
const ELBOW: Look = Look::Line(colours::GREEN, 2.5);
const WRIST: Look = Look::Line(colours::ORANGE, 2.5);
const TIP: Look = Look::Line(colours::SKY, 5.0);
const LINK: Look = Look::Line(colours::GREY, 1.0);
const PIN: Look = Look::Dot(colours::GREY, 2.2);
const END_LINK: Look = Look::Line(colours::BLACK, 2.2);
const END_PIN: Look = Look::Dot(colours::BLACK, 3.5);
const GROUND: Look = Look::Line(colours::EARTH, 2.0);
const SOIL: Look = Look::Filled(colours::EARTH, 0.12);
const OUTSIDE: Look = Look::Line(colours::RED, 5.0);
/// Snapshots of the linkage.
const SNAPSHOTS: usize = 12;

/// What the figure shows. Positions in the boom's plane of the base frame, m.
#[derive(Clone, Debug)]
pub(in crate::report) struct Motion<'a> {
    /// The machine.
    pub(in crate::report) machine: &'a Machine<f64>,
    /// Height of the ground.
    pub(in crate::report) ground_z_m: f64,
    /// Where the tip should go.
    pub(in crate::report) reference: Vec<Option<Point>>,
    /// The joints over time; `None` where there is no such pose.
    pub(in crate::report) joints: Vec<Option<Joints<f64>>>,
    /// Stretches of the tip's path outside reach or travel limits.
    pub(in crate::report) outside: Vec<Vec<Option<Point>>>,
    /// What moved, for the caption.
    pub(in crate::report) caption: String,
}

/// Boom pin, elbow (arm pin), wrist (bucket pin), tip.
fn pins(machine: &Machine<f64>, joints: &Joints<f64>) -> [Point; 4] {
    let chain = machine.chain();
    let [a1, a2, ..] = chain.lengths();
    let elbow: Vec2<f64> = joints.boom.to_vec().scale(a2);
    let wrist = chain.wrist(joints);
    let tip = chain.tip(joints);
    [(a1, 0.0), (a1 + elbow.x, elbow.z), (wrist.x, wrist.z), (tip.reach, tip.height)]
}

/// The figure.
pub(in crate::report) fn figure(motion: &Motion<'_>) -> Figure {
    let pins: Vec<Option<[Point; 4]>> =
        motion.joints.iter().map(|joints| joints.map(|joints| pins(motion.machine, &joints))).collect();
    let (x, y) = axes(motion, &pins);
    let spacing = (x.until - x.from) / 800.0;

    let mut marks = ground(&x, &y, motion.ground_z_m);
    let poses: Vec<[Point; 4]> = pins.iter().copied().flatten().collect();
    marks.extend(snapshots(&poses));
    for (pin, look) in [(1, ELBOW), (2, WRIST), (3, TIP)] {
        marks.push(Mark::Lines(along_path(pins.iter().map(|p| p.map(|p| p[pin])), spacing), look));
    }
    for points in &motion.outside {
        marks.push(Mark::Lines(along_path(points.iter().copied(), spacing), OUTSIDE));
    }
    marks.push(Mark::Lines(along_path(motion.reference.iter().copied(), spacing), REFERENCE));
    marks.extend(names(motion, &poses));

    let mut legend = vec![
        Key { look: ELBOW, text: "elbow (arm pin)" },
        Key { look: WRIST, text: "wrist (bucket pin)" },
        Key { look: TIP, text: "bucket tip" },
        Key { look: REFERENCE, text: "reference of the tip" },
        Key { look: GROUND, text: "ground" },
        Key { look: LINK, text: "linkage on the way" },
    ];
    if !motion.outside.is_empty() {
        legend.push(Key { look: OUTSIDE, text: "out of reach or travel" });
    }
    let panel = Panel { title: String::new(), x, y, height: Height::EqualScale, marks };
    Figure { title: "Joint trajectories", caption: motion.caption.clone(), legend, panels: vec![panel] }
}

/// Room for everything, the ground and the origin of the base frame included.
fn axes(motion: &Motion<'_>, pins: &[Option<[Point; 4]>]) -> (Axis, Axis) {
    let references = motion.reference.iter().flatten();
    let all = || pins.iter().flatten().flatten().chain(references.clone()).chain([&(0.0, 0.0)]);
    let x = Axis::around("x, reach from the swing axis [m]", all().map(|p| p.0));
    let y = Axis::around("z, height above the boom pin [m]", all().map(|p| p.1).chain([motion.ground_z_m]));
    (x, y)
}

fn ground(x: &Axis, y: &Axis, z: f64) -> Vec<Mark> {
    vec![Mark::Area([(x.from, y.from), (x.until, z)], SOIL), Mark::Lines(vec![vec![(x.from, z), (x.until, z)]], GROUND)]
}

/// The linkage at even steps, and at the beginning and the end.
fn snapshots(poses: &[[Point; 4]]) -> Vec<Mark> {
    let (Some(first), Some(last)) = (poses.first(), poses.last()) else { return Vec::new() };
    let step = (poses.len() / SNAPSHOTS).max(1);
    let between: Vec<_> = poses.iter().step_by(step).skip(1).map(|pose| pose.to_vec()).collect();
    let dots = between.iter().flatten().copied().collect();
    let ends = [first, last];
    vec![
        Mark::Lines(between, LINK),
        Mark::Dots(dots, PIN),
        Mark::Lines(ends.iter().map(|pose| pose.to_vec()).collect(), END_LINK),
        Mark::Dots(ends.into_iter().flatten().copied().collect(), END_PIN),
    ]
}

fn names(motion: &Motion<'_>, poses: &[[Point; 4]]) -> Vec<Mark> {
    let [a1, ..] = motion.machine.chain().lengths();
    let text = |at, beside, text: &str| Mark::Text(at, beside, colours::BLACK, text.to_owned());
    let mut marks = vec![
        Mark::Dots(vec![(0.0, 0.0)], Look::Dot(colours::PURPLE, 4.0)),
        text((0.0, 0.0), Beside::ABOVE, "origin"),
        text((a1, 0.0), Beside(HPos::Right, VPos::Top), "boom pin"),
    ];
    if let (Some(first), Some(last)) = (poses.first(), poses.last()) {
        marks.push(text(first[3], Beside::BELOW, "start"));
        marks.push(text(last[3], Beside::ABOVE, "end"));
    }
    marks
}
