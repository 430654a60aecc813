//! The application on the emulated Cortex-M4F, in lockstep with the harness. Not for a board: it reads its inputs over semihosting.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod app;
#[cfg(target_os = "none")]
#[path = "../../emulated/mod.rs"]
mod emulated;

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("ecu-emulated runs in the emulator: cargo hil run SCENARIO --on emulator");
    std::process::exit(2);
}
