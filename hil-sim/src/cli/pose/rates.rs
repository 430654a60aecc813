//! What `--rates` adds to a pose: moment arms, Jacobians of joints and cylinders, velocity and force ellipses.

use kinematics_core::isotropy::{Ellipse, condition_number, force_ellipse, velocity_ellipse};
use kinematics_core::jacobian::PlanarJacobian;
use kinematics_core::rates::MomentArms;
use serde::Serialize;

use super::report::{PerLink, line};
use super::{Number, angle};

/// Rows of the joint-space Jacobian of the tip; columns boom, arm, bucket joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct JointRows<T> {
    reach_m_per_rad: [T; 3],
    height_m_per_rad: [T; 3],
    pitch_rad_per_rad: [T; 3],
}

/// Rows of the cylinder-space Jacobian of the tip; columns boom, arm, bucket cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CylinderRows<T> {
    reach_m_per_m: [T; 3],
    height_m_per_m: [T; 3],
    pitch_rad_per_m: [T; 3],
}

/// What the tip's velocity describes at joint rates of 1 rad/s in all.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct VelocityEllipse<T> {
    major_m_per_rad: T,
    minor_m_per_rad: T,
    /// Of the major axis, above forward, in (−90, 90] degrees.
    direction_deg: T,
}

/// What the tip's force describes at joint torques of 1 N·m in all.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ForceEllipse<T> {
    major_n_per_nm: T,
    minor_n_per_nm: T,
    /// Of the major axis, above forward, in (−90, 90] degrees.
    direction_deg: T,
}

/// The rates of one pose. What a singular pose does not have is `None`, and `singular` says why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rates<T> {
    /// dL/dθ.
    moment_arms_m_per_rad: PerLink<T>,
    /// dθ/dL.
    transmission_rad_per_m: Option<PerLink<T>>,
    joint_jacobian: JointRows<T>,
    cylinder_jacobian: Option<CylinderRows<T>>,
    /// Of rows reach and height of the joint Jacobian.
    condition_number: Option<T>,
    velocity_ellipse: VelocityEllipse<T>,
    force_ellipse: Option<ForceEllipse<T>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    singular: Vec<String>,
}

/// The direction of an axis, which has no front.
fn axis<T: Number>(ellipse: &Ellipse<T>) -> T {
    let degrees = angle::degrees(ellipse.direction).to_f64();
    let turned = if degrees > 90.0 { degrees - 180.0 } else { degrees };
    T::from_f64(if turned <= -90.0 { turned + 180.0 } else { turned })
}

impl<T: Number> Rates<T> {
    pub(super) fn new(arms: &MomentArms<T>, jacobian: &PlanarJacobian<T>) -> Self {
        let mut singular = Vec::new();
        let cylinder = jacobian.per_cylinder(arms);
        let tip = jacobian.matrix_2x3();
        let (ellipse, force) = (velocity_ellipse(&tip), force_ellipse(&tip));
        singular.extend(cylinder.err().map(|e| e.to_string()));
        if force.is_none() {
            singular.push("boom, arm and bucket are in line".to_owned());
        }
        // −0 would be a second name for 0.
        let plain = |row: [T; 3]| row.map(|x| x + T::ZERO);
        let [reach, height, pitch] = jacobian.matrix().map(plain);
        let per_link = |[boom, arm, bucket]: [T; 3]| PerLink { boom, arm, bucket };
        Self {
            moment_arms_m_per_rad: per_link(plain([arms.boom, arms.arm, arms.bucket])),
            transmission_rad_per_m: cylinder.ok().map(|c| per_link(plain(c.pitch))),
            joint_jacobian: JointRows { reach_m_per_rad: reach, height_m_per_rad: height, pitch_rad_per_rad: pitch },
            cylinder_jacobian: cylinder.ok().map(|c| CylinderRows {
                reach_m_per_m: plain(c.reach),
                height_m_per_m: plain(c.height),
                pitch_rad_per_m: plain(c.pitch),
            }),
            condition_number: condition_number(&tip),
            velocity_ellipse: VelocityEllipse {
                major_m_per_rad: ellipse.major,
                minor_m_per_rad: ellipse.minor,
                direction_deg: axis(&ellipse),
            },
            force_ellipse: force.map(|force| ForceEllipse {
                major_n_per_nm: force.major,
                minor_n_per_nm: force.minor,
                direction_deg: axis(&force),
            }),
            singular,
        }
    }

    /// Lines of the table for people.
    pub(super) fn to_table(&self) -> String {
        const NAMES: [&str; 3] = ["boom", "arm", "bucket"];
        let named = |[boom, arm, bucket]: [T; 3]| NAMES.into_iter().zip([boom, arm, bucket]).collect::<Vec<_>>();
        let links = |of: &PerLink<T>| named([of.boom, of.arm, of.bucket]);
        let mut table = line("moment arms", "m/rad", &links(&self.moment_arms_m_per_rad));
        if let Some(transmission) = &self.transmission_rad_per_m {
            table += &line("transmission", "rad/m", &links(transmission));
        }
        let joint = &self.joint_jacobian;
        table += &line("reach/joint", "m/rad", &named(joint.reach_m_per_rad));
        table += &line("height/joint", "m/rad", &named(joint.height_m_per_rad));
        table += &line("pitch/joint", "", &named(joint.pitch_rad_per_rad));
        if let Some(cylinder) = &self.cylinder_jacobian {
            table += &line("reach/cyl.", "m/m", &named(cylinder.reach_m_per_m));
            table += &line("height/cyl.", "m/m", &named(cylinder.height_m_per_m));
            table += &line("pitch/cyl.", "rad/m", &named(cylinder.pitch_rad_per_m));
        }
        if let Some(condition) = self.condition_number {
            table += &line("condition", "", &[("", condition)]);
        }
        let v = &self.velocity_ellipse;
        let axes = [("major", v.major_m_per_rad), ("minor", v.minor_m_per_rad), ("at deg", v.direction_deg)];
        table += &line("velocity", "m/rad", &axes);
        if let Some(f) = &self.force_ellipse {
            let axes = [("major", f.major_n_per_nm), ("minor", f.minor_n_per_nm), ("at deg", f.direction_deg)];
            table += &line("force", "1/m", &axes);
        }
        for reason in &self.singular {
            table += &format!("singular: {reason}\n");
        }
        table
    }
}
