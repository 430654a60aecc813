//! The emulator's TIM5 counts nanoseconds of virtual time; with `-icount shift=3` an instruction takes eight.
//!
//! It counts instructions, not cycles: a regression gate and a lower bound, not a timing of the board.

use stm32f4::stm32f405::TIM5;

/// log2 of the nanoseconds an instruction takes: the harness starts the emulator with this `-icount shift`.
pub(crate) const ICOUNT_SHIFT: u32 = 3;

/// A running free counter of virtual nanoseconds.
pub(crate) struct Stopwatch {
    timer: TIM5,
    /// What two readings in a row differ by, ns.
    overhead_ns: u32,
}

impl Stopwatch {
    /// Starts the counter.
    pub(crate) fn start(timer: TIM5) -> Self {
        timer.cr1().modify(|_, w| w.cen().enabled());
        let mut stopwatch = Self { timer, overhead_ns: 0 };
        let before = stopwatch.now_ns();
        let after = stopwatch.now_ns();
        stopwatch.overhead_ns = after.wrapping_sub(before);
        stopwatch
    }

    /// Virtual time, ns, wrapping.
    #[inline(never)]
    pub(crate) fn now_ns(&self) -> u32 {
        self.timer.cnt().read().bits()
    }

    /// Instructions between two readings, the readings themselves taken off.
    pub(crate) fn instructions(&self, before_ns: u32, after_ns: u32) -> u32 {
        after_ns.wrapping_sub(before_ns).saturating_sub(self.overhead_ns) >> ICOUNT_SHIFT
    }
}
