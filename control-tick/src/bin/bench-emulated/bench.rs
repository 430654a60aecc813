//! Each map behind a call that is not inlined, its input unknown to the compiler, over poses all along the strokes.

use core::cell::RefCell;
use core::fmt::Write;
use core::hint::black_box;

use bench::seed::single::Dimensions;
use bench::{bits, ours};
use cortex_m_rt::entry;
use kinematics_core::chain_n::PlanarChain;
use kinematics_core::cylinder_jacobian::CylinderJacobian;
use kinematics_core::isotropy::singularity_distance;
use kinematics_core::jacobian::Twist;
use kinematics_core::joint_range::JointRange;
use kinematics_core::planning::avoid::{Aim, Avoid, AvoidParameters, Step};
use kinematics_core::planning::cylinder_path::{CylinderPath, PathPoint};
use kinematics_core::planning::effort::Effort;
use kinematics_core::planning::hull::{Flesh, Hull, Sphere};
use kinematics_core::planning::move_limits::{Limits, MoveLimits};
use kinematics_core::planning::pitch_plan::{PathMove, PitchPlanner};
use kinematics_core::planning::pitch_rule::PitchRule;
use kinematics_core::planning::time_scaling::{Pace, Progress, TimeScaling};
use kinematics_core::planning::tip_path::TipPath;
use kinematics_core::rates::{CylinderRates, MomentArms};
use kinematics_core::redundancy::{Rates, Redundancy, RedundancyParameters};
use kinematics_core::{
    Cylinders, GeometryError, Joints, Machine, PinGeometry, PlaneTip, Pose, PoseError, Rotor, Singular, Vec2,
};
use stm32f4::stm32f405::Peripherals;

use crate::coils::coils;
use crate::diagnosis::diagnosis;
use crate::emulated::link::Link;
use crate::emulated::stopwatch::Stopwatch;
use crate::emulated::{fail, succeed};
use crate::fence::fence;

const RUNS: usize = 101;

#[inline(never)]
fn cylinders_to_tip(
    machine: &Machine<f32>,
    cylinders: &Cylinders<f32>,
    swing: Rotor<f32>,
) -> Result<Pose<f32>, PoseError<f32>> {
    machine.cylinders_to_tip(cylinders, swing)
}

#[inline(never)]
fn cylinders_to_tip_unchecked(machine: &Machine<f32>, cylinders: &Cylinders<f32>, swing: Rotor<f32>) -> Pose<f32> {
    machine.cylinders_to_tip_unchecked(cylinders, swing)
}

#[inline(never)]
fn cylinders_to_tip_with_jacobian(
    machine: &Machine<f32>,
    cylinders: &Cylinders<f32>,
    swing: Rotor<f32>,
) -> Result<(Pose<f32>, CylinderJacobian<f32>), PoseError<f32>> {
    machine.cylinders_to_tip_with_jacobian(cylinders, swing)
}

#[inline(never)]
fn cylinders_to_tip_with_fine_jacobian(
    machine: &Machine<f32>,
    cylinders: &Cylinders<f32>,
    swing: Rotor<f32>,
) -> Result<(Pose<f32>, CylinderJacobian<f32>), PoseError<f32>> {
    machine.cylinders_to_tip_with_fine_jacobian(cylinders, swing)
}

#[inline(never)]
fn cylinder_bias(
    machine: &Machine<f32>,
    cylinders: &Cylinders<f32>,
    rates: &CylinderRates<f32>,
) -> Result<Twist<f32>, PoseError<f32>> {
    machine.cylinder_bias(cylinders, rates)
}

#[inline(never)]
fn swing_jacobian(machine: &Machine<f32>, joints: &Joints<f32>, swing: Rotor<f32>) -> [[f32; 4]; 4] {
    machine.chain().swing_jacobian(joints, swing).matrix()
}

#[inline(never)]
fn fine_swing_jacobian(machine: &Machine<f32>, joints: &Joints<f32>, swing: Rotor<f32>) -> [[f32; 4]; 4] {
    machine.chain().fine_swing_jacobian(joints, swing).matrix()
}

#[inline(never)]
fn moment_arms(machine: &Machine<f32>, cylinders: &Cylinders<f32>) -> Result<MomentArms<f32>, PoseError<f32>> {
    machine.moment_arms(cylinders)
}

