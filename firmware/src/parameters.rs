//! Everything the application needs to know of a machine, in one record, validated once.

mod error;

use kinematics_core::PinGeometry;
use kinematics_core::geometry::Stroke;
use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::reach::Target;
use serde::{Deserialize, Serialize};

use crate::apart::apart;
use crate::diagnosis::DiagnosisParameters;
use crate::dig::DigParameters;
use crate::fence::FenceParameters;
use crate::grade::GradeParameters;
use crate::law::LawParameters;
use crate::moves::{MoveParameters, Pitch};
use crate::path::PathParameters;
use crate::service::JogParameters;
use crate::valve::coil_stage::CoilStageParameters;

pub use error::ParameterError;
pub(crate) use error::{ordered, within};

/// A cylinder's position sensor: its stroke lies linearly between two ADC codes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PositionSensor {
    /// The cylinder's stroke between its pins, m.
    pub stroke: Stroke,
    /// Code at the shortest length.
    pub min_code: u16,
    /// Code at the longest length.
    pub max_code: u16,
    /// Codes this far beyond either end still count as that end.
    pub tolerance_codes: u16,
}

/// How the swing is read.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SwingSensor {
    /// An encoder on the swing axis, 65536 codes a turn, counting counter-clockwise.
    Angle {
        /// Code at θ1 = 0.
        zero_code: u16,
    },
    /// The swing cylinder's position sensor.
    Cylinder(PositionSensor),
}

/// One direction of a spool.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValveDirection {
    /// Fraction of the full-scale current below which nothing moves.
    pub dead_band: f32,
    /// Speed at full scale: m/s of a cylinder, rad/s of a swing motor.
    pub full_speed: f32,
}

/// The solenoids, all alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coil {
    /// Full-scale current, A.
    pub full_scale_a: f32,
    /// Winding resistance, Ω.
    pub resistance_ohm: f32,
}

/// A supply's measurement and limits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Supply {
    /// Voltage at code 65535, V.
    pub full_scale_v: f32,
    /// Lowest voltage to work at, V.
    pub min_v: f32,
    /// Highest voltage to work at, V.
    pub max_v: f32,
}

/// The motion stage's tuning.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionParameters {
    /// How far ahead the feed-forward looks: the valve's dead time and lag, s.
    pub preview_s: f32,
    /// Proportional gain on each cylinder's error, 1/s.
    pub gain_per_s: f32,
    /// Speeds below this are zero, m/s.
    pub smallest_speed_mps: f32,
    /// How near each cylinder must be to the dig's start, m.
    pub start_tolerance_m: f32,
    /// How far each cylinder may stray from its reference, m.
    pub following_error_m: f32,
    /// The coordinated law of path, grade and tip velocity; without it there are none of them.
    pub law: Option<LawParameters>,
}

/// The parameter record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// The machine's pins.
    #[serde(deserialize_with = "apart")]
    pub geometry: PinGeometry,
    /// How the swing is read.
    #[serde(deserialize_with = "apart")]
    pub swing_sensor: SwingSensor,
    /// Boom, arm, bucket.
    #[serde(deserialize_with = "apart")]
    pub cylinder_sensors: [PositionSensor; 3],
    /// Valves and their solenoids; of a swing motor \[counter-clockwise, clockwise\].
    #[serde(deserialize_with = "apart")]
    pub coils: CoilStageParameters,
    /// Battery.
    pub supply: Supply,
    /// Supply of the position sensors.
    pub sensor_supply: Supply,
    /// What a healthy machine is like.
    #[serde(deserialize_with = "apart")]
    pub diagnosis: DiagnosisParameters,
    /// Motion.
    #[serde(deserialize_with = "apart")]
    pub motion: MotionParameters,
    /// The service jog.
    pub jog: JogParameters,
    /// The dig, where there is one.
    #[serde(deserialize_with = "apart")]
    pub dig: Option<DigParameters>,
    /// The fence, where there is one.
    #[serde(deserialize_with = "apart")]
    pub fence: Option<FenceParameters>,
    /// The move, where there is one.
    #[serde(deserialize_with = "apart")]
    pub planned_move: Option<MoveParameters>,
    /// The target to reach past obstacles, where there is one.
    #[serde(deserialize_with = "apart")]
    pub reach: Option<ReachParameters>,
    /// The path, where there is one.
    pub path: Option<PathParameters>,
    /// The plane to grade, where there is one.
    pub grade: Option<GradeParameters>,
}

