//! A look at a scene that was not reached: what stands in the way of the routes, and whether one aim on the way would have done.

use kinematics_core::geometry::Stroke;
use kinematics_core::planning::avoid::advanced;
use kinematics_core::planning::hull::Sphere;
use kinematics_core::{Cylinders, Rotor};
use serde::Serialize;

use super::generate::{Kit, Scene};
use super::scene::{joints_f32, joints_f64, to_f32};

/// Aims tried on the way: places of swing, boom, arm, bucket, over the strokes.
const AIMS: [usize; 4] = [7, 5, 5, 3];
/// Poses at the target it is tried with, evenly out of all clear ones.
const POSES: usize = 4;
/// As in the planner's rehearsal: steps, their length in s, and when an aim is passed, the last is reached, a step is stuck.
const STEPS: usize = 2000;
const STEP_S: f32 = 0.02;
const PASSED_S: f32 = 0.15;
const ARRIVED_S: f32 = 0.05;
const STUCK_PACE: f32 = 0.02;
const STUCK_S: f32 = 0.4;

/// What a look shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Look {
    /// A sphere so near the swing axis that no swing clears the boom's plane of it: it has no sector to leave.
    pub about_the_axis: bool,
    /// Pairs of an aim on the way and a clear pose at the target, one after the other.
    pub tried: usize,
    /// Those by which the step arrives, clear of every sphere at each of its steps.
    pub arrived: usize,
}

impl Kit {
    /// Tries one aim on the way, from a grid over the strokes.
    pub(super) fn look(&self, scene: &Scene) -> Look {
        let thickest_m = self.hull.place(&scene.start).capsules().map(|(_, radius)| radius).fold(0.0, f64::max);
        let about = |o: &Sphere<f64>| o.x.hypot(o.y) <= o.radius + thickest_m + self.stop_m();
        let clear = self.clear_poses(scene);
        let poses: Vec<_> =
            (0..POSES.min(clear.len())).map(|i| clear[i * clear.len() / POSES.min(clear.len())]).collect();
        let mut look = Look { about_the_axis: scene.obstacles.iter().any(about), tried: 0, arrived: 0 };
        for index in 0..AIMS.iter().product() {
            let Some(between) = self.posture(index) else { continue };
            let free = self.clearance(&between, &scene.obstacles) > self.stop_m();
            for pose in &poses {
                look.tried += 1;
                look.arrived += usize::from(free && self.arrives(scene, [&between, pose]));
            }
        }
        look
    }

    /// The grid's posture of this number.
    fn posture(&self, index: usize) -> Option<[Rotor<f64>; 4]> {
        let g = &self.geometry;
        let [_, booms, arms, buckets] = AIMS;
        // Three hundredths from the ends: the step need not creep up to a stop.
        let along = |stroke: Stroke, i: usize, of: usize| {
            stroke.min_m + (stroke.max_m - stroke.min_m) * (0.03 + 0.94 * i as f64 / (of - 1) as f64)
        };
        let (bucket, rest) = (index % buckets, index / buckets);
        let (arm, rest) = (rest % arms, rest / arms);
        let (boom, swing) = (rest % booms, rest / booms);
        let joints = self.machine.cylinders_to_joints(&Cylinders {
            boom: along(g.boom.stroke, boom, booms),
            arm: along(g.arm.stroke, arm, arms),
            bucket: along(g.bucket.stroke, bucket, buckets),
        });
        let joints = joints.ok()?;
        let swing = match (self.machine.swing_cylinder(), g.swing) {
            (Some(cylinder), Some(pins)) => cylinder.rotor(along(pins.stroke, swing, AIMS[0])).ok()?,
            _ => Rotor::from_turns(swing as f64 / AIMS[0] as f64),
        };
        Some([swing, joints.boom, joints.arm, joints.bucket])
    }

    /// Whether the step comes by these aims to the last.
    fn arrives(&self, scene: &Scene, aims: [&[Rotor<f64>; 4]; 2]) -> bool {
        let spheres: Vec<_> = scene.obstacles.iter().map(to_f32).collect();
        let [between, last] = aims.map(|aim| self.avoid.aim(&joints_f32(aim)));
        let (mut joints, mut passed, mut stuck) = (joints_f32(&scene.start), false, 0.0);
        for _ in 0..STEPS {
            let aim = if passed { &last } else { &between };
            let step = match *spheres.as_slice() {
                [one] => self.avoid.step(&joints, aim, &[one]),
                [one, two] => self.avoid.step(&joints, aim, &[one, two]),
                _ => self.avoid.step(&joints, aim, &[]),
            };
            if passed && step.to_go_s < ARRIVED_S {
                return true;
            }
            passed |= step.to_go_s < PASSED_S;
            let stands = step.pace < STUCK_PACE && step.to_go_s > STUCK_PACE;
            stuck = if stands { stuck + STEP_S } else { 0.0 };
            joints = advanced(&joints, &step.rates, STEP_S);
            if stuck > STUCK_S || self.clearance(&joints_f64(&joints), &scene.obstacles) <= 0.0 {
                return false;
            }
        }
        false
    }
}
