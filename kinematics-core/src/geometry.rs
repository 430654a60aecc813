//! A machine's geometry from its pins: f64 metres, each number with a name that messages use.

use core::fmt;

use crate::Vec2;
use crate::triangle::Side;

/// A cylinder's shortest and longest length between its pins, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stroke {
    /// Fully retracted.
    pub min_m: f64,
    /// Fully extended.
    pub max_m: f64,
}

/// Two pins and a stroke: the boom's or the arm's cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CylinderPins {
    /// Cylinder base, in the frame of the link that carries it (A: body frame at the boom pin; C: boom frame at the boom pin).
    pub base: Vec2<f64>,
    /// Rod eye, in the frame of the link it moves (B: boom frame; D: arm frame).
    pub rod: Vec2<f64>,
    /// Travel.
    pub stroke: Stroke,
}

/// The bucket's cylinder and four-bar.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BucketPins {
    /// E, cylinder base in the arm frame.
    pub base: Vec2<f64>,
    /// I, rocker pivot in the arm frame.
    pub rocker_pivot: Vec2<f64>,
    /// H, coupler pin in the bucket frame.
    pub coupler_pin: Vec2<f64>,
    /// r, rocker length I–J.
    pub rocker_m: f64,
    /// c, coupler length J–K.
    pub coupler_m: f64,
    /// Travel.
    pub stroke: Stroke,
}

/// A backhoe's swing cylinder: seen from above, its base and its rod eye about the swing axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SwingPins {
    /// Cylinder base in the base frame, (x, y).
    pub base: Vec2<f64>,
    /// Rod eye in the swung frame, (x, y).
    pub rod: Vec2<f64>,
    /// Travel.
    pub stroke: Stroke,
}

/// Where the boom cylinder stands; the pins alone do not tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BoomCylinder {
    /// Below the boom pin: extending raises the boom (most excavators).
    Below,
    /// Above the boom pin: extending lowers the boom (many backhoes).
    Above,
}

impl BoomCylinder {
    pub(crate) const fn side(self) -> Side {
        match self {
            Self::Below => Side::CounterClockwise,
            Self::Above => Side::Clockwise,
        }
    }
}

/// Everything the maps need of a machine. Frames sit at each link's own pin, x along the link, z up (DH frames of
/// Koivo 1994 Table 1).
///
/// ```
/// use kinematics_core::PinGeometry;
/// let mut geometry = PinGeometry::EXACT_MINI;
/// assert!((geometry.reach_m() - 3.667).abs() < 1e-15);
/// assert_eq!(geometry.validate(), Ok(()));
/// // |A| + |B| is 1.36 m: a boom cylinder of 1.4 m closes no triangle.
/// geometry.boom.stroke.max_m = 1.4;
/// let error = geometry.validate().expect_err("too long");
/// assert_eq!(error.to_string(), "`boom.max_m`: the linkage does not close at a cylinder length of 1.4 m");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PinGeometry {
    /// a1, boom pin's forward distance from the swing axis (may be negative), m.
    pub boom_pin_x_m: f64,
    /// a2, boom pin to arm pin, m.
    pub boom_m: f64,
    /// a3, arm pin to bucket pin, m.
    pub arm_m: f64,
    /// a4, bucket pin to tip, m.
    pub bucket_m: f64,
    /// On which side of the boom pin the boom cylinder stands.
    pub boom_cylinder: BoomCylinder,
    /// Boom cylinder: A, B.
    pub boom: CylinderPins,
    /// Arm cylinder: C, D.
    pub arm: CylinderPins,
    /// Bucket cylinder and four-bar: E, I, H, r, c.
    pub bucket: BucketPins,
    /// Swing cylinder, where the machine has one; otherwise an angle sensor reads the swing.
    pub swing: Option<SwingPins>,
}

