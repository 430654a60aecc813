//! Time scaling: over random paths and limits every bound holds, the path is kept, the end is always reached, in little more
//! than the least time.

use cross_tests::sweep::Random;
use kinematics_core::planning::cylinder_path::CylinderPath;
use kinematics_core::planning::move_limits::{Limits, MoveLimits};
use kinematics_core::planning::time_scaling::{Pace, TimeScaling};
use kinematics_core::{Cylinders, Real};

const TICK_S: f64 = 0.001;
const K: usize = 17;
/// No move of these tests takes longer, ticks.
const LONGEST: usize = 400_000;

fn array(c: &Cylinders<f64>) -> [f64; 3] {
    [c.boom, c.arm, c.bucket]
}

/// A smooth path of a few waves, and limits, both random.
fn random_move(stream: &mut Random) -> ([Cylinders<f64>; K], MoveLimits) {
    let mut draw = |low: f64, high: f64| low + (high - low) * stream.unit();
    let waves = [0; 3].map(|_| [draw(-0.6, 0.6), draw(-0.25, 0.25), draw(0.5, 2.5), draw(0.0, 6.0)]);
    let at = |share: f64| {
        let [boom, arm, bucket] = waves
            .map(|[slope, height, waves, phase]| 2.0 + slope * share + height * libm::sin(waves * 3.0 * share + phase));
        Cylinders { boom, arm, bucket }
    };
    let knots = std::array::from_fn(|i| at(i as f64 / (K - 1) as f64));
    let limits = MoveLimits {
        speed_mps: [0; 3].map(|_| [draw(0.1, 0.6), draw(0.1, 0.6)]),
        acceleration_mps2: [0; 3].map(|_| draw(0.3, 3.0)),
        jerk_mps3: [0; 3].map(|_| draw(3.0, 40.0)),
        areas_m2: [0; 3].map(|_| [draw(0.005, 0.03), draw(0.003, 0.02)]),
        flow_m3ps: draw(0.002, 0.012),
    };
    (knots, limits)
}

/// The largest share of each limit a move uses: speed, acceleration, jerk, flow, from the lengths' own differences.
struct Used {
    speed: f64,
    acceleration: f64,
    jerk: f64,
    flow: f64,
    ticks: usize,
}

fn run<T: Real>(
    knots: &[Cylinders<f64>; K],
    limits: &MoveLimits,
    share: impl Fn(usize) -> f64,
) -> Result<Used, Box<dyn std::error::Error>> {
    let to_t = |c: &Cylinders<f64>| Cylinders {
        boom: T::from_f64(c.boom),
        arm: T::from_f64(c.arm),
        bucket: T::from_f64(c.bucket),
    };
    let checked = Limits::<T>::new(limits)?;
    let path = CylinderPath::new(&knots.map(|c| to_t(&c)), &checked).ok_or("no movement")?;
    let mut scaling = TimeScaling::standstill();
    scaling.plan(&path, &checked, TICK_S)?;
    let mut pace = Pace::start();
    // Differences are taken of the same path in f64: of f32 lengths they would show rounding alone.
    let exact = CylinderPath::new(knots, &Limits::<f64>::new(limits)?).ok_or("no movement")?;
    let first = array(&exact.at(0.0).lengths);
    let mut last = [first; 3];
    let mut used = Used { speed: 0.0, acceleration: 0.0, jerk: 0.0, flow: 0.0, ticks: 0 };
    loop {
        let progress = scaling.advance(&mut pace, T::from_f64(share(used.ticks)));
        used.ticks += 1;
        assert!(used.ticks < LONGEST, "never ends");
        let now = array(&exact.at(progress.s.to_f64()).lengths);
        let mut flow = 0.0;
        for i in 0..3 {
            let [l0, l1, l2, l3] = [now[i], last[0][i], last[1][i], last[2][i]];
            let speed = (l0 - l1) / TICK_S;
            let acceleration = (l0 - 2.0 * l1 + l2) / (TICK_S * TICK_S);
            let jerk = (l0 - 3.0 * l1 + 3.0 * l2 - l3) / (TICK_S * TICK_S * TICK_S);
            let way = usize::from(speed < 0.0);
            used.speed = used.speed.max(speed.abs() / limits.speed_mps[i][way]);
            used.acceleration = used.acceleration.max(acceleration.abs() / limits.acceleration_mps2[i]);
            used.jerk = used.jerk.max(jerk.abs() / limits.jerk_mps3[i]);
            flow += limits.areas_m2[i][way] * speed.abs();
        }
        used.flow = used.flow.max(flow / limits.flow_m3ps);
        last = [now, last[0], last[1]];
        if progress.done {
            assert_eq!(progress.s.to_f64(), 1.0);
            assert_eq!(progress.rate.to_f64(), 0.0);
            return Ok(used);
        }
    }
}

