//! Instruction counts of the maps and of the tick on the emulated Cortex-M4F, a line each: name, median, maximum.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod bench;
#[cfg(target_os = "none")]
mod coils;
#[cfg(target_os = "none")]
mod diagnosis;
#[cfg(target_os = "none")]
#[path = "../../../../images/src/emulated/mod.rs"]
mod emulated;

#[cfg(target_os = "none")]
mod fence;

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("bench-emulated runs in the emulator: cargo hil bench");
    std::process::exit(2);
}
