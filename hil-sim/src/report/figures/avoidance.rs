//! The way past obstacles: from above, from the side, and the distance over time.

use kinematics_core::chain::Chain;
use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::reach::Target;
use kinematics_core::{Joints, Vec2};

use super::{Axis, Beside, Figure, Height, Key, Look, Mark, Panel, circle, colours};
use crate::report::series::{Point, along_path, over_time};
use crate::scenes::Sample;

const TIP: Look = Look::Line(colours::SKY, 4.0);
const LINK: Look = Look::Line(colours::GREY, 1.0);
const END_LINK: Look = Look::Line(colours::BLACK, 2.2);
const OBSTACLE: Look = Look::Line(colours::RED, 2.5);
const TARGET: Look = Look::Dot(colours::GREEN, 5.0);
const DISTANCE: Look = Look::Line(colours::BLUE, 2.0);
/// Snapshots of the linkage.
const SNAPSHOTS: usize = 14;

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub(in crate::report) struct Drawn<'a> {
    pub(in crate::report) chain: &'a Chain<f64>,
    pub(in crate::report) samples: &'a [Sample],
    pub(in crate::report) obstacles: &'a [Sphere<f64>],
    pub(in crate::report) target: Target<f64>,
}

/// Boom pin, elbow, wrist, tip in the plane.
fn pins(chain: &Chain<f64>, sample: &Sample) -> [Point; 4] {
    let [_, boom, arm, bucket] = sample.joints;
    let joints = Joints { boom, arm, bucket };
    let [a1, a2, ..] = chain.lengths();
    let elbow: Vec2<f64> = boom.to_vec().scale(a2);
    let (wrist, tip) = (chain.wrist(&joints), chain.tip(&joints));
    [(a1, 0.0), (a1 + elbow.x, elbow.z), (wrist.x, wrist.z), (tip.reach, tip.height)]
}

/// The figure.
pub(in crate::report) fn figure(drawn: &Drawn<'_>) -> Figure {
    let side: Vec<[Point; 4]> = drawn.samples.iter().map(|sample| pins(drawn.chain, sample)).collect();
    let swung = |(sample, pins): (&Sample, &[Point; 4])| {
        let [swing, ..] = sample.joints;
        pins.map(|(reach, _)| (reach * swing.cos, reach * swing.sin))
    };
    let above: Vec<[Point; 4]> = drawn.samples.iter().zip(&side).map(swung).collect();
    let target = drawn.target;
    let from_above: Vec<_> = drawn.obstacles.iter().map(|o| circle((o.x, o.y), o.radius)).collect();
    // From the side every sphere stands at its distance from the swing axis: met only while the swing points at it.
    let from_side: Vec<_> = drawn.obstacles.iter().map(|o| circle((libm::hypot(o.x, o.y), o.z), o.radius)).collect();
    let panels = vec![
        view(["x, forward [m]", "y, to the left [m]"], "From above", &above, from_above, (target.x, target.y)),
        view(
            ["reach from the swing axis [m]", "z, height above the boom pin [m]"],
            "From the side, turning with the swing",
            &side,
            from_side,
            (libm::hypot(target.x, target.y), target.z),
        ),
        distance(drawn),
    ];
    Figure {
        title: "Past the obstacles",
        caption: "Path of the tip, the linkage at even steps of time (first and last in black), the obstacles and the \
                  target; below, the smallest distance between obstacles and the hull around the linkage. Both views have \
                  the same scale on both axes. From the side an obstacle is where the linkage would meet it when the swing \
                  points at it; at other swings the paths may cross it."
            .to_owned(),
        legend: vec![
            Key { look: TIP, text: "bucket tip" },
            Key { look: LINK, text: "linkage on the way" },
            Key { look: OBSTACLE, text: "obstacle" },
            Key { look: TARGET, text: "target" },
        ],
        panels,
    }
}

fn view(names: [&'static str; 2], title: &str, poses: &[[Point; 4]], circles: Vec<Vec<Point>>, target: Point) -> Panel {
    let all = || poses.iter().flatten().chain(circles.iter().flatten()).chain([&target, &(0.0, 0.0)]);
    let x = Axis::around(names[0], all().map(|p| p.0));
    let y = Axis::around(names[1], all().map(|p| p.1));
    let spacing = (x.until - x.from) / 800.0;
    let step = (poses.len() / SNAPSHOTS).max(1);
    let between = poses.iter().step_by(step).skip(1).map(|pose| pose.to_vec()).collect();
    let ends = [poses.first(), poses.last()].into_iter().flatten().map(|pose| pose.to_vec()).collect();
    let mut marks = vec![
        Mark::Lines(between, LINK),
        Mark::Lines(ends, END_LINK),
        Mark::Lines(along_path(poses.iter().map(|pose| Some(pose[3])), spacing), TIP),
        Mark::Lines(circles, OBSTACLE),
        Mark::Dots(vec![target], TARGET),
    ];
    if let Some(first) = poses.first() {
        marks.push(Mark::Text(first[3], Beside::BELOW, colours::BLACK, "start".to_owned()));
    }
    Panel { title: title.to_owned(), x, y, height: Height::EqualScale, marks }
}

fn distance(drawn: &Drawn<'_>) -> Panel {
    let samples = drawn.samples;
    let x = Axis::around("time [s]", samples.iter().map(|s| s.time_s));
    let y = Axis::around("distance [m]", samples.iter().map(|s| s.clearance_m).chain([0.0]));
    let lines = over_time(samples.iter().map(|s| (s.time_s, Some(s.clearance_m))));
    let touch = Mark::Lines(vec![vec![(x.from, 0.0), (x.until, 0.0)]], OBSTACLE);
    let marks = vec![touch, Mark::Lines(lines, DISTANCE)];
    Panel { title: "Smallest distance".to_owned(), x, y, height: Height::Pixels(170.0), marks }
}
