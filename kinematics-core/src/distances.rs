//! The papers' distances turned into pins: Frankel 2003 `dimensions.m`, and the lengths and angles of Koivo 1994.

use crate::geometry::{BoomCylinder, BucketPins, CylinderPins, GeometryError, PinGeometry, Problem, Stroke, SwingPins};
use crate::validate::positive;
use crate::{Rotor, Vec2};

/// Frankel 2003's measured centre-to-centre distances, under the names of `dimensions.m`, in metres.
///
/// ```
/// use kinematics_core::distances::FrankelDistances;
/// use kinematics_core::geometry::Stroke;
/// use kinematics_core::{Machine, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let inches = |x: f64| x * 0.0254;
/// let stroke = |min, max| Stroke { min_m: inches(min), max_m: inches(max) };
/// let distances = FrankelDistances {
///     r01_m: inches(8.5),
///     r0n_m: inches(10.5),
///     ran_m: inches(7.5),
///     rjm_m: inches(10.0),
///     r0m_m: inches(6.0),
///     r0k_m: inches(5.5),
///     r1c_m: inches(17.5),
///     r12_m: inches(48.0),
///     r2c_m: inches(36.25),
///     r1b_m: inches(36.0),
///     r2b_m: inches(12.35),
///     r2d_m: inches(9.1875),
///     rde_m: inches(13.0),
///     r23_m: inches(38.5),
///     r3d_m: inches(47.25),
///     ref_m: inches(30.77),
///     r3f_m: inches(4.5),
///     r34_m: inches(18.5),
///     r3g_m: inches(5.5),
///     r4g_m: inches(20.01),
///     rfh_m: inches(9.5),
///     rgh_m: inches(9.5),
///     swing: stroke(7.5, 16.6208),
///     boom: stroke(29.0, 46.5434),
///     arm: stroke(27.699, 41.9298),
///     bucket: stroke(22.0242, 38.6144),
/// };
/// let pins = distances.to_pins()?;
/// let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
/// // A stands 1 inch behind the boom pin. Pin to pin, the distances are there again: R2B, R1C, RDE and R4G.
/// assert!(near(pins.boom.base.x, -inches(1.0)));
/// assert!(near((Vec2::new(pins.boom_m, 0.0) - pins.boom.rod).norm(), inches(12.35)));
/// assert!(near(pins.arm.base.norm(), inches(17.5)));
/// assert!(near((pins.arm.rod - pins.bucket.base).norm(), inches(13.0)));
/// assert!(near((Vec2::new(pins.bucket_m, 0.0) - pins.bucket.coupler_pin).norm(), inches(20.01)));
/// assert!(Machine::<f32>::new(&pins)?.swing_cylinder().is_some());
/// // 36 and 11 inches do not reach over the 48 of the boom.
/// let short = FrankelDistances { r2b_m: inches(11.0), ..distances };
/// assert_eq!(short.to_pins().map_err(|e| e.field), Err("distances.r2b_m"));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // The paper's figure labels: r2c is R2C, pins 2 and C.
pub struct FrankelDistances {
    pub r01_m: f64,
    pub r0n_m: f64,
    pub ran_m: f64,
    pub rjm_m: f64,
    pub r0m_m: f64,
    pub r0k_m: f64,
    pub r1c_m: f64,
    pub r12_m: f64,
    pub r2c_m: f64,
    pub r1b_m: f64,
    pub r2b_m: f64,
    pub r2d_m: f64,
    pub rde_m: f64,
    pub r23_m: f64,
    pub r3d_m: f64,
    pub ref_m: f64,
    pub r3f_m: f64,
    pub r34_m: f64,
    pub r3g_m: f64,
    pub r4g_m: f64,
    pub rfh_m: f64,
    pub rgh_m: f64,
    /// Strokes of swing, boom, arm (stick) and bucket.
    pub swing: Stroke,
    pub boom: Stroke,
    pub arm: Stroke,
    pub bucket: Stroke,
}

