//! Cycle times of the 20 t class: a whole stroke at full lever, from the lever (dead time included) to where the cushion begins.

use cross_tests::plant::*;

#[test]
fn the_cycle_times_are_those_of_the_class_within_fifteen_per_cent() {
    let m = model("zx200");
    for (name, function, lever, start, class_s) in [
        ("boom up", BOOM, 1.0, [0.0, 0.5, 0.5], 4.0),
        ("boom down", BOOM, -1.0, [1.0, 0.5, 0.5], 2.5),
        ("arm in", ARM, 1.0, [0.7, 0.0, 0.5], 3.3),
        ("arm out", ARM, -1.0, [0.7, 1.0, 0.5], 3.2),
        ("bucket in", BUCKET, 1.0, [0.7, 0.5, 0.0], 2.4),
    ] {
        let stroke = m.functions[function].stroke.expect("a cylinder");
        let [at_retracted, at_extended] = m.functions[function].cushions.map(|cushion| cushion.length_m);
        let (cushion_m, stop_m) = if lever > 0.0 {
            (stroke.max_m - at_extended, stroke.max_m)
        } else {
            (stroke.min_m + at_retracted, stroke.min_m)
        };
        let time_s = time_to(&mut at(&m, shares(&m, start)), &m, function, lever, cushion_m);
        let stop_s = time_to(&mut at(&m, shares(&m, start)), &m, function, lever, stop_m);
        println!(
            "{name:>10}: {time_s:.2} s ({stop_s:.2} s to the stop), class {class_s} s, {:+.0} %",
            (time_s / class_s - 1.0) * 100.0
        );
        assert!((time_s / class_s - 1.0).abs() < 0.15, "{name}: {time_s} s");
    }
}
