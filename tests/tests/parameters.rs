//! The parameter record: every value out of its range is refused by name, and the record survives its own bytes.

use cross_tests::rig::scenario;
use firmware::dig::DigParameters;
use firmware::grade::GradeParameters;
use firmware::law::LawParameters;
use firmware::moves::{MoveParameters, Pitch};
use firmware::parameters::ReachParameters;
use firmware::path::PathParameters;
use firmware::store::copy::HEADER_BYTES;
use firmware::store::{Bucket, MAX_BUCKETS, Name, Sealed, StoredRecord, parameters_from};
use firmware::{Ecu, Parameters};

type Spoil = fn(&mut Parameters);
type SetTo = fn(&mut Parameters, f32);

fn dig(p: &mut Parameters) -> &mut DigParameters {
    p.dig.as_mut().expect("a dig")
}

const SPOILT: [(&str, Spoil); 39] = [
    ("jog.max_current_a", |p| p.jog.max_current_a = Some(9.0)),
    ("links.boom_m", |p| p.geometry.boom_m = -1.0),
    ("boom.base_x_m", |p| p.geometry.boom.base.x = f64::NAN),
    ("sensor.min_code", |p| p.cylinder_sensors[0].min_code = 60_000),
    ("sensor.min_code", |p| (p.cylinder_sensors[0].min_code, p.cylinder_sensors[0].tolerance_codes) = (0, 0)),
    ("sensor.max_code", |p| (p.cylinder_sensors[0].max_code, p.cylinder_sensors[0].tolerance_codes) = (u16::MAX, 0)),
    ("sensor.stroke.min_m", |p| p.cylinder_sensors[0].stroke.min_m = 3.0),
    ("sensor.stroke.min_m", |p| p.cylinder_sensors[1].stroke.min_m = f64::NAN),
    ("sensor.stroke.max_m", |p| p.cylinder_sensors[1].stroke.max_m = f64::NAN),
    ("sensor.stroke.max_m", |p| p.cylinder_sensors[2].stroke.max_m = -1.0),
    ("sensor.tolerance_codes", |p| p.cylinder_sensors[1].tolerance_codes = 60_000),
    ("sensor.max_code", |p| p.cylinder_sensors[2].max_code = 0),
    ("valve.min_current_a", |p| p.coils.spools[0].flow[0].min_current_a = 1.19),
    ("valve.min_current_a", |p| p.coils.spools[2].flow[1].min_current_a = f32::NAN),
    ("valve.full_speed", |p| p.coils.spools[1].flow[0].full_speed = 0.0),
    ("valve.max_current_a", |p| p.coils.spools[3].flow[1].max_current_a = 0.0),
    ("coil.resistance_ohm", |p| p.coils.coil.resistance_ohm = -1.0),
    ("sensor_supply.full_scale_v", |p| p.sensor_supply.full_scale_v = 2.0),
    ("sensor_supply.min_v", |p| p.sensor_supply.min_v = f32::NAN),
    ("sensor_supply.max_v", |p| p.sensor_supply.max_v = 10.3),
    ("supply.full_scale_v", |p| p.supply.full_scale_v = f32::INFINITY),
    ("supply.min_v", |p| p.supply.min_v = 0.0),
    ("supply.max_v", |p| p.supply.max_v = 100.0),
    ("supply.min_v", |p| p.supply.min_v = 33.0),
    ("motion.preview_s", |p| p.motion.preview_s = -0.1),
    ("motion.gain_per_s", |p| p.motion.gain_per_s = 21.0),
    ("motion.smallest_speed_mps", |p| p.motion.smallest_speed_mps = f32::NAN),
    ("motion.start_tolerance_m", |p| p.motion.start_tolerance_m = 0.0),
    ("motion.following_error_m", |p| p.motion.following_error_m = 1.0),
    ("dig.start_x_m", |p| dig(p).start_x_m = f64::NAN),
    ("dig.start_z_m", |p| dig(p).start_z_m = 1e9),
    ("dig.ground_z_m", |p| dig(p).ground_z_m = f64::INFINITY),
    ("dig.reach_m", |p| dig(p).reach_m = 0.0),
    ("dig.plunge_m", |p| dig(p).plunge_m = -1.0),
    ("dig.scoop_radius_m", |p| dig(p).scoop_radius_m = 0.0),
    ("dig.scoop_end_deg", |p| dig(p).scoop_end_deg = 500.0),
    ("dig.pitch_deg", |p| dig(p).pitch_deg[2] = f64::NAN),
    ("dig.until_s", |p| dig(p).until_s = [4.0, 3.0, 20.0]),
    ("dig.hold_lead_s", |p| dig(p).hold_lead_s = 5.0),
];

