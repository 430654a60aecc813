//! Motion planning in the loop: the linkage's hull and its distances, one step past obstacles, the way to a target.

pub mod avoid;
pub mod hull;
mod joint_line;
pub mod reach;
mod route;
