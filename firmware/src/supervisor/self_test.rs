//! What the start-up self-test found. The library cannot try a memory or a driver by itself: the board does, and reports.

use crate::fault::Fault;

/// How a step stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// Not done yet; nothing is enabled before it is.
    Pending,
    /// Good.
    Passed,
    /// Bad: nothing is enabled before a restart.
    Failed,
}

/// The report, a step each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SelfTest {
    /// CRC of the stored parameter record.
    pub parameters: Check,
    /// Memory: patterns written and read back.
    pub memory: Check,
    /// The converters' configuration as read back from them.
    pub converters: Check,
    /// The output drivers: with the cut-off open, each switched on and off, and no current anywhere.
    pub drivers: Check,
    /// The cut-off: closed and opened once with all duties zero, and its contact followed.
    pub cut_off: Check,
}

impl SelfTest {
    /// Nothing done yet.
    pub const PENDING: Self = Self::all(Check::Pending);
    /// Everything good: what a bench or a simulated machine reports, which has none of these parts.
    pub const PASSED: Self = Self::all(Check::Passed);

    #[inline]
    const fn all(check: Check) -> Self {
        Self { parameters: check, memory: check, converters: check, drivers: check, cut_off: check }
    }

    #[inline]
    const fn steps(&self) -> [(Check, Fault); 5] {
        [
            (self.parameters, Fault::ParametersCorrupt),
            (self.memory, Fault::Memory),
            (self.converters, Fault::ConverterSetUp),
            (self.drivers, Fault::OutputDrivers),
            (self.cut_off, Fault::CutOffUnproven),
        ]
    }

    /// Every step has passed.
    #[inline]
    pub fn passed(&self) -> bool {
        *self == Self::PASSED
    }

    /// The first step that failed.
    #[inline]
    pub fn fault(&self) -> Option<Fault> {
        self.steps().into_iter().find(|(check, _)| *check == Check::Failed).map(|(_, fault)| fault)
    }
}
