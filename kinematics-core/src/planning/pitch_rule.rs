//! What the bucket's pitch may do during a move: the one degree of freedom the tip's place leaves in the plane.

use crate::Real;

/// The pitches a move may use. Turns are continuous: 0.25 is a quarter turn counter-clockwise, 1.25 the same direction again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PitchRule<T> {
    /// Any within half a turn of the pitch at the start.
    Free,
    /// This one, turns.
    Fixed(T),
    /// Between these, turns.
    Bounded {
        /// Lowest.
        lower: T,
        /// Highest, not below the lowest.
        upper: T,
    },
}

/// Rounding of a pitch that is given and one that is read back from a pose: a thousandth of a turn.
const SAME_PITCH_TURNS: f64 = 1e-3;

impl<T: Real> PitchRule<T> {
    /// Lowest and highest pitch (turns) of a move that starts at `start`.
    ///
    /// ```
    /// use kinematics_core::planning::pitch_rule::PitchRule;
    /// assert_eq!(PitchRule::Free.range(-0.25), [-0.75, 0.25]);
    /// assert_eq!(PitchRule::Fixed(0.1).range(-0.25), [0.1, 0.1]);
    /// assert_eq!(PitchRule::Bounded { lower: -0.3, upper: 0.0 }.range(-0.25), [-0.3, 0.0]);
    /// ```
    pub fn range(&self, start: T) -> [T; 2] {
        match *self {
            Self::Free => {
                let half = T::from_f64(0.5);
                [start - half, start + half]
            }
            Self::Fixed(turns) => [turns, turns],
            Self::Bounded { lower, upper } => [lower, upper],
        }
    }

    /// Whether a move may stand at this pitch, to a thousandth of a turn.
    ///
    /// ```
    /// # use kinematics_core::planning::pitch_rule::PitchRule;
    /// let rule = PitchRule::Bounded { lower: -0.3, upper: 0.0 };
    /// assert!(rule.allows(0.0005, 0.0) && !rule.allows(0.01, 0.0) && !rule.allows(f64::NAN, 0.0));
    /// ```
    pub fn allows(&self, pitch: T, start: T) -> bool {
        let [lower, upper] = self.range(start);
        let slack = T::from_f64(SAME_PITCH_TURNS);
        pitch >= lower - slack && pitch <= upper + slack
    }
}

/// `x` within `low` and `high`, by comparison: not a number stays what it is.
pub(crate) fn within<T: Real>(x: T, low: T, high: T) -> T {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}
