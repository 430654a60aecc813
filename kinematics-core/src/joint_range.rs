//! A joint's limits as rotors: how far the joint has left the middle of its range, and back, without an angle.

use crate::sector::Sector;
use crate::{Real, Rotor};

/// The share of the range's [`Place::share`] from which a joint's mobility fades: a quarter is left to the limit.
const FADING: i32 = 4;

/// The angles a joint may take, less than a full turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRange<T> {
    middle: Rotor<T>,
    /// 1/(1 − cos h), h half the range.
    gain: T,
}

/// Where a joint stands in its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<T> {
    /// H = (1 − cos δ)/(1 − cos h), δ the angle from the middle and h half the range: 0 in the middle, 1 at both limits,
    /// above 1 beyond. It grows with |δ| up to half a turn.
    pub share: T,
    /// dH/dθ = sin δ/(1 − cos h), 1/rad.
    pub slope: T,
}

impl<T: Real> JointRange<T> {
    /// The range from `lower` counter-clockwise to `upper`, unit rotors of different angles.
    ///
    /// ```
    /// use kinematics_core::Rotor;
    /// use kinematics_core::joint_range::JointRange;
    /// let arm = JointRange::<f64>::between(Rotor::from_degrees(-150.0), Rotor::from_degrees(-30.0)).unwrap();
    /// assert!(arm.place(Rotor::from_degrees(-90.0)).share.abs() < 1e-15);
    /// assert!((arm.place(Rotor::from_degrees(-30.0)).share - 1.0).abs() < 1e-15);
    /// assert!(arm.place(Rotor::from_degrees(-151.0)).share > 1.0);
    /// assert!(JointRange::<f64>::between(Rotor::IDENTITY, Rotor::IDENTITY).is_none());
    /// ```
    pub fn between(lower: Rotor<f64>, upper: Rotor<f64>) -> Option<Self> {
        let (middle, half_width_cos) = Sector::<f64>::between(lower, upper).middle_and_half_width_cos();
        let gain = 1.0 / (1.0 - half_width_cos);
        let usable = middle.to_vec().norm_squared() > 0.5 && gain > 0.0 && gain.is_finite();
        let middle = Rotor { cos: T::from_f64(middle.cos), sin: T::from_f64(middle.sin) };
        usable.then(|| Self { middle, gain: T::from_f64(gain) })
    }

    /// Where the joint stands.
    #[inline(always)]
    pub fn place(&self, joint: Rotor<T>) -> Place<T> {
        let (middle, joint) = (self.middle.to_vec(), joint.to_vec());
        Place { share: (T::ONE - middle.dot(joint)) * self.gain, slope: middle.cross(joint) * self.gain }
    }
}

impl<T: Real> Place<T> {
    /// How freely the joint may move for the tip's sake: 1 up to H = 3/4, from there in a straight line to 0 at the limit and
    /// beyond. Continuous.
    ///
    /// ```
    /// use kinematics_core::joint_range::Place;
    /// let at = |share| Place { share, slope: 0.0f32 }.freedom();
    /// assert_eq!([at(0.0), at(0.75), at(0.875), at(1.0), at(1.5)], [1.0, 1.0, 0.5, 0.0, 0.0]);
    /// ```
    #[inline(always)]
    pub fn freedom(&self) -> T {
        let left = (T::ONE - self.share) * T::from_i32(FADING);
        if left >= T::ONE {
            T::ONE
        } else if left > T::ZERO {
            left
        } else {
            T::ZERO
        }
    }
}
