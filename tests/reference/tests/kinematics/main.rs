//! The tests of `kinematics-core` that need nothing above it, in one binary: what a mutant of it has to pass (`docs/mutation.md`).
//!
//! `cargo test` does not run this one: there each file is a binary of its own, in the package `cross-tests`.

/// The files name their helpers as parts of `cross-tests`.
extern crate reference as cross_tests;

// In the order of their names, so that most mutants fail before the sweeps begin.
mod quick;
mod sweeps;
