//! Leaving the emulator with a code that says what the core was in.

use cortex_m::peripheral::SCB;

/// Exit codes; from ten on, how it was caught when the outputs had been dropped.
pub(crate) mod code {
    pub(crate) const WRITTEN: u8 = 0;
    pub(crate) const NOT_CAUGHT: u8 = 1;
    pub(crate) const IN_THREAD: u8 = 10;
    pub(crate) const IN_HARD_FAULT: u8 = 11;
    /// A hard fault because somebody touched the stack guard.
    pub(crate) const AT_GUARD: u8 = 12;
    pub(crate) const IN_INTERRUPT: u8 = 13;
    /// Nobody fed the watchdog: the chip is reset, its pins float, and nothing is driven.
    pub(crate) const WATCHDOG: u8 = 14;
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
pub(crate) fn end(code: u8) -> ! {
    const EXIT_EXTENDED: usize = 0x20;
    const APPLICATION_EXIT: u32 = 0x20026;
    let block = [APPLICATION_EXIT, code.into()];
    // SAFETY: the two words the call reads.
    unsafe { cortex_m_semihosting::syscall1(EXIT_EXTENDED, block.as_ptr() as usize) };
    loop {
        cortex_m::asm::wfi();
    }
}
