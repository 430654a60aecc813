//! One scene from a machine, a seed and its number.

use kinematics_core::planning::avoid::{Avoid, AvoidParameters};
use kinematics_core::planning::hull::{Flesh, Hull, Sphere};
use kinematics_core::planning::reach::Target;
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, Rotor, Vec2};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// Speed limits of swing, boom, arm, bucket, rad/s: those in use on the 12 t machine.
const SPEEDS_RAD_S: [f64; 4] = [1.1, 0.45, 1.1, 1.1];

/// What scenes of one machine share.
#[derive(Clone, Debug)]
pub struct Kit {
    /// Its pins.
    pub geometry: PinGeometry,
    /// Exact maps.
    pub machine: Machine<f64>,
    /// The step as the ECU has it.
    pub avoid: Avoid<f32>,
    /// The hull, to check by.
    pub hull: Hull<f64>,
    /// Nothing may come nearer at the start or the given target pose, m.
    keep_m: f64,
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Its number.
    pub number: u64,
    /// Swing, boom, arm, bucket at the start.
    pub start: [Rotor<f64>; 4],
    /// A pose that reaches the target, clear of the obstacles unless `careless`.
    pub pose: [Rotor<f64>; 4],
    /// Where the tip shall go.
    pub target: Target<f64>,
    /// One or two.
    pub obstacles: Vec<Sphere<f64>>,
    /// The target was taken without a look at the obstacles.
    pub careless: bool,
}

struct Dice(ChaCha8Rng);

impl Dice {
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }
}

impl Kit {
    /// Of a validated geometry.
    ///
    /// # Errors
    /// What the geometry or the rule's parameters lack.
    pub fn new(geometry: &PinGeometry) -> Result<Self, Box<dyn std::error::Error>> {
        let reach = geometry.reach_m();
        let flesh = Flesh::of_reach(reach);
        let rule = AvoidParameters::of_reach(reach, SPEEDS_RAD_S);
        let hull = Hull::<f32>::new(geometry, flesh)?;
        Ok(Self {
            geometry: *geometry,
            machine: Machine::new(geometry)?,
            avoid: Avoid::new(geometry, hull, &rule)?,
            hull: Hull::new(geometry, flesh)?,
            keep_m: 1.5 * rule.stop_m,
        })
    }

    fn pose(&self, dice: &mut Dice) -> [Rotor<f64>; 4] {
        let g = &self.geometry;
        let mut along = |stroke: kinematics_core::geometry::Stroke| {
            // A per mille from the ends: a pose on the very end may lie beyond it in f32.
            dice.between(
                stroke.min_m + 1e-3 * (stroke.max_m - stroke.min_m),
                stroke.max_m - 1e-3 * (stroke.max_m - stroke.min_m),
            )
        };
        let cylinders =
            Cylinders { boom: along(g.boom.stroke), arm: along(g.arm.stroke), bucket: along(g.bucket.stroke) };
        let swing = match (self.machine.swing_cylinder(), g.swing) {
            (Some(cylinder), Some(pins)) => cylinder.rotor(along(pins.stroke)).unwrap_or(Rotor::IDENTITY),
            _ => Rotor::from_turns(dice.unit() - 0.5),
        };
        let joints = self.machine.cylinders_to_joints(&cylinders).unwrap_or(Joints {
            boom: Rotor::IDENTITY,
            arm: Rotor::IDENTITY,
            bucket: Rotor::IDENTITY,
        });
        [swing, joints.boom, joints.arm, joints.bucket]
    }

    /// The distance at which an approach comes to rest, m.
    pub fn stop_m(&self) -> f64 {
        self.keep_m / 1.5
    }

    /// The tip in space, m.
    pub fn tip(&self, joints: &[Rotor<f64>; 4]) -> [f64; 3] {
        let [swing, boom, arm, bucket] = *joints;
        let pose = self.machine.joints_to_tip(&Joints { boom, arm, bucket }, swing);
        [pose.x, pose.y, pose.z()]
    }

    /// Smallest distance of the hull from spheres, m.
    pub fn clearance(&self, joints: &[Rotor<f64>; 4], obstacles: &[Sphere<f64>]) -> f64 {
        let placed = self.hull.place(joints);
        obstacles.iter().map(|o| placed.nearest(o).distance).fold(f64::INFINITY, f64::min)
    }

    fn obstacle(&self, dice: &mut Dice, between: Option<[&[Rotor<f64>; 4]; 2]>) -> Sphere<f64> {
        let reach = self.geometry.reach_m();
        let radius = dice.between(0.02, 0.12) * reach;
        let [x, y, z] = match between {
            Some([start, pose]) => {
                // Around a point of arm or bucket half-way along the straight way.
                let share = dice.between(0.25, 0.75);
                let mut joints = [Rotor::IDENTITY; 4];
                for ((joint, a), b) in joints.iter_mut().zip(start).zip(pose) {
                    *joint = *a * Rotor::from_angle(share * (*b * a.inverse()).angle());
                }
                let placed = self.hull.place(&joints);
                let segments: Vec<_> = placed.capsules().map(|(segment, _)| segment).collect();
                let [from, to] = segments[if dice.unit() < 0.5 { 4 } else { 5 }];
                let s = dice.unit();
                let point = from.scale(1.0 - s) + to.scale(s);
                let point = Vec2::new(point.x + self.geometry.boom_pin_x_m, point.z);
                [point.x * joints[0].cos, point.x * joints[0].sin, point.z]
                    .map(|x| x + dice.between(-0.5, 0.5) * radius)
            }
            None => loop {
                let point = [0; 3].map(|_| dice.between(-1.0, 1.0));
                if point.iter().map(|x| x * x).sum::<f64>() < 1.0 {
                    break point.map(|x| x * reach);
                }
            },
        };
        Sphere { x, y, z, radius }
    }

    /// The scene of this number.
    pub fn scene(&self, seed: u64, number: u64) -> Scene {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(number);
        let mut dice = Dice(rng);
        let careless = dice.unit() < 1.0 / 16.0;
        loop {
            let (start, pose) = (self.pose(&mut dice), self.pose(&mut dice));
            let count = if dice.unit() < 0.5 { 1 } else { 2 };
            let obstacles: Vec<_> = (0..count)
                .map(|_| {
                    let in_the_way = dice.unit() < 0.6;
                    self.obstacle(&mut dice, in_the_way.then_some([&start, &pose]))
                })
                .collect();
            let clear = |joints| self.clearance(joints, &obstacles) > self.keep_m;
            let [x, y, z] = self.tip(&pose);
            if clear(&start) && (careless || clear(&pose)) {
                return Scene { number, start, pose, target: Target { x, y, z }, obstacles, careless };
            }
        }
    }
}
