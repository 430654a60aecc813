//! A part of many cases that do not depend on each other.

/// Case i belongs to shard i modulo `of`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// 0 to `of` − 1.
    pub index: u64,
    /// At least 1.
    pub of: u64,
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { index: 0, of: 1 };

    /// Its cases among the first `all`.
    pub fn cases(self, all: u64) -> Vec<u64> {
        (0..all).filter(|case| case % self.of == self.index).collect()
    }
}
