//! Simulated machine and hardware for the excavator controller.
//!
//! - [`machine_file`] — a machine's geometry from TOML.

pub mod machine_file;
