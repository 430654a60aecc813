//! The tables of path, grade, and the law they and tip velocity share.

use firmware::grade::GradeParameters;
use firmware::law::{LawParameters, NO_OVERRUN};
use firmware::path::{KNOTS, Knot, PathParameters};
use kinematics_core::planning::effort::Piston;
use serde::Deserialize;

use super::Task;
use super::file::ScenarioFile;

/// A path's speeds.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PathTable {
    speed_mps: f64,
    acceleration_mps2: f64,
    pitch_speed_deg_s: f64,
    pitch_acceleration_deg_s2: f64,
    swing_speed_deg_s: f64,
    swing_acceleration_deg_s2: f64,
}

/// A knot of the path.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KnotTable {
    x_m: f64,
    z_m: f64,
    pitch_deg: f64,
    swing_deg: f64,
}

/// The plane to hold.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GradeTable {
    point_x_m: f64,
    point_z_m: f64,
    slope_deg: f64,
    speed_mps: f64,
    tolerance_m: f64,
}

/// The law's tuning and the pump.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LawTable {
    integral_per_s2: f64,
    bias_limit_mps: f64,
    correction_limit_mps: f64,
    rest_zone_m: f64,
    reserve: f64,
    cylinder_acceleration_mps2: f64,
    swing_acceleration_rad_s2: f64,
    cushion_mps2: f64,
    tip_acceleration_mps2: f64,
    pitch_acceleration_deg_s2: f64,
    swing_following_error_deg: f64,
    boom_bore_m: f64,
    boom_rod_m: f64,
    boom_cylinders: u8,
    arm_bore_m: f64,
    arm_rod_m: f64,
    bucket_bore_m: f64,
    bucket_rod_m: f64,
    flow_lpm: f64,
    feedback_lag_s: f64,
    lag_m: f64,
    boom_overrun_kn: Option<[f64; 2]>,
    arm_overrun_kn: Option<[f64; 2]>,
    bucket_overrun_kn: Option<[f64; 2]>,
    swing_overrun_deg_s2: Option<f64>,
}

impl LawTable {
    /// What only this file has is checked here: bores and rods; the rest when the controller's parameters are.
    pub(super) fn check(&self) -> Result<(), String> {
        let bore = [0.01, 1.0];
        for (name, loads) in [
            ("law.boom_overrun_kn", self.boom_overrun_kn),
            ("law.arm_overrun_kn", self.arm_overrun_kn),
            ("law.bucket_overrun_kn", self.bucket_overrun_kn),
        ] {
            for kn in loads.into_iter().flatten() {
                super::check::within(&[(name, kn, [0.001, 10_000.0])])?;
            }
        }
        super::check::within(&[
            ("law.boom_bore_m", self.boom_bore_m, bore),
            ("law.boom_rod_m", self.boom_rod_m, [0.0, 0.99 * self.boom_bore_m]),
            ("law.boom_cylinders", f64::from(self.boom_cylinders), [1.0, 4.0]),
            ("law.arm_bore_m", self.arm_bore_m, bore),
            ("law.arm_rod_m", self.arm_rod_m, [0.0, 0.99 * self.arm_bore_m]),
            ("law.bucket_bore_m", self.bucket_bore_m, bore),
            ("law.bucket_rod_m", self.bucket_rod_m, [0.0, 0.99 * self.bucket_bore_m]),
            ("law.flow_lpm", self.flow_lpm, [0.1, 10_000.0]),
            ("law.feedback_lag_s", self.feedback_lag_s, [0.0, 2.0]),
            ("law.lag_m", self.lag_m, [0.001, 1.0]),
            ("law.swing_overrun_deg_s2", self.swing_overrun_deg_s2.unwrap_or(1.0), [0.06, 1000.0]),
            ("law.integral_per_s2", self.integral_per_s2, [0.0, 100.0]),
            ("law.bias_limit_mps", self.bias_limit_mps, [0.0, 0.1]),
            ("law.correction_limit_mps", self.correction_limit_mps, [0.0, 1.0]),
            ("law.rest_zone_m", self.rest_zone_m, [0.0, 0.05]),
            ("law.reserve", self.reserve, [0.0, 0.5]),
            ("law.cylinder_acceleration_mps2", self.cylinder_acceleration_mps2, [0.01, 100.0]),
            ("law.swing_acceleration_rad_s2", self.swing_acceleration_rad_s2, [0.01, 100.0]),
            ("law.cushion_mps2", self.cushion_mps2, [0.01, 100.0]),
            ("law.tip_acceleration_mps2", self.tip_acceleration_mps2, [0.01, 20.0]),
            ("law.pitch_acceleration_deg_s2", self.pitch_acceleration_deg_s2, [0.6, 1145.0]),
            ("law.swing_following_error_deg", self.swing_following_error_deg, [0.06, 57.0]),
        ])
    }

