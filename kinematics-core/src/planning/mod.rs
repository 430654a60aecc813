//! From a pose to a point: planning on a planar chain of N joints, one iteration at a time and a bounded number of them.
//!
//! - [`obstacle`] — a point to keep away from, and the arm's point nearest to it;
//! - [`park`] — Park 2008, each equation in one place;
//! - [`planner`] — one iteration of it, and the run to a point.
//!
//! `docs/planning.md` says what the paper leaves open and what is chosen here. For planning ahead, not for the control loop:
//! Park's (14) is an angle.

pub mod obstacle;
pub mod park;
pub mod planner;
