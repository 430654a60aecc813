//! What the images for the emulator share: the link to the harness, the stopwatch, the end.
#![allow(dead_code)] // each image uses its part

pub(crate) mod link;
pub(crate) mod stack;
pub(crate) mod stopwatch;

use core::panic::PanicInfo;
use cortex_m_semihosting::{debug, heprintln};

/// Ends the emulator with a failure status.
pub(crate) fn fail() -> ! {
    debug::exit(debug::EXIT_FAILURE);
    loop {
        cortex_m::asm::wfi();
    }
}

/// Ends the emulator with success.
pub(crate) fn succeed() -> ! {
    debug::exit(debug::EXIT_SUCCESS);
    loop {
        cortex_m::asm::wfi();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    heprintln!("panic in the emulated image: {}", info);
    fail()
}