    pub(super) fn parameters(&self) -> LawParameters {
        let piston = |bore_m, rod_m, count| Piston { bore_m, rod_m, count }.areas_m2().map(|area| area as f32);
        let cylinder = self.cylinder_acceleration_mps2 as f32;
        LawParameters {
            feed_forward: 1.0,
            integral_per_s2: self.integral_per_s2 as f32,
            bias_limit_mps: self.bias_limit_mps as f32,
            correction_limit_mps: self.correction_limit_mps as f32,
            rest_zone_m: self.rest_zone_m as f32,
            reserve: self.reserve as f32,
            acceleration: [self.swing_acceleration_rad_s2 as f32, cylinder, cylinder, cylinder],
            cushion_mps2: self.cushion_mps2 as f32,
            tip_acceleration_mps2: self.tip_acceleration_mps2 as f32,
            pitch_acceleration_radps2: self.pitch_acceleration_deg_s2.to_radians() as f32,
            swing_following_error_rad: self.swing_following_error_deg.to_radians() as f32,
            areas_m2: [
                piston(self.boom_bore_m, self.boom_rod_m, self.boom_cylinders),
                piston(self.arm_bore_m, self.arm_rod_m, 1),
                piston(self.bucket_bore_m, self.bucket_rod_m, 1),
            ],
            flow_m3ps: (self.flow_lpm / 60e3) as f32,
            feedback_lag_s: self.feedback_lag_s as f32,
            lag_m: self.lag_m as f32,
            overrun_n: [self.boom_overrun_kn, self.arm_overrun_kn, self.bucket_overrun_kn].map(overrun),
            swing_overrun_radps2: self.swing_overrun_deg_s2.map_or(NO_OVERRUN, |deg| deg.to_radians() as f32),
        }
    }
}

/// Of a cylinder whose load never runs ahead, where nothing is said.
fn overrun(kn: Option<[f64; 2]>) -> [f32; 2] {
    kn.map_or([NO_OVERRUN; 2], |pair| pair.map(|kn| (kn * 1e3) as f32))
}

impl PathTable {
    pub(super) fn parameters(&self, knots: &[KnotTable]) -> Result<PathParameters, String> {
        if !(2..=KNOTS).contains(&knots.len()) {
            return Err(format!("`knot`: {} of them, but a `path` has 2…{KNOTS}", knots.len()));
        }
        let knot = |k: &KnotTable| Knot { x_m: k.x_m, z_m: k.z_m, pitch_deg: k.pitch_deg, swing_deg: k.swing_deg };
        Ok(PathParameters {
            knots: std::array::from_fn(|i| knots.get(i).map(knot)),
            speed_mps: self.speed_mps,
            acceleration_mps2: self.acceleration_mps2,
            pitch_speed_deg_s: self.pitch_speed_deg_s,
            pitch_acceleration_deg_s2: self.pitch_acceleration_deg_s2,
            swing_speed_deg_s: self.swing_speed_deg_s,
            swing_acceleration_deg_s2: self.swing_acceleration_deg_s2,
        })
    }
}

impl GradeTable {
    pub(super) fn parameters(&self) -> GradeParameters {
        GradeParameters {
            point_x_m: self.point_x_m,
            point_z_m: self.point_z_m,
            slope_deg: self.slope_deg,
            speed_mps: self.speed_mps,
            tolerance_m: self.tolerance_m,
        }
    }
}

/// The task of a file with a path, a plane, or velocities of the tip; `None` when it has none of them.
pub(super) fn task(file: &mut ScenarioFile) -> Result<Option<Task>, String> {
    let tips = std::mem::take(&mut file.tip);
    let named = [("path", file.path.is_some()), ("grade", file.grade.is_some()), ("tip", !tips.is_empty())];
    let mut asked = named.into_iter().filter_map(|(name, there)| there.then_some(name));
    let Some(name) = asked.next() else {
        return if file.knot.is_empty() { Ok(None) } else { Err("`knot` is for `path`, which is missing".to_owned()) };
    };
    if file.law.is_none() {
        return Err(format!("`law` is missing: `{name}` is followed by it"));
    }
    let others = [
        ("dig", file.dig.is_some()),
        ("move", file.planned_move.is_some()),
        ("reach", file.reach.is_some()),
        ("lever", !file.lever.is_empty() && name != "grade"),
        ("start", file.start.is_some() && name == "path"),
        ("knot", !file.knot.is_empty() && name != "path"),
    ];
    let other = asked.next().or_else(|| others.into_iter().find_map(|(name, there)| there.then_some(name)));
    if let Some(other) = other {
        return Err(format!("`{other}` must be left out with `{name}`"));
    }
    if name == "path" {
        return Ok(Some(Task::Path));
    }
    let start = file.start.ok_or_else(|| format!("`start` is missing: where the machine stands before `{name}`"))?;
    Ok(Some(if name == "grade" {
        Task::Grade { start, moves: std::mem::take(&mut file.lever) }
    } else {
        Task::TipVelocity { start, moves: tips }
    }))
}