/// The largest shares of speed, acceleration, jerk and flow over so many random moves.
fn worst_of(moves: usize, seed: u64) -> [f64; 4] {
    let mut stream = Random::new(seed);
    let mut worst = [0.0_f64; 4];
    for _ in 0..moves {
        let (knots, limits) = random_move(&mut stream);
        let used = run::<f64>(&knots, &limits, |_| 1.0).unwrap_or_else(|e| panic!("{e}: {limits:?}"));
        let all = [used.speed, used.acceleration, used.jerk, used.flow];
        worst = std::array::from_fn(|i| worst[i].max(all[i]));
    }
    worst
}

#[test]
fn no_bound_is_ever_exceeded_and_every_move_ends() {
    let worst = worst_of(300, 7);
    println!("largest share of speed, acceleration, jerk, flow: {worst:.4?}");
    assert!(worst.iter().all(|share| *share <= 1.0 + 1e-6), "{worst:?}");
    assert!(worst.iter().all(|share| *share > 0.9), "a limit is never used: {worst:?}");
}

#[test]
fn a_score_of_other_moves_keeps_its_bounds_and_uses_them() {
    let worst = worst_of(20, 101);
    assert!(worst.iter().all(|share| *share <= 1.0 + 1e-6 && *share > 0.8), "{worst:?}");
}

#[test]
fn in_f32_the_bounds_hold_to_its_rounding() {
    let mut stream = Random::new(11);
    for _ in 0..100 {
        let (knots, limits) = random_move(&mut stream);
        let used = run::<f32>(&knots, &limits, |_| 1.0).unwrap_or_else(|e| panic!("{e}: {limits:?}"));
        // s itself, a number of 24 bits, steps: only speeds and flow are more than its rounding over a tick.
        assert!(used.speed < 1.01 && used.flow < 1.01, "{} {}", used.speed, used.flow);
    }
}

#[test]
fn less_speed_may_be_asked_for_at_any_time_and_the_bounds_still_hold() {
    let mut stream = Random::new(3);
    let mut worst = [0.0_f64; 4];
    for i in 0..100 {
        let (knots, limits) = random_move(&mut stream);
        // Now and then a third, nothing, all.
        let share = |tick: usize| [1.0, 0.33, 1.0, 0.0, 0.7][(tick / (150 + 13 * i)) % 5];
        let used = run::<f64>(&knots, &limits, share).unwrap_or_else(|e| panic!("{e}: {limits:?}"));
        let all = [used.speed, used.acceleration, used.jerk, used.flow];
        worst = std::array::from_fn(|i| worst[i].max(all[i]));
    }
    assert!(worst.iter().all(|share| *share <= 1.0 + 1e-6), "{worst:?}");
}

/// The least time of a straight path with jerk limit: rest to rest, seven phases or fewer (Biagiotti and Melchiorri 2008, 3.4).
fn double_s(length: f64, speed: f64, acceleration: f64, jerk: f64) -> f64 {
    // Time from rest to a speed, and the length of both ramps.
    let ramp = |v: f64| {
        if v * jerk < acceleration * acceleration {
            2.0 * libm::sqrt(v / jerk)
        } else {
            v / acceleration + acceleration / jerk
        }
    };
    if ramp(speed) * speed <= length {
        return 2.0 * ramp(speed) + (length - ramp(speed) * speed) / speed;
    }
    let (mut low, mut high) = (0.0, speed);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if ramp(middle) * middle <= length { low = middle } else { high = middle }
    }
    2.0 * ramp(low)
}

#[test]
fn a_straight_move_takes_little_more_than_the_least_time() {
    let mut worst: f64 = 0.0;
    for (length, speed, acceleration, jerk) in [
        (1.0, 0.3, 0.5, 5.0),
        (0.3, 0.3, 0.5, 5.0),
        (0.1, 0.4, 1.0, 10.0),
        (1.2, 0.6, 0.6, 3.0),
        (0.02, 0.3, 1.0, 20.0),
    ] {
        let limits = MoveLimits {
            speed_mps: [[speed; 2]; 3],
            acceleration_mps2: [acceleration; 3],
            jerk_mps3: [jerk; 3],
            areas_m2: [[0.0; 2]; 3],
            flow_m3ps: 1.0,
        };
        let knots = std::array::from_fn(|i| {
            let share = i as f64 / (K - 1) as f64;
            Cylinders { boom: 2.0 + length * share, arm: 2.0 - 0.7 * length * share, bucket: 2.0 }
        });
        let used = run::<f64>(&knots, &limits, |_| 1.0).expect("a profile");
        let ratio = used.ticks as f64 * TICK_S / double_s(length, speed, acceleration, jerk);
        println!("{length} m: {:.3} s, {ratio:.3} of the least", used.ticks as f64 * TICK_S);
        assert!(ratio >= 0.999, "faster than possible: {ratio}");
        worst = worst.max(ratio);
    }
    assert!(worst < 1.05, "{worst}");
}

