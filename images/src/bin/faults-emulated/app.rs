//! Fails or writes as it is told, and leaves the emulator with a code that says how it was caught.

use crate::exit::{code, end};
use crate::flash::ParameterFlash;
use crate::link::Link;
use crate::{safe_state, target};
use cortex_m::peripheral::NVIC;
use cortex_m_rt::entry;
use defmt_rtt as _;
use embedded_storage::nor_flash::NorFlash;
use stm32f4xx_hal::pac::{Interrupt, Peripherals};

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