/// The rotor of the angle between sides `a` and `b` opposite `c`, by the law of cosines.
fn corner(field: &'static str, a: f64, b: f64, c: f64) -> Result<Rotor<f64>, GeometryError> {
    let product = (a + b - c) * (a + b + c) * (c - a + b) * (c + a - b);
    if product > 0.0 {
        let two_ab = 2.0 * a * b;
        Ok(Rotor { cos: (a * a + b * b - c * c) / two_ab, sin: libm::sqrt(product) / two_ab })
    } else {
        Err(GeometryError { field, problem: Problem::NoTriangle })
    }
}

/// The direction pointing back along a link, from which both papers measure.
const BACK: Rotor<f64> = Rotor { cos: -1.0, sin: 0.0 };

fn at(direction: Rotor<f64>, distance: f64) -> Vec2<f64> {
    direction.to_vec().scale(distance)
}

impl FrankelDistances {
    /// The pins these distances determine.
    ///
    /// R0N and RAN put A at (RAN − R01, R0N) from the boom pin; the boom cylinder stands above (`joint_to_cyl` part 1–2).
    ///
    /// # Errors
    /// A distance that is not positive, or three that form no triangle, by field name.
    pub fn to_pins(&self) -> Result<PinGeometry, GeometryError> {
        self.check_lengths()?;
        let boom_at_1 = corner("distances.r2b_m", self.r1b_m, self.r12_m, self.r2b_m)?;
        let boom_at_2 = corner("distances.r1c_m", self.r12_m, self.r2c_m, self.r1c_m)?;
        let arm_at_2 = corner("distances.r3d_m", self.r2d_m, self.r23_m, self.r3d_m)?;
        let arm_at_3 = corner("distances.r2d_m", self.r23_m, self.r3d_m, self.r2d_m)?;
        let df = self.r3d_m - self.r3f_m;
        positive("distances.r3f_m", df)?;
        let arm_at_f = corner("distances.rde_m", df, self.ref_m, self.rde_m)?;
        let bucket_at_3 = corner("distances.r4g_m", self.r3g_m, self.r34_m, self.r4g_m)?;

        let arm_pin = Vec2::new(self.r12_m, 0.0);
        let bucket_pin = Vec2::new(self.r23_m, 0.0);
        // D seen from 3, and F on the line 3–D.
        let towards_d = BACK * arm_at_3.inverse();
        let pivot = bucket_pin + at(towards_d, self.r3f_m);
        Ok(PinGeometry {
            boom_pin_x_m: self.r01_m,
            boom_m: self.r12_m,
            arm_m: self.r23_m,
            bucket_m: self.r34_m,
            boom_cylinder: BoomCylinder::Above,
            boom: CylinderPins {
                base: Vec2::new(self.ran_m - self.r01_m, self.r0n_m),
                rod: at(boom_at_1, self.r1b_m),
                stroke: self.boom,
            },
            arm: CylinderPins {
                base: arm_pin + at(BACK * boom_at_2.inverse(), self.r2c_m),
                rod: at(arm_at_2, self.r2d_m),
                stroke: self.arm,
            },
            bucket: BucketPins {
                base: pivot + at(towards_d * arm_at_f.inverse(), self.ref_m),
                rocker_pivot: pivot,
                coupler_pin: at(bucket_at_3, self.r3g_m),
                rocker_m: self.rfh_m,
                coupler_m: self.rgh_m,
                stroke: self.bucket,
            },
            // (2)–(4): the angle at 0 is θ_X00J + θ1 with θ_X00J = π − atan(RJM/R0M), the rod eye K on the swung x axis's far side.
            swing: Some(SwingPins {
                base: Vec2::new(-self.r0m_m, -self.rjm_m),
                rod: Vec2::new(self.r0k_m, 0.0),
                stroke: self.swing,
            }),
        })
    }

