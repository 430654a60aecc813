//! The controller's constants, read over and over, some words a tick: memory that changes by itself is found within a round.

use core::borrow::BorrowMut;

use firmware::constants::{Constant, Constants};
use firmware::supervisor::Check;
use firmware::{Ecu, Fitted, SelfTest};

/// What the supervisor is told of constants that are not what they were: nothing is enabled any more before a restart.
pub(crate) const CORRUPT: SelfTest = SelfTest { parameters: Check::Failed, ..SelfTest::PASSED };

/// The watch over one controller, which must not move.
pub(crate) struct ConstantWatch {
    places: Constants,
    begun: bool,
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
        Self {
            places: [Constant::NOWHERE; _],
            begun: false,
            next: 0,
            at: core::ptr::null(),
            left: 0,
            sum: 0,
            expected: None,
        }
    }

    /// After each tick; false when a round has not the sum of the first. A change of the bucket starts it over.
    #[inline(never)]
    pub(crate) fn look<F: BorrowMut<Fitted>>(&mut self, ecu: &mut Ecu<F>) -> bool {
        if ecu.is_rebuilt() || !self.begun {
            return self.begin(ecu);
        }
        if self.left == 0 {
            return self.next_place();
        }
        // Four or one, written out: a loop of so few would be unrolled into more instructions than it saves.
        if self.left >= 4 {
            self.read();
            self.read();
            self.read();
        }
        self.read();
        true
    }

    /// Takes the next word into the sum.
    #[inline(always)]
    fn read(&mut self) {
        // SAFETY: a word of a part of the controller, which stays where it is. That nobody writes it the compiler need not believe: volatile.
        let word = unsafe { self.at.read_volatile() };
        // One turned bit turns one bit of the sum, wherever it is.
        self.sum = self.sum.rotate_left(5) ^ word;
        (self.at, self.left) = (self.at.wrapping_add(1), self.left.wrapping_sub(1));
    }

    /// Finds the places, once there is nothing more to come.
    #[inline(never)]
    fn begin<F: BorrowMut<Fitted>>(&mut self, ecu: &mut Ecu<F>) -> bool {
        *self = Self::new();
        if let Some(places) = ecu.constants() {
            (self.places, self.begun) = (places, true);
        }
        true
    }

    /// Goes on with the next place, or ends the round.
    #[inline(always)]
    fn next_place(&mut self) -> bool {
        let Some(place) = self.places.get(self.next) else { return self.end() };
        (self.at, self.left, self.next) = (place.start(), place.words(), self.next + 1);
        true
    }

    /// The end of a round.
    #[inline(always)]
    fn end(&mut self) -> bool {
        let sound = self.expected.is_none_or(|expected| expected == self.sum);
        self.expected.get_or_insert(self.sum);
        (self.next, self.sum) = (0, 0);
        sound
    }

    /// It knows the places; finding them takes a tick of its own.
    #[allow(dead_code)] // as below
    pub(crate) const fn has_begun(&self) -> bool {
        self.begun
    }

    /// Whether this address is among the constants.
    #[allow(dead_code)] // only the image that is spoilt asks
    pub(crate) fn watches(&self, address: usize) -> bool {
        let within = |place: &Constant| {
            let start = place.start().addr();
            (start..start + place.words() * size_of::<u32>()).contains(&address)
        };
        self.places.iter().any(within)
    }
}
