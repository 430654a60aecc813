//! Formatting, clippy and rustdoc; a warning is an error.

use crate::arm;
use crate::process::{Outcome, announce, capture, cargo, command as program, run};

const MUTANTS: [&str; 2] = ["--test=kinematics", "--test=supervisor"];
const DENY: [&str; 3] = ["--", "-D", "warnings"];

/// `cargo xtask lint`: stops at the first finding.
pub(crate) fn command() -> Outcome<bool> {
    let tools = ["fmt", "clippy"].map(|tool| capture(cargo().args([tool, "--version"])));
    if tools.iter().any(Result::is_err) {
        announce("installing rustfmt and clippy");
        run(program("rustup").args(["component", "add", "rustfmt", "clippy"]))?;
    }
    announce("formatting");
    run(cargo().args(["fmt", "--all", "--check"]))?;
    announce("clippy, host");
    run(cargo().args(["clippy", "--workspace", "--all-targets"]).args(DENY))?;
    // What mutants are tried by is no part of `--all-targets`: the same tests run elsewhere.
    run(cargo().args(["clippy", "--package=reference", "--features=supervisor"]).args(MUTANTS).args(DENY))?;
    announce("rustdoc");
    run(cargo().args(["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))?;
    announce("clippy, ARM images");
    match arm::rustup() {
        Ok(_) => {
            // In the images' profile, so that the macros are built once for this and for the images.
            let images = [
                "clippy",
                "--profile=image",
                "--package=firmware",
                "--package=images",
                "--package=control-tick",
                "--lib",
                "--bins",
                "--target",
                arm::TARGET,
            ];
            run(cargo().args(images).args(DENY))?;
        }
        // Clippy is part of the toolchain, so Debian's compiler cannot stand in.
        Err(why) => {
            eprintln!("warning: what only the images contain was not linted, clippy lacks {}: {why}", arm::TARGET)
        }
    }
    Ok(true)
}
