//! Between the swing actuator's position and the swing: a motor's angle, or a backhoe's swing cylinder.

use firmware::parameters::SwingSensor;
use kinematics_core::swing::SwingCylinder;
use kinematics_core::{Machine, PoseError, Rotor};

use super::sensors::code;

/// How the swing is driven.
#[derive(Clone, Copy, Debug)]
pub enum SwingDrive {
    /// A motor: the position is θ1, rad.
    Motor,
    /// A cylinder: the position is its length, m.
    Cylinder(SwingCylinder<f64>),
}

impl SwingDrive {
    /// The machine's.
    pub fn of(machine: &Machine<f64>) -> Self {
        machine.swing_cylinder().map_or(Self::Motor, |&cylinder| Self::Cylinder(cylinder))
    }

    /// The position at θ1 = `swing_rad`.
    ///
    /// # Errors
    /// The cylinder's stroke or triangle does not allow it.
    pub fn position(&self, swing_rad: f64) -> Result<f64, PoseError<f64>> {
        match self {
            Self::Motor => Ok(swing_rad),
            Self::Cylinder(cylinder) => cylinder.length(Rotor::from_angle(swing_rad)),
        }
    }

    /// θ1 at a position; `None` where the cylinder's triangle does not close.
    pub fn rotor(&self, position: f64) -> Option<Rotor<f64>> {
        match self {
            Self::Motor => Some(Rotor::from_angle(position)),
            Self::Cylinder(cylinder) => cylinder.rotor(position).ok(),
        }
    }

    /// The sensor's code; an angle encoder has no noise but its steps.
    pub fn code(&self, sensor: &SwingSensor, position: f64, error_m: f64) -> u16 {
        match sensor {
            SwingSensor::Angle { zero_code } => {
                let codes = libm::round(position * (65536.0 / core::f64::consts::TAU)) as i64;
                // One turn is 65536 codes: the low bits are the angle.
                zero_code.wrapping_add(codes as u16)
            }
            SwingSensor::Cylinder(sensor) => code(sensor, position, error_m),
        }
    }
}
