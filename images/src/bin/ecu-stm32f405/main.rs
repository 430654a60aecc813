//! The application on the reference ECU, an STM32F405RG. Never flashed to a board yet: it builds, and that is all that is shown.
//!
//! `app` is the RTIC application, `can_bus` the CAN controller, `flash` the parameter sectors, `pins` the start-up of clocks, pins and buses, `spi_dma` the converters' bus, `watchdog` the
//! independent watchdog, `safe_state` what happens when everything else has failed, `log` what a debug probe reads.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod app;
#[cfg(target_os = "none")]
mod can_bus;
#[cfg(target_os = "none")]
mod flash;
#[cfg(target_os = "none")]
mod log;
#[cfg(target_os = "none")]
mod pins;
#[cfg(target_os = "none")]
mod safe_state;
#[cfg(target_os = "none")]
mod spi_dma;
#[cfg(target_os = "none")]
#[path = "../../target/mod.rs"]
mod target;
#[cfg(target_os = "none")]
mod watchdog;

/// After the outputs were dropped: nothing. The watchdog resets the chip.
#[cfg(target_os = "none")]
fn rest() -> ! {
    loop {
        core::sync::atomic::compiler_fence(core::sync::atomic::Ordering::SeqCst);
    }
}

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("ecu-stm32f405 is an image for a board: see docs/porting.md");
    std::process::exit(2);
}
