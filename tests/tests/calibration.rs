//! Calibration against randomised simulated valves, sensors and buckets: what is found is what was drawn, or it is refused.

use firmware::calibration::end_stops::{EndStopFailure, EndStopParameters, EndStops};
use firmware::calibration::measure_up::{MeasureUp, MeasureUpError};
use firmware::calibration::valve_search::{SearchFailure, ValveSearch, ValveSearchParameters};
use firmware::calibration::{Direction, Step};
use firmware::parameters::PositionSensor;
use hil_sim::plant::sensors::{Noise, code};
use hil_sim::plant::{Actuator, ActuatorModel};
use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinders, Joints, Machine, Rotor, Vec2};
use proptest::prelude::*;

const STEP_S: f64 = 0.001;
const STROKE: Stroke = Stroke { min_m: 1.6, max_m: 2.8 };
const SENSOR: PositionSensor =
    PositionSensor { stroke: STROKE, min_code: 3277, max_code: 62258, tolerance_codes: 1638 };
/// Noise of a position sensor, m.
const SIGMA_M: f64 = 1e-4;
/// No procedure takes longer, ticks.
const PATIENCE: u32 = 600_000;

/// A cylinder with its valve and a noisy 16-bit sensor.
struct Bench {
    actuator: Actuator,
    noise: Noise,
    /// −1 where the solenoids are swapped.
    polarity: f64,
}

impl Bench {
    fn new(model: ActuatorModel, seed: u64) -> Self {
        Self { actuator: Actuator::new(model, 2.2, STEP_S), noise: Noise::new(seed), polarity: 1.0 }
    }

    fn code(&mut self) -> u16 {
        code(&SENSOR, self.actuator.position(), SIGMA_M * self.noise.normal())
    }

    fn metres(&mut self) -> f32 {
        let code = f64::from(self.code());
        let span = f64::from(SENSOR.max_code) - f64::from(SENSOR.min_code);
        (STROKE.min_m + (code - f64::from(SENSOR.min_code)) / span * (STROKE.max_m - STROKE.min_m)) as f32
    }

    fn drive(&mut self, fraction: f32) {
        assert!((-1.0..=1.0).contains(&fraction));
        self.actuator.step(self.polarity * f64::from(fraction), STEP_S);
    }

    /// To the end of a procedure: its result and how many ticks it took.
    fn complete<R, F>(&mut self, mut step: impl FnMut(&mut Self) -> Step<R, F>) -> (Result<R, F>, u32) {
        for tick in 0..PATIENCE {
            match step(self) {
                Step::Drive(fraction) => self.drive(fraction),
                Step::Done(result) => return (Ok(result), tick),
                Step::Failed(why) => return (Err(why), tick),
            }
        }
        panic!("a procedure without end");
    }

    fn search(&mut self) -> (Result<[firmware::parameters::ValveDirection; 2], SearchFailure>, u32) {
        let parameters = ValveSearchParameters::for_cylinder(STROKE.min_m as f32 + 0.02, STROKE.max_m as f32 - 0.02);
        let mut search = ValveSearch::new(parameters).expect("parameters in range");
        self.complete(|bench| {
            let position = bench.metres();
            search.step(position)
        })
    }

    fn find_ends(&mut self) -> Result<firmware::calibration::end_stops::EndCodes, EndStopFailure> {
        let mut ends = EndStops::new(EndStopParameters::default()).expect("parameters in range");
        let found = self.complete(|bench| {
            let code = bench.code();
            ends.step(code)
        });
        found.0
    }
}

fn model(dead_band: [f64; 2], full_speed: [f64; 2], dead_time_s: f64, spool_lag_s: f64) -> ActuatorModel {
    ActuatorModel { stroke: Some(STROKE), dead_time_s, spool_lag_s, dead_band, full_speed }
}

