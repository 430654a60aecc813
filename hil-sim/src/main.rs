//! `hil`: the desktop harness.

use std::process::ExitCode;

fn main() -> ExitCode {
    hil_sim::cli::main()
}
