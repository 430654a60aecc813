//! What the machine keeps clear of, in the base frame: x forward, y left, z above the boom pin.

use firmware::fence::SwingRangeParameters;
use kinematics_core::Rotor;

use crate::scenario::Scenario;

/// normal·p ≤ offset is allowed.
pub(super) struct Plane {
    pub(super) normal: [f64; 3],
    pub(super) offset_m: f64,
}

/// A ball.
pub(super) struct Ball {
    pub(super) centre_m: [f64; 3],
    pub(super) radius_m: f64,
}

/// Fence and obstacles of a scenario.
pub(super) struct Limits {
    pub(super) planes: Vec<Plane>,
    pub(super) balls: Vec<Ball>,
    pub(super) swing: Option<SwingRangeParameters>,
    /// Where the tip shall go.
    pub(super) target_m: Option<[f64; 3]>,
}

impl Limits {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let mut limits = Self { planes: Vec::new(), balls: Vec::new(), swing: None, target_m: None };
        if let Some(fence) = &scenario.parameters.fence {
            // The fence stands on the ground.
            let height = fence.boom_pin_height_m;
            limits.planes.extend(
                fence
                    .planes
                    .iter()
                    .flatten()
                    .map(|plane| Plane { normal: plane.normal, offset_m: plane.offset_m - plane.normal[2] * height }),
            );
            limits.balls.extend(fence.balls.iter().flatten().map(|ball| {
                let [x, y, z] = ball.centre_m;
                Ball { centre_m: [x, y, z - height], radius_m: ball.radius_m }
            }));
            limits.swing = fence.swing;
        }
        if let Some(reach) = &scenario.parameters.reach {
            limits.balls.extend(
                reach.obstacles.iter().flatten().map(|o| Ball { centre_m: [o.x, o.y, o.z], radius_m: o.radius }),
            );
            limits.target_m = Some([reach.target.x, reach.target.y, reach.target.z]);
        }
        limits
    }
}

impl Plane {
    /// The line in which the swing's plane meets it, across this frame of reach and height, m; nowhere where they do not meet.
    pub(super) fn section(&self, swing: Rotor<f64>, frame: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let [nx, ny, nz] = self.normal;
        let along = nx * swing.cos + ny * swing.sin;
        let [[left, right], [bottom, top]] = frame;
        if libm::hypot(along, nz) < 1e-3 {
            return [[0.0, 2.0 * bottom - top]; 2];
        }
        if nz.abs() >= along.abs() {
            [left, right].map(|reach| [reach, (self.offset_m - along * reach) / nz])
        } else {
            [bottom, top].map(|height| [(self.offset_m - nz * height) / along, height])
        }
    }
}

impl Ball {
    /// Middle and radius of the circle in which the swing's plane meets it, m; radius 0 where it does not.
    pub(super) fn section(&self, swing: Rotor<f64>) -> ([f64; 2], f64) {
        let [x, y, z] = self.centre_m;
        let (along, across) = (x * swing.cos + y * swing.sin, y * swing.cos - x * swing.sin);
        let left = self.radius_m * self.radius_m - across * across;
        ([along, z], if left > 0.0 { libm::sqrt(left) } else { 0.0 })
    }
}
