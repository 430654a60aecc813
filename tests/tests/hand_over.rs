//! From mode to mode on drawn hydraulic plants: what both modes want is not interrupted, what only the old one wanted stops at once. And where
//! modes end: at rest the coils are still, before the ends of the strokes levers slow down.

use cross_tests::on_oil::{OnOil, Seen};
use cross_tests::rig::scenario;
use firmware::can::command::TipVelocity;
use firmware::{Request, State};
use hil_sim::machine_file::MachineFile;
use hil_sim::scenario::Scenario;
use hil_sim::score::{Plants, Task, case};

/// Tip at the start: reach and height, m; pitch, degrees.
const START: [f64; 3] = [7.0, -1.0, 240.0];

const STANDS: TipVelocity = TipVelocity::ZERO;
const INWARDS: TipVelocity = TipVelocity { x_mps: -0.4, ..STANDS };

/// A drawn plant in the air, with a plane through the start.
fn plant(number: u64) -> Scenario {
    let machine = MachineFile::load("zx200").expect("zx200");
    let mut scenario = case(&machine, (Task::Level, 0.3), Plants::Tuning, number).expect("a case");
    let grade = scenario.parameters.grade.insert(scenario_of_grade());
    (grade.point_x_m, grade.point_z_m, grade.speed_mps) = (START[0], START[1], 0.4);
    scenario
}

fn scenario_of_grade() -> firmware::grade::GradeParameters {
    scenario("grade-zx200").parameters.grade.expect("a plane")
}

/// What an operator asks for.
type Asked = (Request, [i16; 4], TipVelocity);

const LED: Asked = (Request::TipVelocity, [0; 4], INWARDS);
const GRADED: Asked = (Request::Grade, [0, 0, 32_000, 0], STANDS);
const NEUTRAL: Asked = (Request::Neutral, [0; 4], STANDS);

/// Ticks with each of these, one after the other.
fn ticks(machine: &mut OnOil, asked: &[(Asked, usize)]) -> Vec<Seen> {
    let mut seen = Vec::new();
    for &((request, levers, tip), ticks) in asked {
        (machine.rig.request, machine.rig.levers, machine.rig.tip) = (request, levers, tip);
        seen.extend((0..ticks).map(|_| machine.tick()));
    }
    for one in &seen {
        assert_eq!((one.outputs.fault, one.outputs.state), (None, State::Running), "{asked:?}");
    }
    seen
}

/// The tip's speed over the last 30 ms, m/s.
fn speed(seen: &[Seen], at: usize) -> f64 {
    let (a, b) = (seen[at - 30].tip, seen[at].tip);
    libm::hypot(b[0] - a[0], b[1] - a[1]) / 0.03
}

#[test]
fn a_way_that_two_modes_or_two_requests_share_is_not_interrupted_and_not_left() {
    for number in 0..3 {
        for (name, asked) in [
            ("no change", vec![(LED, 4000)]),
            ("neutral for a tick", vec![(LED, 2500), (NEUTRAL, 1), (LED, 1499)]),
            ("tip velocity to grade", vec![(LED, 2500), (GRADED, 1500)]),
            ("grade to tip velocity", vec![(GRADED, 2500), (LED, 1500)]),
        ] {
            let seen = ticks(&mut OnOil::at_tip(&plant(number), START), &asked);
            let speeds = || (2500..3700).map(|at| speed(&seen, at));
            let (slowest, fastest) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max));
            let off_m = seen[2500..].iter().map(|one| (one.tip[1] - START[1]).abs()).fold(0.0, f64::max);
            println!(
                "plant {number}, {name}: {:.3} m/s before, then {slowest:.3}…{fastest:.3} m/s, {:.1} mm off its line",
                speed(&seen, 2499),
                off_m * 1e3
            );
            assert!(slowest > 0.25 && fastest < 0.52 && off_m < 0.025, "plant {number}, {name}");
        }
    }
}