#[test]
fn every_value_out_of_its_range_is_refused_by_name() {
    for (field, spoil) in SPOILT {
        let mut parameters = scenario("dig").parameters;
        spoil(&mut parameters);
        match Ecu::new(&parameters) {
            Ok(_) => panic!("{field} was accepted"),
            Err(error) => assert!(error.to_string().contains(&format!("`{field}")), "{field}: {error}"),
        }
    }
}

fn reach(p: &mut Parameters) -> &mut ReachParameters {
    p.reach.as_mut().expect("a target")
}

fn planned(p: &mut Parameters) -> &mut MoveParameters {
    p.planned_move.as_mut().expect("a move")
}

const SPOILT_REACH: [(&str, Spoil); 7] = [
    ("reach.target.x", |p| reach(p).target.x = f64::NAN),
    ("reach.target.y", |p| reach(p).target.y = 60.0),
    ("reach.target.z", |p| reach(p).target.z = f64::INFINITY),
    ("reach.tolerance_m", |p| reach(p).tolerance_m = 0.0),
    ("reach.obstacle.x", |p| reach(p).obstacles[0].as_mut().expect("an obstacle").x = f64::NAN),
    ("reach.obstacle.radius", |p| reach(p).obstacles[0].as_mut().expect("an obstacle").radius = -1.0),
    ("reach.speeds_rad_s", |p| reach(p).speeds_rad_s[3] = f64::NAN),
];

const SPOILT_MOVE: [(&str, Spoil); 10] = [
    ("move.start_m", |p| planned(p).start_m[1] = f64::NAN),
    ("move.start_pitch_deg", |p| planned(p).start_pitch_deg = 1e9),
    ("move.turn_per_knot_deg", |p| planned(p).turn_per_knot_deg = 0.0),
    ("move.lower_deg", |p| planned(p).pitch = Pitch::Bounded { lower_deg: 0.0, upper_deg: 10.0 }),
    ("move.upper_deg", |p| planned(p).pitch = Pitch::Bounded { lower_deg: -180.0, upper_deg: f64::NAN }),
    ("move`: `weights", |p| planned(p).weights = [0.0; 3]),
    ("move`: `speed_mps", |p| planned(p).speed_mps[2][1] = f64::NAN),
    ("move`: `acceleration_mps2", |p| planned(p).acceleration_mps2[0] = 0.0),
    ("move`: `jerk_mps3", |p| planned(p).jerk_mps3[1] = -1.0),
    ("move`: `areas_m2", |p| planned(p).areas_m2[0][0] = f64::NAN),
];

#[test]
fn what_is_wrong_with_a_target_or_a_move_is_refused_by_name() {
    let cases = SPOILT_REACH.map(|case| ("obstacle-over", case));
    for (name, (field, spoil)) in cases.into_iter().chain(SPOILT_MOVE.map(|case| ("move-least-effort", case))) {
        let mut parameters = scenario(name).parameters;
        spoil(&mut parameters);
        match Ecu::new(&parameters) {
            Ok(_) => panic!("{field} was accepted"),
            Err(error) => assert!(error.to_string().contains(&format!("`{field}")), "{field}: {error}"),
        }
    }
}

#[test]
fn a_swing_cylinders_sensor_needs_a_swing_cylinder() {
    let mut parameters = scenario("dig").parameters;
    parameters.geometry.swing = None;
    let error = Ecu::new(&parameters).unwrap_err().to_string();
    assert!(error.contains("`swing_sensor`"), "{error}");
}

