//! Least effort: never worse than minimum norm, bounds and fences kept, the end of a move the best of many.

use cross_tests::jacobians::jacobian;
use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::geometry::Stroke;
use kinematics_core::planning::effort::{Effort, PumpEnergy};
use kinematics_core::planning::least_effort::least_effort;
use kinematics_core::planning::minimum_norm::minimum_norm_pitches;
use kinematics_core::planning::pitch_plan::{PathMove, PitchPlan, PlanError, plan_path, profile};
use kinematics_core::planning::pitch_rule::PitchRule;
use kinematics_core::planning::tip_path::TipPath;
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, PlaneTip, Rotor, Vec2};

const K: usize = 17;
const TURN: f64 = 0.03;

fn random_lengths(g: &PinGeometry, stream: &mut Random) -> Cylinders<f64> {
    let mut draw = |s: Stroke| s.min_m + (0.05 + 0.9 * stream.unit()) * (s.max_m - s.min_m);
    Cylinders { boom: draw(g.boom.stroke), arm: draw(g.arm.stroke), bucket: draw(g.bucket.stroke) }
}

fn place(machine: &Machine<f64>, lengths: &Cylinders<f64>) -> (Vec2<f64>, f64) {
    let tip = machine.cylinders_to_tip(lengths, Rotor::IDENTITY).expect("inside the strokes").plane;
    (Vec2::new(tip.reach, tip.height), tip.pitch.angle() / std::f64::consts::TAU)
}

fn efforts() -> [Effort<f64>; 2] {
    let areas_m2 = [[0.0226, 0.0113], [0.0143, 0.0072], [0.0113, 0.0056]];
    let pump_share = [[1.0, 0.3], [1.0; 2], [1.0; 2]];
    let pump = PumpEnergy { pressure_pa: 2e7, areas_m2, pump_share };
    [Effort::travel([1.0; 3]).expect("weights"), Effort::pump_energy(&pump).expect("a pump")]
}

/// Random straight moves of a machine, half of them bounded.
fn requests(g: &PinGeometry, machine: &Machine<f64>, count: usize, seed: u64) -> Vec<PathMove<f64, K>> {
    let mut stream = Random::new(seed);
    (0..count)
        .map(|i| {
            let (from, pitch) = place(machine, &random_lengths(g, &mut stream));
            let (to, _) = place(machine, &random_lengths(g, &mut stream));
            let bounded = PitchRule::Bounded { lower: pitch - 0.1, upper: pitch + 0.05 };
            let rule = if i % 2 == 0 { PitchRule::Free } else { bounded };
            PathMove { path: TipPath::line(from, to), start_pitch_turns: pitch, rule, turn_per_knot: TURN }
        })
        .collect()
}

/// Everything a plan promises.
fn check(machine: &Machine<f64>, request: &PathMove<f64, K>, effort: &Effort<f64>, plan: &PitchPlan<f64, K>) {
    let again =
        profile(machine, request, effort, &plan.pitch_turns, |_| true).expect("keeps to rule, turn and strokes");
    assert_eq!(again, *plan);
    assert_eq!(plan.pitch_turns[0], request.start_pitch_turns);
    for (lengths, knot) in plan.cylinders.iter().zip(request.path.knots()) {
        let (at, _) = place(machine, lengths);
        assert!((at - *knot).norm() < 1e-9, "off the path");
    }
}

#[test]
fn a_path_never_costs_more_than_minimum_norm_where_that_is_feasible_nor_than_the_pitch_kept() {
    let (mut compared, mut cheaper, mut planned) = (0, 0, 0);
    for (name, g) in machines::all().expect("four machines") {
        let machine = Machine::<f64>::new(&g).expect("valid pins");
        for request in requests(&g, &machine, 24, 5) {
            for effort in &efforts() {
                let usual = minimum_norm_pitches(&machine, &request.path, request.start_pitch_turns)
                    .and_then(|pitches| profile(&machine, &request, effort, &pitches, |_| true));
                match plan_path(&machine, &request, effort, |_| true) {
                    Ok(plan) => {
                        check(&machine, &request, effort, &plan);
                        planned += 1;
                        if let Some(usual) = usual {
                            assert!(plan.cost <= usual.cost, "{name}: {} against {}", plan.cost, usual.cost);
                            compared += 1;
                            cheaper += usize::from(plan.cost < 0.999 * usual.cost);
                        }
                        let kept = [request.start_pitch_turns; K];
                        if let Some(kept) = profile(&machine, &request, effort, &kept, |_| true) {
                            // Even steps may cost a hundredth.
                            assert!(plan.cost <= 1.02 * kept.cost, "{name}: {} against {}", plan.cost, kept.cost);
                        }
                    }
                    Err(error) => assert!(usual.is_none(), "{name}: {error}, but minimum norm gets there"),
                }
            }
        }
    }
    println!("{planned} planned, {compared} compared with minimum norm, {cheaper} cheaper by more than a thousandth");
    assert!(compared > 30 && cheaper * 2 > compared, "{compared} {cheaper}");
}

