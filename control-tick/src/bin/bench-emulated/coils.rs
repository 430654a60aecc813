//! The coil stage: all four spools driven with dither, and all of them off.

use core::hint::black_box;

use firmware::io::{Solenoids, Speeds};
use firmware::parameters::{Coil, ValveDirection};
use firmware::supervisor::Gate;
use firmware::valve::coil_stage::{CoilStage, CoilStageParameters, CoilsDriven};

use crate::bench::{Out, row};
use crate::emulated::fail;
use crate::emulated::stopwatch::Stopwatch;

type Tick = (Gate, Speeds, [Solenoids<u16>; 4]);

#[inline(never)]
fn drive(stage: &mut CoilStage, (gate, speeds, codes): &Tick) -> CoilsDriven {
    stage.drive(*gate, speeds, 24.0, codes)
}

pub(crate) fn coils(out: &mut Out, stopwatch: &Stopwatch) {
    let valve = ValveDirection { dead_band: 0.15, full_speed: 0.5 };
    let coil = Coil { full_scale_a: 1.2, resistance_ohm: 5.3 };
    let mut parameters = CoilStageParameters::plain(&[[valve; 2]; 4], &coil, 0.1);
    for spool in &mut parameters.spools {
        (spool.dither.amplitude_a, spool.dither.fade_below_a) = (0.05, 0.3);
    }
    let zero = parameters.sense.zero_code;
    let Ok(stage) = CoilStage::new(&parameters) else { fail() };
    let mut stage = black_box(stage);
    let driven = |t: f32| -> Tick {
        let current = (t * 30_000.0) as u16;
        (Gate::Open, Speeds::from_array([0.5 * t + 0.01; 4]), [[zero.saturating_add(current), zero]; 4])
    };
    row(out, stopwatch, "coil_stage_driven", driven, |tick| drive(&mut stage, tick));
    let off = |_: f32| -> Tick { (Gate::Open, Speeds::ZERO, [[zero; 2]; 4]) };
    row(out, stopwatch, "coil_stage_dying", off, |tick| drive(&mut stage, tick));
    for _ in 0..500 {
        drive(&mut stage, &off(0.0));
    }
    row(out, stopwatch, "coil_stage_off", off, |tick| drive(&mut stage, tick));
}
