//! Calibration by command, through the pins: a service tool on the bus asks, the controller drives the coils, the answer is on the bus.

use cross_tests::rig::scenario;
use hil_sim::service::calibrate::{search, with_random_valves};

#[test]
fn randomised_valves_are_found_within_one_percent_of_full_scale_and_three_of_gain() {
    let zx200 = scenario("dig-zx200");
    let (mut dead_band, mut gain, mut longest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for seed in 1..=3 {
        let machine = with_random_valves(&zx200, seed);
        for spool in 0..4 {
            let found = search(&machine, spool, seed).expect("a machine");
            assert_eq!((found.phase, found.reason), ("done", "none"), "seed {seed}, {}", found.spool);
            assert_eq!(found.rows.len(), 2);
            for row in &found.rows {
                dead_band = dead_band.max(row.dead_band_error().abs());
                gain = gain.max(row.gain_error().abs());
            }
            longest = longest.max(found.duration_s);
        }
    }
    println!("dead band {:.2} % of full scale, gain {:.2} %, longest {longest:.0} s", 100.0 * dead_band, 100.0 * gain);
    assert!(dead_band <= 0.01 && gain <= 0.03);
}
