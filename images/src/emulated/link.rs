//! Bytes to and from the harness over semihosting: its standard input and output are the emulator's own pipes.

use core::ffi::CStr;
use cortex_m_semihosting::{nr, syscall};

/// The harness went away or the emulator refused a call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkLost;

/// The two pipes.
pub(crate) struct Link {
    input: usize,
    output: usize,
}

fn open(path: &CStr, mode: usize) -> Result<usize, LinkLost> {
    // SAFETY: the three words SYS_OPEN reads: a NUL-terminated name that outlives the call, mode, length.
    let handle = unsafe { syscall!(OPEN, path.as_ptr(), mode, path.to_bytes().len()) };
    if handle == usize::MAX { Err(LinkLost) } else { Ok(handle) }
}

impl Link {
    /// Opens both directions.
    pub(crate) fn open() -> Result<Self, LinkLost> {
        Ok(Self {
            input: open(c"/dev/stdin", nr::open::R_BINARY)?,
            output: open(c"/dev/stdout", nr::open::W_TRUNC_BINARY)?,
        })
    }

    /// Fills the buffer; reads may come short.
    pub(crate) fn read(&mut self, buffer: &mut [u8]) -> Result<(), LinkLost> {
        let mut rest = buffer;
        while !rest.is_empty() {
            // SAFETY: pointer and length of a live, exclusively borrowed buffer.
            let missing = unsafe { syscall!(READ, self.input, rest.as_mut_ptr(), rest.len()) };
            let taken = rest.len().checked_sub(missing).filter(|&taken| taken > 0).ok_or(LinkLost)?;
            rest = rest.get_mut(taken..).ok_or(LinkLost)?;
        }
        Ok(())
    }

    /// Writes all bytes.
    pub(crate) fn write(&mut self, bytes: &[u8]) -> Result<(), LinkLost> {
        let mut rest = bytes;
        while !rest.is_empty() {
            // SAFETY: pointer and length of a live buffer.
            let missing = unsafe { syscall!(WRITE, self.output, rest.as_ptr(), rest.len()) };
            let taken = rest.len().checked_sub(missing).filter(|&taken| taken > 0).ok_or(LinkLost)?;
            rest = rest.get(taken..).ok_or(LinkLost)?;
        }
        Ok(())
    }
}
