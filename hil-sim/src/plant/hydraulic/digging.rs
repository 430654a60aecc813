//! The bucket in the ground: resistance at the tip, what is cut, what the bucket holds and what falls out.
//!
//! Only the teeth meet the ground, as a blade of the bucket's width: the bucket's back and sides do not, nor does the swing.

use kinematics_core::Vec2;

use super::body::TipResistance;
use super::ground::Ground;
use super::soil_factors::{FactorTable, Soil};

/// Speed within which the resistance turns with the motion, m/s.
const SMOOTH_MPS: f64 = 0.02;
/// Time in which what a bucket no longer holds falls out, s.
const FALL_S: f64 = 0.4;
/// A cell of the ground ahead of the tip is what resists, m.
const AHEAD_M: f64 = 0.05;

/// The ground and the bucket that cuts it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiggingModel {
    /// What the ground is made of.
    pub soil: Soil,
    /// Height of the level ground above the boom pin, m.
    pub ground_m: f64,
    /// Width of the bucket, m.
    pub width_m: f64,
    /// What it holds level with its mouth, m³.
    pub capacity_m3: f64,
    /// Angle of the cutting plate against the line from tip to bucket pin, rad; positive towards the bucket's back.
    pub plate_rad: f64,
}

/// Digging under way.
#[derive(Clone, Debug)]
pub(super) struct Digging {
    model: DiggingModel,
    table: FactorTable,
    /// The ground.
    pub ground: Ground,
    /// In the bucket, m³.
    load_m3: f64,
    /// Along and across the motion, N, and the tip's last place.
    along_n: f64,
    across_n: f64,
    tip: Option<[f64; 2]>,
}

impl Digging {
    /// Level ground out to a reach, an empty bucket.
    pub(super) fn new(model: &DiggingModel, reach_m: f64) -> Self {
        Self {
            model: *model,
            table: FactorTable::new(&model.soil),
            ground: Ground::level(model.ground_m, reach_m),
            load_m3: 0.0,
            along_n: 0.0,
            across_n: 0.0,
            tip: None,
        }
    }

    /// Soil in the bucket, kg.
    pub(super) fn load_kg(&self) -> f64 {
        self.load_m3 * self.model.soil.density_kgpm3
    }

    /// A tick: the tip is at `tip` (reach, height; m) with this velocity, the bucket line points along `line`.
    pub(super) fn tick(&mut self, tip: Vec2<f64>, velocity: Vec2<f64>, line: Vec2<f64>, tick_s: f64) {
        let here = [tip.x, tip.z];
        let cut = self.tip.replace(here).map_or(0.0, |before| self.ground.cut(before, here));
        // The mouth looks up where the tip points back to the machine; tipped over, the bucket holds nothing.
        let holds = self.model.capacity_m3 * (0.5 - line.x).clamp(0.0, 1.0);
        let filled = self.load_m3 + cut * self.model.width_m;
        let over = filled - holds;
        self.load_m3 = if over <= 0.0 {
            filled
        } else if filled > self.load_m3 && self.load_m3 <= holds {
            holds
        } else {
            holds + (self.load_m3 - holds) * (1.0 - tick_s / FALL_S)
        };

        let speed = velocity.norm();
        let ahead = if speed > 0.0 { velocity.x / speed * AHEAD_M } else { 0.0 };
        let depth = self.ground.height(tip.x + ahead) - tip.z;
        (self.along_n, self.across_n) = (0.0, 0.0);
        if depth > 0.0 && speed > 1e-6 {
            let (cos, sin) = (libm::cos(self.model.plate_rad), libm::sin(self.model.plate_rad));
            // From the tip up the plate: back along the bucket line, turned towards the bucket's back.
            let plate = line.scale(-1.0).complex_mul(Vec2::new(cos, -sin));
            let rake = libm::acos((-plate.dot(velocity) / speed).clamp(-1.0, 1.0));
            let force = self.model.width_m * self.model.soil.force(depth, self.table.at(rake));
            let blade = rake + self.model.soil.blade_friction_rad;
            self.along_n = force * libm::sin(blade).abs();
            self.across_n = force * libm::cos(blade);
        }
    }

    /// What resists the tip at this velocity: the same force from tick to tick, turned with the motion.
    pub(super) fn resistance(&self, velocity: Vec2<f64>) -> TipResistance {
        if self.along_n == 0.0 {
            return TipResistance::default();
        }
        let by_speed = 1.0 / (velocity.norm() + SMOOTH_MPS);
        // Across the motion, downwards: a flat blade is drawn in.
        let side =
            if velocity.x > 0.0 { Vec2::new(velocity.z, -velocity.x) } else { Vec2::new(-velocity.z, velocity.x) };
        let across = side.scale(self.across_n * by_speed);
        TipResistance { damping: self.along_n * by_speed, force: [across.x, across.z] }
    }
}
