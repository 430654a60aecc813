//! A path of straight segments: the tip keeps to it with valves that are not quite known and a pump that gives too little.

use cross_tests::rig::scenario;
use cross_tests::ways::{Across, across_path, run};
use hil_sim::scenario::Scenario;

/// The plant as calibration leaves it: gain ± 3 %, dead band ± 1 % of full scale, dead time ± 20 ms, of the cylinders in turn.
fn off_calibration(scenario: &mut Scenario, case: u32) {
    for (index, model) in scenario.plant.iter_mut().enumerate() {
        let sign = |bit: usize| if (case >> ((bit + index) % 6)) & 1 == 1 { 1.0 } else { -1.0 };
        model.full_speed = model.full_speed.map(|speed| speed * (1.0 + 0.03 * sign(0)));
        model.dead_band = [model.dead_band[0] + 0.01 * sign(1), model.dead_band[1] + 0.01 * sign(2)];
        model.dead_time_s += 0.02 * if case & 1 == 1 { 1.0 } else { -1.0 };
    }
}

fn worst(name: &str, speed_mps: f64) -> (f64, f64) {
    let (mut square_sum, mut max_m) = (0.0, 0.0);
    for case in 0..16 {
        let mut scenario = scenario(name);
        off_calibration(&mut scenario, case);
        scenario.parameters.path.as_mut().expect("a path").speed_mps = speed_mps;
        scenario.duration_s *= 0.5 / speed_mps;
        let log = run(&scenario, u64::from(case));
        assert!(log.faults.is_empty(), "{name}, case {case}: {:?}", log.faults);
        let Across { rms_m, max_m: max, .. } = across_path(&scenario, &log);
        println!("{name} at {speed_mps} m/s, case {case}: {:.1} mm RMS, {:.1} mm max", rms_m * 1e3, max * 1e3);
        square_sum += rms_m * rms_m;
        max_m = f64::max(max_m, max);
    }
    (libm::sqrt(square_sum / 16.0), max_m)
}

#[test]
fn levelling_stays_within_ten_millimetres_rms_with_valves_off_their_calibration() {
    for speed_mps in [0.3, 0.5] {
        let (rms_m, max_m) = worst("level-zx200", speed_mps);
        println!("all: {:.1} mm RMS, {:.1} mm max", rms_m * 1e3, max_m * 1e3);
        assert!(rms_m <= 0.010 && max_m <= 0.030, "{speed_mps}: {rms_m} {max_m}");
    }
}
