//! First stage: ADC codes → cylinder lengths and swing, each valid or not.

use kinematics_core::swing::SwingCylinder;
use kinematics_core::{Cylinder, Cylinders, Machine, Rotor};

use crate::io::{Inputs, limited};
use crate::parameters::{PositionSensor, Supply, SwingSensor};

/// One cylinder's sensor: the stroke lies linearly between two codes.
#[derive(Clone, Copy, Debug)]
struct Scale {
    first_valid: u16,
    last_valid: u16,
    min_code: f32,
    metres_per_code: f32,
    min_m: f32,
    max_m: f32,
}

impl Scale {
    fn new(sensor: &PositionSensor) -> Self {
        let span = f64::from(sensor.max_code) - f64::from(sensor.min_code);
        Self {
            first_valid: sensor.min_code.saturating_sub(sensor.tolerance_codes),
            last_valid: sensor.max_code.saturating_add(sensor.tolerance_codes),
            min_code: f32::from(sensor.min_code),
            metres_per_code: ((sensor.stroke.max_m - sensor.stroke.min_m) / span) as f32,
            min_m: sensor.stroke.min_m as f32,
            max_m: sensor.stroke.max_m as f32,
        }
    }

    /// Length (m); `None` outside the valid codes. Valid codes beyond an end of the stroke (noise at the stop) mean that end.
    #[inline]
    fn length(&self, code: u16) -> Option<f32> {
        if code < self.first_valid || code > self.last_valid {
            return None;
        }
        let length = self.min_m + (f32::from(code) - self.min_code) * self.metres_per_code;
        Some(limited(length, self.min_m, self.max_m))
    }
}

/// A sensor's steps, and where its actuator may be held by a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorView {
    /// A code's worth of travel, m or rad.
    pub unit: f32,
    /// Beyond these codes it is near an end of its stroke: within a thirty-second of it.
    pub stops: [u16; 2],
}

impl Scale {
    fn view(&self) -> SensorView {
        // The casts saturate.
        let (min, span) = (self.min_code as u16, ((self.max_m - self.min_m) / self.metres_per_code) as u16);
        let near = span / 32;
        SensorView {
            unit: self.metres_per_code,
            stops: [min.saturating_add(near), min.saturating_add(span).saturating_sub(near)],
        }
    }
}

/// How the swing is read.
#[derive(Clone, Copy, Debug)]
enum SwingScale {
    Angle { zero_code: u16 },
    Cylinder { scale: Scale, cylinder: SwingCylinder<f32> },
}

/// What the sensors say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Swing θ1.
    pub swing: Rotor<f32>,
    /// Cylinder lengths, m.
    pub lengths: Cylinders<f32>,
}

/// The sensing stage.
#[derive(Clone, Copy, Debug)]
pub struct Sensing {
    swing: SwingScale,
    cylinders: [Scale; 3],
    volts_per_code: f32,
    sensor_volts_per_code: f32,
}

impl Sensing {
    #[inline(never)]
    pub(crate) fn new(
        swing: &SwingSensor,
        cylinders: &[PositionSensor; 3],
        [supply, sensor_supply]: [&Supply; 2],
        machine: &Machine<f32>,
    ) -> Option<Self> {
        let swing = match swing {
            SwingSensor::Angle { zero_code } => SwingScale::Angle { zero_code: *zero_code },
            SwingSensor::Cylinder(sensor) => {
                SwingScale::Cylinder { scale: Scale::new(sensor), cylinder: *machine.swing_cylinder()? }
            }
        };
        let [boom, arm, bucket] = cylinders;
        Some(Self {
            swing,
            cylinders: [Scale::new(boom), Scale::new(arm), Scale::new(bucket)],
            volts_per_code: supply.full_scale_v / 65535.0,
            sensor_volts_per_code: sensor_supply.full_scale_v / 65535.0,
        })
    }

    /// Each sensor as the diagnosis sees it: swing, boom, arm, bucket.
    pub fn views(&self) -> [SensorView; 4] {
        let swing = match &self.swing {
            SwingScale::Angle { .. } => SensorView { unit: core::f32::consts::TAU / 65536.0, stops: [0, u16::MAX] },
            SwingScale::Cylinder { scale, .. } => scale.view(),
        };
        let [boom, arm, bucket] = self.cylinders.each_ref().map(Scale::view);
        [swing, boom, arm, bucket]
    }

    /// Supply voltage, V: valid whatever the other sensors say.
    #[inline]
    pub fn supply_v(&self, inputs: &Inputs) -> f32 {
        f32::from(inputs.supply_code) * self.volts_per_code
    }

    /// Voltage of the position sensors' supply, V.
    #[inline]
    pub fn sensor_supply_v(&self, inputs: &Inputs) -> f32 {
        f32::from(inputs.sensor_supply_code) * self.sensor_volts_per_code
    }

    /// All sensors, or the first whose code is outside its range: no sensor's good value makes up for another's.
    ///
    /// # Errors
    /// The sensor at fault.
    #[inline]
    pub fn read(&self, inputs: &Inputs) -> Result<Sensed, Cylinder> {
        let [swing_code, boom_code, arm_code, bucket_code] = inputs.codes;
        let [boom, arm, bucket] = &self.cylinders;
        let lengths = Cylinders {
            boom: boom.length(boom_code).ok_or(Cylinder::Boom)?,
            arm: arm.length(arm_code).ok_or(Cylinder::Arm)?,
            bucket: bucket.length(bucket_code).ok_or(Cylinder::Bucket)?,
        };
        let swing = match &self.swing {
            // 65536 codes are one turn; the difference wraps as the angle does.
            SwingScale::Angle { zero_code } => {
                let codes = swing_code.wrapping_sub(*zero_code) as i16;
                Rotor::from_turns(f32::from(codes) * (1.0 / 65536.0))
            }
            SwingScale::Cylinder { scale, cylinder } => {
                let length = scale.length(swing_code).ok_or(Cylinder::Swing)?;
                cylinder.rotor(length).map_err(|_| Cylinder::Swing)?
            }
        };
        Ok(Sensed { swing, lengths })
    }
}
