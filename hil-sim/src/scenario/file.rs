//! The scenario file's own shape: one scalar a line, every table complete, nothing unknown.

use serde::Deserialize;

use super::event::Event;
use super::fence::FenceTable;
use super::modes::{GradeTable, KnotTable, LawTable, PathTable};
use super::plant::Plant;
use super::task::{LeverMove, Start, TipMove};
use crate::toml_text::{Tag, strictly};

const TAGS: [Tag; 5] = [
    ("fence.guards", "`\"linkage\"` or `\"tip\"`"),
    ("dig.reading", "`\"as_meant\"` or `\"as_published\"`"),
    ("plant.model", "`\"speeds\"` or `\"hydraulic\"`"),
    ("plant.soil", "`\"sand\"`, `\"loam\"` or `\"clay\"`"),
    ("move.pitch", "`\"free\"`, `\"fixed\"` or `\"bounded\"`"),
];

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ScenarioFile {
    pub(super) name: String,
    pub(super) description: String,
    pub(super) machine: String,
    pub(super) duration_s: f64,
    pub(super) operator: Operator,
    pub(super) dig: Option<Dig>,
    #[serde(rename = "move")]
    pub(super) planned_move: Option<PlannedMove>,
    pub(super) start: Option<Start>,
    #[serde(default)]
    pub(super) lever: Vec<LeverMove>,
    pub(super) reach: Option<Reach>,
    #[serde(default)]
    pub(super) obstacle: Vec<Obstacle>,
    pub(super) path: Option<PathTable>,
    #[serde(default)]
    pub(super) knot: Vec<KnotTable>,
    pub(super) grade: Option<GradeTable>,
    #[serde(default)]
    pub(super) tip: Vec<TipMove>,
    pub(super) motion: Motion,
    pub(super) law: Option<LawTable>,
    pub(super) plant: Plant,
    pub(super) fence: Option<FenceTable>,
    #[serde(default)]
    pub(super) event: Vec<Event>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Operator {
    pub(super) enable_s: f64,
    pub(super) begin_s: f64,
}

/// Where the tip shall go, and how fast the joints may move.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Reach {
    pub(super) target_x_m: f64,
    pub(super) target_y_m: f64,
    pub(super) target_z_m: f64,
    pub(super) tolerance_m: f64,
    pub(super) swing_rad_s: f64,
    pub(super) boom_rad_s: f64,
    pub(super) arm_rad_s: f64,
    pub(super) bucket_rad_s: f64,
}

/// A sphere to keep away from.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Obstacle {
    pub(super) x_m: f64,
    pub(super) y_m: f64,
    pub(super) z_m: f64,
    pub(super) radius_m: f64,
}

/// How to read the paper's program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Reading {
    /// x stays at the reach while plunging; `scoop_m` is the arc's radius.
    AsMeant,
    /// x stays at the reach's last sample of `samples`; `scoop_m` is not used.
    AsPublished,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Dig {
    pub(super) reading: Reading,
    pub(super) samples: u32,
    pub(super) start_x_m: f64,
    pub(super) start_z_m: f64,
    pub(super) ground_z_m: f64,
    pub(super) reach_m: f64,
    pub(super) plunge_m: f64,
    pub(super) scoop_m: f64,
    pub(super) scoop_end_deg: f64,
    pub(super) start_pitch_deg: f64,
    pub(super) reach_pitch_deg: f64,
    pub(super) plunge_pitch_deg: f64,
    pub(super) scoop_pitch_deg: f64,
    pub(super) reach_until_s: f64,
    pub(super) plunge_until_s: f64,
    pub(super) scoop_until_s: f64,
}

/// What the bucket may do during a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum PitchRule {
    /// Anything.
    Free,
    /// Keep the start's pitch.
    Fixed,
    /// Between `lower_deg` and `upper_deg`.
    Bounded,
}

/// A straight move with the least cylinder travel.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlannedMove {
    pub(super) start_x_m: f64,
    pub(super) start_z_m: f64,
    pub(super) start_pitch_deg: f64,
    pub(super) target_x_m: f64,
    pub(super) target_z_m: f64,
    pub(super) pitch: PitchRule,
    pub(super) lower_deg: Option<f64>,
    pub(super) upper_deg: Option<f64>,
    pub(super) turn_per_knot_deg: f64,
    pub(super) speed_share: f64,
    pub(super) acceleration_mps2: f64,
    pub(super) jerk_mps3: f64,
    pub(super) boom_bore_m: f64,
    pub(super) boom_rod_m: f64,
    pub(super) boom_cylinders: u8,
    pub(super) arm_bore_m: f64,
    pub(super) arm_rod_m: f64,
    pub(super) bucket_bore_m: f64,
    pub(super) bucket_rod_m: f64,
    pub(super) flow_lpm: f64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Motion {
    pub(super) preview_s: f64,
    pub(super) gain_per_s: f64,
    pub(super) smallest_speed_mps: f64,
    pub(super) start_tolerance_m: f64,
    pub(super) following_error_m: f64,
}

pub(super) fn parse(text: &str) -> Result<ScenarioFile, String> {
    strictly(text, &TAGS).map_err(|fault| fault.to_string())
}
