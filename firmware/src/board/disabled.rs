//! The proof that nothing can move.

use core::fmt;

use super::{Board, BoardError};

/// The board had every solenoid off and the cut-off open, seen by its read-back. Whoever makes one lets nothing drive until it is gone:
/// [`super::Controller`] holds everything off until the errand it gave one to is back. Writing flash asks for one, because the STM32F405
/// stands still while it erases.
#[derive(Debug)]
pub struct Disabled(());

/// Why a board cannot be proved disabled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotDisabled {
    /// An output or input failed.
    Board(BoardError),
    /// The cut-off reads closed though it was told to open: a welded contact, or it has yet to fall.
    CutOffClosed,
}

impl fmt::Display for NotDisabled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Board(error) => error.fmt(f),
            Self::CutOffClosed => f.write_str("the master cut-off reads closed"),
        }
    }
}

impl core::error::Error for NotDisabled {}

impl Disabled {
    /// Switches everything off and looks whether it is.
    ///
    /// # Errors
    /// What failed; everything that could be switched off is off all the same.
    pub fn new<B: Board>(board: &mut B) -> Result<Self, NotDisabled> {
        let driven = board.drive(&[[0; 2]; 4]);
        let opened = board.set_cut_off(false);
        driven.and(opened).map_err(NotDisabled::Board)?;
        if board.cut_off_is_closed().map_err(NotDisabled::Board)? {
            return Err(NotDisabled::CutOffClosed);
        }
        Ok(Self(()))
    }
}
