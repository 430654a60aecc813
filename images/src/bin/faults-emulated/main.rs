//! What the emulator can try of the board's own code: its last resort and the writing of its parameter flash. The same handlers, stack
//! guard and flash code as the board's image, made to act by one byte from the harness. Not for a board.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod app;
#[cfg(target_os = "none")]
#[path = "../ecu-stm32f405/flash.rs"]
mod flash;
#[cfg(target_os = "none")]
#[path = "../../emulated/link.rs"]
#[allow(dead_code)] // it only reads
mod link;
#[cfg(target_os = "none")]
#[path = "../ecu-stm32f405/safe_state.rs"]
mod safe_state;
#[cfg(target_os = "none")]
#[path = "../../target/mod.rs"]
mod target;

#[cfg(target_os = "none")]
use app::rest;

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("faults-emulated runs in the emulator: cargo xtask test");
    std::process::exit(2);
}
