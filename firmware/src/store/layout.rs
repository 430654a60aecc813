//! The record's structures and the order of their fields. It is the format: another order is another [`FORMAT_VERSION`].
//!
//! [`FORMAT_VERSION`]: super::copy::FORMAT_VERSION

use kinematics_core::geometry::{BoomCylinder, BucketPins, CylinderPins, Stroke, SwingPins};
use kinematics_core::planning::hull::Sphere;
use kinematics_core::planning::outline::OutlineShape;
use kinematics_core::planning::reach::Target;
use kinematics_core::{PinGeometry, Vec2};

use super::fields::{Field, Sink, Source, either, fields};
use super::record::{Bucket, StoredRecord};
use crate::diagnosis::{ActuatorLimits, DiagnosisParameters};
use crate::dig::DigParameters;
use crate::fence::{BallParameters, FenceParameters, Guards, PlaneParameters, SwingRangeParameters};
use crate::grade::GradeParameters;
use crate::law::LawParameters;
use crate::moves::{MoveParameters, Pitch};
use crate::parameters::{MotionParameters, Parameters, PositionSensor, ReachParameters, Supply, SwingSensor};
use crate::path::{Knot, PathParameters};
use crate::service::JogParameters;
use crate::valve::coil_fault::WatchParameters;
use crate::valve::coil_stage::{CoilStageParameters, CurrentSense, SpoolParameters};
use crate::valve::current_loop::LoopParameters;
use crate::valve::dither::DitherParameters;
use crate::valve::flow_map::FlowParameters;
use crate::valve::ramp::RampParameters;

fields!(StoredRecord: machine, parameters, buckets, mounted);
fields!(Bucket: name, bucket_m, coupler_pin, coupler_m);
fields!(Parameters:
    geometry, swing_sensor, cylinder_sensors, coils, supply, sensor_supply, diagnosis, motion, jog, dig, fence,
    planned_move, reach, path, grade
);
fields!(PinGeometry: boom_pin_x_m, boom_m, arm_m, bucket_m, boom_cylinder, boom, arm, bucket, swing);
fields!(CylinderPins: base, rod, stroke);
fields!(BucketPins: base, rocker_pivot, coupler_pin, rocker_m, coupler_m, stroke);
fields!(SwingPins: base, rod, stroke);
fields!(Stroke: min_m, max_m);
fields!(Vec2<f64>: x, z);
fields!(PositionSensor: stroke, min_code, max_code, tolerance_codes);
fields!(CoilStageParameters: spools, coil, watch, sense, released_a);
fields!(SpoolParameters: flow, ramp, dither);
fields!(FlowParameters: min_current_a, max_current_a, full_speed, on_above, off_at, flow_table);
fields!(RampParameters: up_a_per_s, down_a_per_s);
fields!(DitherParameters: frequency_hz, amplitude_a, fade_below_a);
fields!(LoopParameters:
    resistance_ohm, inductance_h, response_s, proportional_v_per_a, integral_v_per_a_s, freewheel_v, max_duty
);
fields!(WatchParameters: winding_c, slowest_s, floor_a, over_current_a, open_ticks, short_ticks, saturated_ticks);
fields!(CurrentSense: full_scale_a, zero_code);
fields!(Supply: full_scale_v, min_v, max_v);
fields!(DiagnosisParameters:
    actuators, latest_start_s, spool_lag_s, run_on_s, overshoot, ring, coupling, rebound, supplied_pa, stalled_pa
);
fields!(ActuatorLimits: full_speed, noise, jump, speed_margin, stuck_travel);
fields!(MotionParameters: preview_s, gain_per_s, smallest_speed_mps, start_tolerance_m, following_error_m, law);
fields!(LawParameters:
    feed_forward, integral_per_s2, bias_limit_mps, correction_limit_mps, rest_zone_m, reserve, acceleration,
    cushion_mps2, tip_acceleration_mps2, pitch_acceleration_radps2, swing_following_error_rad, areas_m2,
    flow_m3ps, feedback_lag_s, lag_m, overrun_n, swing_overrun_radps2
);
fields!(JogParameters: max_current_a);
fields!(DigParameters:
    start_x_m, start_z_m, ground_z_m, reach_m, plunge_m, scoop_radius_m, scoop_end_deg, pitch_deg, until_s,
    hold_lead_s
);
fields!(FenceParameters:
    planes, balls, swing, boom_pin_height_m, outline, guards, margin_m, deceleration_mps2, reaction_s,
    swing_margin_rad, swing_deceleration_rad_s2, dead_time_s, lag_s
);
fields!(PlaneParameters: normal, offset_m);
fields!(BallParameters: centre_m, radius_m);
fields!(SwingRangeParameters: right_deg, left_deg);
fields!(OutlineShape:
    boom_knee, bucket_back, boom_radius_m, boom_half_width_m, arm_radius_m, arm_half_width_m, cylinder_radius_m,
    boom_cylinder_half_width_m, link_radius_m, link_half_width_m, bucket_radius_m, bucket_half_width_m
);
fields!(MoveParameters:
    start_m, start_pitch_deg, target_m, pitch, turn_per_knot_deg, weights, speed_mps, acceleration_mps2,
    jerk_mps3, areas_m2, flow_m3ps
);
fields!(ReachParameters: target, tolerance_m, obstacles, speeds_rad_s);
fields!(Target<f64>: x, y, z);
fields!(Sphere<f64>: x, y, z, radius);
fields!(PathParameters:
    knots, speed_mps, acceleration_mps2, pitch_speed_deg_s, pitch_acceleration_deg_s2, swing_speed_deg_s,
    swing_acceleration_deg_s2
);
fields!(Knot: x_m, z_m, pitch_deg, swing_deg);
fields!(GradeParameters: point_x_m, point_z_m, slope_deg, speed_mps, tolerance_m);

either!(BoomCylinder: Below, Above);
either!(Guards: Linkage, Tip);

impl Field for SwingSensor {
    #[inline(never)]
    fn read(from: &mut Source) -> Self {
        if from.variant(2) == 0 {
            Self::Angle { zero_code: Field::read(from) }
        } else {
            Self::Cylinder(Field::read(from))
        }
    }

    #[inline(never)]
    fn write(&self, to: &mut Sink) {
        match self {
            Self::Angle { zero_code } => {
                to.variant(0);
                zero_code.write(to);
            }
            Self::Cylinder(sensor) => {
                to.variant(1);
                sensor.write(to);
            }
        }
    }
}

impl Field for Pitch {
    #[inline(never)]
    fn read(from: &mut Source) -> Self {
        match from.variant(3) {
            0 => Self::Free,
            1 => Self::Fixed,
            _ => Self::Bounded { lower_deg: Field::read(from), upper_deg: Field::read(from) },
        }
    }

    #[inline(never)]
    fn write(&self, to: &mut Sink) {
        match self {
            Self::Free => to.variant(0),
            Self::Fixed => to.variant(1),
            Self::Bounded { lower_deg, upper_deg } => {
                to.variant(2);
                lower_deg.write(to);
                upper_deg.write(to);
            }
        }
    }
}
