//! The joint angles a stroke covers, as an arc: one scalar product tells whether a rotor lies in it.
//!
//! Over a validated stroke angle and length change together without folding, so a joint in the arc is a length in the
//! stroke, on this side of every dead point: one comparison in place of the stroke's two and the linkage's own.

use crate::{Real, Rotor};

/// An arc of angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sector<T> {
    middle: Rotor<T>,
    half_width_cos: T,
}

impl<T: Real> Sector<T> {
    /// The arc from `first` counter-clockwise to `last`, less than a full turn.
    pub(crate) fn between(first: Rotor<f64>, last: Rotor<f64>) -> Self {
        let width = last * first.inverse();
        // Half the width lies in (0, π): its sine is positive, and sin 2h = 2 sin h cos h keeps accuracy near h = π/2.
        let half_sin = (0.5 - 0.5 * width.cos).sqrt();
        let half = Rotor { cos: 0.5 * width.sin / half_sin, sin: half_sin };
        let middle = first * half;
        Self {
            middle: Rotor { cos: T::from_f64(middle.cos), sin: T::from_f64(middle.sin) },
            half_width_cos: T::from_f64(half.cos),
        }
    }

    /// The arc's middle and the cosine of half its width.
    pub(crate) fn middle_and_half_width_cos(&self) -> (Rotor<T>, T) {
        (self.middle, self.half_width_cos)
    }

    /// Whether the rotor lies in the arc, to rounding; false for what is not a number.
    #[inline(always)]
    pub(crate) fn contains(&self, rotor: Rotor<T>) -> bool {
        rotor.to_vec().dot(self.middle.to_vec()) >= self.half_width_cos
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(degrees: f64) -> Rotor<f64> {
        Rotor::from_degrees(degrees)
    }

    #[test]
    fn an_arc_holds_its_ends_and_what_lies_between_but_nothing_else() {
        for (first, width) in [(-120.0, 104.0), (-158.0, 185.0), (170.0, 30.0), (10.0, 300.0), (-90.0, 180.0)] {
            let sector = Sector::<f64>::between(at(first), at(first + width));
            for inside in [1e-6, 0.3 * width, 0.9 * width, width - 1e-6] {
                assert!(sector.contains(at(first + inside)), "{first} + {inside}");
            }
            for outside in [-1e-6, width + 1e-6, width + 0.5 * (360.0 - width)] {
                assert!(!sector.contains(at(first + outside)), "{first} + {outside}");
            }
        }
    }

    #[test]
    fn what_is_not_a_number_lies_in_no_arc() {
        let sector = Sector::<f64>::between(at(0.0), at(350.0));
        assert!(!sector.contains(Rotor { cos: f64::NAN, sin: 0.0 }));
    }
}
