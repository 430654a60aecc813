//! Planning around obstacles: where the whole linkage stands, how far it is from what it must not touch, and how fast it
//! comes nearer.
//!
//! 1. [`outline`] — the linkage's bodies as rounded strips, placed by the joints;
//! 2. [`clearance`] — their distance to half-spaces and spheres, with its derivative by every joint;
//! 3. [`fence`] — commands slowed so that the machine stops before them.

pub mod clearance;
pub mod fence;
pub mod outline;
