//! Degrees ↔ rotors at the edge: in f64, rounded to T once.

use kinematics_core::{Real, Rotor};

/// The same angle in (−180, 180], without rounding.
fn half_open(degrees: f64) -> f64 {
    // The remainder is exact, and so is the one subtraction after it.
    let rest = degrees % 360.0;
    let wrapped = if rest > 180.0 {
        rest - 360.0
    } else if rest <= -180.0 {
        rest + 360.0
    } else {
        rest
    };
    // No −0.
    wrapped + 0.0
}

/// The rotor of an angle; exact at quarter turns.
pub(super) fn rotor(degrees: f64) -> Rotor<f64> {
    let degrees = half_open(degrees);
    let quarters = libm::round(degrees / 90.0);
    let (sin, cos) = libm::sincos((degrees - 90.0 * quarters).to_radians());
    match quarters as i32 {
        0 => Rotor { cos, sin },
        1 => Rotor { cos: -sin, sin: cos },
        -1 => Rotor { cos: sin, sin: -cos },
        _ => Rotor { cos: -cos, sin: -sin },
    }
}

/// A rotor rounded to T.
pub(super) fn rounded<T: Real>(rotor: Rotor<f64>) -> Rotor<T> {
    Rotor { cos: T::from_f64(rotor.cos), sin: T::from_f64(rotor.sin) }
}

/// An angle rounded to T, in (−180, 180] after rounding too.
pub(super) fn wrapped<T: Real>(degrees: f64) -> T {
    let degrees = T::from_f64(half_open(degrees));
    if degrees.to_f64() <= -180.0 { T::from_f64(180.0) } else { degrees }
}

/// The angle of a rotor in degrees.
pub(super) fn degrees<T: Real>(rotor: Rotor<T>) -> T {
    wrapped(libm::atan2(rotor.sin.to_f64(), rotor.cos.to_f64()).to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_have_one_name_each() {
        for (given, expected) in [
            (180.0, 180.0),
            (-180.0, 180.0),
            (540.0, 180.0),
            (-540.0, 180.0),
            (190.0, -170.0),
            (-190.0, 170.0),
            (360.0, 0.0),
            (-15.3, -15.3),
        ] {
            assert_eq!(wrapped::<f64>(given).to_bits(), f64::to_bits(expected), "{given}");
        }
        // Just above −180 in f64 is −180 in f32, which is called 180.
        assert_eq!(wrapped::<f32>(-179.999_999_999), 180.0);
        assert_eq!(wrapped::<f64>(-0.0).to_bits(), 0.0f64.to_bits());
    }

    #[test]
    fn rotors_and_degrees_undo_each_other() {
        for tenth in -1799..=1800 {
            let angle = f64::from(tenth) / 10.0;
            assert!((degrees(rotor(angle)) - angle).abs() < 1e-13, "{angle}");
            assert!((degrees(rounded::<f32>(rotor(angle))) - angle as f32).abs() < 2e-5, "{angle}");
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(rotor(90.0), Rotor { cos: 0.0, sin: 1.0 });
        assert_eq!(rotor(-90.0), Rotor { cos: 0.0, sin: -1.0 });
        assert_eq!(rotor(180.0 + 360.0 * 1e9), Rotor { cos: -1.0, sin: 0.0 });
        assert_eq!(degrees(rounded::<f32>(rotor(270.0))), -90.0);
    }
}
