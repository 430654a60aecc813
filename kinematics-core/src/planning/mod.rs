//! Planning of moves: which configuration, which path, how fast. Fixed work and memory; not finding an answer is a value.
//!
//! - [`effort`] — what a move costs: cylinder travel or the pump's energy;
//! - [`tip_path`], [`pitch_rule`] — where the tip goes, and what the bucket may do meanwhile;
//! - [`least_effort`] — the cheapest end of a move from point to point; [`pitch_plan`] — the cheapest pitches along a path,
//!   against [`minimum_norm`];
//! - [`cylinder_path`] — a smooth path through the planned cylinder lengths; [`time_scaling`] — how fast along it.

pub mod cylinder_path;
pub mod effort;
pub mod least_effort;
pub mod minimum_norm;
pub mod move_limits;
pub mod pitch_plan;
pub mod pitch_rule;
mod speed_table;
pub mod time_scaling;
pub mod tip_path;
