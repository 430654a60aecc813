//! Helpers of the cross-crate tests.

pub mod rig;