/// A bound below the least time of a curved path: speeds, flow and accelerations on a fine grid, jerk left aside, by a pass
/// backwards and one forwards in ṡ².
fn least_time_without_jerk(knots: &[Cylinders<f64>; K], limits: &MoveLimits) -> f64 {
    const N: usize = 4000;
    let path = CylinderPath::new(knots, &Limits::<f64>::new(limits).expect("limits")).expect("movement");
    let at: Vec<_> = (0..=N).map(|i| path.at(i as f64 / N as f64)).collect();
    let ds = 1.0 / N as f64;
    // Allowed s̈ at a place for a square x of the rate.
    let range = |i: usize, x: f64| {
        (0..3).fold([f64::NEG_INFINITY, f64::INFINITY], |[low, high], axis| {
            let (slope, bend) = (at[i].slope[axis], at[i].curvature[axis] * x);
            let limit = limits.acceleration_mps2[axis];
            if slope.abs() < 1e-9 {
                return [low, high];
            }
            let ends = [(-limit - bend) / slope, (limit - bend) / slope];
            [low.max(ends[0].min(ends[1])), high.min(ends[0].max(ends[1]))]
        })
    };
    let mut square: Vec<f64> = (0..=N)
        .map(|i| {
            let mut flow = 0.0;
            let mut rate = f64::INFINITY;
            for axis in 0..3 {
                let slope = at[i].slope[axis];
                let way = usize::from(slope < 0.0);
                rate = rate.min(limits.speed_mps[axis][way] / slope.abs());
                flow += limits.areas_m2[axis][way] * slope.abs();
            }
            let mut x = rate.min(limits.flow_m3ps / flow).powi(2);
            while range(i, x)[0] > range(i, x)[1] {
                x *= 0.999;
            }
            x
        })
        .collect();
    square[0] = 0.0;
    square[N] = 0.0;
    for i in (0..N).rev() {
        let slowing = -range(i + 1, square[i + 1])[0];
        square[i] = square[i].min(square[i + 1] + 2.0 * slowing.max(0.0) * ds);
    }
    for i in 0..N {
        let gaining = range(i, square[i])[1];
        square[i + 1] = square[i + 1].min(square[i] + 2.0 * gaining.max(0.0) * ds);
    }
    square.windows(2).map(|x| 2.0 * ds / (x[0].sqrt() + x[1].sqrt())).sum()
}

#[test]
fn curved_moves_stay_near_a_bound_that_no_jerk_limited_move_can_reach() {
    let mut stream = Random::new(21);
    let mut ratios: Vec<f64> = (0..60)
        .map(|_| {
            let (knots, limits) = random_move(&mut stream);
            let used = run::<f64>(&knots, &limits, |_| 1.0).unwrap_or_else(|e| panic!("{e}: {limits:?}"));
            used.ticks as f64 * TICK_S / least_time_without_jerk(&knots, &limits)
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    let (median, worst) = (ratios[ratios.len() / 2], ratios[ratios.len() - 1]);
    let most = ratios[ratios.len() * 9 / 10];
    println!("time over the bound without jerk: median {median:.3}, nine in ten below {most:.3}, worst {worst:.3}");
    assert!(ratios[0] > 0.999, "faster than possible: {}", ratios[0]);
    // A single place that wants little jerk sets it for the whole path: a few moves are far slower than they need to be.
    assert!(median < 1.25 && most < 2.2, "{median} {most}");
}

#[test]
fn the_rate_the_acceleration_and_the_jerk_told_are_the_differences_of_the_way() {
    let mut stream = Random::new(89);
    for _ in 0..3 {
        let (knots, limits) = random_move(&mut stream);
        let limits = Limits::<f64>::new(&limits).unwrap();
        let path = CylinderPath::new(&knots, &limits).unwrap();
        let mut scaling = TimeScaling::standstill();
        scaling.plan(&path, &limits, TICK_S).unwrap();
        let mut pace = Pace::start();
        let mut before = pace.progress();
        let mut ticks = 0;
        while !before.done && ticks < LONGEST {
            // Less is asked for now and then.
            let share = if ticks % 900 < 300 { 0.3 } else { 1.0 };
            let now = scaling.advance(&mut pace, share);
            assert!(((now.s - before.s) / TICK_S - now.rate).abs() < 1e-9, "{now:?} {before:?}");
            assert!(((now.rate - before.rate) / TICK_S - now.acceleration).abs() < 1e-8, "{now:?} {before:?}");
            assert!(((now.acceleration - before.acceleration) / TICK_S - now.jerk).abs() < 1e-6, "{now:?} {before:?}");
            (before, ticks) = (now, ticks + 1);
        }
        assert!(before.done && before.s == 1.0);
    }
}
