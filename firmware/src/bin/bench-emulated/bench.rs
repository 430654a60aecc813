//! Each map behind a call that is not inlined, its input unknown to the compiler, over poses all along the strokes.

use core::fmt::Write;
use core::hint::black_box;

use cortex_m_rt::entry;
use kinematics_core::cylinder_jacobian::CylinderJacobian;
use kinematics_core::jacobian::Twist;
use kinematics_core::rates::{CylinderRates, MomentArms};
use kinematics_core::{Cylinders, Machine, PinGeometry, PlaneTip, Pose, PoseError, Rotor, Singular};
use stm32f4::stm32f405::Peripherals;

use crate::emulated::link::Link;
use crate::emulated::stopwatch::Stopwatch;
use crate::emulated::{fail, succeed};

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
fn rotor_from_turns(turns: f32) -> Rotor<f32> {
    Rotor::from_turns(turns)
}

struct Out(Link);

impl Write for Out {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        self.0.write(text.as_bytes()).map_err(|_| core::fmt::Error)
    }
}

/// Runs `map` on each of [`RUNS`] inputs and writes the line.
fn row<I, O>(out: &mut Out, stopwatch: &Stopwatch, name: &str, input: impl Fn(f32) -> I, map: impl Fn(&I) -> O) {
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
    row(&mut out, s, "moment_arms", along, |c| moment_arms(m, c));
    let jacobian = |t: f32| match m.cylinders_to_tip_with_jacobian(&along(t), swing) {
        Ok((_, jacobian)) => jacobian,
        Err(_) => fail(),
    };
    let twist = black_box(Twist { reach: -0.5, height: 0.1, pitch: 0.2 });
    row(&mut out, s, "tip_twist_to_cylinder_rates", jacobian, |j| tip_twist_to_cylinder_rates(j, &twist));
    let tip = |t: f32| m.cylinders_to_tip_unchecked(&along(t), swing).plane;
    row(&mut out, s, "tip_to_cylinders", tip, |tip| tip_to_cylinders(m, tip));
    row(&mut out, s, "rotor_from_turns", |t| t - 0.5, |t| rotor_from_turns(*t));
    succeed()
}
