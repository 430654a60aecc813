//! Planning: which path, which configuration, how fast, and what to keep clear of. Fixed work and memory; not finding an answer is
//! a value. The mathematics and its sources stand in `docs/planning.md`.
//!
//! Park 2008 on a planar chain, for planning ahead (its (14) is an angle):
//! - [`obstacle`] — a point to keep away from, and the arm's point nearest to it;
//! - [`park`] — the paper, each equation in one place;
//! - [`planner`] — one iteration of it, and the run to a point.
//!
//! Least effort and timing of moves:
//! - [`effort`] — what a move costs: cylinder travel or the pump's energy;
//! - [`tip_path`], [`pitch_rule`] — where the tip goes, and what the bucket may do meanwhile;
//! - [`least_effort`] — the cheapest end of a move from point to point; [`pitch_plan`] — the cheapest pitches along a path,
//!   against [`minimum_norm`];
//! - [`cylinder_path`] — a smooth path through the planned cylinder lengths; [`time_scaling`] — how fast along it.
//!
//! The real machine in the loop, swing included:
//! - [`hull`] — the linkage as capsules and its distances from spheres;
//! - [`avoid`] — one step past obstacles; [`reach`] — the whole way to a target.
//!
//! A fence:
//! - [`outline`] — the linkage's bodies as rounded strips, placed by the joints;
//! - [`clearance`] — their distance to half-spaces and spheres, with its derivative by every joint;
//! - [`limits`] — what to keep clear of; [`fence`] — commands slowed so that the machine stops before it.

pub mod avoid;
pub mod clearance;
pub mod cylinder_path;
pub mod effort;
pub mod fence;
pub mod hull;
mod joint_line;
pub mod least_effort;
pub mod limits;
pub mod minimum_norm;
pub mod move_limits;
mod nearby;
pub mod obstacle;
pub mod outline;
pub mod park;
pub mod pitch_plan;
pub mod pitch_rule;
pub mod planner;
pub mod reach;
mod route;
mod speed_table;
pub mod time_scaling;
pub mod tip_path;
