//! The outputs dropped without anybody's help: no peripheral's owner is asked, because whoever owns them has just failed.

use core::panic::PanicInfo;
use core::sync::atomic::{AtomicBool, Ordering, compiler_fence};

use cortex_m_rt::{ExceptionFrame, exception};
use stm32f4xx_hal::pac::{GPIOB, GPIOC, TIM3, TIM4};

/// Cut-off open, every solenoid pin low. The cut-off first: it alone is enough.
pub(crate) fn drop_outputs() {
    // SAFETY: single stores to registers of peripherals that are clocked; nothing else runs any more, or runs on with outputs dropped.
    unsafe {
        // PB0 is the cut-off; the upper half of the register resets.
        (*GPIOB::ptr()).bsrr().write(|w| w.bits(1 << 16));
        // Solenoid pins leave their timers: outputs, low. PC6…PC9 and PB6…PB9.
        (*GPIOC::ptr()).bsrr().write(|w| w.bits(0b1111 << (16 + 6)));
        (*GPIOB::ptr()).bsrr().write(|w| w.bits(0b1111 << (16 + 6)));
        (*GPIOC::ptr()).moder().modify(|r, w| w.bits(r.bits() & !(0xFF << 12) | 0x55 << 12));
        (*GPIOB::ptr()).moder().modify(|r, w| w.bits(r.bits() & !(0xFF << 12) | 0x55 << 12));
        (*TIM3::ptr()).ccer().write(|w| w.bits(0));
        (*TIM4::ptr()).ccer().write(|w| w.bits(0));
    }
    compiler_fence(Ordering::SeqCst);
}

/// Outputs dropped, said once, and then the image's rest.
pub(crate) fn halt(why: &dyn Fn()) -> ! {
    static SAID: AtomicBool = AtomicBool::new(false);
    cortex_m::interrupt::disable();
    drop_outputs();
    // A fault while saying so ends here again, silently.
    if !SAID.swap(true, Ordering::Relaxed) {
        why();
    }
    crate::rest()
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    halt(&|| defmt::error!("panic: outputs dropped"))
}

// SAFETY: the handler uses no state of the program it interrupted.
#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    let at = frame.pc();
    halt(&|| defmt::error!("hard fault at {:#010x}: outputs dropped", at))
}

// SAFETY: as above.
#[exception]
unsafe fn DefaultHandler(interrupt: i16) -> ! {
    halt(&|| defmt::error!("unexpected interrupt {}: outputs dropped", interrupt))
}