    fn check_lengths(&self) -> Result<(), GeometryError> {
        let lengths = [
            ("distances.r01_m", self.r01_m),
            ("distances.r0n_m", self.r0n_m),
            ("distances.ran_m", self.ran_m),
            ("distances.rjm_m", self.rjm_m),
            ("distances.r0m_m", self.r0m_m),
            ("distances.r0k_m", self.r0k_m),
            ("distances.r1c_m", self.r1c_m),
            ("distances.r12_m", self.r12_m),
            ("distances.r2c_m", self.r2c_m),
            ("distances.r1b_m", self.r1b_m),
            ("distances.r2b_m", self.r2b_m),
            ("distances.r2d_m", self.r2d_m),
            ("distances.rde_m", self.rde_m),
            ("distances.r23_m", self.r23_m),
            ("distances.r3d_m", self.r3d_m),
            ("distances.ref_m", self.ref_m),
            ("distances.r3f_m", self.r3f_m),
            ("distances.r34_m", self.r34_m),
            ("distances.r3g_m", self.r3g_m),
            ("distances.r4g_m", self.r4g_m),
            ("distances.rfh_m", self.rfh_m),
            ("distances.rgh_m", self.rgh_m),
        ];
        lengths.iter().try_for_each(|&(field, x)| positive(field, x))
    }
}

/// Koivo 1994's lengths (m) and structural angles (rad), under the labels of its Figures 1 and 2. ε3, which the paper reads from a
/// sensor, is not needed.
///
/// ```
/// use core::f64::consts::PI;
/// use kinematics_core::distances::KoivoDistances;
/// use kinematics_core::{Machine, PinGeometry, Vec2};
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// // The mini excavator's pins in Koivo's labels: lengths and directions of the vectors between them.
/// let mini = PinGeometry::EXACT_MINI;
/// let polar = |v: Vec2<f64>| (v.norm(), v.z.atan2(v.x));
/// let (l_ab_m, beta_rad) = polar(mini.boom.rod);
/// let (l_ci_m, towards_i) = polar(mini.arm.base - Vec2::new(mini.boom_m, 0.0));
/// let (l_fc_m, gamma2_rad) = polar(mini.arm.rod);
/// let (l_jl_m, towards_j) = polar(mini.bucket.base - mini.bucket.rocker_pivot);
/// let (l_gd_m, nu3_rad) = polar(mini.bucket.coupler_pin);
/// let distances = KoivoDistances {
///     a1_m: 0.0,
///     a2_m: 2.050,
///     a3_m: 1.050,
///     a4_m: 0.567,
///     l_ab_m,
///     l_ah_m: 0.264,
///     l_he_m: 0.135,
///     beta_rad,
///     l_ci_m,
///     l_fc_m,
///     gamma1_rad: PI - towards_i,
///     gamma2_rad,
///     l_jl_m,
///     l_kl_m: 0.240,
///     // The rocker's pivot lies on the arm's line, 0.17 m behind the bucket pin.
///     nu1_rad: towards_j,
///     l_ld_m: 0.170,
///     l_kg_m: 0.240,
///     l_gd_m,
///     nu2_rad: 0.0,
///     nu3_rad,
///     boom: mini.boom.stroke,
///     arm: mini.arm.stroke,
///     bucket: mini.bucket.stroke,
/// };
/// let pins = distances.to_pins()?;
/// let near = |a: Vec2<f64>, b: Vec2<f64>| (a - b).norm() < 1e-15;
/// assert!(near(pins.boom.base, mini.boom.base) && near(pins.boom.rod, mini.boom.rod));
/// assert!(near(pins.arm.base, mini.arm.base) && near(pins.arm.rod, mini.arm.rod));
/// assert!(near(pins.bucket.base, mini.bucket.base) && near(pins.bucket.rocker_pivot, mini.bucket.rocker_pivot));
/// Machine::<f32>::new(&pins)?;
/// let broken = KoivoDistances { nu2_rad: f64::NAN, ..distances };
/// assert_eq!(broken.to_pins().map_err(|e| e.field), Err("distances.nu2_deg"));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // The paper's figure labels: l_ab is L_AB.
pub struct KoivoDistances {
    pub a1_m: f64,
    pub a2_m: f64,
    pub a3_m: f64,
    pub a4_m: f64,
    /// (10): A boom pin, B rod eye at β above AC; E cylinder base at (L_HE, −L_AH) from A. The two may be negative.
    pub l_ab_m: f64,
    pub l_ah_m: f64,
    pub l_he_m: f64,
    pub beta_rad: f64,
    /// (12): C arm pin, I cylinder base (γ1 = ∠ACI), F rod eye (γ2 = ∠FCD).
    pub l_ci_m: f64,
    pub l_fc_m: f64,
    pub gamma1_rad: f64,
    pub gamma2_rad: f64,
    /// (14): L rocker pivot, J cylinder base (ν1 = ∠JLD), K common pin.
    pub l_jl_m: f64,
    pub l_kl_m: f64,
    pub nu1_rad: f64,
    /// (16), (17): D bucket pin (ν2 = ∠CDL), G coupler pin (ν3 = ∠GDN).
    pub l_ld_m: f64,
    pub l_kg_m: f64,
    pub l_gd_m: f64,
    pub nu2_rad: f64,
    pub nu3_rad: f64,
    pub boom: Stroke,
    pub arm: Stroke,
    pub bucket: Stroke,
}

