//! Validation of a geometry, once: every field finite, lengths positive, linkages closed and unfolded over the stroke.

use crate::four_bar::FourBar;
use crate::geometry::{CylinderPins, GeometryError, PinGeometry, Problem, Stroke};
use crate::sector::Sector;
use crate::stroke::STROKE_TOLERANCE_M;
use crate::triangle::{Side, Sides, Triangle};
use crate::{Real, Rotor, Vec2};

/// How many cylinder lengths the four-bar is tried at: a fold shows as a changed sign at every later one.
const SAMPLES: i32 = 512;

fn error(field: &'static str, problem: Problem) -> GeometryError {
    GeometryError { field, problem }
}

/// No machine has a number beyond this, m; far beyond, f32 overflows and a pose is not a number.
const LARGEST_M: f64 = 1e3;

pub(crate) fn finite(field: &'static str, x: f64) -> Result<(), GeometryError> {
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

fn pin(fields: [&'static str; 2], v: Vec2<f64>) -> Result<(), GeometryError> {
    finite(fields[0], v.x)?;
    finite(fields[1], v.z)?;
    if v.norm_squared() > 0.0 { Ok(()) } else { Err(error(fields[0], Problem::PinsCoincide)) }
}

fn stroke(fields: [&'static str; 2], stroke: Stroke) -> Result<(), GeometryError> {
    let Stroke { min_m, max_m } = stroke;
    positive(fields[0], min_m)?;
    positive(fields[1], max_m)?;
    if min_m < max_m { Ok(()) } else { Err(error(fields[0], Problem::MinNotBelowMax { min_m, max_m })) }
}

/// The triangle closes, with the tolerance, over the whole stroke.
fn closes(fields: [&'static str; 2], sides: Sides, stroke: Stroke) -> Result<(), GeometryError> {
    let ends = [
        (fields[0], stroke.min_m, stroke.min_m - STROKE_TOLERANCE_M),
        (fields[1], stroke.max_m, stroke.max_m + STROKE_TOLERANCE_M),
    ];
    for (field, length_m, tried) in ends {
        if !sides.closed_by(tried) {
            return Err(error(field, Problem::DoesNotClose { length_m }));
        }
    }
    Ok(())
}

/// The arc between a joint's rotors at both ends of a stroke, tolerance included.
fn sector<T: Real>(
    side: Side,
    fields: [&'static str; 2],
    stroke: Stroke,
    rotor: impl Fn(f64) -> Option<Rotor<f64>>,
) -> Result<Sector<T>, GeometryError> {
    let end = |field, length_m| rotor(length_m).ok_or_else(|| error(field, Problem::DoesNotClose { length_m }));
    let shortest = end(fields[0], stroke.min_m - STROKE_TOLERANCE_M)?;
    let longest = end(fields[1], stroke.max_m + STROKE_TOLERANCE_M)?;
    Ok(match side {
        Side::CounterClockwise => Sector::between(shortest, longest),
        Side::Clockwise => Sector::between(longest, shortest),
    })
}

impl PinGeometry {
    /// Checks everything the maps rely on.
    ///
    /// # Errors
    /// The first problem found, named by its field.
    pub fn validate(&self) -> Result<(), GeometryError> {
        finite("links.boom_pin_x_m", self.boom_pin_x_m)?;
        positive("links.boom_m", self.boom_m)?;
        positive("links.arm_m", self.arm_m)?;
        positive("links.bucket_m", self.bucket_m)?;
        self.validate_boom()?;
        self.validate_arm()?;
        self.validate_bucket()?;
        self.validate_swing()
    }

    fn validate_boom(&self) -> Result<(), GeometryError> {
        let CylinderPins { base, rod, stroke: travel } = self.boom;
        pin(["boom.base_x_m", "boom.base_z_m"], base)?;
        pin(["boom.rod_x_m", "boom.rod_z_m"], rod)?;
        let ends = ["boom.min_m", "boom.max_m"];
        stroke(ends, travel)?;
        closes(ends, Sides { a: base.norm(), b: rod.norm() }, travel)
    }

    fn validate_arm(&self) -> Result<(), GeometryError> {
        let CylinderPins { base, rod, stroke: travel } = self.arm;
        finite("arm.base_x_m", base.x)?;
        finite("arm.base_z_m", base.z)?;
        let base = self.arm_base_from_pin();
        pin(["arm.base_x_m", "arm.base_z_m"], base)?;
        pin(["arm.rod_x_m", "arm.rod_z_m"], rod)?;
        let ends = ["arm.min_m", "arm.max_m"];
        stroke(ends, travel)?;
        closes(ends, Sides { a: base.norm(), b: rod.norm() }, travel)?;
        let triangle = Triangle::<f64>::new(base, rod, Side::Clockwise, 1.0);
        for (field, length_m) in [(ends[0], travel.min_m), (ends[1], travel.max_m)] {
            // Both ends curled means curled all the way: the triangle turns by less than half a turn.
            if !triangle.rotor(length_m).is_ok_and(|r| r.sin < 0.0) {
                return Err(error(field, Problem::ArmStretches { length_m }));
            }
        }
        Ok(())
    }

    fn validate_bucket(&self) -> Result<(), GeometryError> {
        let b = self.bucket;
        // Each pin by itself first: the differences below would name one pin for the other.
        finite("bucket.base_x_m", b.base.x)?;
        finite("bucket.base_z_m", b.base.z)?;
        finite("bucket.rocker_pivot_x_m", b.rocker_pivot.x)?;
        finite("bucket.rocker_pivot_z_m", b.rocker_pivot.z)?;
        pin(["bucket.base_x_m", "bucket.base_z_m"], b.base - b.rocker_pivot)?;
        let pivot_from_pin = b.rocker_pivot - self.bucket_pin();
        pin(["bucket.rocker_pivot_x_m", "bucket.rocker_pivot_z_m"], pivot_from_pin)?;
        pin(["bucket.coupler_pin_x_m", "bucket.coupler_pin_z_m"], b.coupler_pin)?;
        positive("bucket.rocker_m", b.rocker_m)?;
        positive("bucket.coupler_m", b.coupler_m)?;
        let ends = ["bucket.min_m", "bucket.max_m"];
        stroke(ends, b.stroke)?;
        let sides = Sides { a: (b.base - b.rocker_pivot).norm(), b: b.rocker_m };
        closes(ends, sides, b.stroke)?;

        let linkage = self.four_bar::<f64>();
        let lowest = b.stroke.min_m - STROKE_TOLERANCE_M;
        let step = (b.stroke.max_m + STROKE_TOLERANCE_M - lowest) / f64::from(SAMPLES);
        for i in 0..=SAMPLES {
            let length_m = lowest + f64::from(i) * step;
            let field = if 2 * i <= SAMPLES { ends[0] } else { ends[1] };
            match linkage.assembly(length_m) {
                Ok(assembly) if assembly.forward > 0.0 && assembly.inverse > 0.0 => {}
                Ok(_) => return Err(error(field, Problem::Folds { length_m })),
                Err(_) => return Err(error(field, Problem::DoesNotClose { length_m })),
            }
        }
        Ok(())
    }

    fn validate_swing(&self) -> Result<(), GeometryError> {
        let Some(swing) = self.swing else { return Ok(()) };
        pin(["swing.base_x_m", "swing.base_y_m"], swing.base)?;
        pin(["swing.rod_x_m", "swing.rod_y_m"], swing.rod)?;
        let ends = ["swing.min_m", "swing.max_m"];
        stroke(ends, swing.stroke)?;
        closes(ends, Sides { a: swing.base.norm(), b: swing.rod.norm() }, swing.stroke)
    }

    /// The joint angles of boom, arm and bucket over their strokes, tolerance included.
    pub(crate) fn sectors<T: Real>(&self) -> Result<[Sector<T>; 3], GeometryError> {
        let side = self.boom_cylinder.side();
        let boom = Triangle::<f64>::new(self.boom.base, self.boom.rod, side, 1.0);
        let arm = Triangle::<f64>::new(self.arm_base_from_pin(), self.arm.rod, Side::Clockwise, 1.0);
        let bucket = self.four_bar::<f64>();
        Ok([
            sector(side, ["boom.min_m", "boom.max_m"], self.boom.stroke, |l| boom.rotor(l).ok())?,
            sector(Side::Clockwise, ["arm.min_m", "arm.max_m"], self.arm.stroke, |l| arm.rotor(l).ok())?,
            sector(Side::Clockwise, ["bucket.min_m", "bucket.max_m"], self.bucket.stroke, |l| bucket.rotor(l).ok())?,
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
