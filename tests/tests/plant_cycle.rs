//! Cycle times of the 20 t class: from the lever to the stop, dead time and cushion included. The boom starts from (and comes down to) the
//! bucket on the ground, as it is timed on a machine; arm and bucket go through their whole strokes.

use cross_tests::plant::*;

#[test]
fn the_cycle_times_are_those_of_the_class_within_fifteen_per_cent() {
    let m = model("zx200");
    let ground = on_ground("zx200", &m, [0.7, 0.7]);
    let up = shares(&m, [1.0, 0.7, 0.7]);
    let stroke = |f: usize| m.functions[f].stroke.expect("a cylinder");
    println!("boom from {:.3} m on the ground to {:.3} m", ground[BOOM], up[BOOM]);
    for (name, function, lever, start, end_m, class_s) in [
        ("boom up", BOOM, 1.0, ground, up[BOOM], 4.0),
        ("boom down", BOOM, -1.0, up, ground[BOOM], 2.5),
        ("arm in", ARM, 1.0, shares(&m, [0.7, 0.0, 0.5]), stroke(ARM).max_m, 3.3),
        ("arm out", ARM, -1.0, shares(&m, [0.7, 1.0, 0.5]), stroke(ARM).min_m, 3.2),
        ("bucket in", BUCKET, 1.0, shares(&m, [0.7, 0.5, 0.0]), stroke(BUCKET).max_m, 2.4),
    ] {
        let time_s = time_to(&mut at(&m, start), &m, function, lever, end_m);
        println!("{name:>10}: {time_s:.2} s, class {class_s} s, {:+.0} %", (time_s / class_s - 1.0) * 100.0);
        assert!((time_s / class_s - 1.0).abs() < 0.15, "{name}: {time_s} s");
    }
}
