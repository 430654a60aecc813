//! The path through planned lengths is the natural cubic spline over the times that its steps take at the limits.

use cross_tests::sweep::Random;
use kinematics_core::Cylinders;
use kinematics_core::planning::cylinder_path::{CylinderPath, PathPoint};
use kinematics_core::planning::move_limits::{Limits, MoveLimits};

const K: usize = 5;

fn array(c: &Cylinders<f64>) -> [f64; 3] {
    [c.boom, c.arm, c.bucket]
}

fn random_limits(random: &mut Random) -> MoveLimits {
    let mut some = |low: f64, high: f64| low + (high - low) * random.unit();
    MoveLimits {
        speed_mps: core::array::from_fn(|_| [some(0.1, 0.6), some(0.1, 0.6)]),
        acceleration_mps2: [1.0; 3],
        jerk_mps3: [10.0; 3],
        areas_m2: core::array::from_fn(|_| [some(5e-3, 2e-2), some(5e-3, 2e-2)]),
        flow_m3ps: some(2e-3, 8e-3),
    }
}

fn random_lengths(random: &mut Random) -> [Cylinders<f64>; K] {
    core::array::from_fn(|_| {
        let mut some = || 1.0 + random.unit();
        Cylinders { boom: some(), arm: some(), bucket: some() }
    })
}

/// The longest of the cylinders' times at their speeds, outwards or inwards, and of the pump's, s.
fn shortest_time(limits: &MoveLimits, from: &Cylinders<f64>, to: &Cylinders<f64>) -> f64 {
    let (from, to) = (array(from), array(to));
    let (mut time, mut volume) = (0.0f64, 0.0);
    for i in 0..3 {
        let way = to[i] - from[i];
        let inwards = usize::from(way < 0.0);
        time = time.max(way.abs() / limits.speed_mps[i][inwards]);
        volume += way.abs() * limits.areas_m2[i][inwards];
    }
    time.max(volume / limits.flow_m3ps)
}

fn near(a: [f64; 3], b: [f64; 3], within: f64) -> bool {
    (0..3).all(|i| (a[i] - b[i]).abs() <= within)
}

/// The knots' parameters.
fn knots(limits: &MoveLimits, through: &[Cylinders<f64>; K]) -> Vec<f64> {
    let steps: Vec<f64> = through.windows(2).map(|pair| shortest_time(limits, &pair[0], &pair[1])).collect();
    let whole: f64 = steps.iter().sum();
    (0..K).map(|k| steps[..k].iter().sum::<f64>() / whole).collect()
}

#[test]
fn it_passes_through_every_knot_at_its_share_of_the_time_with_no_jump_and_straight_at_both_ends() {
    let mut random = Random::new(31);
    for _ in 0..50 {
        let (limits, through) = (random_limits(&mut random), random_lengths(&mut random));
        let path = CylinderPath::new(&through, &Limits::new(&limits).unwrap()).unwrap();
        let at = knots(&limits, &through);
        for (s, lengths) in at.iter().zip(&through) {
            assert!(near(array(&path.at(*s).lengths), array(lengths), 1e-12), "{s}");
        }
        for s in &at[1..K - 1] {
            let [before, after] = [-1e-9, 1e-9].map(|by| path.at(s + by));
            let scale = 1.0 + before.curvature.iter().chain(&before.third).fold(0.0f64, |l, x| l.max(x.abs()));
            assert!(near(before.slope, after.slope, 1e-8 * scale), "{s}: {before:?} {after:?}");
            let scale = scale + after.third.iter().fold(0.0f64, |l, x| l.max(x.abs()));
            assert!(near(before.curvature, after.curvature, 1e-8 * scale), "{s}: {before:?} {after:?}");
        }
        for end in [0.0, 1.0] {
            let size = path.at(0.5).third.iter().fold(1.0f64, |l, x| l.max(x.abs()));
            assert!(near(path.at(end).curvature, [0.0; 3], 1e-9 * size), "{:?}", path.at(end));
        }
    }
}

#[test]
fn slope_curvature_and_third_derivative_are_the_differences_of_lengths() {
    let mut random = Random::new(37);
    for _ in 0..50 {
        let (limits, through) = (random_limits(&mut random), random_lengths(&mut random));
        let path = CylinderPath::new(&through, &Limits::new(&limits).unwrap()).unwrap();
        let at = knots(&limits, &through);
        for pair in at.windows(2) {
            let h = 0.1 * (pair[1] - pair[0]);
            let s = pair[0] + (pair[1] - pair[0]) * (0.25 + 0.5 * random.unit());
            let points: [PathPoint<f64>; 5] = core::array::from_fn(|i| path.at(s + (i as f64 - 2.0) * h));
            let found = points[2];
            for i in 0..3 {
                let [first, before, here, after, last] = points.map(|point| array(&point.lengths)[i]);
                // Exact for a cubic.
                let third = (last - 2.0 * after + 2.0 * before - first) / (2.0 * h * h * h);
                let second = (after - 2.0 * here + before) / (h * h);
                let first = (after - before) / (2.0 * h) - third * h * h / 6.0;
                assert!((found.slope[i] - first).abs() < 1e-12 / h, "{first} {found:?}");
                assert!((found.curvature[i] - second).abs() < 1e-12 / (h * h), "{second} {found:?}");
                assert!((found.third[i] - third).abs() < 1e-11 / (h * h * h), "{third} {found:?}");
            }
        }
    }
}

#[test]
fn knots_that_coincide_take_a_thousandth_of_the_time_and_the_path_stands_there() {
    let mut random = Random::new(41);
    let limits = random_limits(&mut random);
    let mut through = random_lengths(&mut random);
    through[2] = through[1];
    let path = CylinderPath::new(&through, &Limits::new(&limits).unwrap()).unwrap();
    let steps: Vec<f64> = through.windows(2).map(|pair| shortest_time(&limits, &pair[0], &pair[1])).collect();
    let whole: f64 = steps.iter().sum();
    let short = 1e-3 / K as f64;
    let [second, third] = [steps[0] / whole / (1.0 + short), (steps[0] / whole + short) / (1.0 + short)];
    for s in [second, third] {
        assert!(near(array(&path.at(s).lengths), array(&through[1]), 1e-12));
    }
    assert!(path.at(0.5).curvature.iter().all(|c| c.is_finite()));
}

#[test]
fn a_move_of_nothing_or_of_no_numbers_has_no_path() {
    let mut random = Random::new(43);
    let limits = Limits::new(&random_limits(&mut random)).unwrap();
    let mut through = random_lengths(&mut random);
    assert!(CylinderPath::new(&[through[0]; K], &limits).is_none());
    through[3].arm = f64::NAN;
    assert!(CylinderPath::new(&through, &limits).is_none());
    through[3].arm = f64::INFINITY;
    assert!(CylinderPath::new(&through, &limits).is_none());
}
