//! What the service stage knows of the machine: currents, positions and the room to move in.

use serde::{Deserialize, Serialize};

use crate::calibration::valve_search::ValveSearchParameters;
use crate::io::{Solenoids, limited};
use crate::parameters::{ParameterError, Parameters, PositionSensor, SwingSensor, within};
use crate::valve::flow_map::FlowParameters;

/// Without a limit of its own a jog gets the dead band and this share of full-scale current.
const BEYOND_DEAD_BAND: f32 = 0.2;

/// The jog's parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JogParameters {
    /// Largest current, A; `None`: of each direction its dead band and a fifth of its full-scale current.
    pub max_current_a: Option<f32>,
}

impl JogParameters {
    /// Each direction's own limit.
    pub const DEFAULT: Self = Self { max_current_a: None };

    pub(crate) fn validate(&self) -> Result<(), ParameterError> {
        self.max_current_a.map_or(Ok(()), |max_a| within("jog.max_current_a", max_a, [0.05, 3.0]))
    }
}

/// Share of full-scale current below which a healthy coil cannot be told from an open one: most of its voltage is the freewheel's drop.
const LEAST: f32 = 0.05;
/// The stroke's ends stay this far away while a valve is searched, m.
const MARGIN_M: f32 = 0.02;
/// A swing motor turns this far to either side while its valve is searched, rad.
const SWING_ROOM_RAD: f32 = 3.0;
/// Codes nearer to the converter's ends than this are a broken wire.
const SOUND_CODES: [u16; 2] = [655, 64880];

/// Where an actuator stands, linear in its code.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Code of `at`.
    code: u16,
    /// m or rad.
    at: f32,
    per_code: f32,
    room: [f32; 2],
    /// Valid codes of a cylinder's sensor; `None` of an angle.
    valid: Option<[u16; 2]>,
}

impl Place {
    fn of_cylinder(sensor: &PositionSensor) -> Self {
        let (min_m, max_m) = (sensor.stroke.min_m as f32, sensor.stroke.max_m as f32);
        let span = f32::from(sensor.max_code.saturating_sub(sensor.min_code));
        Self {
            code: sensor.min_code,
            at: min_m,
            // Validated sensors span ten thousand codes at least.
            per_code: if span > 0.0 { (max_m - min_m) / span } else { 0.0 },
            room: [min_m + MARGIN_M, max_m - MARGIN_M],
            valid: Some([sensor.min_code, sensor.max_code]),
        }
    }

    fn of_angle(zero_code: u16) -> Self {
        let per_code = core::f32::consts::TAU / 65536.0;
        Self { code: zero_code, at: 0.0, per_code, room: [-SWING_ROOM_RAD, SWING_ROOM_RAD], valid: None }
    }

    fn position(&self, code: u16) -> f32 {
        let codes = match self.valid {
            Some(_) => f32::from(code) - f32::from(self.code),
            None => f32::from(code.wrapping_sub(self.code) as i16),
        };
        self.at + codes * self.per_code
    }
}

/// Of one spool.
#[derive(Clone, Copy, Debug)]
pub struct SpoolLimits {
    place: Place,
    full_scale_a: Solenoids<f32>,
    jog_a: Solenoids<f32>,
}

impl SpoolLimits {
    fn new(flow: &Solenoids<FlowParameters>, jog: &JogParameters, place: Place) -> Self {
        let full_scale_a = flow.map(|flow| flow.max_current_a);
        let jog_a = flow.map(|flow| {
            let own = flow.min_current_a + BEYOND_DEAD_BAND * flow.max_current_a;
            limited(jog.max_current_a.unwrap_or(own), 0.0, flow.max_current_a)
        });
        Self { place, full_scale_a, jog_a }
    }

    /// Swing, boom, arm, bucket, of valid parameters.
    pub(crate) fn all(p: &Parameters) -> [Self; 4] {
        let swing = match &p.swing_sensor {
            SwingSensor::Angle { zero_code } => Place::of_angle(*zero_code),
            SwingSensor::Cylinder(sensor) => Place::of_cylinder(sensor),
        };
        let [boom, arm, bucket] = p.cylinder_sensors.each_ref().map(Place::of_cylinder);
        let [on_swing, on_boom, on_arm, on_bucket] = &p.coils.spools;
        [(on_swing, swing), (on_boom, boom), (on_arm, arm), (on_bucket, bucket)]
            .map(|(spool, place)| Self::new(&spool.flow, &p.jog, place))
    }

    /// How to search this spool's valve.
    pub(crate) fn search(&self) -> ValveSearchParameters {
        let [low, high] = self.place.room;
        ValveSearchParameters { start: LEAST, ..ValveSearchParameters::for_cylinder(low, high) }
    }

    /// It drives a cylinder, whose stroke has ends.
    pub(crate) const fn has_ends(&self) -> bool {
        self.place.valid.is_some()
    }

    /// m or rad.
    pub(crate) fn position(&self, code: u16) -> f32 {
        self.place.position(code)
    }

    /// While the ends are looked for, the code that the rest of the controller is to work with: beyond a known end it is that end,
    /// unless it is a broken wire's.
    pub(crate) fn within_ends(&self, code: u16) -> u16 {
        let [lowest, highest] = SOUND_CODES;
        match self.place.valid {
            Some([min, _]) if code >= lowest && code < min => min,
            Some([_, max]) if code <= highest && code > max => max,
            _ => code,
        }
    }

    /// A signed share of full-scale current as a signed current, A.
    pub(crate) fn amperes(&self, share: f32) -> f32 {
        let [extend, retract] = self.full_scale_a;
        share * if share < 0.0 { retract } else { extend }
    }

    /// A jog's current within its limit, A.
    pub(crate) fn jog(&self, current_a: f32) -> f32 {
        let [extend, retract] = self.jog_a;
        let current_a = limited(current_a, -retract, extend);
        let [least_extend, least_retract] = self.full_scale_a.map(|full_scale_a| LEAST * full_scale_a);
        if current_a < least_extend && current_a > -least_retract { 0.0 } else { current_a }
    }
}
