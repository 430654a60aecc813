//! The same chain through peer libraries: `k` (iterative inverse) and `rs-opw-kinematics` (closed form, six axes). Neither knows
//! cylinders; the papers' angle formulas supply that part.

use k::nalgebra as na;
use k::prelude::*;
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;

use crate::seed::double::Dimensions;

/// Both peers, set up for Frankel's chain, inches.
pub struct Peers {
    k: k::SerialChain<f64>,
    k_solver: k::JacobianIkSolver<f64>,
    opw: OPWKinematics,
}

/// A revolute joint at `offset` from the one before, turning counter-clockwise in the boom's plane for `plane`, else about z.
fn node(name: &str, offset: [f64; 3], plane: bool) -> k::Node<f64> {
    let [x, y, z] = offset;
    let axis = if plane { -na::Vector3::y_axis() } else { na::Vector3::z_axis() };
    k::NodeBuilder::new()
        .name(name)
        .translation(na::Translation3::new(x, y, z))
        .joint_type(k::JointType::Rotational { axis })
        .finalize()
        .into()
}

/// The base-frame orientation of a bucket swung by `swing` and pitched by `pitch`.
fn orientation(swing: f64, pitch: f64) -> na::UnitQuaternion<f64> {
    na::UnitQuaternion::from_axis_angle(&na::Vector3::z_axis(), swing)
        * na::UnitQuaternion::from_axis_angle(&na::Vector3::y_axis(), -pitch)
}

impl Peers {
    /// Frankel's chain in both libraries.
    pub fn new() -> Self {
        let [a1, a2, a3, a4] = Dimensions::new().a;
        let swing = node("swing", [0.0; 3], false);
        let boom = node("boom", [a1, 0.0, 0.0], true);
        let arm = node("arm", [a2, 0.0, 0.0], true);
        let bucket = node("bucket", [a3, 0.0, 0.0], true);
        let tip: k::Node<f64> =
            k::NodeBuilder::new().name("tip").translation(na::Translation3::new(a4, 0.0, 0.0)).finalize().into();
        boom.set_parent(&swing);
        arm.set_parent(&boom);
        bucket.set_parent(&arm);
        tip.set_parent(&bucket);
        Self {
            k: k::SerialChain::from_end(&tip),
            // To a micrometre and a microradian, in inches.
            k_solver: k::JacobianIkSolver::new(4e-5, 1e-6, 0.5, 100),
            opw: OPWKinematics::new(Parameters {
                a1,
                a2: 0.0,
                b: 0.0,
                c1: 0.0,
                c2: a2,
                c3: a3,
                c4: a4,
                offsets: [0.0; 6],
                sign_corrections: [1; 6],
                dof: 6,
            }),
        }
    }

    /// `k`: joints → tip, in.
    pub fn k_tip(&self, swing: f64, [boom, arm, bucket]: [f64; 3]) -> [f64; 3] {
        self.k.set_joint_positions_unchecked(&[swing, boom, arm, bucket]);
        self.k.update_transforms();
        self.k.end_transform().translation.vector.into()
    }

    /// `k`: tip (reach, height, pitch) → joints, iterating from a pose in mid-stroke.
    pub fn k_joints(&self, swing: f64, [reach, height, pitch]: [f64; 3]) -> [f64; 3] {
        self.k.set_joint_positions_unchecked(&[swing, 0.0, -1.2, -1.0]);
        let at = na::Translation3::new(reach * swing.cos(), reach * swing.sin(), height);
        let target = na::Isometry3::from_parts(at, orientation(swing, pitch));
        let only = k::Constraints { rotation_x: false, rotation_z: false, ..Default::default() };
        let _ = self.k_solver.solve_with_constraints(&self.k, &target, &only);
        let joints = self.k.joint_positions();
        [joints[1], joints[2], joints[3]]
    }

    /// `rs-opw-kinematics`: joints → pose of the tool, in. Its arm stands upright at zero, and J5 turns the bucket.
    pub fn opw_pose(&self, swing: f64, [boom, arm, bucket]: [f64; 3]) -> Pose {
        let quarter = core::f64::consts::FRAC_PI_2;
        self.opw.forward(&[swing, quarter - boom, -arm, 0.0, -bucket, 0.0])
    }

    /// `rs-opw-kinematics`: joints → tip, in.
    pub fn opw_tip(&self, swing: f64, joints: [f64; 3]) -> [f64; 3] {
        let pose = self.opw_pose(swing, joints);
        [pose.translation.x, pose.translation.y, pose.translation.z]
    }

    /// `rs-opw-kinematics`: pose of the tool → joints, the curled arm among up to eight solutions.
    pub fn opw_joints(&self, pose: &Pose) -> Option<[f64; 3]> {
        let quarter = core::f64::consts::FRAC_PI_2;
        let solutions = self.opw.inverse(pose);
        let joints = solutions.iter().map(|q| [q[3].abs() + q[5].abs(), quarter - q[1], -q[2], -q[4]]);
        joints.filter(|[off_plane, _, arm, _]| *off_plane < 1e-6 && *arm < 0.0).map(|[_, b, a, k]| [b, a, k]).next()
    }
}

impl Default for Peers {
    fn default() -> Self {
        Self::new()
    }
}