/// A target for the tip and what stands around, in the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReachParameters {
    /// Where the tip shall go.
    pub target: Target<f64>,
    /// How near it must come, m.
    pub tolerance_m: f64,
    /// What to keep away from.
    pub obstacles: [Option<Sphere<f64>>; 2],
    /// Speed limits of swing, boom, arm, bucket, rad/s.
    pub speeds_rad_s: [f64; 4],
}

impl PositionSensor {
    fn validate(&self) -> Result<(), ParameterError> {
        let Stroke { min_m, max_m } = self.stroke;
        within("sensor.stroke.min_m", min_m, [0.001, 50.0])?;
        within("sensor.stroke.max_m", max_m, [0.001, 50.0])?;
        ordered(("sensor.stroke.min_m", min_m), ("sensor.stroke.max_m", max_m))?;
        // A stroke over fewer codes would read coarser than a tenth of a per mille.
        ordered(("sensor.min_code", f64::from(self.min_code) + 9999.0), ("sensor.max_code", f64::from(self.max_code)))?;
        // Some codes must be left to mean a broken wire: the lowest for an open one, the highest for a short.
        within("sensor.min_code", self.min_code, [1.0, f64::from(u16::MAX)])?;
        within("sensor.max_code", self.max_code, [0.0, f64::from(u16::MAX - 1)])?;
        let room = core::cmp::min(self.min_code, u16::MAX - self.max_code);
        within("sensor.tolerance_codes", f64::from(self.tolerance_codes), [0.0, f64::from(room.saturating_sub(1))])
    }
}

impl PositionSensor {
    /// The sensor was calibrated on the cylinder it stands on: another stroke would give a plausible wrong pose.
    fn spans(&self, stroke: Stroke) -> Result<(), ParameterError> {
        within("sensor.stroke.min_m", self.stroke.min_m, [stroke.min_m; 2])?;
        within("sensor.stroke.max_m", self.stroke.max_m, [stroke.max_m; 2])
    }
}

impl Parameters {
    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range. The dig's travel is checked when the application is built.
    pub fn validate(&self) -> Result<(), ParameterError> {
        self.geometry.validate()?;
        if let SwingSensor::Cylinder(sensor) = &self.swing_sensor {
            sensor.validate()?;
        }
        let g = &self.geometry;
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        for (sensor, stroke) in self.cylinder_sensors.iter().zip(strokes) {
            sensor.validate()?;
            sensor.spans(stroke)?;
        }
        if let (SwingSensor::Cylinder(sensor), Some(swing)) = (&self.swing_sensor, &g.swing) {
            sensor.spans(swing.stroke)?;
        }
        self.coils.validate()?;
        let [full_scale, min, max] = ["supply.full_scale_v", "supply.min_v", "supply.max_v"];
        self.supply.validate([(full_scale, [10.0, 100.0]), (min, [6.0, 60.0]), (max, [6.0, 60.0])])?;
        let [full_scale, min, max] = ["sensor_supply.full_scale_v", "sensor_supply.min_v", "sensor_supply.max_v"];
        self.sensor_supply.validate([(full_scale, [3.0, 50.0]), (min, [2.5, 30.0]), (max, [2.5, 30.0])])?;
        self.diagnosis.validate()?;
        self.motion.validate()?;
        self.jog.validate()?;
        self.fence.as_ref().map_or(Ok(()), FenceParameters::validate)?;
        self.dig.as_ref().map_or(Ok(()), DigParameters::validate)?;
        self.planned_move.as_ref().map_or(Ok(()), MoveParameters::validate)?;
        self.reach.as_ref().map_or(Ok(()), ReachParameters::validate)?;
        self.path.as_ref().map_or(Ok(()), PathParameters::validate)?;
        self.grade.as_ref().map_or(Ok(()), GradeParameters::validate)
    }
}

