//! Simulated machine and hardware for the excavator controller.
//!
//! - [`machine_file`] — a machine's geometry from TOML;
//! - [`cli`] — the `hil` command.

pub mod cli;
pub mod machine_file;
