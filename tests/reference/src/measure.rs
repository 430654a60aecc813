//! The worst error of the maps over whole strokes, against the oracle.

use core::fmt;

use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, PlaneTip, PoseError, Real, Rotor};

use crate::oracle::{Oracle, Placed, apart, direction};
use crate::sweep::{Random, lengths};
use crate::wide::Point;

/// Of each cylinder, how many lengths with the largest error to either side enter the poses, and how many random ones beside.
const EXTREMES: usize = 24;
const OTHERS: usize = 12;
/// Random triples of lengths out of all.
const RANDOM_POSES: usize = 200_000;

/// The largest error seen and where.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    /// The error.
    pub value: f64,
    /// Boom, arm and bucket cylinder there, m.
    pub at: [f64; 3],
}

impl Worst {
    fn see(&mut self, value: f64, at: [f64; 3]) {
        assert!(value.is_finite(), "error {value} at {at:?}");
        if value > self.value {
            *self = Self { value, at };
        }
    }

    /// Divided by `by`.
    pub fn relative_to(self, by: f64) -> Self {
        Self { value: self.value / by, ..self }
    }
}

impl fmt::Display for Worst {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [boom, arm, bucket] = self.at;
        write!(f, "{:.2e} at cylinders {boom},{arm},{bucket} m", self.value)
    }
}

/// The worst of several, all over one set of poses.
pub fn worst_of(several: &[Worst]) -> Worst {
    several.iter().fold(Worst::default(), |worst, one| if one.value > worst.value { *one } else { worst })
}

/// One cylinder length with the exact joint direction.
#[derive(Clone, Copy, Debug)]
struct Sample<T> {
    length: T,
    exact: Point,
    /// Signed: by what angle the map's rotor lies counter-clockwise of the exact one, rad.
    turned_by: f64,
}

/// A machine in one precision beside its oracle.
#[derive(Debug)]
pub struct Bench<T> {
    machine: Machine<T>,
    oracle: Oracle,
    reach: f64,
    strokes: [Stroke; 3],
    samples: [Vec<Sample<T>>; 3],
    /// Index triples into `samples`.
    poses: Vec<[usize; 3]>,
    joints: [Worst; 3],
}

fn directions<T: Real>(joints: &Joints<T>) -> [Point; 3] {
    [joints.boom, joints.arm, joints.bucket].map(direction)
}

impl<T: Real> Bench<T> {
    /// Walks every cylinder's stroke and chooses the poses: all combinations of the lengths with the largest joint errors,
    /// the ends of the strokes among them, and random ones.
    ///
    /// # Panics
    /// When the geometry is refused or the maps refuse a length inside the stroke.
    pub fn new(geometry: &PinGeometry) -> Self {
        let machine = Machine::<T>::new(geometry).unwrap();
        let oracle = Oracle::new(geometry);
        let strokes = [geometry.boom.stroke, geometry.arm.stroke, geometry.bucket.stroke];
        let mut random = Random::new(1);
        let mut joints = [Worst::default(); 3];
        let middle = strokes.map(|s| T::from_f64(0.5 * (s.min_m + s.max_m)));
        let samples = [0, 1, 2].map(|which| {
            let worst = &mut joints[which];
            lengths(strokes[which], &mut random)
                .into_iter()
                .map(|length| {
                    let mut at = middle;
                    at[which] = length;
                    let [boom, arm, bucket] = at;
                    let found = machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap();
                    let found = directions(&found)[which];
                    let exact = match which {
                        0 => oracle.boom(length.to_f64()),
                        1 => oracle.arm(length.to_f64()),
                        _ => oracle.bucket(length.to_f64()),
                    };
                    worst.see(apart(found, exact), at.map(T::to_f64));
                    Sample { length, exact, turned_by: exact.cross(found).to_f64() }
                })
                .collect::<Vec<_>>()
        });
        let poses = poses(&samples, &strokes, &mut random);
        Self { machine, oracle, reach: geometry.reach_m(), strokes, samples, poses, joints }
    }

    /// How many poses the maps between cylinders and tip are tried at.
    pub fn pose_count(&self) -> usize {
        self.poses.len()
    }

    /// How many lengths each cylinder's joint is tried at.
    pub fn length_counts(&self) -> [usize; 3] {
        [0, 1, 2].map(|which| self.samples[which].len())
    }

    /// Joint rotors of boom, arm, bucket: distance from the exact unit vector, rad.
    pub fn joints(&self) -> [Worst; 3] {
        self.joints
    }

    fn visit(&self, mut at_pose: impl FnMut([f64; 3], Cylinders<T>, [Point; 3])) {
        for indices in &self.poses {
            let chosen = [0, 1, 2].map(|which| self.samples[which][indices[which]]);
            let [boom, arm, bucket] = chosen.map(|s| s.length);
            let at = chosen.map(|s| s.length.to_f64());
            at_pose(at, Cylinders { boom, arm, bucket }, chosen.map(|s| s.exact));
        }
    }

    fn tip(&self, cylinders: &Cylinders<T>) -> PlaneTip<T> {
        self.machine.cylinders_to_tip(cylinders, Rotor::IDENTITY).unwrap().plane
    }