#[test]
fn the_record_fits_the_link_and_survives_its_own_bytes() {
    for name in cross_tests::rig::scenario_names() {
        let parameters = scenario(&name).parameters;
        let bytes = postcard::to_stdvec(&parameters).unwrap();
        println!("{name}: {} bytes", bytes.len());
        assert!(bytes.len() <= firmware::simulated::link::RECORD_BYTES);
        assert_eq!(postcard::from_bytes::<Parameters>(&bytes).unwrap(), parameters);
        assert_eq!(parameters_from(&bytes), Some(parameters));
        for length in 0..bytes.len() {
            assert_eq!(parameters_from(&bytes[..length]), None, "{name}: the first {length} bytes");
        }
        // Places with a bucket and without.
        let bucket = Bucket {
            name: Name::new("own").unwrap(),
            bucket_m: parameters.geometry.bucket_m,
            coupler_pin: parameters.geometry.bucket.coupler_pin,
            coupler_m: parameters.geometry.bucket.coupler_m,
        };
        let mut buckets = [None; MAX_BUCKETS];
        buckets[..2].copy_from_slice(&[Some(bucket); 2]);
        let record =
            StoredRecord { machine: Name::new(&name[..name.len().min(16)]).unwrap(), parameters, buckets, mounted: 1 };
        let sealed = Sealed::new(&record).unwrap();
        assert_eq!(&sealed.as_bytes()[HEADER_BYTES..], postcard::to_stdvec(&record).unwrap());
    }
}

fn law(p: &mut Parameters) -> &mut LawParameters {
    p.motion.law.as_mut().expect("a law")
}

fn path(p: &mut Parameters) -> &mut PathParameters {
    p.path.as_mut().expect("a path")
}

const SPOILT_PATH: [(&str, Spoil); 27] = [
    ("motion.law.integral_per_s2", |p| law(p).integral_per_s2 = -1.0),
    ("motion.law.bias_limit_mps", |p| law(p).bias_limit_mps = 0.2),
    ("motion.law.correction_limit_mps", |p| law(p).correction_limit_mps = f32::NAN),
    ("motion.law.rest_zone_m", |p| law(p).rest_zone_m = 0.1),
    ("motion.law.reserve", |p| law(p).reserve = 0.6),
    ("motion.law.acceleration", |p| law(p).acceleration[2] = 0.0),
    ("motion.law.cushion_mps2", |p| law(p).cushion_mps2 = 0.0),
    ("motion.law.tip_acceleration_mps2", |p| law(p).tip_acceleration_mps2 = f32::INFINITY),
    ("motion.law.pitch_acceleration_radps2", |p| law(p).pitch_acceleration_radps2 = 0.0),
    ("motion.law.swing_following_error_rad", |p| law(p).swing_following_error_rad = 2.0),
    ("motion.law.areas_m2", |p| law(p).areas_m2[1][0] = 0.0),
    ("motion.law.flow_m3ps", |p| law(p).flow_m3ps = 0.0),
    ("motion.law.feedback_lag_s", |p| law(p).feedback_lag_s = -0.1),
    ("motion.law.lag_m", |p| law(p).lag_m = 0.0),
    ("motion.law.overrun_n", |p| law(p).overrun_n[1][1] = 0.0),
    ("motion.law.swing_overrun_radps2", |p| law(p).swing_overrun_radps2 = f32::NAN),
    ("path.knots", |p| path(p).knots = [None; 9]),
    ("path.knots", |p| path(p).knots.swap(1, 5)),
    ("path.knot.x_m", |p| path(p).knots[0].as_mut().expect("a knot").x_m = f64::NAN),
    ("path.knot.z_m", |p| path(p).knots[0].as_mut().expect("a knot").z_m = 99.0),
    ("path.knot.pitch_deg", |p| path(p).knots[1].as_mut().expect("a knot").pitch_deg = 999.0),
    ("path.knot.swing_deg", |p| path(p).knots[1].as_mut().expect("a knot").swing_deg = f64::NAN),
    ("path.speed_mps", |p| path(p).speed_mps = 0.0),
    ("path.acceleration_mps2", |p| path(p).acceleration_mps2 = 0.0),
    ("path.pitch_speed_deg_s", |p| path(p).pitch_speed_deg_s = f64::NAN),
    ("path.swing_speed_deg_s", |p| path(p).swing_speed_deg_s = 0.0),
    ("path.swing_acceleration_deg_s2", |p| path(p).swing_acceleration_deg_s2 = -1.0),
];

