//! Closed-form kinematics of an excavator's or backhoe's working equipment: swing, boom, arm, bucket.
//!
//! Every joint is a unit complex number, a [`Rotor`] `(cos θ, sin θ)`. Rotations compose by complex
//! multiplication, the law of cosines gives the cosine directly and a square root the sine; so
//! cylinder → joint → tip and back, the bucket's four-bar included, use only `+ − × ÷ √`. These are correctly
//! rounded by IEEE 754: the host and the ECU compute the same bits.
//!
//! Frames: x forward, z up, counter-clockwise positive. Lengths are metres. Angles are radians and exist only at
//! the edges ([`Rotor::from_angle`], [`Rotor::angle`]).
//!
//! Read in this order:
//! 1. [`geometry`] — a machine's pins, validated once, every problem named by its field
//!    ([`distances`] turns the papers' distances into pins);
//! 2. [`triangle`] and [`four_bar`] — cylinder ↔ joint;
//! 3. [`chain`] — joints ↔ tip and wrist;
//! 4. [`machine`] — all of it together: [`Machine::cylinders_to_tip`], [`Machine::tip_to_cylinders`];
//! 5. [`rates`], [`jacobian`], [`cylinder_jacobian`], [`swing_jacobian`] — how fast: cylinders ↔ joints ↔ tip, and how they
//!    accelerate; [`forces`] and [`payload`] — how strong: cylinders ↔ joints ↔ tip, and what the bucket carries;
//! 6. [`swing`], [`world`], [`matrix`] — swing, base ↔ world, homogeneous matrices;
//! 7. [`isotropy`], [`isotropic_configurations`] — how well a pose turns joint rates into motion ([`svd`], [`svd3`] below them);
//! 8. [`redundancy`] — tip velocity into the rates of N joints ([`chain_n`]), damped and within limits ([`joint_range`]);
//! 9. [`planning`] — past obstacles, within fences, with least effort, and how fast.
//!
//! ```
//! use kinematics_core::{Cylinders, Machine, PinGeometry, Rotor};
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let machine = Machine::<f32>::new(&PinGeometry::EXACT_MINI)?;
//! let cylinders = Cylinders { boom: 1.1, arm: 1.3, bucket: 1.0 };
//! let pose = machine.cylinders_to_tip(&cylinders, Rotor::IDENTITY)?;
//! let back = machine.tip_to_cylinders(&pose.plane)?;
//! assert!((back.arm - cylinders.arm).abs() < 1e-6);
//! # Ok(())
//! # }
//! ```
#![no_std]
#![deny(unsafe_code)]
// One exception, on the target alone: the hardware square root (`sqrt.rs`).
#![cfg_attr(not(target_arch = "arm"), forbid(unsafe_code))]

pub mod chain;
pub mod chain_n;
mod cylinder_bias;
pub mod cylinder_jacobian;
pub mod distances;
mod error;
mod fine_swing;
mod fixed;
mod fixed_chain;
mod fixed_kernel;
mod fixed_linkage;
pub mod forces;
pub mod four_bar;
pub mod geometry;
pub mod isotropic_configurations;
pub mod isotropy;
pub mod jacobian;
pub mod joint_range;
mod linkages;
pub mod machine;
pub mod matrix;
pub mod payload;
pub mod planning;
pub mod rates;
mod real;
pub mod redundancy;
mod rotor;
mod sector;
mod singular;
mod sqrt;
mod stroke;
pub mod svd;
pub mod svd3;
pub mod swing;
pub mod swing_jacobian;
pub mod triangle;
mod validate;
pub mod world;

pub use chain::{Joints, PlaneTip};
pub use error::{Cylinder, PoseError};
pub use geometry::{GeometryError, PinGeometry};
pub use machine::{Cylinders, Machine, Pose};
pub use real::{Real, Split};
pub use rotor::{Rotor, Vec2};
pub use singular::Singular;
pub use stroke::STROKE_TOLERANCE_M;