fn any_model() -> impl Strategy<Value = ActuatorModel> {
    let dead_band = || 0.05..0.37;
    let speed = || 0.15..0.6;
    ((dead_band(), dead_band()), (speed(), speed()), 0.04..0.2, 0.01..0.08)
        .prop_map(|((a, b), (c, d), dead_time, lag)| model([a, b], [c, d], dead_time, lag))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn any_valves_dead_band_is_found_within_one_percent_of_full_scale_and_its_gain_within_three(
        model in any_model(), seed in any::<u64>(),
    ) {
        let (found, ticks) = Bench::new(model, seed).search();
        let found = found.map_err(|why| TestCaseError::fail(format!("{why:?}")))?;
        for (i, found) in found.into_iter().enumerate() {
            let dead_band = f64::from(found.dead_band) - model.dead_band[i];
            let gain = |full_speed: f64, dead_band: f64| full_speed / (1.0 - dead_band);
            let gain = gain(f64::from(found.full_speed), f64::from(found.dead_band))
                / gain(model.full_speed[i], model.dead_band[i]) - 1.0;
            prop_assert!(dead_band.abs() <= 0.01, "dead band off by {dead_band} after {ticks} ticks");
            prop_assert!(gain.abs() <= 0.03, "gain off by {gain}");
        }
    }

    #[test]
    fn any_strokes_end_codes_are_found_within_a_fifth_of_a_millimetre(model in any_model(), seed in any::<u64>()) {
        // The search presses with half of full-scale current.
        let found = Bench::new(model, seed).find_ends();
        let found = found.map_err(|why| TestCaseError::fail(format!("{why:?}")))?;
        let codes_per_m = f64::from(SENSOR.max_code - SENSOR.min_code) / (STROKE.max_m - STROKE.min_m);
        for (found, is) in [(found.min_code, SENSOR.min_code), (found.max_code, SENSOR.max_code)] {
            let off_m = (f64::from(found) - f64::from(is)) / codes_per_m;
            prop_assert!(off_m.abs() <= 2e-4, "{off_m}");
        }
    }

    #[test]
    fn any_bucket_is_measured_within_two_millimetres(
        length in 1.2..1.8_f64, offset_deg in -8.0..8.0_f64, seed in any::<u64>(), touches in 8_usize..16,
    ) {
        let (found, off_m, off_rad) = measured(length, offset_deg, seed, touches, SIGMA_M);
        prop_assert!(off_m <= 0.002, "length off by {off_m} m: {found:?}");
        prop_assert!(off_rad <= 0.002, "direction off by {off_rad} rad: {found:?}");
        prop_assert!(found.residual_m < 0.005);
    }
}

/// The tip of a bucket of this length and offset touches one point at angles between −50° and 50° of the first; the sensors are noisy.
fn measured(
    length: f64,
    offset_deg: f64,
    seed: u64,
    touches: usize,
    sigma_m: f64,
) -> (firmware::calibration::measure_up::MeasuredBucket, f64, f64) {
    let geometry = hil_sim::machine_file::MachineFile::load("zx200").expect("the machine").geometry;
    let truth = Machine::<f64>::new(&geometry).expect("a geometry");
    let ecu = Machine::<f32>::new(&geometry).expect("a geometry");
    let mut noise = Noise::new(seed);
    let tip = Rotor::from_degrees(offset_deg).to_vec().scale(length);
    let point = Vec2::new(6.5, -1.0);
    let mut up = MeasureUp::new();
    let mut done = 0;
    for i in 0..touches {
        // The bucket's frame turned so, the wrist follows from the point: any pose of the machine with that wrist will do.
        let turned = Rotor::from_degrees(-140.0 + 100.0 * i as f64 / (touches - 1) as f64);
        let wrist = point - turned.rotate(tip);
        let assumed = truth.chain().lengths()[3];
        let tip_of_parameters = wrist + turned.to_vec().scale(assumed);
        let plane =
            kinematics_core::PlaneTip { reach: tip_of_parameters.x, height: tip_of_parameters.z, pitch: turned };
        let Ok(exact) = truth.tip_to_cylinders(&plane) else { continue };
        let mut noisy = |length: f64| (length + sigma_m * noise.normal()) as f32;
        let read = Cylinders { boom: noisy(exact.boom), arm: noisy(exact.arm), bucket: noisy(exact.bucket) };
        let joints: Joints<f32> = ecu.cylinders_to_joints(&read).expect("within the strokes");
        up.touch(ecu.chain().wrist(&joints), &joints);
        done += 1;
    }
    assert!(done >= 5, "only {done} touches can be reached");
    let found = up.bucket().expect("enough touches");
    let off_rad = (found.offset.angle() - offset_deg.to_radians() as f32).abs();
    (found, (f64::from(found.length_m) - length).abs(), f64::from(off_rad))
}

#[test]
fn without_noise_the_bucket_is_exact_to_f32_and_its_residual_says_so() {
    let (found, off_m, off_rad) = measured(1.55, 5.0, 1, 9, 0.0);
    println!("{found:?}, off by {off_m:e} m, {off_rad:e} rad");
    assert!(off_m < 1e-5 && off_rad < 1e-5 && found.residual_m < 1e-3);
}

