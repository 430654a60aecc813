//! One pose in all its descriptions, as JSON or as a table.

use std::fmt::Write;

use serde::Serialize;

use super::Number;
use super::rates::Rates;

/// One value a moving link.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PerLink<T> {
    /// Boom.
    pub boom: T,
    /// Arm.
    pub arm: T,
    /// Bucket.
    pub bucket: T,
}

/// The bucket tip in the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tip<T> {
    /// Forward at zero swing, m.
    pub x_m: T,
    /// To the left, m.
    pub y_m: T,
    /// Above the boom pin, m.
    pub z_m: T,
    /// φ in (−180, 180] degrees.
    pub pitch_deg: T,
    /// Signed distance from the swing axis in the boom's plane, m.
    pub reach_m: T,
}

/// The bucket tip from the boom pin, in the boom's plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct InPlane<T> {
    /// Reach less a1, m.
    pub x_m: T,
    /// Height, m.
    pub z_m: T,
}

/// Everything `hil pose` says of one pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report<T> {
    /// θ1 in (−180, 180] degrees.
    pub swing_deg: T,
    /// θ2, θ3, θ4 in (−180, 180] degrees.
    pub joints_deg: PerLink<T>,
    /// Lengths between pins, m.
    pub cylinders_m: PerLink<T>,
    /// Tip in the base frame.
    pub tip: Tip<T>,
    /// Tip in the plane.
    pub tip_from_boom_pin: InPlane<T>,
    /// Whether every cylinder is inside its stroke.
    pub within_stroke: bool,
    /// Where asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rates: Option<Rates<T>>,
}

impl<T: Number> Report<T> {
    /// JSON with every number the shortest that reads back as the same T.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("finite numbers always serialise")
    }

    /// The numbers, in the order of the fields.
    pub(super) fn numbers(&self) -> [T; 14] {
        let Self { swing_deg, joints_deg: j, cylinders_m: c, tip, tip_from_boom_pin: p, .. } = *self;
        [
            swing_deg,
            j.boom,
            j.arm,
            j.bucket,
            c.boom,
            c.arm,
            c.bucket,
            tip.x_m,
            tip.y_m,
            tip.z_m,
            tip.pitch_deg,
            tip.reach_m,
            p.x_m,
            p.z_m,
        ]
    }

    /// A short aligned table for people.
    pub fn to_table(&self, machine: &str) -> String {
        let mut table = String::new();
        let mut line = |title: &str, unit: &str, values: &[(&str, T)]| table += &line(title, unit, values);
        let (j, c, tip, p) = (&self.joints_deg, &self.cylinders_m, &self.tip, &self.tip_from_boom_pin);
        line("cylinders", "m", &[("boom", c.boom), ("arm", c.arm), ("bucket", c.bucket)]);
        line("joints", "deg", &[("boom", j.boom), ("arm", j.arm), ("bucket", j.bucket)]);
        line("swing", "deg", &[("", self.swing_deg)]);
        line("tip", "m", &[("x", tip.x_m), ("y", tip.y_m), ("z", tip.z_m)]);
        line("in the plane", "m", &[("reach", tip.reach_m), ("height", tip.z_m)]);
        line("from boom pin", "m", &[("x", p.x_m), ("z", p.z_m)]);
        line("pitch", "deg", &[("", tip.pitch_deg)]);
        let stroke = if self.within_stroke { "within" } else { "OUTSIDE" };
        let rates = self.rates.as_ref().map(Rates::to_table).unwrap_or_default();
        format!("{machine}, {stroke} the stroke\n{table}{rates}")
    }
}

/// One line of the table: title, unit, named values.
pub(super) fn line<T: Number>(title: &str, unit: &str, values: &[(&str, T)]) -> String {
    let mut row = format!("{title:<14}{unit:<5}");
    for (name, value) in values {
        // As text first: padding would otherwise round to a precision of its own.
        let value = value.to_string();
        let _ = write!(row, "{name:>8} {value:<21}");
    }
    row.truncate(row.trim_end().len());
    row + "\n"
}
