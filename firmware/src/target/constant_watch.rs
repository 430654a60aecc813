//! The controller's constants, read over and over, some words a tick: memory that changes by itself is found within a round.

use core::borrow::BorrowMut;

use firmware::constants::{Constant, Constants};
use firmware::supervisor::Check;
use firmware::{Ecu, Followers, SelfTest};

/// Words read in a tick.
const WORDS: usize = 4;

/// What the supervisor is told of constants that are not what they were: nothing is enabled any more before a restart.
pub(crate) const CORRUPT: SelfTest = SelfTest { parameters: Check::Failed, ..SelfTest::PASSED };

/// The watch over one controller, which must not move.
pub(crate) struct ConstantWatch {
    places: Option<Constants>,
    /// The place after the one that is read.
    next: usize,
    at: *const u32,
    left: usize,
    sum: u32,
    /// The sum of the first round.
    expected: Option<u32>,
}

// SAFETY: it only reads, and what it reads is written by nobody else.
unsafe impl Send for ConstantWatch {}

impl ConstantWatch {
    /// Before the first tick.
    pub(crate) const fn new() -> Self {
        Self { places: None, next: 0, at: core::ptr::null(), left: 0, sum: 0, expected: None }
    }

    /// After each tick; false when a round has not the sum of the first. A change of the bucket starts it over.
    #[inline(never)]
    pub(crate) fn look<F: BorrowMut<Followers>>(&mut self, ecu: &Ecu<F>) -> bool {
        if ecu.is_rebuilt() {
            *self = Self::new();
            return true;
        }
        let Some(places) = &self.places else {
            self.places = ecu.constants();
            return true;
        };
        if self.left == 0 {
            let Some(place) = places.get(self.next) else { return self.end() };
            (self.at, self.left, self.next) = (place.start(), place.words(), self.next + 1);
        }
        let count = if self.left < WORDS { self.left } else { WORDS };
        let (mut at, mut sum) = (self.at, self.sum);
        for _ in 0..count {
            // SAFETY: a word of a part of `ecu`, which stays where it is. That nobody writes it the compiler need not believe: volatile.
            let word = unsafe { at.read_volatile() };
            // One turned bit turns one bit of the sum, wherever it is.
            sum = sum.rotate_left(5) ^ word;
            at = at.wrapping_add(1);
        }
        (self.at, self.sum, self.left) = (at, sum, self.left - count);
        true
    }

    /// The end of a round.
    #[inline(never)]
    fn end(&mut self) -> bool {
        let sound = self.expected.is_none_or(|expected| expected == self.sum);
        self.expected.get_or_insert(self.sum);
        (self.next, self.sum) = (0, 0);
        sound
    }

    /// It knows the places; finding them takes a tick of its own.
    #[allow(dead_code)] // as below
    pub(crate) const fn has_begun(&self) -> bool {
        self.places.is_some()
    }

    /// Whether this address is among the constants.
    #[allow(dead_code)] // only the image that is spoilt asks
    pub(crate) fn watches(&self, address: usize) -> bool {
        let within = |place: &Constant| {
            let start = place.start().addr();
            (start..start + place.words() * size_of::<u32>()).contains(&address)
        };
        self.places.is_some_and(|places| places.iter().any(within))
    }
}
