//! Length and direction of the bucket's tip from touches of one point, anywhere, at several bucket angles.
//!
//! At touch i the bucket pin stands at wᵢ and the bucket's frame is turned by the rotor rᵢ; the tip t (bucket frame) then stands at
//! wᵢ + rᵢ·t, at every touch the same unknown point. As complex numbers that is linear in t, and least squares give
//! `t = −Σ conj(rᵢ − r̄)(wᵢ − w̄) / Σ|rᵢ − r̄|²`: no angle, no iteration.

use kinematics_core::{Joints, Real, Rotor, Vec2};

/// Fewest touches.
pub const MIN_TOUCHES: u32 = 3;
/// The rotors' mean square distance from their mean must reach this: touches about 30° to either side of the middle one.
pub const MIN_SPREAD: f32 = 0.15;

/// What the touches say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredBucket {
    /// Bucket pin → tip, m.
    pub length_m: f32,
    /// Direction of the tip in the bucket's frame as the parameters have it: [`Rotor::IDENTITY`] where they are right.
    pub offset: Rotor<f32>,
    /// Root mean square distance of the touches' tips from their mean, m: how well they agree, to half a millimetre.
    pub residual_m: f32,
}

/// Why there is no result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeasureUpError {
    /// Fewer touches than [`MIN_TOUCHES`].
    TooFew {
        /// How many there are.
        touches: u32,
    },
    /// The bucket was turned too little between the touches.
    TooAlike {
        /// The spread reached; [`MIN_SPREAD`] is needed.
        spread: f32,
    },
}

impl core::fmt::Display for MeasureUpError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooFew { touches } => write!(f, "{touches} touches, but at least {MIN_TOUCHES} are needed"),
            Self::TooAlike { spread } => {
                write!(f, "the bucket's angles are too alike: spread {spread}, at least {MIN_SPREAD} is needed")
            }
        }
    }
}

impl core::error::Error for MeasureUpError {}

/// The touches so far, as sums; wrists relative to the first touch's.
#[derive(Clone, Copy, Debug)]
pub struct MeasureUp {
    touches: u32,
    first: Vec2<f32>,
    rotors: Vec2<f32>,
    wrists: Vec2<f32>,
    wrists_squared: f32,
    /// Σ conj(rᵢ)·wᵢ
    products: Vec2<f32>,
}

impl Default for MeasureUp {
    fn default() -> Self {
        Self::new()
    }
}

impl MeasureUp {
    /// No touch yet.
    pub const fn new() -> Self {
        let zero = Vec2 { x: 0.0, z: 0.0 };
        Self { touches: 0, first: zero, rotors: zero, wrists: zero, wrists_squared: 0.0, products: zero }
    }

    /// The tip touches the point now: the bucket pin stands at `wrist` (m) and the joints as given.
    pub fn touch(&mut self, wrist: Vec2<f32>, joints: &Joints<f32>) {
        let r = joints.boom * joints.arm * joints.bucket;
        if self.touches == 0 {
            self.first = wrist;
        }
        let w = wrist - self.first;
        self.touches = self.touches.saturating_add(1);
        self.rotors = self.rotors + r.to_vec();
        self.wrists = self.wrists + w;
        self.wrists_squared += w.norm_squared();
        self.products = self.products + r.inverse().rotate(w);
    }

    /// The bucket by all touches.
    ///
    /// # Errors
    /// [`MeasureUpError`]
    pub fn bucket(&self) -> Result<MeasuredBucket, MeasureUpError> {
        if self.touches < MIN_TOUCHES {
            return Err(MeasureUpError::TooFew { touches: self.touches });
        }
        let share = 1.0 / self.touches as f32;
        let (r, w) = (self.rotors.scale(share), self.wrists.scale(share));
        let spread = 1.0 - r.norm_squared();
        let enough = spread >= MIN_SPREAD;
        if !enough {
            return Err(MeasureUpError::TooAlike { spread });
        }
        let covariance = self.products.scale(share) - r.conjugate().complex_mul(w);
        let tip = covariance.scale(-1.0 / spread);
        let Some(offset) = tip.direction() else { return Err(MeasureUpError::TooAlike { spread }) };
        let variance = self.wrists_squared * share - w.norm_squared();
        let left = variance - covariance.norm_squared() / spread;
        let residual_m = if left > 0.0 { Real::sqrt(left) } else { 0.0 };
        Ok(MeasuredBucket { length_m: tip.norm(), offset, residual_m })
    }
}