#[test]
fn what_only_the_old_mode_wanted_stops_by_the_cylinders_accelerations() {
    let full_levers = (Request::Levers, [0, 0, 24_000, 0], STANDS);
    for number in 0..3 {
        let stands = (Request::TipVelocity, [0; 4], STANDS);
        let seen = ticks(&mut OnOil::at_tip(&plant(number), START), &[(full_levers, 1200), (stands, 2000)]);
        let told = seen[1199].outputs.speeds.arm;
        // Slower than this, corrections are under way.
        let until = seen[1200..].iter().position(|one| one.outputs.speeds.arm.abs() < 0.03).expect("it stops");
        let (from, end) = (seen[1500].tip, seen[3199].tip);
        let back_m = libm::hypot(end[0] - from[0], end[1] - from[1]);
        println!("plant {number}: told {told:.3} m/s, slow after {until} ms; then {:.0} mm of the tip", back_m * 1e3);
        assert!(told > 0.15 && until < 250, "plant {number}: {told} {until}");
    }
}

#[test]
fn a_tip_that_is_led_to_rest_stays_there_and_its_coils_are_still() {
    for number in 0..3 {
        let stands = (Request::TipVelocity, [0; 4], STANDS);
        // Seconds to come to rest, then eight at which is looked: enable drops after ten.
        let seen = ticks(&mut OnOil::at_tip(&plant(number), START), &[(LED, 2500), (stands, 9500)]);
        let rest = &seen[6000..];
        let currents = |one: &Seen| one.outputs.currents;
        let changes = rest.windows(2).filter(|pair| currents(&pair[0]) != currents(&pair[1])).count();
        let starts =
            rest.windows(2).filter(|pair| currents(&pair[0]) == [[0.0; 2]; 4] && currents(&pair[1]) != [[0.0; 2]; 4]);
        let starts = starts.count();
        let heights = || rest.iter().map(|one| one.tip[1]);
        let wander_m = heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min);
        println!(
            "plant {number}: {changes} changes of current, {starts} starts in 6 s; {:.1} mm of height",
            wander_m * 1e3
        );
        // A cylinder that leaks may be brought back once.
        assert!(starts <= 1 && changes < 1500 && wander_m < 0.02, "plant {number}");
    }
}

#[test]
fn full_levers_slow_down_before_every_end_of_a_stroke() {
    for (name, lever, index, from) in [
        ("boom extends", [0, 32_767, 0, 0], 0, [0.5, 0.5, 0.5]),
        ("boom retracts", [0, -32_767, 0, 0], 0, [0.5, 0.1, 0.5]),
        ("arm extends", [0, 0, 32_767, 0], 1, [0.8, 0.3, 0.5]),
        ("arm retracts", [0, 0, -32_767, 0], 1, [0.8, 0.6, 0.5]),
        ("bucket extends", [0, 0, 0, 32_767], 2, [0.8, 0.5, 0.4]),
        ("bucket retracts", [0, 0, 0, -32_767], 2, [0.8, 0.5, 0.6]),
    ] {
        let scenario = plant(0);
        let g = &scenario.parameters.geometry;
        let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
        let at: [f64; 3] = std::array::from_fn(|i| strokes[i].min_m + from[i] * (strokes[i].max_m - strokes[i].min_m));
        let seen = ticks(&mut OnOil::at_lengths(&scenario, at), &[((Request::Levers, lever, STANDS), 6000)]);
        let length = |one: &Seen| [one.lengths.boom, one.lengths.arm, one.lengths.bucket][index];
        let extends = lever.iter().sum::<i16>() > 0;
        let left =
            |one: &Seen| if extends { strokes[index].max_m - length(one) } else { length(one) - strokes[index].min_m };
        let speed = |at: usize| (length(&seen[at]) - length(&seen[at - 10])).abs() / 0.01;
        let fastest = (10..6000).map(speed).fold(0.0, f64::max);
        // The last millimetre is the plant's own cushion.
        let arrives = (10..6000).find(|&at| left(&seen[at]) < 0.001).map_or(0.0, speed);
        println!("{name}: {fastest:.3} m/s, {arrives:.3} m/s a millimetre before its end");
        assert!(fastest > 0.1 && arrives < 0.5 * fastest, "{name}");
    }
}
