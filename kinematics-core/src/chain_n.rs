//! The planar chain of N revolute joints: tip and Jacobian from the joints' rotors.
//!
//! Hareesha 2015 (8), (11) and (12) for N = 3; more joints for a two-piece boom, a tilting quick coupler or the chassis' own pitch.

use crate::chain::Chain;
use crate::{Real, Rotor, Vec2};

/// A chain of N = 2…6 links in the plane; another N does not compile.
///
/// ```
/// use kinematics_core::chain_n::PlanarChain;
/// use kinematics_core::{Rotor, Vec2};
/// let chain = PlanarChain::new([2.0f64, 1.0, 0.5]);
/// let quarter = Rotor { cos: 0.0, sin: 1.0 };
/// // Boom level, arm straight down, bucket level again.
/// let joints = [Rotor::IDENTITY, quarter.inverse(), quarter];
/// assert_eq!(chain.tip(&joints), Vec2::new(2.5, -1.0));
/// assert_eq!(chain.jacobian(&joints), [[1.0, 1.0, 0.0], [2.5, 0.5, 0.5]]);
/// assert_eq!(chain.tip_and_jacobian(&joints), (chain.tip(&joints), chain.jacobian(&joints)));
/// assert_eq!(chain.ends(&joints), [Vec2::new(2.0, 0.0), Vec2::new(2.0, -1.0), Vec2::new(2.5, -1.0)]);
/// ```
/// ```compile_fail
/// let too_short = kinematics_core::chain_n::PlanarChain::new([1.0f32]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarChain<T, const N: usize> {
    lengths: [T; N],
}

impl<T: Real, const N: usize> PlanarChain<T, N> {
    /// The chain with these link lengths, m, first joint first.
    #[inline]
    pub fn new(lengths: [T; N]) -> Self {
        const { assert!(N >= 2 && N <= 6, "a planar chain has two to six joints") };
        Self { lengths }
    }

    /// The link lengths, m.
    pub fn lengths(&self) -> [T; N] {
        self.lengths
    }

    /// The links as vectors in the base's directions: each joint's rotor turns all that follow.
    #[inline(always)]
    fn links(&self, joints: &[Rotor<T>; N]) -> [Vec2<T>; N] {
        let mut links = [Vec2::new(T::ZERO, T::ZERO); N];
        let mut direction = Rotor::IDENTITY;
        let mut first = true;
        for ((link, &joint), &length) in links.iter_mut().zip(joints).zip(&self.lengths) {
            direction = if first { joint } else { direction * joint };
            first = false;
            *link = direction.to_vec().scale(length);
        }
        links
    }

    /// Where each link ends, m, from the first joint; the last is the tip.
    #[inline]
    pub fn ends(&self, joints: &[Rotor<T>; N]) -> [Vec2<T>; N] {
        let mut ends = self.links(joints);
        let mut end = Vec2::new(T::ZERO, T::ZERO);
        for link in &mut ends {
            end = end + *link;
            *link = end;
        }
        ends
    }

    /// The tip from the first joint, m: Hareesha 2015 (8).
    #[inline]
    pub fn tip(&self, joints: &[Rotor<T>; N]) -> Vec2<T> {
        self.tip_and_jacobian(joints).0
    }

    /// The 2 × N Jacobian, m: Hareesha 2015 (10), (12).
    #[inline]
    pub fn jacobian(&self, joints: &[Rotor<T>; N]) -> [[T; N]; 2] {
        self.tip_and_jacobian(joints).1
    }

    /// Tip and Jacobian together, which cost no more than the Jacobian. A joint's column is the vector from it to the tip, a
    /// quarter turn ahead.
    #[inline(always)]
    pub fn tip_and_jacobian(&self, joints: &[Rotor<T>; N]) -> (Vec2<T>, [[T; N]; 2]) {
        let links = self.links(joints);
        let (mut reach, mut height) = ([T::ZERO; N], [T::ZERO; N]);
        let mut to_tip = Vec2::new(T::ZERO, T::ZERO);
        // From the tip backwards, so that the last column is not a difference of long vectors.
        for ((x, z), &link) in reach.iter_mut().zip(&mut height).zip(&links).rev() {
            to_tip = link + to_tip;
            (*x, *z) = (-to_tip.z, to_tip.x);
        }
        (to_tip, [reach, height])
    }
}

impl<T: Real> From<&Chain<T>> for PlanarChain<T, 3> {
    /// Boom, arm and bucket; its tip is measured from the boom pin, a1 before the swing axis.
    ///
    /// ```
    /// use kinematics_core::chain_n::PlanarChain;
    /// use kinematics_core::{Machine, PinGeometry};
    /// let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI).unwrap();
    /// assert_eq!(PlanarChain::from(machine.chain()).lengths(), [2.05, 1.05, 0.567]);
    /// ```
    fn from(chain: &Chain<T>) -> Self {
        let [_, a2, a3, a4] = chain.lengths();
        Self::new([a2, a3, a4])
    }
}
