//! What a linked ARM image holds: its functions, who calls whom, and what stack that takes.
//!
//! Read from the machine code itself, so that it covers what no compiler's report does: the assembler's routines, and what was inlined.

pub mod graph;
pub mod thumb;

pub use graph::{Deepest, Function, Graph, instructions};

/// The function in which the board's idle loop runs what service does beside the ticks.
pub const ERRAND: &str = "ecu_stm32f405::app::app::run";

/// Why an image cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ElfError {
    /// No ELF.
    #[error("this is no image: {0}")]
    Elf(#[from] object::Error),
    /// Code and data cannot be told apart.
    #[error("the image was stripped of its symbols")]
    Stripped,
    /// A frame of unknown size.
    #[error("the stack taken at {at:#x} cannot be told")]
    Frame {
        /// Address of the instruction.
        at: u64,
    },
    /// No such function.
    #[error("the image has no function `{0}`")]
    NoFunction(String),
    /// No bound of the stack.
    #[error("`{0}` calls itself: its stack has no bound")]
    Recursion(String),
}
