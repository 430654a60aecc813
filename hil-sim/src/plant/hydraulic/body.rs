//! Rigid-body dynamics of swing, boom, arm and bucket: one implicit step of the rates under cylinder forces.
//!
//! Worked in the links' absolute angles, where a planar chain's mass matrix is made of scalar products of first moments, then summed to
//! the joints' relative angles. The swing turns the whole plane: its inertia depends on the pose, and its rate throws the links outwards.

use kinematics_core::Vec2;

use super::matrix::{Sym3, solve};
use crate::machine_file::Link;

/// Acceleration of gravity, m/s².
pub(super) const GRAVITY_MPS2: f64 = kinematics_core::payload::STANDARD_GRAVITY_M_S2;

type Vector = Vec2<f64>;

/// The links' constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// a1 … a4, m.
    pub lengths: [f64; 4],
    /// Boom, arm, bucket; the bucket with what it carries.
    pub links: [Link; 3],
    /// Of the upper structure about the swing axis, without the links, kg m².
    pub upper_inertia_kgm2: f64,
}

/// Where everything is: vectors along the links and their first moments in the boom's plane.
#[derive(Clone, Copy, Debug)]
pub struct Posture {
    /// Boom pin → arm pin, arm pin → bucket pin, bucket pin → tip, m.
    pub links: [Vector; 3],
    /// Each link's pin → its centre of mass, m.
    centres: [Vector; 3],
    /// cos and sin of the absolute angles.
    directions: [Vector; 3],
}

/// A force on the tip and its secant damping: what the soil does in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TipResistance {
    /// Force over speed, N s/m.
    pub damping: f64,
    /// Constant part, N: along the reach and upwards.
    pub force: [f64; 2],
}

/// What turns the joints in a step.
#[derive(Clone, Copy, Debug)]
pub struct Loads {
    /// Torques of swing, boom, arm, bucket, N·m.
    pub torques: [f64; 4],
    /// Friction: torque over rate, N·m s.
    pub damping: [f64; 4],
    /// At the tip.
    pub tip: TipResistance,
    /// Rates at which a stop holds a joint, rad/s.
    pub held: [Option<f64>; 3],
}

/// A mass no machine has: what a held joint is given.
const HELD: f64 = 1e14;

impl Body {
    /// The posture at these absolute angles, rad.
    pub fn posture(&self, absolute: [f64; 3]) -> Posture {
        let directions = absolute.map(|angle| Vector::new(libm::cos(angle), libm::sin(angle)));
        let [_, a2, a3, a4] = self.lengths;
        let along = |i: usize, length: f64| directions[i].scale(length);
        let centre = |i: usize| self.links[i].centre.complex_mul(directions[i]);
        Posture { links: [along(0, a2), along(1, a3), along(2, a4)], centres: [0, 1, 2].map(centre), directions }
    }

    /// First moments about boom, arm and bucket pin that the links further in feel: m·c + (masses further out)·link.
    fn first_moments(&self, p: &Posture) -> [Vector; 3] {
        let [boom, arm, bucket] = self.links.map(|link| link.mass_kg);
        let of_bucket = p.centres[2].scale(bucket);
        let of_arm = p.centres[1].scale(arm) + p.links[1].scale(bucket);
        let of_boom = p.centres[0].scale(boom) + p.links[0].scale(arm + bucket);
        [of_boom, of_arm, of_bucket]
    }

    /// Mass matrix in absolute angles, kg m².
    fn mass(&self, p: &Posture, moments: &[Vector; 3]) -> Sym3 {
        let [boom, arm, bucket] = self.links;
        let own = |link: Link, i: usize| link.mass_kg * p.centres[i].norm_squared() + link.inertia_kgm2;
        let [b, a, _] = p.links;
        Sym3 {
            d: [
                own(boom, 0) + (arm.mass_kg + bucket.mass_kg) * b.norm_squared(),
                own(arm, 1) + bucket.mass_kg * a.norm_squared(),
                own(bucket, 2),
            ],
            o: [b.dot(moments[1]), b.dot(moments[2]), a.dot(moments[2])],
        }
    }

    /// Distances of the three centres of mass from the swing axis, m.
    fn radii(&self, p: &Posture) -> [f64; 3] {
        let elbow = self.lengths[0] + p.links[0].x;
        [self.lengths[0] + p.centres[0].x, elbow + p.centres[1].x, elbow + p.links[1].x + p.centres[2].x]
    }

    /// Inertia about the swing axis, kg m²; each link as a slender one along its line.
    pub fn swing_inertia(&self, p: &Posture) -> f64 {
        let radii = self.radii(p);
        let of = |i: usize| {
            let (link, cos) = (self.links[i], p.directions[i].x);
            link.mass_kg * radii[i] * radii[i] + link.inertia_kgm2 * cos * cos
        };
        self.upper_inertia_kgm2 + of(0) + of(1) + of(2)
    }

