//! Random scenes for obstacle avoidance: a start, a target, one or two spheres; how each of thousands ended.

mod generate;
mod look;
mod proof;
mod scene;
mod tally;

pub use generate::{Kit, Scene};
pub use look::Look;
pub use proof::Proof;
pub use scene::{Ended, Outcome, Sample};
pub use tally::{Failure, Tally};