#[inline(never)]
fn tip_twist_to_cylinder_rates(
    jacobian: &CylinderJacobian<f32>,
    twist: &Twist<f32>,
) -> Result<CylinderRates<f32>, Singular> {
    jacobian.cylinder_rates(twist)
}

#[inline(never)]
fn tip_to_cylinders(machine: &Machine<f32>, tip: &PlaneTip<f32>) -> Result<Cylinders<f32>, PoseError<f32>> {
    machine.tip_to_cylinders(tip)
}

#[inline(never)]
fn angles_cylinders_to_tip(seed: &Dimensions, cylinders: &[f32; 3]) -> [f32; 3] {
    seed.cylinders_to_tip(0.3, *cylinders)
}

#[inline(never)]
fn angles_tip_to_cylinders(seed: &Dimensions, tip: &[f32; 3]) -> [f32; 3] {
    seed.tip_to_cylinders(*tip)
}

/// The maps of another bucket.
#[inline(never)]
fn machine_new(geometry: &PinGeometry) -> Result<Machine<f32>, GeometryError> {
    Machine::new(geometry)
}

#[inline(never)]
fn rotor_from_turns(turns: f32) -> Rotor<f32> {
    Rotor::from_turns(turns)
}

#[inline(never)]
fn singularity_distance_3(jacobian: &[[f32; 3]; 2]) -> f32 {
    singularity_distance(jacobian)
}

/// Joints, tip velocity and second wish, all unknown to the compiler.
type Motion = ([Rotor<f32>; 3], Vec2<f32>, [f32; 3]);

#[inline(never)]
fn redundancy_3(redundancy: &Redundancy<f32, 3>, (joints, velocity, wish): &Motion) -> Rates<f32, 3> {
    redundancy.rates(joints, *velocity, wish)
}

/// Knots of the planning rows' path, as of the controller's moves.
const KNOTS: usize = 17;

#[inline(never)]
fn time_scaling_step(scaling: &TimeScaling<f32>, pace: &mut Pace<f32>) -> Progress<f32> {
    scaling.advance(pace, 1.0)
}

#[inline(never)]
fn cylinder_path_at(path: &CylinderPath<f32, KNOTS>, s: f32) -> PathPoint<f32> {
    path.at(s)
}

#[inline(never)]
fn planning_step(planner: &mut PitchPlanner<f32, KNOTS>, machine: &Machine<f32>) -> bool {
    planner.step(machine, |_| true).is_ok()
}

/// Following a planned move, and planning it: a knot a step, here those of the first passes.
fn planning(out: &mut Out, stopwatch: &Stopwatch, machine: &Machine<f32>) -> Option<()> {
    let limits = Limits::new(&MoveLimits {
        speed_mps: [[0.2; 2]; 3],
        acceleration_mps2: [0.5; 3],
        jerk_mps3: [5.0; 3],
        areas_m2: [[0.005, 0.003]; 3],
        flow_m3ps: 0.001,
    })
    .ok()?;
    let path = TipPath::line(Vec2::new(2.6, -0.5), Vec2::new(1.8, -0.5));
    let request = PathMove { path, start_pitch_turns: -0.3, rule: PitchRule::Free, turn_per_knot: 0.03 };
    let effort = Effort::travel([1.0; 3]).ok()?;
    let planner = RefCell::new(PitchPlanner::new(machine, &request, effort, |_| true).ok()?);
    let plan = |_: &f32| planning_step(&mut planner.borrow_mut(), machine);
    row(out, stopwatch, "planning_step", |t| t, plan);

    let at =
        |share: f32| Cylinders { boom: 1.0 + 0.2 * share, arm: 1.2 + 0.3 * share * share, bucket: 1.2 - 0.3 * share };
    let path = CylinderPath::new(&core::array::from_fn::<_, KNOTS, _>(|i| at(i as f32 / 16.0)), &limits)?;
    let mut scaling = TimeScaling::standstill();
    scaling.plan(&path, &limits, 0.001).ok()?;
    let pace = RefCell::new(Pace::start());
    // Every twentieth tick from start to end.
    let run = |_: f32| {
        for _ in 0..19 {
            scaling.advance(&mut pace.borrow_mut(), 1.0);
        }
    };
    row(out, stopwatch, "time_scaling_step", run, |()| time_scaling_step(&scaling, &mut pace.borrow_mut()));
    row(out, stopwatch, "cylinder_path_at", |t| t, |s| cylinder_path_at(&path, *s));
    Some(())
}

