//! What an engineer asks of a machine as a whole, over all of its stroke.
//!
//! - [`isotropic`] — isotropic points, best and worst condition number.

pub mod isotropic;
