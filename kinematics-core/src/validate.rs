//! Validation of a geometry, once: every field finite, lengths positive, linkages closed and unfolded over the stroke.

use crate::error::Cylinder;
use crate::four_bar::FourBar;
use crate::geometry::{CylinderPins, GeometryError, PinGeometry, Problem, Stroke};
use crate::linkages::Linkages;
use crate::sector::Sector;
use crate::stroke::STROKE_TOLERANCE_M;
use crate::triangle::{Side, Sides};
use crate::{Real, Vec2};

/// How many cylinder lengths the four-bar is tried at: a fold shows as a changed sign at every later one.
const SAMPLES: i32 = 512;

fn error(field: &'static str, problem: Problem) -> GeometryError {
    GeometryError { field, problem }
}

/// No machine has a number beyond this, m; far beyond, f32 overflows and a pose is not a number.
const LARGEST_M: f64 = 1e3;

fn finite(field: &'static str, x: f64) -> Result<(), GeometryError> {
    if !x.is_finite() {
        Err(error(field, Problem::NotFinite))
    } else if !(-LARGEST_M..=LARGEST_M).contains(&x) {
        Err(error(field, Problem::TooLarge(x)))
    } else {
        Ok(())
    }
}

pub(crate) fn positive(field: &'static str, x: f64) -> Result<(), GeometryError> {
    finite(field, x)?;
    if x > 0.0 { Ok(()) } else { Err(error(field, Problem::NotPositive(x))) }
}

/// Checks values one after the other and keeps the first error: looking at a result after each would take more code than the checks.
pub(crate) struct Checks(pub(crate) Result<(), GeometryError>);

