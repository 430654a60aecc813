//! What the machine is doing when something breaks.

use kinematics_core::geometry::Stroke;
use serde::Serialize;

use crate::machine_file::MachineFile;
use crate::scenario::{LeverMove, Scenario, Start, Task};

/// Full speeds of a 20 t excavator, as the time a whole stroke takes, s.
const STROKE_TIMES_S: [f64; 3] = [4.3, 3.4, 1.75];
/// The levers move from here on, s.
pub(super) const BEGIN_S: f64 = 0.4;
/// The end, s.
pub(super) const DURATION_S: f64 = 5.0;

/// What the machine is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Situation {
    /// Enabled, levers in neutral.
    Idle,
    /// A fifth of full speed.
    Slow,
    /// Full speed.
    FullSpeed,
    /// All cylinders move, back and forth, as in a dig.
    Digging,
    /// Full lever against an end stop.
    EndStop,
}

impl Situation {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Idle, Self::Slow, Self::FullSpeed, Self::Digging, Self::EndStop];
}

/// The cylinder that moves: spool 1 to 3, and which way: 0 extending, 1 retracting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Mover {
    pub(super) spool: usize,
    pub(super) side: usize,
}

/// A scenario of levers on this machine: on its hydraulics where the file has them.
pub(crate) fn working(
    machine: &MachineFile,
    start: Start,
    duration_s: f64,
    payload_kg: f64,
) -> Result<Scenario, String> {
    let g = &machine.geometry;
    let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
    let speed = |i: usize| (strokes[i].max_m - strokes[i].min_m) / STROKE_TIMES_S[i];
    let plant = if machine.hydraulics.is_some() {
        format!("model = \"hydraulic\"\npayload_kg = {payload_kg}\n")
    } else {
        format!(
            "dead_time_s = 0.1\nspool_lag_s = 0.05\ndead_band_extend = 0.15\ndead_band_retract = 0.20\nswing_speed_rad_s = 1.2\n\
             boom_speed_mps = {}\narm_speed_mps = {}\nbucket_speed_mps = {}\nretract_speed_ratio = 0.8\n",
            speed(0),
            speed(1),
            speed(2)
        )
    };
    let text = format!(
        "name = \"fault\"\ndescription = \"something breaks\"\nmachine = \"exact-mini\"\nduration_s = {duration_s}\n\
         [operator]\nenable_s = 0.2\nbegin_s = {BEGIN_S}\n\
         [start]\nswing_deg = 0.0\nboom_m = 1.1\narm_m = 1.3\nbucket_m = 1.0\n\
         [[lever]]\nat_s = 0.0\nuntil_s = 1.0\nswing = 0.0\nboom = 0.0\narm = 0.0\nbucket = 0.0\n\
         [motion]\npreview_s = 0.15\ngain_per_s = 2.0\nsmallest_speed_mps = 0.002\nstart_tolerance_m = 0.02\n\
         following_error_m = 0.1\n\
         [plant]\n{plant}coil_full_scale_a = 1.2\ncoil_resistance_ohm = 5.3\ncoil_inductance_h = 0.1\n\
         supply_v = 24.0\nsensor_noise_m = 0.0001\n"
    );
    Scenario::of_machine(&text, machine.clone(), start)
}

/// The machine's scenario in a situation; the levers are in neutral from `released_s` on.
pub(super) fn scenario(
    machine: &MachineFile,
    situation: Situation,
    mover: Mover,
    released_s: f64,
) -> Result<Scenario, String> {
    let g = &machine.geometry;
    let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
    // Room for the motion of the whole run, or none.
    let [extending, at_stop] = [mover.side == 0, situation == Situation::EndStop];
    let place = |i: usize| {
        let Stroke { min_m, max_m } = strokes[i];
        let share = match (i + 1 == mover.spool, extending, at_stop) {
            (false, ..) => 0.5,
            (true, true, false) => 0.12,
            (true, true, true) => 1.0,
            (true, false, false) => 0.88,
            (true, false, true) => 0.0,
        };
        min_m + share * (max_m - min_m)
    };
    let start = Start { swing_deg: 0.0, boom_m: place(0), arm_m: place(1), bucket_m: place(2) };
    let mut scenario = working(machine, start, DURATION_S, 500.0)?;
    let mut moves = moves(situation, mover);
    moves.retain(|lever| lever.at_s < released_s);
    moves.iter_mut().for_each(|lever| lever.until_s = lever.until_s.min(released_s));
    scenario.task = Task::Levers { start, moves };
    Ok(scenario)
}

fn moves(situation: Situation, mover: Mover) -> Vec<LeverMove> {
    let sign = if mover.side == 0 { 1.0 } else { -1.0 };
    let lever = |at_s: f64, until_s: f64, deflections: [f64; 3]| {
        let [boom, arm, bucket] = deflections;
        LeverMove { at_s, until_s, swing: 0.0, boom, arm, bucket }
    };
    let alone = |deflection: f64| {
        let mut deflections = [0.0; 3];
        deflections[mover.spool - 1] = sign * deflection;
        lever(BEGIN_S, DURATION_S, deflections)
    };
    match situation {
        Situation::Idle => vec![alone(0.0)],
        Situation::Slow => vec![alone(0.2)],
        Situation::FullSpeed | Situation::EndStop => vec![alone(1.0)],
        Situation::Digging => (0..4)
            .map(|i| {
                let at_s = BEGIN_S + 0.9 * f64::from(i);
                let turn = if i % 2 == 0 { 0.4 } else { -0.3 };
                let mut deflections = [turn; 3];
                // The one in motion keeps its way.
                deflections[mover.spool - 1] = sign * (0.3 + 0.1 * f64::from(i));
                lever(at_s, at_s + 0.9, deflections)
            })
            .collect(),
    }
}