impl KoivoDistances {
    /// The pins these distances and angles determine.
    ///
    /// # Errors
    /// A length that is not positive or an angle that is not finite, by field name.
    pub fn to_pins(&self) -> Result<PinGeometry, GeometryError> {
        let lengths = [
            ("distances.a2_m", self.a2_m),
            ("distances.a3_m", self.a3_m),
            ("distances.a4_m", self.a4_m),
            ("distances.l_ab_m", self.l_ab_m),
            ("distances.l_ci_m", self.l_ci_m),
            ("distances.l_fc_m", self.l_fc_m),
            ("distances.l_jl_m", self.l_jl_m),
            ("distances.l_kl_m", self.l_kl_m),
            ("distances.l_ld_m", self.l_ld_m),
            ("distances.l_kg_m", self.l_kg_m),
            ("distances.l_gd_m", self.l_gd_m),
        ];
        lengths.iter().try_for_each(|&(field, x)| positive(field, x))?;
        let coordinates_and_angles = [
            ("distances.a1_m", self.a1_m),
            ("distances.l_ah_m", self.l_ah_m),
            ("distances.l_he_m", self.l_he_m),
            ("distances.beta_deg", self.beta_rad),
            ("distances.gamma1_deg", self.gamma1_rad),
            ("distances.gamma2_deg", self.gamma2_rad),
            ("distances.nu1_deg", self.nu1_rad),
            ("distances.nu2_deg", self.nu2_rad),
            ("distances.nu3_deg", self.nu3_rad),
        ];
        for (field, x) in coordinates_and_angles {
            if !x.is_finite() {
                return Err(GeometryError { field, problem: Problem::NotFinite });
            }
        }
        let [beta, gamma1, gamma2, nu1, nu2, nu3] =
            [self.beta_rad, self.gamma1_rad, self.gamma2_rad, self.nu1_rad, self.nu2_rad, self.nu3_rad]
                .map(Rotor::from_angle);
        let bucket_pin = Vec2::new(self.a3_m, 0.0);
        // L seen from D; J seen from L, counter-clockwise of D by ν1.
        let towards_l = BACK * nu2.inverse();
        let pivot = bucket_pin + at(towards_l, self.l_ld_m);
        let towards_j = BACK * towards_l * nu1;
        Ok(PinGeometry {
            boom_pin_x_m: self.a1_m,
            boom_m: self.a2_m,
            arm_m: self.a3_m,
            bucket_m: self.a4_m,
            // (11) adds the triangle's angle to the direction of E.
            boom_cylinder: BoomCylinder::Below,
            boom: CylinderPins {
                base: Vec2::new(self.l_he_m, -self.l_ah_m),
                rod: at(beta, self.l_ab_m),
                stroke: self.boom,
            },
            arm: CylinderPins {
                base: Vec2::new(self.a2_m, 0.0) + at(BACK * gamma1.inverse(), self.l_ci_m),
                rod: at(gamma2, self.l_fc_m),
                stroke: self.arm,
            },
            bucket: BucketPins {
                base: pivot + at(towards_j, self.l_jl_m),
                rocker_pivot: pivot,
                coupler_pin: at(nu3, self.l_gd_m),
                rocker_m: self.l_kl_m,
                coupler_m: self.l_kg_m,
                stroke: self.bucket,
            },
            swing: None,
        })
    }
}
