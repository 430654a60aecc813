//! Homogeneous matrices for those who want them: Koivo 1994 (2), (3), (9), Frankel 2003 `Jdisp`. Row-major; the ECU uses none.

use crate::chain::{Chain, Joints};
use crate::{Real, Rotor};

/// A homogeneous 4 × 4 transform, `matrix[row][column]`.
pub type Matrix4<T> = [[T; 4]; 4];

/// The Denavit–Hartenberg transform A of one joint, Koivo 1994 (2): rotor of θ, rotor of the twist α, a and d in metres.
pub fn denavit_hartenberg<T: Real>(theta: Rotor<T>, twist: Rotor<T>, a: T, d: T) -> Matrix4<T> {
    let (c, s) = (theta.cos, theta.sin);
    let (ca, sa) = (twist.cos, twist.sin);
    let (zero, one) = (T::ZERO, T::ONE);
    [[c, -(ca * s), sa * s, a * c], [s, ca * c, -(sa * c), a * s], [zero, sa, ca, d], [zero, zero, zero, one]]
}

/// The matrix product.
pub fn product<T: Real>(left: &Matrix4<T>, right: &Matrix4<T>) -> Matrix4<T> {
    let mut out = [[T::ZERO; 4]; 4];
    for (row, out_row) in left.iter().zip(&mut out) {
        for (scale, right_row) in row.iter().zip(right) {
            for (sum, value) in out_row.iter_mut().zip(right_row) {
                *sum = *sum + *scale * *value;
            }
        }
    }
    out
}

impl<T: Real> Chain<T> {
    /// A_0^1, A_1^2, A_2^3, A_3^4 of Koivo 1994 (3a)–(3d).
    pub fn link_matrices(&self, swing: Rotor<T>, joints: &Joints<T>) -> [Matrix4<T>; 4] {
        let quarter = Rotor { cos: T::ZERO, sin: T::ONE };
        let level = Rotor::IDENTITY;
        let [a1, a2, a3, a4] = self.lengths();
        [
            denavit_hartenberg(swing, quarter, a1, T::ZERO),
            denavit_hartenberg(joints.boom, level, a2, T::ZERO),
            denavit_hartenberg(joints.arm, level, a3, T::ZERO),
            denavit_hartenberg(joints.bucket, level, a4, T::ZERO),
        ]
    }

    /// A_0^3, base to wrist: its last column is Koivo 1994 (5).
    pub fn base_to_wrist(&self, swing: Rotor<T>, joints: &Joints<T>) -> Matrix4<T> {
        let [swing, boom, arm, _] = self.link_matrices(swing, joints);
        product(&product(&swing, &boom), &arm)
    }

    /// A_0^4, base to tip: Koivo 1994 (9).
    pub fn base_to_tip(&self, swing: Rotor<T>, joints: &Joints<T>) -> Matrix4<T> {
        let [_, _, _, bucket] = self.link_matrices(swing, joints);
        product(&self.base_to_wrist(swing, joints), &bucket)
    }
}
