//! A machine with its hull, for the tests of planning past obstacles.

use kinematics_core::geometry::Stroke;
use kinematics_core::planning::avoid::{Avoid, AvoidParameters};
use kinematics_core::planning::hull::{Flesh, Hull, Sphere};
use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};

use crate::sweep::Random;

/// Speed limits of swing, boom, arm, bucket, rad/s.
pub const SPEEDS_RAD_S: [f64; 4] = [1.1, 0.45, 0.9, 1.2];

/// What planning past obstacles needs of a machine.
#[derive(Clone, Debug)]
pub struct Kit {
    /// Its pins.
    pub geometry: PinGeometry,
    /// Its maps.
    pub machine: Machine<f64>,
    /// What is around its pins.
    pub flesh: Flesh,
    /// Its hull.
    pub hull: Hull<f64>,
    /// Of the step.
    pub parameters: AvoidParameters,
    /// The step.
    pub avoid: Avoid<f64>,
}

/// A difference of angles, rad, without whole turns.
pub fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::TAU;
    angle - TAU * libm::round(angle / TAU)
}

impl Kit {
    /// Of a validated machine.
    ///
    /// # Panics
    /// When it is not.
    pub fn new(geometry: &PinGeometry) -> Self {
        let reach_m = geometry.reach_m();
        let flesh = Flesh::of_reach(reach_m);
        let parameters = AvoidParameters::of_reach(reach_m, SPEEDS_RAD_S);
        let hull = Hull::new(geometry, flesh).unwrap();
        let avoid = Avoid::new(geometry, hull, &parameters).unwrap();
        Self { geometry: *geometry, machine: Machine::new(geometry).unwrap(), flesh, hull, parameters, avoid }
    }

    /// Angles of boom, arm, bucket, rad, at shares of their strokes, counted on from the shortest length without a jump.
    ///
    /// # Panics
    /// When a linkage does not close.
    pub fn angles(&self, shares: [f64; 3]) -> [f64; 3] {
        let g = &self.geometry;
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        core::array::from_fn(|which| {
            let at = |share: f64| {
                let along = |s: Stroke| s.min_m + (s.max_m - s.min_m) * share;
                let mut lengths = strokes.map(|s| s.min_m);
                lengths[which] = along(strokes[which]);
                let [boom, arm, bucket] = lengths;
                let joints = self.machine.cylinders_to_joints(&Cylinders { boom, arm, bucket }).unwrap();
                [joints.boom, joints.arm, joints.bucket][which].angle()
            };
            let pieces = 20;
            (0..pieces).fold(at(0.0), |angle, i| {
                let part = |i: i32| shares[which] * f64::from(i) / f64::from(pieces);
                angle + wrapped(at(part(i + 1)) - at(part(i)))
            })
        })
    }

    /// A pose within the strokes, at any swing: the angles.
    pub fn pose(&self, random: &mut Random) -> [f64; 4] {
        let [boom, arm, bucket] = self.angles(core::array::from_fn(|_| 0.02 + 0.96 * random.unit()));
        [std::f64::consts::TAU * (random.unit() - 0.5), boom, arm, bucket]
    }

    /// A ball beside a capsule of the hull at these angles, up to a tenth of the reach away from it.
    ///
    /// # Panics
    /// When the hull has no capsules.
    pub fn ball_beside(&self, angles: [f64; 4], random: &mut Random) -> Sphere<f64> {
        let reach = self.geometry.reach_m();
        let placed = self.hull.place(&rotors(angles));
        let capsules: Vec<_> = placed.capsules().collect();
        let ([from, to], thickness) = capsules[random.index(capsules.len())];
        let along = from + (to - from).scale(random.unit());
        let [mut up, mut aside] = [random.unit() - 0.5, random.unit() - 0.5];
        let size = libm::hypot(up, aside);
        let radius = (0.02 + 0.08 * random.unit()) * reach;
        let away = thickness + radius + 0.1 * reach * random.unit();
        (up, aside) = (up * away / size, aside * away / size);
        let (out, swing) = (along.x + self.geometry.boom_pin_x_m, angles[0]);
        Sphere {
            x: out * libm::cos(swing) - aside * libm::sin(swing),
            y: out * libm::sin(swing) + aside * libm::cos(swing),
            z: along.z + up,
            radius,
        }
    }
}

/// The joints at these angles, rad.
pub fn rotors(angles: [f64; 4]) -> [Rotor<f64>; 4] {
    angles.map(Rotor::from_angle)
}
