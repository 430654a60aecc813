//! Both solenoids of a spool are never on together.

use crate::io::Solenoids;

/// A solenoid of a spool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The first of [`Solenoids`].
    Extend,
    /// The second.
    Retract,
}

impl Side {
    /// Both, in the order of [`Solenoids`].
    pub const BOTH: [Self; 2] = [Self::Extend, Self::Retract];

    /// This side's and the other's of two values.
    #[inline(always)]
    pub fn split<T>(self, [extend, retract]: Solenoids<T>) -> (T, T) {
        match self {
            Self::Extend => (extend, retract),
            Self::Retract => (retract, extend),
        }
    }

    /// This side's of two places. By its number, as the compiler otherwise chooses between two addresses, which takes longer.
    #[inline(always)]
    pub fn of<T>(self, both: &mut Solenoids<T>) -> Option<&mut T> {
        both.get_mut(self as usize)
    }

    /// This value on this side and that on the other.
    #[inline(always)]
    pub fn join<T>(self, this: T, that: T) -> Solenoids<T> {
        match self {
            Self::Extend => [this, that],
            Self::Retract => [that, this],
        }
    }

    /// The other one.
    #[inline]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Extend => Self::Retract,
            Self::Retract => Self::Extend,
        }
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Extend => "extend",
            Self::Retract => "retract",
        }
    }
}

/// Which solenoid of a spool holds the permission to be on: one value, so it can never be two.
#[derive(Clone, Copy, Debug)]
pub struct Interlock {
    released_a: f32,
    holder: Option<Side>,
}

impl Interlock {
    /// A coil counts as off below the current `released_a`.
    pub fn new(released_a: f32) -> Self {
        Self { released_a, holder: None }
    }

    /// The solenoid that may be on.
    #[inline(always)]
    pub fn holder(&self) -> Option<Side> {
        self.holder
    }

    /// Takes the permission back.
    #[inline(always)]
    pub fn release(&mut self) {
        self.holder = None;
    }

    /// Asks for the permission: given when nobody holds it and the other solenoid's measured current has died away.
    #[inline(always)]
    pub fn request(&mut self, side: Side, measured_a: Solenoids<f32>) {
        let (_, other) = side.split(measured_a);
        if self.holder.is_none() && other < self.released_a {
            self.holder = Some(side);
        }
    }
}