fn grade(p: &mut Parameters) -> &mut GradeParameters {
    p.grade.as_mut().expect("a plane")
}

const SPOILT_GRADE: [(&str, Spoil); 5] = [
    ("grade.point_x_m", |p| grade(p).point_x_m = f64::NAN),
    ("grade.point_z_m", |p| grade(p).point_z_m = 60.0),
    ("grade.slope_deg", |p| grade(p).slope_deg = 90.0),
    ("grade.speed_mps", |p| grade(p).speed_mps = 0.0),
    ("grade.tolerance_m", |p| grade(p).tolerance_m = 2.0),
];

#[test]
fn every_value_of_law_path_and_plane_out_of_its_range_is_refused_by_name() {
    let of = |name: &'static str| move |&(field, spoil): &(&'static str, Spoil)| (name, field, spoil);
    let all = SPOILT_PATH.iter().map(of("level-zx200")).chain(SPOILT_GRADE.iter().map(of("grade-zx200")));
    for (name, field, spoil) in all {
        let mut parameters = scenario(name).parameters;
        spoil(&mut parameters);
        match Ecu::new(&parameters) {
            Ok(_) => panic!("{field} was accepted"),
            Err(error) => assert!(error.to_string().contains(&format!("`{field}`")), "{field}: {error}"),
        }
    }
}

/// Ends of ranges that lie between two values of the type they are stored in: written as a decimal, each is rounded out of its range or into it.
const ENDS: [(&str, f32, SetTo); 13] = [
    ("motion.law.bias_limit_mps", 0.1, |p, x| law(p).bias_limit_mps = x),
    ("motion.law.rest_zone_m", 0.05, |p, x| law(p).rest_zone_m = x),
    ("motion.law.acceleration", -0.01, |p, x| law(p).acceleration[2] = x),
    ("motion.law.cushion_mps2", -0.01, |p, x| law(p).cushion_mps2 = x),
    ("motion.law.swing_following_error_rad", -0.001, |p, x| law(p).swing_following_error_rad = x),
    ("motion.law.areas_m2", -1e-5, |p, x| law(p).areas_m2[1][0] = x),
    ("motion.law.flow_m3ps", -1e-6, |p, x| law(p).flow_m3ps = x),
    ("motion.law.lag_m", -0.001, |p, x| law(p).lag_m = x),
    ("motion.smallest_speed_mps", 0.1, |p, x| p.motion.smallest_speed_mps = x),
    ("motion.start_tolerance_m", -0.001, |p, x| p.motion.start_tolerance_m = x),
    ("diagnosis.latest_start_s", -0.02, |p, x| p.diagnosis.latest_start_s = x),
    ("diagnosis.spool_lag_s", -0.01, |p, x| p.diagnosis.spool_lag_s = x),
    ("diagnosis.run_on_s", -0.1, |p, x| p.diagnosis.run_on_s = x),
];

#[test]
fn a_range_s_end_lies_within_it_as_it_is_stored_and_the_next_value_beyond_does_not() {
    for (field, end, set) in ENDS {
        // A lower end is written with a minus.
        let beyond = if end < 0.0 { (-end).next_down() } else { end.next_up() };
        let mut parameters = scenario("level-zx200").parameters;
        set(&mut parameters, end.abs());
        assert!(Ecu::new(&parameters).is_ok(), "{field} at {}", end.abs());
        set(&mut parameters, beyond);
        let error = Ecu::new(&parameters).map(drop).unwrap_err().to_string();
        assert!(error.contains(&format!("`{field}`")), "{field}: {error}");
    }
}
