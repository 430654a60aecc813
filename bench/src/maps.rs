//! The maps that are counted on the host, each on the same poses.

use std::hint::black_box;

use kinematics_core::{Cylinders, Machine, PlaneTip, Real, Rotor};

use crate::{ours, seed};

const SWING_RAD: f64 = 0.3;

/// One machine and poses along its strokes, in one number type.
pub struct Set<T> {
    machine: Machine<T>,
    swing: Rotor<T>,
    cylinders: Vec<Cylinders<T>>,
    tips: Vec<PlaneTip<T>>,
}

impl<T: Real> Set<T> {
    fn new() -> Self {
        let pins = ours::frankel().to_pins().expect("the paper's distances");
        let exact = Machine::<f64>::new(&pins).expect("the paper's machine");
        let cylinders = Poses::lengths_m();
        let tips = cylinders.iter().map(|&[boom, arm, bucket]| {
            let pose = exact.cylinders_to_tip(&Cylinders { boom, arm, bucket }, Rotor::IDENTITY);
            let plane = pose.expect("lengths inside the strokes").plane;
            let pitch = Rotor { cos: T::from_f64(plane.pitch.cos), sin: T::from_f64(plane.pitch.sin) };
            PlaneTip { reach: T::from_f64(plane.reach), height: T::from_f64(plane.height), pitch }
        });
        let swing = Rotor::<f64>::from_angle(SWING_RAD);
        Self {
            machine: Machine::new(&pins).expect("the paper's machine"),
            swing: Rotor { cos: T::from_f64(swing.cos), sin: T::from_f64(swing.sin) },
            tips: tips.collect(),
            cylinders: cylinders
                .iter()
                .map(|lengths| lengths.map(T::from_f64))
                .map(|[boom, arm, bucket]| Cylinders { boom, arm, bucket })
                .collect(),
        }
    }
}

/// Everything the maps work on.
pub struct Poses {
    f32: Set<f32>,
    f64: Set<f64>,
    seed_f32: seed::single::Dimensions,
    seed_f64: seed::double::Dimensions,
    cylinders_in: Vec<[f64; 3]>,
    tips_in: Vec<[f64; 3]>,
    #[cfg(feature = "peers")]
    peers: crate::peers::Peers,
    #[cfg(feature = "peers")]
    opw_poses: Vec<rs_opw_kinematics::kinematic_traits::Pose>,
}

impl Poses {
    /// How many poses there are.
    pub const COUNT: usize = 64;

    fn lengths_m() -> Vec<[f64; 3]> {
        let strokes = [(29.0, 46.5434), (27.699, 41.9298), (22.0242, 38.6144)];
        // Different strides spread the poses over all three strokes.
        let at = |i: usize, stride: usize| 0.02 + 0.96 * ((i * stride) % Self::COUNT) as f64 / Self::COUNT as f64;
        let length = |i: usize, stride: usize, (min, max): (f64, f64)| (min + at(i, stride) * (max - min)) * 0.0254;
        (0..Self::COUNT)
            .map(|i| [length(i, 1, strokes[0]), length(i, 5, strokes[1]), length(i, 11, strokes[2])])
            .collect()
    }

    /// The poses.
    pub fn new() -> Self {
        let f64 = Set::<f64>::new();
        let inches = |x: f64| x / 0.0254;
        let tips = f64.tips.iter().map(|tip| [inches(tip.reach), inches(tip.height), tip.pitch.angle()]);
        #[cfg(feature = "peers")]
        let (peers, opw_poses) = {
            let (peers, seed) = (crate::peers::Peers::new(), seed::double::Dimensions::new());
            let pose = |m: [f64; 3]| peers.opw_pose(SWING_RAD, seed.cyl_to_joint(m.map(inches)));
            let poses = Self::lengths_m().into_iter().map(pose).collect();
            (peers, poses)
        };
        Self {
            f32: Set::new(),
            seed_f32: seed::single::Dimensions::new(),
            seed_f64: seed::double::Dimensions::new(),
            cylinders_in: Self::lengths_m().into_iter().map(|lengths| lengths.map(inches)).collect(),
            tips_in: tips.collect(),
            #[cfg(feature = "peers")]
            peers,
            #[cfg(feature = "peers")]
            opw_poses,
            f64,
        }
    }
}

impl Default for Poses {
    fn default() -> Self {
        Self::new()
    }
}

/// Runs a map on pose number so-and-so.
pub type Map = fn(&Poses, usize);

fn single(x: [f64; 3]) -> [f32; 3] {
    x.map(|x| x as f32)
}

/// Every map by name. `nothing` is what the counting itself costs.
pub const MAPS: &[(&str, Map)] = &[
    ("nothing", |p, i| {
        black_box((black_box(&p.f64.cylinders[i]), black_box(&p.f64.tips[i])));
    }),
    ("cylinders_to_tip_f64", |p, i| {
        let set = &p.f64;
        let _ = black_box(set.machine.cylinders_to_tip(black_box(&set.cylinders[i]), set.swing));
    }),
    ("cylinders_to_tip_f32", |p, i| {
        let set = &p.f32;
        let _ = black_box(set.machine.cylinders_to_tip(black_box(&set.cylinders[i]), set.swing));
    }),
    ("tip_to_cylinders_f64", |p, i| {
        let _ = black_box(p.f64.machine.tip_to_cylinders(black_box(&p.f64.tips[i])));
    }),
    ("tip_to_cylinders_f32", |p, i| {
        let _ = black_box(p.f32.machine.tip_to_cylinders(black_box(&p.f32.tips[i])));
    }),
    ("angles_cylinders_to_tip_f64", |p, i| {
        black_box(p.seed_f64.cylinders_to_tip(SWING_RAD, *black_box(&p.cylinders_in[i])));
    }),
    ("angles_cylinders_to_tip_f32", |p, i| {
        black_box(p.seed_f32.cylinders_to_tip(SWING_RAD as f32, single(*black_box(&p.cylinders_in[i]))));
    }),
    ("angles_tip_to_cylinders_f64", |p, i| {
        black_box(p.seed_f64.tip_to_cylinders(*black_box(&p.tips_in[i])));
    }),
    ("angles_tip_to_cylinders_f32", |p, i| {
        black_box(p.seed_f32.tip_to_cylinders(single(*black_box(&p.tips_in[i]))));
    }),
    #[cfg(feature = "peers")]
    ("k_cylinders_to_tip_f64", |p, i| {
        let joints = p.seed_f64.cyl_to_joint(*black_box(&p.cylinders_in[i]));
        black_box(p.peers.k_tip(SWING_RAD, joints));
    }),
    #[cfg(feature = "peers")]
    ("k_tip_to_cylinders_f64", |p, i| {
        let joints = p.peers.k_joints(SWING_RAD, *black_box(&p.tips_in[i]));
        black_box(p.seed_f64.joint_to_cyl(joints));
    }),
    #[cfg(feature = "peers")]
    ("opw_cylinders_to_tip_f64", |p, i| {
        let joints = p.seed_f64.cyl_to_joint(*black_box(&p.cylinders_in[i]));
        black_box(p.peers.opw_tip(SWING_RAD, joints));
    }),
    #[cfg(feature = "peers")]
    ("opw_tip_to_cylinders_f64", |p, i| {
        let joints = p.peers.opw_joints(black_box(&p.opw_poses[i]));
        black_box(joints.map(|joints| p.seed_f64.joint_to_cyl(joints)));
    }),
];