/// One planning step with two obstacles, both close enough to be heeded.
#[inline(never)]
fn avoid_step_2(avoid: &Avoid<f32>, joints: &[Rotor<f32>; 4], aim: &Aim<f32>, balls: &[Sphere<f32>; 2]) -> Step<f32> {
    avoid.step(joints, aim, balls)
}

pub(crate) struct Out(Link);

impl Write for Out {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        self.0.write(text.as_bytes()).map_err(|_| core::fmt::Error)
    }
}

/// Runs `map` on each of [`RUNS`] inputs and writes the line.
pub(crate) fn row<I, O>(
    out: &mut Out,
    stopwatch: &Stopwatch,
    name: &str,
    input: impl Fn(f32) -> I,
    mut map: impl FnMut(&I) -> O,
) {
    let mut counts = [0; RUNS];
    for (i, count) in counts.iter_mut().enumerate() {
        let input = black_box(input(i as f32 / (RUNS - 1) as f32));
        let before = stopwatch.now_ns();
        let result = map(&input);
        let after = stopwatch.now_ns();
        black_box(&result);
        *count = stopwatch.instructions(before, after);
    }
    counts.sort_unstable();
    if writeln!(out, "{name} {} {}", counts[RUNS / 2], counts[RUNS - 1]).is_err() {
        fail();
    }
}

/// The papers' formulas with libm, on the paper's machine, inches.
fn angles(out: &mut Out, stopwatch: &Stopwatch) {
    let seed = black_box(Dimensions::new());
    let strokes = [(29.0, 46.5434), (27.699, 41.9298), (22.0242, 38.6144)];
    let along = |t: f32| strokes.map(|(min, max)| min + (0.01 + 0.98 * t) * (max - min));
    row(out, stopwatch, "angles_cylinders_to_tip", along, |c| angles_cylinders_to_tip(&seed, c));
    let tip = |t: f32| {
        let joints = seed.cyl_to_joint(along(t));
        let [x, _, z] = seed.jdisp(0.0, joints);
        [x, z, joints[0] + joints[1] + joints[2]]
    };
    row(out, stopwatch, "angles_tip_to_cylinders", tip, |tip| angles_tip_to_cylinders(&seed, tip));
}

/// What the fixed-point kernels come to, bit for bit: no rows, but lines for the test to compare with the host's.
fn bits(out: &mut Out) {
    let Ok(frankel) = ours::frankel().to_pins() else { fail() };
    for (name, geometry) in [("exact-mini", PinGeometry::EXACT_MINI), ("frankel", frankel)] {
        let Some((hash, answered)) = bits::fine(&geometry) else { fail() };
        if writeln!(out, "# bits of the fine kernels, {name}: {hash:08x} at {answered} poses").is_err() {
            fail();
        }
    }
}

