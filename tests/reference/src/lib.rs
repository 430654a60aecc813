//! What `kinematics-core` is measured against, for its tests in `tests/tests`.
//!
//! - [`machines`]: the four reference machines' pins as numbers;
//! - [`golden`]: the golden values, read from `tests/data`;
//! - [`wide`] and [`oracle`]: the reference the maps are measured against, in double-double arithmetic, by circles;
//! - [`differences`]: derivatives of the oracle by central differences;
//! - [`sweep`], [`measure`], [`stated`]: lengths over whole strokes, the worst error found, what `docs/accuracy.md` states;
//! - [`rates`]: rates at random poses, and their references;
//! - [`jacobians`]: Jacobians with known singular values;
//! - [`obstacle_kit`]: a machine with its hull, for planning past obstacles;
//! - [`papers`]: the papers' formulas as printed, for the tests of their errata.
//!
//! It depends on nothing above `kinematics-core`: so does `tests/kinematics.rs`, all tests of that crate in one binary, which a
//! mutant of it rebuilds in seconds (`docs/mutation.md`).

pub mod differences;
pub mod golden;
pub mod jacobians;
pub mod machines;
pub mod measure;
pub mod obstacle_kit;
pub mod oracle;
pub mod papers;
pub mod rates;
pub mod stated;
pub mod sweep;
pub mod wide;
