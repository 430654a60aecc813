//! How deep the stack ever went: the start-up code painted it, the deepest overwritten word tells.

const PAINT: u32 = 0xCCCC_CCCC;

unsafe extern "C" {
    static _stack_start: u32;
    static _stack_end: u32;
}

/// Deepest use of the stack since reset, bytes.
pub(crate) fn peak_bytes() -> u32 {
    let top = &raw const _stack_start;
    let mut word = &raw const _stack_end;
    // SAFETY: both are the linker's bounds of the stack region in RAM, word-aligned; every word between them is readable.
    while word < top && unsafe { word.read_volatile() } == PAINT {
        word = word.wrapping_add(1);
    }
    (top as u32).wrapping_sub(word as u32)
}
