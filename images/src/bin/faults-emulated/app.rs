//! Fails or writes as it is told, and leaves the emulator with a code that says how it was caught.

use crate::flash::ParameterFlash;
use crate::link::Link;
use crate::{safe_state, target};
use cortex_m::peripheral::{NVIC, SCB};
use cortex_m_rt::entry;
use defmt_rtt as _;
use embedded_storage::nor_flash::NorFlash;
use stm32f4xx_hal::pac::{Interrupt, Peripherals};

/// Exit codes; from ten on, what the core was in when the outputs had been dropped.
mod code {
    pub(super) const WRITTEN: u8 = 0;
    pub(super) const NOT_CAUGHT: u8 = 1;
    pub(super) const IN_THREAD: u8 = 10;
    pub(super) const IN_HARD_FAULT: u8 = 11;
    /// A hard fault because somebody touched the stack guard.
    pub(super) const AT_GUARD: u8 = 12;
    pub(super) const IN_INTERRUPT: u8 = 13;
}

#[entry]
fn main() -> ! {
    let taken = (cortex_m::Peripherals::take(), Peripherals::take(), Link::open());
    let (Some(mut core), Some(device), Ok(mut link)) = taken else { end(code::NOT_CAUGHT) };
    target::stack_guard::arm(&mut core.MPU);
    let mut way = [0];
    if link.read(&mut way).is_err() {
        end(code::NOT_CAUGHT);
    }
    match &way {
        b"p" => panic!("as told"),
        b"s" => end(deeper(1) as u8),
        b"h" => cortex_m::asm::udf(),
        b"i" => {
            // SAFETY: nothing here is shared with a handler.
            unsafe { NVIC::unmask(Interrupt::EXTI0) };
            NVIC::pend(Interrupt::EXTI0);
        }
        // The emulator has no flash controller: it reads as ready, and notes every access.
        b"w" => {
            let mut flash = ParameterFlash::new(device.FLASH);
            let sector = ParameterFlash::ERASE_SIZE as u32;
            if flash.erase(sector, 2 * sector).is_ok() && flash.write(sector, &[1, 2, 3, 4]).is_ok() {
                end(code::WRITTEN);
            }
        }
        b"x" => safe_state::halt(&|| defmt::error!("halted as told")),
        _ => {}
    }
    end(code::NOT_CAUGHT)
}

/// Takes stack until there is none.
#[inline(never)]
#[allow(unconditional_recursion)]
fn deeper(depth: u32) -> u32 {
    let here = core::hint::black_box([depth; 16]);
    deeper(depth.wrapping_add(1)).wrapping_add(here.iter().copied().fold(0, u32::wrapping_add))
}

/// Where the board's image would wait for its watchdog: ends the emulator, and tells what the core was in.
pub(crate) fn rest() -> ! {
    /// Memory-management faults in the configurable fault status register (ARMv7-M, B3.2.15): access and stacking.
    const GUARD_TOUCHED: u32 = 1 << 1 | 1 << 4;
    /// What runs: 0 is the thread, 3 a hard fault, interrupts begin at 16 (B3.2.4).
    const VECTOR: u32 = 0x1ff;
    // SAFETY: reads of status registers.
    let (faults, running) = unsafe { ((*SCB::PTR).cfsr.read(), (*SCB::PTR).icsr.read() & VECTOR) };
    end(match running {
        0 => code::IN_THREAD,
        16.. => code::IN_INTERRUPT,
        _ if faults & GUARD_TOUCHED != 0 => code::AT_GUARD,
        _ => code::IN_HARD_FAULT,
    })
}

/// Ends the emulator with this exit code (SYS_EXIT_EXTENDED).
fn end(code: u8) -> ! {
    const EXIT_EXTENDED: usize = 0x20;
    const APPLICATION_EXIT: u32 = 0x20026;
    let block = [APPLICATION_EXIT, code.into()];
    // SAFETY: the two words the call reads.
    unsafe { cortex_m_semihosting::syscall1(EXIT_EXTENDED, block.as_ptr() as usize) };
    loop {
        cortex_m::asm::wfi();
    }
}