/// A pin's two coordinates, or a stroke's two ends, by their fields.
type Two = [&'static str; 2];

const BOOM: Two = ["boom.min_m", "boom.max_m"];
const ARM: Two = ["arm.min_m", "arm.max_m"];
const BUCKET: Two = ["bucket.min_m", "bucket.max_m"];
const SWING: Two = ["swing.min_m", "swing.max_m"];

impl Checks {
    fn and(&mut self, checked: Result<(), GeometryError>) {
        if self.0.is_ok() {
            self.0 = checked;
        }
    }

    #[inline(never)]
    pub(crate) fn finite(&mut self, field: &'static str, x: f64) {
        self.and(finite(field, x));
    }

    #[inline(never)]
    pub(crate) fn positive(&mut self, field: &'static str, x: f64) {
        self.and(positive(field, x));
    }

    #[inline(never)]
    fn pin(&mut self, [x, z]: &Two, v: Vec2<f64>) {
        self.finite(x, v.x);
        self.finite(z, v.z);
        let stands_apart = v.norm_squared() > 0.0;
        self.and(if stands_apart { Ok(()) } else { Err(error(x, Problem::PinsCoincide)) });
    }

    #[inline(never)]
    fn stroke(&mut self, [shortest, longest]: &Two, Stroke { min_m, max_m }: Stroke) {
        self.positive(shortest, min_m);
        self.positive(longest, max_m);
        self.and(if min_m < max_m { Ok(()) } else { Err(error(shortest, Problem::MinNotBelowMax { min_m, max_m })) });
    }

    /// The triangle closes, with the tolerance, over the whole stroke.
    #[inline(never)]
    fn closes(&mut self, [shortest, longest]: &Two, [a, b]: [f64; 2], stroke: Stroke) {
        let sides = Sides { a, b };
        self.closed(shortest, &sides, stroke.min_m, stroke.min_m - STROKE_TOLERANCE_M);
        self.closed(longest, &sides, stroke.max_m, stroke.max_m + STROKE_TOLERANCE_M);
    }

    #[inline(never)]
    fn closed(&mut self, field: &'static str, sides: &Sides, length_m: f64, tried: f64) {
        self.and(if sides.closed_by(tried) { Ok(()) } else { Err(error(field, Problem::DoesNotClose { length_m })) });
    }
}

impl PinGeometry {
    /// Checks everything the maps rely on.
    ///
    /// # Errors
    /// The first problem found, named by its field.
    pub fn validate(&self) -> Result<(), GeometryError> {
        let mut checks = Checks(Ok(()));
        checks.finite("links.boom_pin_x_m", self.boom_pin_x_m);
        checks.positive("links.boom_m", self.boom_m);
        checks.positive("links.arm_m", self.arm_m);
        checks.positive("links.bucket_m", self.bucket_m);
        self.check_boom(&mut checks);
        self.check_arm(&mut checks);
        self.check_bucket(&mut checks);
        self.check_swing(&mut checks);
        checks.0
    }

    fn check_boom(&self, checks: &mut Checks) {
        let CylinderPins { base, rod, stroke } = self.boom;
        checks.pin(&["boom.base_x_m", "boom.base_z_m"], base);
        checks.pin(&["boom.rod_x_m", "boom.rod_z_m"], rod);
        checks.stroke(&BOOM, stroke);
        checks.closes(&BOOM, [base.norm(), rod.norm()], stroke);
    }

    fn check_arm(&self, checks: &mut Checks) {
        let CylinderPins { base, rod, stroke } = self.arm;
        checks.finite("arm.base_x_m", base.x);
        checks.finite("arm.base_z_m", base.z);
        let base = self.arm_base_from_pin();
        checks.pin(&["arm.base_x_m", "arm.base_z_m"], base);
        checks.pin(&["arm.rod_x_m", "arm.rod_z_m"], rod);
        checks.stroke(&ARM, stroke);
        checks.closes(&ARM, [base.norm(), rod.norm()], stroke);
        if checks.0.is_ok() {
            checks.0 = self.arm_curls();
        }
    }

    /// Both ends curled means curled all the way: the triangle turns by less than half a turn.
    fn arm_curls(&self) -> Result<(), GeometryError> {
        let linkages = Linkages::new(self);
        let Stroke { min_m, max_m } = self.arm.stroke;
        for (field, length_m) in ARM.into_iter().zip([min_m, max_m]) {
            if !linkages.rotor(Cylinder::Arm, length_m).is_some_and(|r| r.sin < 0.0) {
                return Err(error(field, Problem::ArmStretches { length_m }));
            }
        }
        Ok(())
    }

    fn check_bucket(&self, checks: &mut Checks) {
        let b = &self.bucket;
        // Each pin by itself first: the differences below would name one pin for the other.
        checks.finite("bucket.base_x_m", b.base.x);
        checks.finite("bucket.base_z_m", b.base.z);
        checks.finite("bucket.rocker_pivot_x_m", b.rocker_pivot.x);
        checks.finite("bucket.rocker_pivot_z_m", b.rocker_pivot.z);
        let base_from_pivot = b.base - b.rocker_pivot;
        checks.pin(&["bucket.base_x_m", "bucket.base_z_m"], base_from_pivot);
        let pivot_from_pin = b.rocker_pivot - self.bucket_pin();
        checks.pin(&["bucket.rocker_pivot_x_m", "bucket.rocker_pivot_z_m"], pivot_from_pin);
        checks.pin(&["bucket.coupler_pin_x_m", "bucket.coupler_pin_z_m"], b.coupler_pin);
        checks.positive("bucket.rocker_m", b.rocker_m);
        checks.positive("bucket.coupler_m", b.coupler_m);
        checks.stroke(&BUCKET, b.stroke);
        checks.closes(&BUCKET, [base_from_pivot.norm(), b.rocker_m], b.stroke);
        if checks.0.is_ok() {
            checks.0 = self.bucket_turns();
        }
    }

    /// The four-bar neither folds nor falls apart anywhere on the stroke.
    fn bucket_turns(&self) -> Result<(), GeometryError> {
        let Stroke { min_m, max_m } = self.bucket.stroke;
        let [shortest, longest] = BUCKET;
        let linkages = Linkages::new(self);
        let lowest = min_m - STROKE_TOLERANCE_M;
        let step = (max_m + STROKE_TOLERANCE_M - lowest) / f64::from(SAMPLES);
        for i in 0..=SAMPLES {
            let length_m = lowest + f64::from(i) * step;
            let field = if 2 * i <= SAMPLES { shortest } else { longest };
            match linkages.bucket().assembly(length_m) {
                Ok(assembly) if assembly.forward > 0.0 && assembly.inverse > 0.0 => {}
                Ok(_) => return Err(error(field, Problem::Folds { length_m })),
                Err(_) => return Err(error(field, Problem::DoesNotClose { length_m })),
            }
        }
        Ok(())
    }

    fn check_swing(&self, checks: &mut Checks) {
        let Some(swing) = &self.swing else { return };
        checks.pin(&["swing.base_x_m", "swing.base_y_m"], swing.base);
        checks.pin(&["swing.rod_x_m", "swing.rod_y_m"], swing.rod);
        checks.stroke(&SWING, swing.stroke);
        checks.closes(&SWING, [swing.base.norm(), swing.rod.norm()], swing.stroke);
    }

    /// The joint angles of boom, arm and bucket over their strokes, tolerance included.
    pub(crate) fn sectors<T: Real>(&self) -> Result<[Sector<T>; 3], GeometryError> {
        let linkages = Linkages::new(self);
        let sector = |side, cylinder, [shortest, longest]: Two, Stroke { min_m, max_m }| {
            let rotor = |field, length_m, tried| {
                linkages.rotor(cylinder, tried).ok_or_else(|| error(field, Problem::DoesNotClose { length_m }))
            };
            let shortest = rotor(shortest, min_m, min_m - STROKE_TOLERANCE_M)?;
            let longest = rotor(longest, max_m, max_m + STROKE_TOLERANCE_M)?;
            Ok(match side {
                Side::CounterClockwise => Sector::between(shortest, longest),
                Side::Clockwise => Sector::between(longest, shortest),
            })
        };
        Ok([
            sector(self.boom_cylinder.side(), Cylinder::Boom, BOOM, self.boom.stroke)?,
            sector(Side::Clockwise, Cylinder::Arm, ARM, self.arm.stroke)?,
            sector(Side::Clockwise, Cylinder::Bucket, BUCKET, self.bucket.stroke)?,
        ])
    }

    /// C from the arm pin, in the boom frame's directions.
    pub(crate) fn arm_base_from_pin(&self) -> Vec2<f64> {
        self.arm.base - Vec2::new(self.boom_m, 0.0)
    }

    fn bucket_pin(&self) -> Vec2<f64> {
        Vec2::new(self.arm_m, 0.0)
    }

    /// The bucket's linkage, unvalidated.
    pub(crate) fn four_bar<T: Real>(&self) -> FourBar<T> {
        let b = self.bucket;
        FourBar::new(b.base, b.rocker_pivot, self.bucket_pin(), b.coupler_pin, b.rocker_m, b.coupler_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rocker_pivot_that_is_not_finite_is_named_and_not_the_pin_measured_from_it() {
        let mut g = PinGeometry::EXACT_MINI;
        g.bucket.rocker_pivot.z = f64::NAN;
        assert_eq!(g.validate(), Err(error("bucket.rocker_pivot_z_m", Problem::NotFinite)));
    }
}
