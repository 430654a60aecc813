//! Homogeneous matrices for those who want them: Koivo 1994 (2), (3), (9), Frankel 2003 `Jdisp`. Row-major; the ECU uses none.
//!
//! ```
//! use kinematics_core::matrix::{denavit_hartenberg, product};
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let machine = Machine::<f64>::new(&PinGeometry { boom_pin_x_m: 0.3, ..PinGeometry::EXACT_MINI })?;
//! let swing = Rotor::from_degrees(40.0);
//! let pose = machine.cylinders_to_tip(&Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 }, swing)?;
//! // The last column is the tip, and the wrist: the same point as by the rotors.
//! let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
//! let tip = machine.chain().base_to_tip(swing, &pose.joints).map(|row| row[3]);
//! assert!(near(tip[0], pose.x) && near(tip[1], pose.y) && near(tip[2], pose.z()));
//! let to_wrist = machine.chain().base_to_wrist(swing, &pose.joints);
//! let wrist = machine.chain().wrist(&pose.joints);
//! assert!(near(to_wrist[0][3], wrist.x * swing.cos) && near(to_wrist[2][3], wrist.z));
//! // From the wrist on, the bucket's own transform: 0.567 m along its x axis.
//! let [_, _, _, bucket] = machine.chain().link_matrices(swing, &pose.joints);
//! assert_eq!(bucket, denavit_hartenberg(pose.joints.bucket, Rotor::IDENTITY, 0.567, 0.0));
//! assert_eq!(product(&to_wrist, &bucket).map(|row| row[3]), tip);
//! # Ok(())
//! # }
//! ```

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
