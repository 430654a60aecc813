//! The application of `ecu-emulated` with the board's own last resort, its watch over constants and a watchdog, and with what the harness
//! can break in it: bits of the controller's memory, the timer's interrupt. Not for a board.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod app;
#[cfg(target_os = "none")]
#[path = "../../emulated/mod.rs"]
mod emulated;
#[cfg(target_os = "none")]
#[path = "../ecu-stm32f405/safe_state.rs"]
mod safe_state;
#[cfg(target_os = "none")]
#[path = "../../emulated/session.rs"]
mod session;
#[cfg(target_os = "none")]
mod spoil;
#[cfg(target_os = "none")]
#[path = "../../target/mod.rs"]
mod target;

#[cfg(target_os = "none")]
use emulated::exit::rest;

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("spoilt-emulated runs in the emulator: cargo hil flips");
    std::process::exit(2);
}
