//! `hil`: the desktop harness.
fn main() {}
