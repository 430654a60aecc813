//! One scene played at 1 kHz.

use kinematics_core::Rotor;
use kinematics_core::planning::avoid::advanced;
use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::reach::{Progress, Reach, Target};
use serde::Serialize;

use super::generate::{Kit, Scene};
use super::look::Look;
use super::proof::Proof;

/// The loop's period, s.
const TICK_S: f32 = 0.001;
/// After this long a scene has not converged, s.
const LONGEST_S: u32 = 120;
/// How near the tip must come, m.
const TOLERANCE_M: f32 = 0.01;

/// How a scene ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// At the target.
    Reached,
    /// No clear pose reaches the target.
    Blocked,
    /// No route was found.
    NoRoute,
    /// Stuck, or out of time.
    NotConverged,
}

/// What a scene showed.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Its number.
    pub scene: u64,
    /// How it ended.
    pub ended: Ended,
    /// For what was not reached: what an independent search says.
    pub proof: Option<Proof>,
    /// For what was not reached although a clear pose is there.
    pub look: Option<Look>,
    /// Smallest distance between hull and spheres while it moved, m; infinite if it never did.
    pub smallest_clearance_m: f64,
    /// Planning before and between motion, s at one piece a tick.
    pub planning_s: f64,
    /// From the first motion to the target, s.
    pub motion_s: f64,
    /// The tip's way, m, and the way without obstacles.
    pub way_m: f64,
    /// The tip's way without obstacles, m.
    pub free_way_m: f64,
    /// Straight at the target as if there were no obstacles: it would have collided.
    pub blind_collides: bool,
    /// The step alone, straight at the pose without routes: it would have got stuck.
    pub step_alone_stuck: bool,
}

/// A moment of a scene, for drawing.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// s.
    pub time_s: f64,
    /// Swing, boom, arm, bucket.
    pub joints: [Rotor<f64>; 4],
    /// m.
    pub clearance_m: f64,
}

pub(super) fn to_f32(sphere: &Sphere<f64>) -> Sphere<f32> {
    let Sphere { x, y, z, radius } = *sphere;
    Sphere { x: x as f32, y: y as f32, z: z as f32, radius: radius as f32 }
}

pub(super) fn joints_f32(joints: &[Rotor<f64>; 4]) -> [Rotor<f32>; 4] {
    joints.map(|r| Rotor { cos: r.cos as f32, sin: r.sin as f32 })
}

pub(super) fn joints_f64(joints: &[Rotor<f32>; 4]) -> [Rotor<f64>; 4] {
    joints.map(|r| Rotor { cos: r.cos.into(), sin: r.sin.into() })
}

struct Played {
    ended: Ended,
    clearance_m: f64,
    planning: u32,
    moving: u32,
    way_m: f64,
}

impl Kit {
    /// Plays a scene; `watch` sees it every 20 ms while it moves.
    pub fn play(&self, scene: &Scene, mut watch: impl FnMut(Sample)) -> Outcome {
        let played = match *scene.obstacles.as_slice() {
            [one] => self.run(scene, [one], &mut watch),
            [one, two] => self.run(scene, [one, two], &mut watch),
            _ => self.run(scene, [], &mut watch),
        };
        let free = self.run(scene, [], &mut |_| {});
        let proof = (played.ended != Ended::Reached).then(|| self.prove(scene));
        let (blind_collides, step_alone_stuck) = self.alone(scene);
        Outcome {
            scene: scene.number,
            ended: played.ended,
            proof,
            look: proof.is_some_and(|proof| proof != Proof::NoClearPose).then(|| self.look(scene)),
            smallest_clearance_m: played.clearance_m,
            planning_s: f64::from(played.planning) * f64::from(TICK_S),
            motion_s: f64::from(played.moving) * f64::from(TICK_S),
            way_m: played.way_m,
            free_way_m: free.way_m,
            blind_collides,
            step_alone_stuck,
        }
    }

    fn run<const N: usize>(&self, scene: &Scene, spheres: [Sphere<f64>; N], watch: &mut dyn FnMut(Sample)) -> Played {
        let Target { x, y, z } = scene.target;
        let target = Target { x: x as f32, y: y as f32, z: z as f32 };
        let chain = *kinematics_core::Machine::<f32>::new(&self.geometry).expect("validated").chain();
        let mut reach = Reach::new(self.avoid, chain, target, spheres.each_ref().map(to_f32), TOLERANCE_M);
        let mut joints = joints_f32(&scene.start);
        let mut played =
            Played { ended: Ended::NotConverged, clearance_m: f64::INFINITY, planning: 0, moving: 0, way_m: 0.0 };
        let mut last = self.tip(&scene.start);
        for tick in 0..LONGEST_S * 1000 {
            let told = reach.tick(&joints, TICK_S);
            match told.progress {
                Progress::Planning => played.planning += 1,
                Progress::Moving => played.moving += 1,
                Progress::Reached => played.ended = Ended::Reached,
                Progress::Blocked => played.ended = Ended::Blocked,
                Progress::NoRoute => played.ended = Ended::NoRoute,
                Progress::NotConverged => {}
            }
            if !matches!(told.progress, Progress::Planning | Progress::Moving) {
                break;
            }
            if told.progress == Progress::Moving {
                joints = advanced(&joints, &told.rates, TICK_S);
                // In f64, every 5 ms: the step's own word is not taken for it.
                if tick % 5 == 0 {
                    let exact = joints_f64(&joints);
                    let clearance_m = self.clearance(&exact, &spheres);
                    played.clearance_m = played.clearance_m.min(clearance_m);
                    let tip = self.tip(&exact);
                    played.way_m += tip.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
                    last = tip;
                    if tick % 20 == 0 {
                        watch(Sample { time_s: f64::from(tick) * 1e-3, joints: exact, clearance_m });
                    }
                }
            }
        }
        played
    }

    /// Without routes: straight and blind, and the step alone.
    fn alone(&self, scene: &Scene) -> (bool, bool) {
        let dt = 0.01f32;
        let spheres: Vec<_> = scene.obstacles.iter().map(to_f32).collect();
        let aim = self.avoid.aim(&joints_f32(&scene.pose));
        let (mut blind, mut collides) = (joints_f32(&scene.start), false);
        for _ in 0..3000 {
            let step = self.avoid.step(&blind, &aim, &[]);
            blind = advanced(&blind, &step.rates, dt);
            collides |= self.clearance(&joints_f64(&blind), &scene.obstacles) < 0.0;
            if collides || step.to_go_s < 0.01 {
                break;
            }
        }
        let (mut joints, mut to_go) = (joints_f32(&scene.start), f32::INFINITY);
        for _ in 0..3000 {
            let step = match *spheres.as_slice() {
                [one] => self.avoid.step(&joints, &aim, &[one]),
                [one, two] => self.avoid.step(&joints, &aim, &[one, two]),
                _ => self.avoid.step(&joints, &aim, &[]),
            };
            joints = advanced(&joints, &step.rates, dt);
            to_go = step.to_go_s;
            if to_go < 0.05 {
                break;
            }
        }
        (collides, to_go >= 0.05)
    }
}