    /// Cylinders → tip: the tip's error relative to reach, and the pitch rotor's.
    pub fn forward(&self) -> [Worst; 2] {
        let mut worst = [Worst::default(); 2];
        self.visit(|at, cylinders, exact| {
            let found = self.tip(&cylinders);
            let Placed { tip, pitch, .. } = self.oracle.place(exact);
            worst[0].see(apart(Point::new(found.reach.to_f64(), found.height.to_f64()), tip) / self.reach, at);
            worst[1].see(apart(direction(found.pitch), pitch), at);
        });
        worst
    }

    /// The lengths tip → cylinders finds, strokes unchecked: a pose at the very end may round to just outside.
    fn back(&self, tip: &PlaneTip<T>) -> [T; 3] {
        let joints = self.machine.tip_to_joints(tip).unwrap();
        let Cylinders { boom, arm, bucket } = self.machine.joints_to_cylinders_any_stroke(&joints).unwrap();
        [boom, arm, bucket]
    }

    /// Tip → cylinders of the same tip (as rounded to T), boom, arm, bucket, m.
    pub fn inverse(&self) -> [Worst; 3] {
        let mut worst = [Worst::default(); 3];
        self.visit(|at, cylinders, _| {
            let tip = self.tip(&cylinders);
            let exact = self.oracle.inverse(Point::new(tip.reach.to_f64(), tip.height.to_f64()), direction(tip.pitch));
            for ((worst, found), exact) in worst.iter_mut().zip(self.back(&tip)).zip(exact) {
                worst.see((found.to_f64() - exact.to_f64()).abs(), at);
            }
        });
        worst
    }

    /// Cylinders → tip → cylinders, all in T: by how much each length comes back changed, m.
    pub fn round_trip(&self) -> [Worst; 3] {
        let mut worst = [Worst::default(); 3];
        self.visit(|at, cylinders, _| {
            for ((worst, found), sent) in worst.iter_mut().zip(self.back(&self.tip(&cylinders))).zip(at) {
                worst.see((found.to_f64() - sent).abs(), at);
            }
        });
        worst
    }

    /// Of the poses with every cylinder from end to end of its stroke (the tolerance not used): how many the strict tip →
    /// cylinders refuses, and the largest excess it names, m.
    ///
    /// # Panics
    /// When one is refused for anything but an end of a stroke.
    pub fn refused_round_trips(&self) -> (usize, Worst) {
        let (mut count, mut worst) = (0, Worst::default());
        let ends = self.strokes.map(|s| [s.min_m, s.max_m].map(|end| T::from_f64(end).to_f64()));
        self.visit(|at, cylinders, _| {
            if at.iter().zip(ends).any(|(length, [min, max])| *length < min || *length > max) {
                return;
            }
            match self.machine.tip_to_cylinders(&self.tip(&cylinders)) {
                Ok(_) => {}
                Err(PoseError::OutOfStroke { by, .. }) => {
                    count += 1;
                    worst.see(by.to_f64().abs(), at);
                }
                Err(other) => panic!("{other:?} at {at:?}"),
            }
        });
        (count, worst)
    }

    /// Cylinders → tip → cylinders → tip: how far the tip moves, relative to reach.
    pub fn tip_round_trip(&self) -> Worst {
        let mut worst = Worst::default();
        self.visit(|at, cylinders, _| {
            let tip = self.tip(&cylinders);
            let [boom, arm, bucket] = self.back(&tip);
            // The strokes stop short of the dead points by more than rounding, so there always is a second tip.
            let joints = self.machine.cylinders_to_joints_any_stroke(&Cylinders { boom, arm, bucket }).unwrap();
            let again = self.machine.joints_to_tip(&joints, Rotor::IDENTITY).plane;
            let moved = apart(
                Point::new(again.reach.to_f64(), again.height.to_f64()),
                Point::new(tip.reach.to_f64(), tip.height.to_f64()),
            );
            worst.see(moved / self.reach, at);
        });
        worst
    }
}

fn poses<T: Real>(samples: &[Vec<Sample<T>>; 3], strokes: &[Stroke; 3], random: &mut Random) -> Vec<[usize; 3]> {
    let chosen = [0, 1, 2].map(|which| {
        let all = &samples[which];
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by(|l, r| all[*l].turned_by.total_cmp(&all[*r].turned_by));
        let mut chosen = [&order[..EXTREMES], &order[order.len() - EXTREMES..]].concat();
        chosen.extend((0..OTHERS).map(|_| random.index(all.len())));
        // Both ends of the stroke as T holds them, and the outermost lengths the tolerance lets in.
        let ends = [strokes[which].min_m, strokes[which].max_m].map(|x| T::from_f64(x));
        chosen.extend((0..all.len()).filter(|i| ends.contains(&all[*i].length)));
        chosen.extend([0, all.len() - 1]);
        chosen
    });
    let mut poses = Vec::new();
    for &boom in &chosen[0] {
        for &arm in &chosen[1] {
            poses.extend(chosen[2].iter().map(|&bucket| [boom, arm, bucket]));
        }
    }
    poses.extend((0..RANDOM_POSES).map(|_| [0, 1, 2].map(|which| random.index(samples[which].len()))));
    poses
}
