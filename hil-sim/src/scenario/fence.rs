//! `[fence]`: limits the controller keeps the linkage clear of. Every field may be left out.

use firmware::fence::{BallParameters, FenceParameters, Guards, PlaneParameters, SwingRangeParameters};
use kinematics_core::planning::limits::{HALF_SPACES, SPHERES};
use serde::Deserialize;

use super::check::within;
use crate::machine_file::MachineFile;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Guarded {
    #[default]
    Linkage,
    Tip,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FenceTable {
    #[serde(default)]
    guards: Guarded,
    ceiling_m: Option<f64>,
    floor_m: Option<f64>,
    front_m: Option<f64>,
    left_m: Option<f64>,
    right_m: Option<f64>,
    swing_right_deg: Option<f64>,
    swing_left_deg: Option<f64>,
    margin_m: Option<f64>,
    deceleration_mps2: Option<f64>,
    reaction_s: Option<f64>,
    swing_margin_deg: Option<f64>,
    swing_deceleration_deg_s2: Option<f64>,
    #[serde(default)]
    ball: Vec<Ball>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ball {
    x_m: f64,
    y_m: f64,
    z_m: f64,
    radius_m: f64,
}

impl Ball {
    fn check(&self) -> Result<(), String> {
        let far = [-1000.0, 1000.0];
        within(&[
            ("x_m", self.x_m, far),
            ("y_m", self.y_m, far),
            ("z_m", self.z_m, far),
            ("radius_m", self.radius_m, [0.0, 100.0]),
        ])
    }
}

/// A fence's defaults for a machine and its valves, without any limit: a margin of 1/200 of the reach, a deceleration of 0.2
/// reaches/s², and the dead time once more as reserve for a valve slower than its model.
fn unlimited(machine: &MachineFile, dead_time_s: f64, lag_s: f64) -> FenceParameters {
    let reach = machine.geometry.reach_m();
    FenceParameters {
        planes: [None; HALF_SPACES],
        balls: [None; SPHERES],
        swing: None,
        boom_pin_height_m: machine.boom_pin_height_m,
        outline: machine.outline,
        guards: Guards::Linkage,
        margin_m: (0.005 * reach) as f32,
        deceleration_mps2: (0.2 * reach) as f32,
        reaction_s: if dead_time_s > 0.01 { dead_time_s as f32 } else { 0.01 },
        swing_margin_rad: 1.0_f32.to_radians(),
        swing_deceleration_rad_s2: 30.0_f32.to_radians(),
        dead_time_s: dead_time_s as f32,
        lag_s: lag_s as f32,
    }
}

impl FenceTable {
    pub(super) fn parameters(
        &self,
        machine: &MachineFile,
        dead_time_s: f64,
        lag_s: f64,
    ) -> Result<FenceParameters, String> {
        if self.ball.len() > SPHERES {
            return Err(format!("`fence.ball` stands {} times but must at most {SPHERES} times", self.ball.len()));
        }
        within(&[("plant.dead_time_s", dead_time_s, [0.0, 0.5])]).map_err(|what| format!("with a fence, {what}"))?;
        let far = [-1000.0, 1000.0];
        let stated = [
            ("fence.ceiling_m", self.ceiling_m, far),
            ("fence.floor_m", self.floor_m, far),
            ("fence.front_m", self.front_m, far),
            ("fence.left_m", self.left_m, far),
            ("fence.right_m", self.right_m, far),
            ("fence.swing_right_deg", self.swing_right_deg, [-179.0, 179.0]),
            ("fence.swing_left_deg", self.swing_left_deg, [-179.0, 179.0]),
            ("fence.margin_m", self.margin_m, [0.0, 5.0]),
            ("fence.deceleration_mps2", self.deceleration_mps2, [0.01, 20.0]),
            ("fence.reaction_s", self.reaction_s, [0.002, 2.0]),
            ("fence.swing_margin_deg", self.swing_margin_deg, [0.0, 57.0]),
            ("fence.swing_deceleration_deg_s2", self.swing_deceleration_deg_s2, [0.6, 1000.0]),
        ];
        let stated: Vec<_> = stated.iter().filter_map(|&(field, value, range)| Some((field, value?, range))).collect();
        within(&stated)?;
        for (i, ball) in self.ball.iter().enumerate() {
            ball.check().map_err(|what| format!("`fence.ball[{i}]`: {what}"))?;
        }
        let mut fence = unlimited(machine, dead_time_s, lag_s);
        let planes = [
            (self.ceiling_m, [0.0, 0.0, 1.0]),
            (self.floor_m.map(|z| -z), [0.0, 0.0, -1.0]),
            (self.front_m, [1.0, 0.0, 0.0]),
            (self.left_m, [0.0, 1.0, 0.0]),
            (self.right_m, [0.0, -1.0, 0.0]),
        ];
        for (slot, (offset, normal)) in fence.planes.iter_mut().zip(planes) {
            *slot = offset.map(|offset_m| PlaneParameters { normal, offset_m });
        }
        for (slot, ball) in fence.balls.iter_mut().zip(&self.ball) {
            *slot = Some(BallParameters { centre_m: [ball.x_m, ball.y_m, ball.z_m], radius_m: ball.radius_m });
        }
        fence.swing = match (self.swing_right_deg, self.swing_left_deg) {
            (None, None) => None,
            (Some(right_deg), Some(left_deg)) => Some(SwingRangeParameters { right_deg, left_deg }),
            _ => return Err("`fence.swing_right_deg` and `fence.swing_left_deg` must stand together".to_owned()),
        };
        if self.guards == Guarded::Tip {
            fence.guards = Guards::Tip;
        }
        let set = |at: &mut f32, stated: Option<f64>, factor: f64| {
            *at = stated.map_or(*at, |value| (value * factor) as f32);
        };
        set(&mut fence.margin_m, self.margin_m, 1.0);
        set(&mut fence.deceleration_mps2, self.deceleration_mps2, 1.0);
        set(&mut fence.reaction_s, self.reaction_s, 1.0);
        set(&mut fence.swing_margin_rad, self.swing_margin_deg, 1.0_f64.to_radians());
        set(&mut fence.swing_deceleration_rad_s2, self.swing_deceleration_deg_s2, 1.0_f64.to_radians());
        Ok(fence)
    }
}
