//! Everything the application needs to know of a machine, in one record, validated once.

mod error;

use kinematics_core::PinGeometry;
use kinematics_core::geometry::Stroke;
use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::reach::Target;
use serde::{Deserialize, Serialize};

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
pub(crate) use error::{Checks, ordered, within};

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
    pub geometry: PinGeometry,
    /// How the swing is read.
    pub swing_sensor: SwingSensor,
    /// Boom, arm, bucket.
    pub cylinder_sensors: [PositionSensor; 3],
    /// Valves and their solenoids; of a swing motor \[counter-clockwise, clockwise\].
    pub coils: CoilStageParameters,
    /// Battery.
    pub supply: Supply,
    /// Supply of the position sensors.
    pub sensor_supply: Supply,
    /// What a healthy machine is like.
    pub diagnosis: DiagnosisParameters,
    /// Motion.
    pub motion: MotionParameters,
    /// The service jog.
    pub jog: JogParameters,
    /// The dig, where there is one.
    pub dig: Option<DigParameters>,
    /// The fence, where there is one.
    pub fence: Option<FenceParameters>,
    /// The move, where there is one.
    pub planned_move: Option<MoveParameters>,
    /// The target to reach past obstacles, where there is one.
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
    #[inline(never)]
    fn check(&self, checks: &mut Checks) {
        let Stroke { min_m, max_m } = self.stroke;
        checks.within("sensor.stroke.min_m", min_m, &[0.001, 50.0]);
        checks.within("sensor.stroke.max_m", max_m, &[0.001, 50.0]);
        checks.ordered(&["sensor.stroke.min_m", "sensor.stroke.max_m"], [min_m, max_m]);
        // A stroke over fewer codes would read coarser than a tenth of a per mille.
        checks.ordered(
            &["sensor.min_code", "sensor.max_code"],
            [f64::from(self.min_code) + 9999.0, f64::from(self.max_code)],
        );
        // Some codes must be left to mean a broken wire: the lowest for an open one, the highest for a short.
        checks.within("sensor.min_code", self.min_code, &[1.0, f64::from(u16::MAX)]);
        checks.within("sensor.max_code", self.max_code, &[0.0, f64::from(u16::MAX - 1)]);
        let room = core::cmp::min(self.min_code, u16::MAX - self.max_code);
        checks.within("sensor.tolerance_codes", self.tolerance_codes, &[0.0, f64::from(room.saturating_sub(1))]);
    }
}

impl PositionSensor {
    /// The sensor was calibrated on the cylinder it stands on: another stroke would give a plausible wrong pose.
    fn spans(&self, checks: &mut Checks, stroke: &Stroke) {
        checks.within("sensor.stroke.min_m", self.stroke.min_m, &[stroke.min_m; 2]);
        checks.within("sensor.stroke.max_m", self.stroke.max_m, &[stroke.max_m; 2]);
    }
}

impl Parameters {
    /// Checks every value.
    ///
    /// # Errors
    /// The first at fault, by name and range. The dig's travel is checked when the application is built.
    pub fn validate(&self) -> Result<(), ParameterError> {
        let mut checks = Checks::new();
        checks.and(self.geometry.validate().map_err(ParameterError::Geometry));
        self.check(&mut checks);
        checks.done()
    }

    #[inline(never)]
    fn check(&self, checks: &mut Checks) {
        if let SwingSensor::Cylinder(sensor) = &self.swing_sensor {
            sensor.check(checks);
        }
        let g = &self.geometry;
        let strokes = [&g.boom.stroke, &g.arm.stroke, &g.bucket.stroke];
        for (sensor, stroke) in self.cylinder_sensors.iter().zip(strokes) {
            sensor.check(checks);
            sensor.spans(checks, stroke);
        }
        if let (SwingSensor::Cylinder(sensor), Some(swing)) = (&self.swing_sensor, &g.swing) {
            sensor.spans(checks, &swing.stroke);
        }
        self.coils.check(checks);
        self.supply.check(checks, &SUPPLY);
        self.sensor_supply.check(checks, &SENSOR_SUPPLY);
        self.diagnosis.check(checks);
        self.motion.check(checks);
        self.jog.check(checks);
        if let Some(fence) = &self.fence {
            fence.check(checks);
        }
        if let Some(dig) = &self.dig {
            dig.check(checks);
        }
        if let Some(planned_move) = &self.planned_move {
            planned_move.check(checks);
        }
        if let Some(reach) = &self.reach {
            reach.check(checks);
        }
        if let Some(path) = &self.path {
            path.check(checks);
        }
        if let Some(grade) = &self.grade {
            grade.check(checks);
        }
    }
}

