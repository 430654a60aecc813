//! Time scaling: over random paths and limits every bound holds, the path is kept, the end is always reached, in little more
//! than the least time.

use cross_tests::sweep::Random;
use kinematics_core::planning::cylinder_path::CylinderPath;
use kinematics_core::planning::move_limits::{Limits, MoveLimits};
use kinematics_core::planning::time_scaling::TimeScaling;
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
    let mut scaling = TimeScaling::new(&path, &checked, TICK_S)?;
    // Differences are taken of the same path in f64: of f32 lengths they would show rounding alone.
    let exact = CylinderPath::new(knots, &Limits::<f64>::new(limits)?).ok_or("no movement")?;
    let first = array(&exact.at(0.0).lengths);
    let mut last = [first; 3];
    let mut used = Used { speed: 0.0, acceleration: 0.0, jerk: 0.0, flow: 0.0, ticks: 0 };
    loop {
        let progress = scaling.advance(T::from_f64(share(used.ticks)));
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

#[test]
fn no_bound_is_ever_exceeded_and_every_move_ends() {
    let mut stream = Random::new(7);
    let mut worst = [0.0_f64; 4];
    for _ in 0..300 {
        let (knots, limits) = random_move(&mut stream);
        let used = run::<f64>(&knots, &limits, |_| 1.0).unwrap_or_else(|e| panic!("{e}: {limits:?}"));
        let all = [used.speed, used.acceleration, used.jerk, used.flow];
        worst = std::array::from_fn(|i| worst[i].max(all[i]));
    }
    println!("largest share of speed, acceleration, jerk, flow: {worst:.4?}");
    assert!(worst.iter().all(|share| *share <= 1.0 + 1e-6), "{worst:?}");
    assert!(worst.iter().all(|share| *share > 0.9), "a limit is never used: {worst:?}");
}
