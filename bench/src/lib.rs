//! What the maps are measured against; nothing of this is in the product.
//!
//! - [`seed`]: Frankel 2003's angle formulas as written, with libm, in f32 and f64;
//! - [`bits`]: the fixed-point kernels' bits, to be compared between host and target;
//! - [`ours`], `maps`: the machine and the poses all are compared on (poses: host only);
//! - `peers`: the same chain through peer libraries (feature `peers`, host only).
#![cfg_attr(target_os = "none", no_std)]

pub mod bits;
#[cfg(not(target_os = "none"))]
pub mod maps;
pub mod ours;
#[cfg(all(feature = "peers", not(target_os = "none")))]
pub mod peers;
pub mod seed;
