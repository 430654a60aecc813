//! Swing θ1: an angle sensor ([`Rotor::from_turns`]) or a backhoe's swing cylinder, and the plane it turns.

use crate::geometry::SwingPins;
use crate::stroke::StrokeCheck;
use crate::triangle::{Side, Triangle};
use crate::{Cylinder, PlaneTip, PoseError, Real, Rotor};

/// The swing cylinder's triangle, seen from above: Frankel 2003 (1)–(4).
///
/// ```
/// use kinematics_core::geometry::{PinGeometry, Stroke, SwingPins};
/// use kinematics_core::{Machine, Rotor, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// // Frankel's R0M, RJM, R0K and travel, inches.
/// let inch_m = 0.0254;
/// let swing = SwingPins {
///     base: Vec2::new(-6.0, -10.0).scale(inch_m),
///     rod: Vec2::new(5.5, 0.0).scale(inch_m),
///     stroke: Stroke { min_m: 7.5 * inch_m, max_m: 16.6208 * inch_m },
/// };
/// let machine = Machine::<f64>::new(&PinGeometry { swing: Some(swing), ..PinGeometry::EXACT_MINI })?;
/// let cylinder = machine.swing_cylinder().ok_or("no swing cylinder")?;
/// // Straight ahead the pins are 11.5 and 10 inches apart.
/// let ahead = cylinder.length(Rotor::IDENTITY)?;
/// assert!((ahead - 11.5f64.hypot(10.0) * inch_m).abs() < 1e-15);
/// assert!(cylinder.rotor(ahead)?.angle().abs() < 1e-14);
/// // Extending swings to the left.
/// assert!(cylinder.rotor(ahead + inch_m)?.sin > 0.0);
/// assert!(cylinder.rotor(17.0 * inch_m).is_err());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SwingCylinder<T> {
    triangle: Triangle<T>,
    stroke: StrokeCheck<T>,
}

impl<T: Real> SwingCylinder<T> {
    pub(crate) fn from_pins(pins: &SwingPins) -> Self {
        Self {
            triangle: Triangle::new(pins.base, pins.rod, Side::CounterClockwise, 1.0),
            stroke: StrokeCheck::new(pins.stroke),
        }
    }

    /// Cylinder length (m) → rotor of θ1.
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`], [`PoseError::NoAssembly`] of the swing cylinder.
    #[inline]
    pub fn rotor(&self, length: T) -> Result<Rotor<T>, PoseError<T>> {
        self.stroke.check(Cylinder::Swing, length)?;
        self.triangle.rotor(length).map_err(|by| PoseError::NoAssembly { cylinder: Cylinder::Swing, by })
    }

    /// Cylinder length (m) → moment arm dL/dθ1 (m/rad).
    ///
    /// ```
    /// use kinematics_core::geometry::{PinGeometry, Stroke, SwingPins};
    /// use kinematics_core::{Machine, Vec2};
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let swing = SwingPins {
    ///     base: Vec2::new(0.0, -1.0),
    ///     rod: Vec2::new(0.5, 0.0),
    ///     stroke: Stroke { min_m: 0.8, max_m: 1.4 },
    /// };
    /// let machine = Machine::<f64>::new(&PinGeometry { swing: Some(swing), ..PinGeometry::EXACT_MINI })?;
    /// let cylinder = machine.swing_cylinder().ok_or("no swing cylinder")?;
    /// // Straight ahead the rod eye is 0.5 m from the axis and the cylinder slants.
    /// let length = 1.25f64.sqrt();
    /// assert!((cylinder.moment_arm(length)? - 0.5 / length).abs() < 1e-15);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`SwingCylinder::rotor`].
    #[inline]
    pub fn moment_arm(&self, length: T) -> Result<T, PoseError<T>> {
        self.stroke.check(Cylinder::Swing, length)?;
        self.triangle.moment_arm(length).map_err(|by| PoseError::NoAssembly { cylinder: Cylinder::Swing, by })
    }

    /// Rotor of θ1 → cylinder length (m).
    ///
    /// # Errors
    /// [`PoseError::OutOfStroke`], [`PoseError::NoAssembly`] of the swing cylinder.
    #[inline]
    pub fn length(&self, swing: Rotor<T>) -> Result<T, PoseError<T>> {
        let length =
            self.triangle.length(swing).map_err(|by| PoseError::NoAssembly { cylinder: Cylinder::Swing, by })?;
        self.stroke.check(Cylinder::Swing, length)?;
        Ok(length)
    }
}

/// A point in the base frame → swing rotor and plane tip, the tip in front of the axis: Koivo 1994 (23) with its branch named.
///
/// # Errors
/// [`PoseError::Unreachable`] for a point on the swing axis, where the swing is undefined.
///
/// ```
/// use kinematics_core::Rotor;
/// use kinematics_core::swing::plane_through;
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let (swing, tip) = plane_through(1.5, -2.0, -1.0, Rotor::IDENTITY)?;
/// assert_eq!((swing.cos, swing.sin), (0.6, -0.8));
/// assert_eq!((tip.reach, tip.height), (2.5, -1.0));
/// assert!(plane_through(0.0, 0.0, -1.0, Rotor::IDENTITY).is_err());
/// # Ok(())
/// # }
/// ```
pub fn plane_through<T: Real>(x: T, y: T, z: T, pitch: Rotor<T>) -> Result<(Rotor<T>, PlaneTip<T>), PoseError<T>> {
    let radial = crate::Vec2::new(x, y);
    let swing = radial.direction().ok_or(PoseError::Unreachable { by: -radial.norm() })?;
    let tip = PlaneTip { reach: radial.norm(), height: z, pitch };
    Ok((swing, tip))
}