impl PinGeometry {
    /// The pins of eXactMPC's mini excavator (its published constants), the crate's example machine.
    pub const EXACT_MINI: Self = Self {
        boom_pin_x_m: 0.0,
        boom_m: 2.050,
        arm_m: 1.050,
        bucket_m: 0.567,
        boom_cylinder: BoomCylinder::Below,
        boom: CylinderPins {
            base: Vec2::new(0.135, -0.264),
            rod: Vec2::new(1.025, 0.278),
            stroke: Stroke { min_m: 0.905, max_m: 1.305 },
        },
        arm: CylinderPins {
            base: Vec2::new(0.977, 0.737),
            rod: Vec2::new(-0.251, 0.158),
            stroke: Stroke { min_m: 1.046, max_m: 1.556 },
        },
        bucket: BucketPins {
            base: Vec2::new(-0.134, 0.320),
            rocker_pivot: Vec2::new(0.880, 0.0),
            coupler_pin: Vec2::new(-0.014, 0.164),
            rocker_m: 0.240,
            coupler_m: 0.240,
            stroke: Stroke { min_m: 0.840, max_m: 1.260 },
        },
        swing: None,
    };

    /// The radius the tip can reach from the boom pin, m: what accuracies are relative to.
    pub fn reach_m(&self) -> f64 {
        self.boom_m + self.arm_m + self.bucket_m
    }
}

/// What is wrong with a geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Problem {
    /// Not a number or infinite.
    NotFinite,
    /// More than a kilometre, m: no machine, and beyond what single precision can square.
    TooLarge(f64),
    /// A length that is not above zero, m.
    NotPositive(f64),
    /// The minimum of a stroke is not below its maximum.
    MinNotBelowMax {
        /// m
        min_m: f64,
        /// m
        max_m: f64,
    },
    /// Two pins coincide, so that no triangle is left.
    PinsCoincide,
    /// The triangle (or for the bucket the four-bar) does not close at this cylinder length, m.
    DoesNotClose {
        /// m
        length_m: f64,
    },
    /// A dead point lies inside the stroke, near this cylinder length, m: the map is not unique there.
    Folds {
        /// m
        length_m: f64,
    },
    /// The arm reaches or passes its stretched position (θ3 = 0 or ±π) at this cylinder length, m: tip → joints is not unique.
    ArmStretches {
        /// m
        length_m: f64,
    },
    /// Distances of a triangle that cannot close among themselves.
    NoTriangle,
    /// Two ways of giving the same distance disagree by this much, m.
    Inconsistent(f64),
}

/// One problem of a geometry, named by its field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometryError {
    /// The field as machine files name it, e.g. `boom.base_x_m`.
    pub field: &'static str,
    /// What is wrong.
    pub problem: Problem,
}

impl fmt::Display for GeometryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let field = self.field;
        match self.problem {
            Problem::NotFinite => write!(f, "`{field}` must be a finite number"),
            Problem::TooLarge(x) => write!(f, "`{field}` must be within −1000…1000 m, not {x}"),
            Problem::NotPositive(x) => write!(f, "`{field}` is a length and must be above 0, not {x}"),
            Problem::MinNotBelowMax { min_m, max_m } => {
                write!(f, "`{field}`: the stroke's minimum {min_m} m must be below its maximum {max_m} m")
            }
            Problem::PinsCoincide => write!(f, "`{field}`: the pin coincides with its joint"),
            Problem::DoesNotClose { length_m } => {
                write!(f, "`{field}`: the linkage does not close at a cylinder length of {length_m} m")
            }
            Problem::Folds { length_m } => write!(
                f,
                "`{field}`: the linkage folds (dead point) inside the stroke, at a cylinder length of {length_m} m"
            ),
            Problem::ArmStretches { length_m } => write!(
                f,
                "`{field}`: boom and arm are in line at a cylinder length of {length_m} m; \
                 the arm must stay curled (−180° < θ3 < 0°) over its stroke"
            ),
            Problem::NoTriangle => write!(f, "`{field}`: the three distances do not form a triangle"),
            Problem::Inconsistent(by) => {
                write!(f, "`{field}` disagrees with the other distances by {by} m")
            }
        }
    }
}

impl core::error::Error for GeometryError {}