    /// Its derivatives by the absolute angles, kg m²/rad.
    fn swing_inertia_slopes(&self, p: &Posture) -> [f64; 3] {
        let radii = self.radii(p);
        let weight = [0, 1, 2].map(|i| -2.0 * self.links[i].mass_kg * radii[i]);
        let spin = |i: usize| -2.0 * self.links[i].inertia_kgm2 * p.directions[i].x * p.directions[i].z;
        [
            weight[0] * p.centres[0].z + (weight[1] + weight[2]) * p.links[0].z + spin(0),
            weight[1] * p.centres[1].z + weight[2] * p.links[1].z + spin(1),
            weight[2] * p.centres[2].z + spin(2),
        ]
    }

    /// Kinetic energy at these rates of swing, boom, arm, bucket (relative), J.
    pub fn kinetic_energy(&self, p: &Posture, rates: [f64; 4]) -> f64 {
        let absolute = absolute_rates(rates);
        let momenta = self.mass(p, &self.first_moments(p)).times(absolute);
        let plane: f64 = momenta.iter().zip(absolute).map(|(m, w)| m * w).sum();
        0.5 * (plane + self.swing_inertia(p) * rates[0] * rates[0])
    }

    /// Potential energy above the boom pin, J.
    pub fn potential_energy(&self, p: &Posture) -> f64 {
        GRAVITY_MPS2 * self.first_moments(p).iter().map(|moment| moment.z).sum::<f64>()
    }

    /// Torques of boom, arm and bucket that hold the links against gravity, N·m.
    pub fn holding_torques(&self, p: &Posture) -> [f64; 3] {
        let [boom, arm, bucket] = self.first_moments(p).map(|moment| GRAVITY_MPS2 * moment.x);
        [boom + arm + bucket, arm + bucket, bucket]
    }

    /// Rates of swing, boom, arm, bucket after a step of `h` seconds, rad/s.
    pub fn step(&self, p: &Posture, rates: [f64; 4], loads: &Loads, h: f64) -> [f64; 4] {
        let [_, boom, arm, bucket] = rates;
        let absolute = absolute_rates(rates);
        let moments = self.first_moments(p);
        let mass = self.mass(p, &moments);
        let swing_slopes = self.swing_inertia_slopes(p);

        // The plane: gravity, what the links' turning and the swing throw outwards, the cylinders, the soil.
        let [w2, w3, w4] = absolute.map(|w| w * w);
        let [b, a, tip] = p.links;
        let (b_arm, b_bucket, a_bucket) = (b.cross(moments[1]), b.cross(moments[2]), a.cross(moments[2]));
        let thrown = [-b_arm * w3 - b_bucket * w4, b_arm * w2 - a_bucket * w4, b_bucket * w2 + a_bucket * w3];
        let [_, of_boom, of_arm, of_bucket] = loads.torques;
        let drive = [of_boom - of_arm, of_arm - of_bucket, of_bucket];
        let outwards = 0.5 * rates[0] * rates[0];
        let pushed = Vector::new(loads.tip.force[0], loads.tip.force[1]);
        let momenta = mass.times(absolute);
        let levers = [b, a, tip];
        let impulse = [0, 1, 2].map(|i| {
            let torque = drive[i] - thrown[i] - GRAVITY_MPS2 * moments[i].x
                + outwards * swing_slopes[i]
                + levers[i].cross(pushed);
            momenta[i] + h * torque
        });
        let mut matrix = mass;
        if loads.tip.damping > 0.0 {
            matrix.add_tip(levers, h * loads.tip.damping);
        }
        // To relative angles: sums over what lies further out.
        let mut matrix = matrix.relative();
        let mut right = [impulse[0] + impulse[1] + impulse[2], impulse[1] + impulse[2], impulse[2]];
        for (i, right) in right.iter_mut().enumerate() {
            matrix.d[i] += h * loads.damping[i + 1];
            if let Some(rate) = loads.held[i] {
                matrix.d[i] += HELD;
                *right += HELD * rate;
            }
        }
        let [boom_after, arm_after, bucket_after] = solve(&matrix, right);

        let inertia = self.swing_inertia(p);
        let turned = swing_slopes[0] * boom + swing_slopes[1] * (boom + arm) + swing_slopes[2] * (boom + arm + bucket);
        let swing = (inertia * rates[0] + h * loads.torques[0]) / (inertia + h * (loads.damping[0] + turned));
        [swing, boom_after, arm_after, bucket_after]
    }
}

/// Rates of boom, arm and bucket line against the ground.
pub(super) fn absolute_rates([_, boom, arm, bucket]: [f64; 4]) -> [f64; 3] {
    [boom, boom + arm, boom + arm + bucket]
}

impl Posture {
    /// The tip from the boom pin, m.
    pub fn tip(&self) -> Vector {
        self.links[0] + self.links[1] + self.links[2]
    }

    /// Its velocity, m/s.
    pub fn tip_velocity(&self, rates: [f64; 4]) -> Vector {
        let [w2, w3, w4] = absolute_rates(rates);
        let [b, a, t] = self.links;
        Vector::new(-(w2 * b.z + w3 * a.z + w4 * t.z), w2 * b.x + w3 * a.x + w4 * t.x)
    }

    /// Direction of the bucket line.
    pub fn bucket_direction(&self) -> Vector {
        self.directions[2]
    }
}
