//! Joint angles → cylinder lengths and moment arms, through the exact maps of `kinematics-core`; a swing motor is its own joint.

use kinematics_core::swing::SwingCylinder;
use kinematics_core::{Cylinders, GeometryError, Joints, Machine, PinGeometry, PoseError, Rotor};

/// The machine's joints and their ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointMap {
    machine: Machine<f64>,
    /// Angles of swing, boom, arm, bucket at the retracted and extended end, rad; a motor has none.
    ends: [Option<[f64; 2]>; 4],
}

/// What the joints' angles make of the actuators.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Actuators {
    /// Swing (motor: rad), boom, arm, bucket: m.
    pub positions: [f64; 4],
    /// dL/dθ, m/rad; 1 for a motor.
    pub arms: [f64; 4],
}

fn rotor(angle: f64) -> Rotor<f64> {
    Rotor { cos: libm::cos(angle), sin: libm::sin(angle) }
}

fn swing_angle(cylinder: &SwingCylinder<f64>, length: f64) -> Result<f64, PoseError<f64>> {
    cylinder.rotor(length).map(Rotor::angle)
}

impl JointMap {
    /// Of a machine's pins.
    ///
    /// # Errors
    /// The geometry's first problem.
    pub(super) fn new(geometry: &PinGeometry) -> Result<Self, GeometryError> {
        let machine = Machine::new(geometry)?;
        let mut map = Self { machine, ends: [None; 4] };
        let strokes = [geometry.boom.stroke, geometry.arm.stroke, geometry.bucket.stroke];
        let at = |lengths: [f64; 3]| map.angles_in_plane(lengths).ok();
        let (low, high) = (at(strokes.map(|s| s.min_m)), at(strokes.map(|s| s.max_m)));
        for i in 0..3 {
            map.ends[i + 1] = low.zip(high).map(|(low, high)| [low[i], high[i]]);
        }
        if let Some((cylinder, pins)) = machine.swing_cylinder().zip(geometry.swing) {
            let end = |length| swing_angle(cylinder, length).ok();
            map.ends[0] = end(pins.stroke.min_m).zip(end(pins.stroke.max_m)).map(|(low, high)| [low, high]);
        }
        Ok(map)
    }

    fn angles_in_plane(&self, [boom, arm, bucket]: [f64; 3]) -> Result<[f64; 3], PoseError<f64>> {
        let joints = self.machine.cylinders_to_joints(&Cylinders { boom, arm, bucket })?;
        Ok([joints.boom, joints.arm, joints.bucket].map(Rotor::angle))
    }

    /// The joints at positions, rad.
    ///
    /// # Errors
    /// A position outside its stroke.
    pub(super) fn angles(&self, [swing, boom, arm, bucket]: [f64; 4]) -> Result<[f64; 4], PoseError<f64>> {
        let [boom, arm, bucket] = self.angles_in_plane([boom, arm, bucket])?;
        let swing = self.machine.swing_cylinder().map_or(Ok(swing), |cylinder| swing_angle(cylinder, swing))?;
        Ok([swing, boom, arm, bucket])
    }

    /// Smallest and largest angle of a joint, rad.
    pub(super) fn range(&self, joint: usize) -> Option<[f64; 2]> {
        self.ends[joint].map(|[a, b]| if a < b { [a, b] } else { [b, a] })
    }

    /// The actuators at these angles. Between the ends every linkage closes; `before` stands in where rounding says otherwise.
    pub(super) fn actuators(&self, angles: [f64; 4], before: &Actuators) -> Actuators {
        let [swing, boom, arm, bucket] = angles;
        let joints = Joints { boom: rotor(boom), arm: rotor(arm), bucket: rotor(bucket) };
        let mut found = *before;
        if let Ok(lengths) = self.machine.joints_to_cylinders_any_stroke(&joints) {
            [found.positions[1], found.positions[2], found.positions[3]] = [lengths.boom, lengths.arm, lengths.bucket];
        }
        if let Ok(arms) = self.machine.moment_arms_at(&joints) {
            [found.arms[1], found.arms[2], found.arms[3]] = [arms.boom, arms.arm, arms.bucket];
        }
        (found.positions[0], found.arms[0]) = match self.machine.swing_cylinder() {
            None => (swing, 1.0),
            Some(cylinder) => {
                let length = cylinder.length(rotor(swing)).unwrap_or(before.positions[0]);
                (length, cylinder.moment_arm(length).unwrap_or(before.arms[0]))
            }
        };
        found
    }
}