#[entry]
fn main() -> ! {
    let Some(peripherals) = Peripherals::take() else { fail() };
    let stopwatch = Stopwatch::start(peripherals.TIM5);
    let Ok(link) = Link::open() else { fail() };
    let mut out = Out(link);
    let geometry = PinGeometry::EXACT_MINI;
    let Ok(machine) = Machine::<f32>::new(&geometry) else { fail() };
    let machine = black_box(machine);

    let [boom, arm, bucket] = [geometry.boom.stroke, geometry.arm.stroke, geometry.bucket.stroke]
        .map(|stroke| (stroke.min_m as f32, (stroke.max_m - stroke.min_m) as f32));
    let along = |t: f32| Cylinders {
        boom: boom.0 + t * boom.1,
        arm: arm.0 + (1.0 - t) * arm.1,
        bucket: bucket.0 + t * bucket.1,
    };
    let swing = black_box(Rotor::from_turns(0.1f32));
    let (m, s) = (&machine, &stopwatch);

    row(&mut out, s, "cylinders_to_tip", along, |c| cylinders_to_tip(m, c, swing));
    row(&mut out, s, "cylinders_to_tip_unchecked", along, |c| cylinders_to_tip_unchecked(m, c, swing));
    row(&mut out, s, "cylinders_to_tip_with_jacobian", along, |c| cylinders_to_tip_with_jacobian(m, c, swing));
    row(&mut out, s, "cylinders_to_tip_with_fine_jacobian", along, |c| {
        cylinders_to_tip_with_fine_jacobian(m, c, swing)
    });
    let rates = black_box(CylinderRates { boom: 0.1, arm: -0.2, bucket: 0.3 });
    row(&mut out, s, "cylinder_bias", along, |c| cylinder_bias(m, c, &rates));
    let given = |t: f32| m.cylinders_to_tip_unchecked(&along(t), swing).joints;
    row(&mut out, s, "swing_jacobian", given, |j| swing_jacobian(m, j, swing));
    row(&mut out, s, "fine_swing_jacobian", given, |j| fine_swing_jacobian(m, j, swing));
    row(&mut out, s, "moment_arms", along, |c| moment_arms(m, c));
    let jacobian = |t: f32| match m.cylinders_to_tip_with_jacobian(&along(t), swing) {
        Ok((_, jacobian)) => jacobian,
        Err(_) => fail(),
    };
    let twist = black_box(Twist { reach: -0.5, height: 0.1, pitch: 0.2 });
    row(&mut out, s, "tip_twist_to_cylinder_rates", jacobian, |j| tip_twist_to_cylinder_rates(j, &twist));
    let tip = |t: f32| m.cylinders_to_tip_unchecked(&along(t), swing).plane;
    row(&mut out, s, "tip_to_cylinders", tip, |tip| tip_to_cylinders(m, tip));
    row(&mut out, s, "machine_new", |_| geometry, |geometry| machine_new(geometry).is_ok());
    row(&mut out, s, "rotor_from_turns", |t| t - 0.5, |t| rotor_from_turns(*t));
    let end = |l: [f64; 3]| {
        let [boom, arm, bucket] = l;
        Machine::<f64>::new(&geometry)
            .map(|m| m.cylinders_to_tip_unchecked(&Cylinders { boom, arm, bucket }, Rotor::IDENTITY).joints)
    };
    let strokes = [geometry.boom.stroke, geometry.arm.stroke, geometry.bucket.stroke];
    let (Ok(short), Ok(long)) = (end(strokes.map(|s| s.min_m)), end(strokes.map(|s| s.max_m))) else { fail() };
    let ranges = [
        JointRange::between(short.boom, long.boom),
        JointRange::between(long.arm, short.arm),
        JointRange::between(long.bucket, short.bucket),
    ];
    let parameters = RedundancyParameters { ranges, mobility: [1.0; 3], trusted_m: 0.2, retreat_rad_s: 0.1 };
    let Ok(redundancy) = Redundancy::new(PlanarChain::from(m.chain()), parameters) else { fail() };
    let redundancy = black_box(redundancy);
    let joints = |t: f32| {
        let joints = m.cylinders_to_tip_unchecked(&along(t), swing).joints;
        [joints.boom, joints.arm, joints.bucket]
    };
    let chain = redundancy.chain();
    row(&mut out, s, "singularity_distance_3", |t| chain.jacobian(&joints(t)), singularity_distance_3);
    let motion = |t: f32| (joints(t), Vec2::new(0.3, -t), [0.0, -0.1, t]);
    row(&mut out, s, "redundancy_3", motion, |j| redundancy_3(&redundancy, j));
    if planning(&mut out, s, m).is_none() {
        fail();
    }
    let reach_m = geometry.reach_m();
    let Ok(hull) = Hull::new(&geometry, Flesh::of_reach(reach_m)) else { fail() };
    let limits = AvoidParameters::of_reach(reach_m, [1.1, 0.45, 1.1, 1.1]);
    let Ok(avoid) = Avoid::new(&geometry, hull, &limits) else { fail() };
    let avoid = black_box(avoid);
    let four = |t: f32| {
        let [boom, arm, bucket] = joints(t);
        [swing, boom, arm, bucket]
    };
    let aim = black_box(avoid.aim(&four(0.5)));
    let balls =
        black_box([Sphere { x: 1.0, y: 1.6, z: 0.8, radius: 0.3 }, Sphere { x: 1.6, y: 0.4, z: -0.6, radius: 0.2 }]);
    row(&mut out, s, "avoid_step_2", four, |joints| avoid_step_2(&avoid, joints, &aim, &balls));
    fence(&mut out, s, m, along);
    coils(&mut out, s);
    diagnosis(&mut out, s);
    angles(&mut out, s);
    bits(&mut out);
    succeed()
}