/// A supply's values by name and range: full scale, lowest, highest.
type Ranges = [(&'static str, [f64; 2]); 3];

const SUPPLY: Ranges =
    [("supply.full_scale_v", [10.0, 100.0]), ("supply.min_v", [6.0, 60.0]), ("supply.max_v", [6.0, 60.0])];
const SENSOR_SUPPLY: Ranges = [
    ("sensor_supply.full_scale_v", [3.0, 50.0]),
    ("sensor_supply.min_v", [2.5, 30.0]),
    ("sensor_supply.max_v", [2.5, 30.0]),
];

impl Supply {
    #[inline(never)]
    fn check(&self, checks: &mut Checks, [full_scale, min, max]: &Ranges) {
        checks.within(full_scale.0, self.full_scale_v, &full_scale.1);
        checks.within(min.0, self.min_v, &min.1);
        checks.within(max.0, self.max_v, &max.1);
        checks.ordered(&[min.0, max.0], [self.min_v.into(), self.max_v.into()]);
        // What the converter cannot say could never be seen to be too high.
        checks.ordered(&[max.0, full_scale.0], [self.max_v.into(), self.full_scale_v.into()]);
    }
}

impl ReachParameters {
    #[inline(never)]
    fn check(&self, checks: &mut Checks) {
        let far = [-50.0, 50.0];
        checks.within("reach.target.x", self.target.x, &far);
        checks.within("reach.target.y", self.target.y, &far);
        checks.within("reach.target.z", self.target.z, &far);
        checks.within("reach.tolerance_m", self.tolerance_m, &[0.001, 1.0]);
        for obstacle in self.obstacles.iter().flatten() {
            checks.within("reach.obstacle.x", obstacle.x, &far);
            checks.within("reach.obstacle.y", obstacle.y, &far);
            checks.within("reach.obstacle.z", obstacle.z, &far);
            checks.within("reach.obstacle.radius", obstacle.radius, &[0.0, 50.0]);
        }
        for speed in &self.speeds_rad_s {
            checks.within("reach.speeds_rad_s", *speed, &[0.001, 4.0]);
        }
    }
}

impl MotionParameters {
    #[inline(never)]
    fn check(&self, checks: &mut Checks) {
        checks.within("motion.preview_s", self.preview_s, &[0.0, 1.0]);
        checks.within("motion.gain_per_s", self.gain_per_s, &[0.0, 20.0]);
        checks.within("motion.smallest_speed_mps", self.smallest_speed_mps, &[0.0, 0.1]);
        checks.within("motion.start_tolerance_m", self.start_tolerance_m, &[0.001, 0.5]);
        // A start farther off than the following error would be a fault in the first tick.
        checks.within("motion.following_error_m", self.following_error_m, &[self.start_tolerance_m.into(), 0.5]);
        if let Some(law) = &self.law {
            law.check(checks);
        }
    }
}

impl DigParameters {
    #[inline(never)]
    fn check(&self, checks: &mut Checks) {
        let far = [-50.0, 50.0];
        checks.within("dig.start_x_m", self.start_x_m, &far);
        checks.within("dig.start_z_m", self.start_z_m, &far);
        checks.within("dig.ground_z_m", self.ground_z_m, &far);
        checks.within("dig.reach_m", self.reach_m, &[0.01, 50.0]);
        checks.within("dig.plunge_m", self.plunge_m, &[0.01, 50.0]);
        checks.within("dig.scoop_radius_m", self.scoop_radius_m, &[0.01, 50.0]);
        checks.within("dig.scoop_end_deg", self.scoop_end_deg, &[-360.0, 360.0]);
        for pitch in &self.pitch_deg {
            checks.within("dig.pitch_deg", *pitch, &[-720.0, 720.0]);
        }
        let [reached, plunged, end] = self.until_s;
        checks.within("dig.until_s", end, &[0.1, 600.0]);
        checks.ordered(&["dig.until_s[0]", "dig.until_s[1]"], [reached, plunged]);
        checks.ordered(&["dig.until_s[1]", "dig.until_s[2]"], [plunged, end]);
        checks.within("dig.hold_lead_s", self.hold_lead_s, &[0.0, reached]);
        checks.ordered(&["0", "dig.until_s[0]"], [0.0, reached]);
    }
}

impl MoveParameters {
    /// Limits and weights are checked where the move is planned.
    #[inline(never)]
    fn check(&self, checks: &mut Checks) {
        for place in self.start_m.iter().chain(&self.target_m) {
            checks.within("move.start_m, move.target_m", *place, &[-50.0, 50.0]);
        }
        checks.within("move.start_pitch_deg", self.start_pitch_deg, &[-720.0, 720.0]);
        checks.within("move.turn_per_knot_deg", self.turn_per_knot_deg, &[0.01, 90.0]);
        if let Pitch::Bounded { lower_deg, upper_deg } = self.pitch {
            checks.within("move.lower_deg", lower_deg, &[-720.0, self.start_pitch_deg]);
            checks.within("move.upper_deg", upper_deg, &[self.start_pitch_deg, 720.0]);
        }
    }
}
