//! Where the controller's constants lie in memory: what was derived from the parameters and is never written again, but by a change of the
//! bucket. An image reads these places over and over, to find memory that has changed by itself; the library only says where they are.

/// A place of whole words.
#[derive(Clone, Copy, Debug)]
pub struct Constant {
    start: *const u32,
    words: usize,
}

impl Constant {
    /// No place at all.
    pub const NOWHERE: Self = Self { start: core::ptr::null(), words: 0 };

    /// Where `part` lies.
    pub(crate) const fn of<T: Copy>(part: &T) -> Self {
        const { assert!(align_of::<T>() >= align_of::<u32>(), "whole words only") };
        Self { start: core::ptr::from_ref(part).cast(), words: size_of::<T>() / size_of::<u32>() }
    }

    /// Its first word.
    pub const fn start(&self) -> *const u32 {
        self.start
    }

    /// How many there are.
    pub const fn words(&self) -> usize {
        self.words
    }
}

/// Places of a controller's constants; those that are not there have no words.
pub type Constants = [Constant; 21];