#[test]
fn a_ceiling_and_a_floor_are_kept() {
    let g = PinGeometry::EXACT_MINI;
    let machine = Machine::<f64>::new(&g).expect("valid pins");
    let effort = &efforts()[0];
    let chain = *machine.chain();
    let mut kept = 0;
    for request in requests(&g, &machine, 60, 9) {
        let Ok(open) = plan_path(&machine, &request, effort, |_| true) else { continue };
        // The bucket's pin must stay between a floor and a ceiling.
        let heights = |plan: &PitchPlan<f64, K>| {
            plan.cylinders.map(|c| chain.wrist(&machine.cylinders_to_joints(&c).expect("closes")).z)
        };
        let highest = heights(&open).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let start = heights(&open)[0];
        let ceiling = if highest > start + 0.02 { highest - 0.01 } else { continue };
        let floor = start - 1.0;
        let allowed = |joints: &Joints<f64>| (floor..=ceiling).contains(&chain.wrist(joints).z);
        if let Ok(fenced) = plan_path(&machine, &request, effort, allowed) {
            assert!(heights(&fenced).iter().all(|z| (floor..=ceiling).contains(z)));
            assert!(fenced.cost >= 0.98 * open.cost);
            kept += 1;
        }
    }
    assert!(kept > 5, "only {kept} moves met the ceiling");
}

#[test]
fn the_end_of_a_move_is_as_cheap_as_the_best_of_ten_thousand_pitches() {
    let mut found = 0;
    for (name, g) in machines::all().expect("four machines") {
        let machine = Machine::<f64>::new(&g).expect("valid pins");
        let mut stream = Random::new(17);
        for _ in 0..10 {
            let from = random_lengths(&g, &mut stream);
            let (goal, pitch) = place(&machine, &random_lengths(&g, &mut stream));
            let bounded = PitchRule::Bounded { lower: pitch - 0.05, upper: pitch + 0.1 };
            for (rule, [low, high]) in [(PitchRule::Free, [0.0, 1.0]), (bounded, [pitch - 0.05, pitch + 0.1])] {
                for effort in &efforts() {
                    let least =
                        least_effort(&machine, &from, goal, rule, effort, |_| true).expect("one pitch is known");
                    let best = (0..=10_000)
                        .filter_map(|i| {
                            let turns = low + (high - low) * f64::from(i) / 10_000.0;
                            let tip = PlaneTip { reach: goal.x, height: goal.z, pitch: Rotor::from_turns(turns) };
                            machine.tip_to_cylinders(&tip).ok().map(|c| effort.between(&from, &c))
                        })
                        .fold(f64::INFINITY, f64::min);
                    assert!(least.cost <= best * (1.0 + 1e-3), "{name}: {} against {best}", least.cost);
                    found += 1;
                }
            }
        }
    }
    assert_eq!(found, 160);
}

/// θ̇ = Jᵀ(JJᵀ)⁻¹·v, by the trigonometric Jacobian.
fn shortest_rates(lengths: [f64; 3], angles: [f64; 3], by: Vec2<f64>) -> [f64; 3] {
    let [x, z] = jacobian(lengths, angles);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [xx, xz, zz] = [dot(x, x), dot(x, z), dot(z, z)];
    let determinant = xx * zz - xz * xz;
    let (u, v) = ((zz * by.x - xz * by.z) / determinant, (xx * by.z - xz * by.x) / determinant);
    core::array::from_fn(|i| x[i] * u + z[i] * v)
}

#[test]
fn minimum_norm_pitches_are_those_of_a_fine_integration_of_the_joints() {
    let g = PinGeometry::EXACT_MINI;
    let machine = Machine::<f64>::new(&g).expect("valid pins");
    let lengths = [g.boom_m, g.arm_m, g.bucket_m];
    let start = Cylinders { boom: 1.15, arm: 1.3, bucket: 1.0 };
    let (from, pitch) = place(&machine, &start);
    let joints = machine.cylinders_to_joints(&start).expect("closes");
    for way in [Vec2::new(-0.5, 0.1), Vec2::new(0.2, -0.4), Vec2::new(-0.1, 0.5)] {
        let path = TipPath::<f64, K>::line(from, from + way);
        let found = minimum_norm_pitches(&machine, &path, pitch).expect("in reach");
        let mut angles = [joints.boom, joints.arm, joints.bucket].map(Rotor::angle);
        let first: f64 = angles.iter().sum();
        let pieces = 400;
        for (knot, planned) in found.iter().enumerate().skip(1) {
            for _ in 0..pieces {
                // Midpoints of steps fifty times finer than the planner's.
                let by = way.scale(1.0 / f64::from(pieces * (K as i32 - 1)));
                let half = shortest_rates(lengths, angles, by.scale(0.5));
                let middle = core::array::from_fn(|i| angles[i] + half[i]);
                let whole = shortest_rates(lengths, middle, by);
                angles = core::array::from_fn(|i| angles[i] + whole[i]);
            }
            let turned = (angles.iter().sum::<f64>() - first) / std::f64::consts::TAU;
            assert!((planned - pitch - turned).abs() < 2e-6, "{knot}: {} {turned}", planned - pitch);
        }
    }
}

#[test]
fn what_has_no_answer_says_so_after_the_same_work() {
    let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).expect("valid pins");
    let effort = &efforts()[0];
    let path = TipPath::<f64, K>::line(Vec2::new(2.6, -0.5), Vec2::new(4.5, -0.5));
    let beyond = PathMove { path, start_pitch_turns: -0.3, rule: PitchRule::Free, turn_per_knot: TURN };
    assert!(matches!(plan_path(&machine, &beyond, effort, |_| true), Err(PlanError::NoWay { knot }) if knot > 1));
    let wrong = PathMove { turn_per_knot: f64::NAN, ..beyond };
    assert_eq!(plan_path(&machine, &wrong, effort, |_| true), Err(PlanError::Question));
    let elsewhere = PathMove { rule: PitchRule::Fixed(0.3), ..beyond };
    assert_eq!(plan_path(&machine, &elsewhere, effort, |_| true), Err(PlanError::Start));
}
