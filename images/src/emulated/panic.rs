//! A panic ends the emulator; it is said why.

use core::panic::PanicInfo;
use cortex_m_semihosting::heprintln;

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    heprintln!("panic in the emulated image: {}", info);
    crate::emulated::fail()
}