#[test]
fn touches_at_one_angle_or_too_few_give_no_bucket() {
    let still = Joints { boom: Rotor::IDENTITY, arm: Rotor::IDENTITY, bucket: Rotor::IDENTITY };
    let mut up = MeasureUp::new();
    up.touch(Vec2::new(5.0, 1.0), &still);
    assert_eq!(up.bucket(), Err(MeasureUpError::TooFew { touches: 1 }));
    for _ in 0..5 {
        up.touch(Vec2::new(5.0, 1.0), &still);
    }
    assert!(matches!(up.bucket(), Err(MeasureUpError::TooAlike { spread }) if spread < 1e-6));
}

const PLAIN: ([f64; 2], [f64; 2]) = ([0.15, 0.2], [0.3, 0.25]);

#[test]
fn a_direction_that_never_moves_is_named() {
    let (dead_band, speed) = PLAIN;
    let dead = model([dead_band[0], 0.95], speed, 0.1, 0.05);
    assert_eq!(Bench::new(dead, 1).search().0, Err(SearchFailure::NoMotion(Direction::Retract)));
}

#[test]
fn swapped_solenoids_are_noticed() {
    let (dead_band, speed) = PLAIN;
    let mut bench = Bench::new(model(dead_band, speed, 0.1, 0.05), 1);
    bench.polarity = -1.0;
    assert_eq!(bench.search().0, Err(SearchFailure::WrongWay(Direction::Extend)));
    let mut bench = Bench::new(model(dead_band, speed, 0.1, 0.05), 1);
    bench.polarity = -1.0;
    assert_eq!(bench.find_ends(), Err(EndStopFailure::Reversed));
}

#[test]
fn a_search_that_starts_at_an_end_gives_up_before_the_stop() {
    let (dead_band, speed) = PLAIN;
    let mut bench = Bench::new(model(dead_band, speed, 0.1, 0.05), 1);
    for _ in 0..6000 {
        bench.drive(1.0);
    }
    assert_eq!(bench.search().0, Err(SearchFailure::NoRoom(Direction::Extend)));
}

#[test]
fn a_cylinder_that_does_not_move_has_no_ends() {
    let (_, speed) = PLAIN;
    let stuck = model([0.9, 0.9], speed, 0.1, 0.05);
    assert_eq!(Bench::new(stuck, 1).find_ends(), Err(EndStopFailure::TooShort));
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let good = ValveSearchParameters::for_cylinder(1.0, 2.0);
    assert!(ValveSearch::new(good).is_ok());
    let spoilt = [
        ("search.start", ValveSearchParameters { start: -0.1, ..good }),
        ("search.increment", ValveSearchParameters { increment: f32::NAN, ..good }),
        ("search.largest", ValveSearchParameters { largest: 0.95, ..good }),
        ("search.dwell_ticks", ValveSearchParameters { dwell_ticks: 100, ..good }),
        ("search.threshold", ValveSearchParameters { threshold: 0.0, ..good }),
        ("search.window_ticks", ValveSearchParameters { window_ticks: 0, ..good }),
        ("search.measured_at", ValveSearchParameters { measured_at: [0.5, 0.5], ..good }),
        ("search.room[0]", ValveSearchParameters { room: [2.0, 1.0], ..good }),
    ];
    for (field, parameters) in spoilt {
        let error = ValveSearch::new(parameters).unwrap_err().to_string();
        assert!(error.contains(&format!("`{field}`")), "{field}: {error}");
    }
    let good = EndStopParameters::default();
    let error = EndStops::new(EndStopParameters { current: 0.9, ..good }).unwrap_err().to_string();
    assert!(error.contains("`end_stops.current`"), "{error}");
}

#[test]
fn the_worst_of_two_hundred_valves_is_printed() {
    let mut random = cross_tests::sweep::Random::new(1);
    let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
    let (mut dead_band, mut gain, mut longest) = (0.0_f64, 0.0_f64, 0);
    for seed in 0..200 {
        let bands = [between(0.05, 0.37), between(0.05, 0.37)];
        let speeds = [between(0.15, 0.6), between(0.15, 0.6)];
        let model = model(bands, speeds, between(0.04, 0.2), between(0.01, 0.08));
        let (found, ticks) = Bench::new(model, seed).search();
        for (i, found) in found.expect("a valve").into_iter().enumerate() {
            let slope = |full: f64, band: f64| full / (1.0 - band);
            let ratio = slope(found.full_speed.into(), found.dead_band.into()) / slope(speeds[i], bands[i]);
            dead_band = dead_band.max((f64::from(found.dead_band) - bands[i]).abs());
            gain = gain.max((ratio - 1.0).abs());
        }
        longest = longest.max(ticks);
    }
    println!("dead band {:.2} % of full scale, gain {:.2} %, {} s", dead_band * 100.0, gain * 100.0, longest / 1000);
    assert!(dead_band <= 0.01 && gain <= 0.03);
}
