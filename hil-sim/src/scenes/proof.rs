//! What an independent search says of a target that was not reached.

use std::collections::VecDeque;

use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinders, Joints, PlaneTip, Rotor};
use serde::Serialize;

use super::generate::{Kit, Scene};

/// Pitches tried: nearly twice as dense as the planner's finest.
const PITCHES: u32 = 2880;
/// Places of swing, boom, arm, bucket on the grid, and on the one tried where that has no path.
const GRIDS: [[usize; 4]; 2] = [[60, 21, 21, 21], [120, 41, 41, 41]];

/// The search's word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Proof {
    /// None of the pitches gives a pose within the stroke that is clear by what the planner asks for.
    NoClearPose,
    /// There is a clear pose, but a flood from the start over a grid of all poses does not come to it, nor over one twice as fine.
    NoPathOnGrid,
    /// The places of the grid hang together; between them nothing is checked. The planner owes an answer.
    PathOnGrid,
}

/// A place on the grid.
type Node = [usize; 4];

/// All poses of the grid, by axis.
struct Grid {
    sizes: Node,
    axes: [Vec<Rotor<f64>>; 4],
    all_round: bool,
}

impl Kit {
    /// Looks for a clear pose at the target, and then for a path to it.
    pub(super) fn prove(&self, scene: &Scene) -> Proof {
        let goals = self.clear_poses(scene);
        if goals.is_empty() {
            return Proof::NoClearPose;
        }
        let path = GRIDS.into_iter().any(|sizes| self.flood(scene, &self.grid(sizes), &goals));
        if path { Proof::PathOnGrid } else { Proof::NoPathOnGrid }
    }

    /// Clear poses at the target, by their pitch.
    pub(super) fn clear_poses(&self, scene: &Scene) -> Vec<[Rotor<f64>; 4]> {
        let t = scene.target;
        let reach = t.x.hypot(t.y);
        let ahead = Rotor { cos: t.x / reach, sin: t.y / reach };
        let behind = Rotor { cos: -ahead.cos, sin: -ahead.sin };
        let tries = (0..PITCHES).flat_map(|i| [(i, ahead, reach), (i, behind, -reach)]);
        let pose = |(i, swing, reach): (u32, Rotor<f64>, f64)| {
            let pitch = Rotor::from_turns(f64::from(i) / f64::from(PITCHES));
            let joints = self.machine.tip_to_joints(&PlaneTip { reach, height: t.z, pitch }).ok()?;
            self.machine.joints_to_cylinders(&joints).ok()?;
            if let Some(cylinder) = self.machine.swing_cylinder() {
                cylinder.length(swing).ok()?;
            }
            let joints = [swing, joints.boom, joints.arm, joints.bucket];
            (self.clearance(&joints, &scene.obstacles) > 1.02 * self.stop_m()).then_some(joints)
        };
        tries.filter_map(pose).collect()
    }

    fn grid(&self, sizes: Node) -> Grid {
        let g = &self.geometry;
        let along = |stroke: Stroke, i: usize, of: usize| {
            stroke.min_m + (stroke.max_m - stroke.min_m) * i as f64 / (of - 1) as f64
        };
        let [swings, booms, arms, buckets] = sizes;
        let joints = |boom: f64, arm: f64, bucket: f64| -> Joints<f64> {
            let level = Joints { boom: Rotor::IDENTITY, arm: Rotor::IDENTITY, bucket: Rotor::IDENTITY };
            self.machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap_or(level)
        };
        let (b, a, k) = (g.boom.stroke, g.arm.stroke, g.bucket.stroke);
        let swing = |i: usize| match (self.machine.swing_cylinder(), g.swing) {
            (Some(cylinder), Some(pins)) => cylinder.rotor(along(pins.stroke, i, swings)).unwrap_or(Rotor::IDENTITY),
            _ => Rotor::from_turns(i as f64 / swings as f64),
        };
        Grid {
            sizes,
            axes: [
                (0..swings).map(swing).collect(),
                (0..booms).map(|i| joints(along(b, i, booms), a.min_m, k.min_m).boom).collect(),
                (0..arms).map(|i| joints(b.min_m, along(a, i, arms), k.min_m).arm).collect(),
                (0..buckets).map(|i| joints(b.min_m, a.min_m, along(k, i, buckets)).bucket).collect(),
            ],
            all_round: g.swing.is_none(),
        }
    }

    /// Whether the free places around the start and those around a goal hang together.
    fn flood(&self, scene: &Scene, grid: &Grid, goals: &[[Rotor<f64>; 4]]) -> bool {
        let size: usize = grid.sizes.iter().product();
        let mut wanted = vec![false; size];
        for goal in goals {
            for node in grid.around(grid.nearest(goal)) {
                wanted[grid.index(node)] = true;
            }
        }
        let mut seen = vec![false; size];
        let mut edge: VecDeque<Node> = grid.around(grid.nearest(&scene.start)).into();
        while let Some(node) = edge.pop_front() {
            let at = grid.index(node);
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            let joints = std::array::from_fn(|axis| grid.axes[axis][node[axis]]);
            if self.clearance(&joints, &scene.obstacles) <= self.stop_m() {
                continue;
            }
            if wanted[at] {
                return true;
            }
            edge.extend(grid.neighbours(node));
        }
        false
    }
}

impl Grid {
    fn index(&self, node: Node) -> usize {
        node.iter().zip(self.sizes).fold(0, |sum, (&i, of)| sum * of + i)
    }

    fn nearest(&self, joints: &[Rotor<f64>; 4]) -> Node {
        std::array::from_fn(|axis| {
            let toward = |r: &Rotor<f64>| r.to_vec().dot(joints[axis].to_vec());
            let best = self.axes[axis].iter().enumerate().max_by(|a, b| toward(a.1).total_cmp(&toward(b.1)));
            best.map_or(0, |(i, _)| i)
        })
    }

    /// The place itself and its neighbours.
    fn around(&self, node: Node) -> Vec<Node> {
        let mut all = self.neighbours(node);
        all.push(node);
        all
    }

    /// One step along one axis.
    fn neighbours(&self, node: Node) -> Vec<Node> {
        let mut all = Vec::with_capacity(8);
        for (axis, of) in self.sizes.into_iter().enumerate() {
            let wraps = axis == 0 && self.all_round;
            for to in [node[axis].checked_add(1), node[axis].checked_sub(1).or(wraps.then_some(of - 1))] {
                let to = to.map(|to| if wraps { to % of } else { to });
                if let Some(to) = to.filter(|&to| to < of) {
                    let mut other = node;
                    other[axis] = to;
                    all.push(other);
                }
            }
        }
        all
    }
}