impl Supply {
    /// Each value by its name and range: full scale, lowest, highest.
    fn validate(&self, [full_scale, min, max]: [(&'static str, [f64; 2]); 3]) -> Result<(), ParameterError> {
        within(full_scale.0, self.full_scale_v, full_scale.1)?;
        within(min.0, self.min_v, min.1)?;
        within(max.0, self.max_v, max.1)?;
        ordered((min.0, self.min_v.into()), (max.0, self.max_v.into()))?;
        // What the converter cannot say could never be seen to be too high.
        ordered((max.0, self.max_v.into()), (full_scale.0, self.full_scale_v.into()))
    }
}

impl ReachParameters {
    fn validate(&self) -> Result<(), ParameterError> {
        let far = [-50.0, 50.0];
        within("reach.target.x", self.target.x, far)?;
        within("reach.target.y", self.target.y, far)?;
        within("reach.target.z", self.target.z, far)?;
        within("reach.tolerance_m", self.tolerance_m, [0.001, 1.0])?;
        for obstacle in self.obstacles.iter().flatten() {
            within("reach.obstacle.x", obstacle.x, far)?;
            within("reach.obstacle.y", obstacle.y, far)?;
            within("reach.obstacle.z", obstacle.z, far)?;
            within("reach.obstacle.radius", obstacle.radius, [0.0, 50.0])?;
        }
        for speed in self.speeds_rad_s {
            within("reach.speeds_rad_s", speed, [0.001, 4.0])?;
        }
        Ok(())
    }
}

impl MotionParameters {
    fn validate(&self) -> Result<(), ParameterError> {
        within("motion.preview_s", self.preview_s, [0.0, 1.0])?;
        within("motion.gain_per_s", self.gain_per_s, [0.0, 20.0])?;
        within("motion.smallest_speed_mps", self.smallest_speed_mps, [0.0, 0.1])?;
        within("motion.start_tolerance_m", self.start_tolerance_m, [0.001, 0.5])?;
        // A start farther off than the following error would be a fault in the first tick.
        within("motion.following_error_m", self.following_error_m, [self.start_tolerance_m.into(), 0.5])?;
        self.law.as_ref().map_or(Ok(()), LawParameters::validate)
    }
}

impl DigParameters {
    fn validate(&self) -> Result<(), ParameterError> {
        let far = [-50.0, 50.0];
        within("dig.start_x_m", self.start_x_m, far)?;
        within("dig.start_z_m", self.start_z_m, far)?;
        within("dig.ground_z_m", self.ground_z_m, far)?;
        within("dig.reach_m", self.reach_m, [0.01, 50.0])?;
        within("dig.plunge_m", self.plunge_m, [0.01, 50.0])?;
        within("dig.scoop_radius_m", self.scoop_radius_m, [0.01, 50.0])?;
        within("dig.scoop_end_deg", self.scoop_end_deg, [-360.0, 360.0])?;
        for pitch in self.pitch_deg {
            within("dig.pitch_deg", pitch, [-720.0, 720.0])?;
        }
        let [reached, plunged, end] = self.until_s;
        within("dig.until_s", end, [0.1, 600.0])?;
        ordered(("dig.until_s[0]", reached), ("dig.until_s[1]", plunged))?;
        ordered(("dig.until_s[1]", plunged), ("dig.until_s[2]", end))?;
        within("dig.hold_lead_s", self.hold_lead_s, [0.0, reached])?;
        ordered(("0", 0.0), ("dig.until_s[0]", reached))
    }
}

impl MoveParameters {
    /// Limits and weights are checked where the move is planned.
    fn validate(&self) -> Result<(), ParameterError> {
        for place in self.start_m.into_iter().chain(self.target_m) {
            within("move.start_m, move.target_m", place, [-50.0, 50.0])?;
        }
        within("move.start_pitch_deg", self.start_pitch_deg, [-720.0, 720.0])?;
        within("move.turn_per_knot_deg", self.turn_per_knot_deg, [0.01, 90.0])?;
        if let Pitch::Bounded { lower_deg, upper_deg } = self.pitch {
            within("move.lower_deg", lower_deg, [-720.0, self.start_pitch_deg])?;
            within("move.upper_deg", upper_deg, [self.start_pitch_deg, 720.0])?;
        }
        Ok(())
    }
}
