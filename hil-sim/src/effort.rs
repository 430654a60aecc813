//! Least effort against minimum norm: the same moves on a machine, each with both functionals.

use std::fmt::Write;

use kinematics_core::planning::effort::{Effort, Piston, PumpEnergy};
use kinematics_core::planning::minimum_norm::minimum_norm_pitches;
use kinematics_core::planning::pitch_plan::{PathMove, plan_path, profile};
use kinematics_core::planning::pitch_rule::PitchRule;
use kinematics_core::planning::tip_path::TipPath;
use kinematics_core::{Cylinders, Machine, Rotor, Vec2};
use serde::Serialize;

use crate::machine_file::MachineFile;

/// Knots of a path.
pub const KNOTS: usize = 33;

/// The bucket may turn this much from knot to knot, turns.
const TURN_PER_KNOT: f64 = 0.02;

/// Bounded means this far to either side of the start's pitch, turns.
const BOUND: f64 = 30.0 / 360.0;

/// Moves from shares of the strokes (boom, arm, bucket) to the tip of others, straight or by an arc.
const MOVES: [(&str, [f64; 3], [f64; 3]); 6] = [
    ("draw in", [0.45, 0.35, 0.5], [0.45, 0.7, 0.5]),
    ("reach out", [0.5, 0.75, 0.6], [0.5, 0.3, 0.6]),
    ("lift", [0.3, 0.5, 0.6], [0.7, 0.5, 0.6]),
    ("lower", [0.7, 0.4, 0.4], [0.3, 0.5, 0.4]),
    ("to the truck", [0.35, 0.7, 0.8], [0.75, 0.4, 0.7]),
    ("back to the cut", [0.75, 0.4, 0.2], [0.35, 0.35, 0.3]),
];

/// One move with one functional and one rule.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The machine.
    pub machine: String,
    /// The move.
    pub path: &'static str,
    /// Length of the tip's path, m.
    pub length_m: f64,
    /// `travel` (m) or `energy` (J).
    pub functional: &'static str,
    /// `free` or `bounded`.
    pub pitch: &'static str,
    /// Of the plan; none where no pitch keeps to the strokes.
    pub least: Option<f64>,
    /// Of the minimum-norm solution; none where that leaves stroke, bounds or turning.
    pub minimum_norm: Option<f64>,
    /// With the pitch of the start kept; none where that leaves the strokes.
    pub kept_pitch: Option<f64>,
    /// What the plan saves against minimum norm, percent.
    pub saved_percent: Option<f64>,
}

/// What the pump works with, where a machine's cylinders are known: boom twice, arm, bucket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hydraulics {
    /// Pistons of boom, arm, bucket.
    pub pistons: [Piston; 3],
    /// Pump pressure, Pa.
    pub pressure_pa: f64,
    /// The pump's share in lowering the boom.
    pub boom_lowering_share: f64,
}

impl Hydraulics {
    fn effort(&self) -> Option<Effort<f64>> {
        let lowering = [1.0, self.boom_lowering_share];
        Effort::pump_energy(&PumpEnergy {
            pressure_pa: self.pressure_pa,
            areas_m2: self.pistons.map(|piston| piston.areas_m2()),
            pump_share: [lowering, [1.0; 2], [1.0; 2]],
        })
        .ok()
    }
}

/// All moves of a machine; `progress` hears of each done.
pub fn rows(machine: &MachineFile, hydraulics: Option<&Hydraulics>, mut progress: impl FnMut()) -> Vec<Row> {
    let g = &machine.geometry;
    let Ok(maps) = Machine::<f64>::new(g) else { return Vec::new() };
    let at = |[boom, arm, bucket]: [f64; 3]| {
        let along =
            |stroke: kinematics_core::geometry::Stroke, share| stroke.min_m + share * (stroke.max_m - stroke.min_m);
        let lengths = Cylinders {
            boom: along(g.boom.stroke, boom),
            arm: along(g.arm.stroke, arm),
            bucket: along(g.bucket.stroke, bucket),
        };
        maps.cylinders_to_tip_unchecked(&lengths, Rotor::IDENTITY).plane
    };
    let travel = Effort::travel([1.0; 3]).ok().map(|effort| ("travel", effort));
    let energy = hydraulics.and_then(Hydraulics::effort).map(|effort| ("energy", effort));
    let mut rows = Vec::new();
    for (name, from, to) in MOVES {
        let (start, end) = (at(from), at(to));
        let path = TipPath::<f64, KNOTS>::line(Vec2::new(start.reach, start.height), Vec2::new(end.reach, end.height));
        let pitch = start.pitch.angle() / std::f64::consts::TAU;
        for (functional, effort) in travel.iter().chain(&energy) {
            let bounded = PitchRule::Bounded { lower: pitch - BOUND, upper: pitch + BOUND };
            for (rule_name, rule) in [("free", PitchRule::Free), ("bounded", bounded)] {
                let request = PathMove { path, start_pitch_turns: pitch, rule, turn_per_knot: TURN_PER_KNOT };
                let least = plan_path(&maps, &request, effort, |_| true).ok().map(|plan| plan.cost);
                let cost = |pitches: [f64; KNOTS]| profile(&maps, &request, effort, &pitches, |_| true).map(|p| p.cost);
                let minimum_norm = minimum_norm_pitches(&maps, &path, pitch).and_then(cost);
                let saved = least.zip(minimum_norm).map(|(least, usual)| 100.0 * (1.0 - least / usual));
                rows.push(Row {
                    machine: machine.name.clone(),
                    path: name,
                    length_m: path.length(),
                    functional,
                    pitch: rule_name,
                    least,
                    minimum_norm,
                    kept_pitch: cost([pitch; KNOTS]),
                    saved_percent: saved,
                });
            }
        }
        progress();
    }
    rows
}

/// How many moves a machine makes.
pub const fn moves() -> usize {
    MOVES.len()
}

/// The rows as text.
pub fn table(rows: &[Row]) -> String {
    let mut out = format!(
        "{:<11} {:<16} {:>6}  {:<11} {:<8} {:>9} {:>9} {:>10} {:>7}\n",
        "machine", "move", "m", "functional", "pitch", "least", "min norm", "pitch kept", "saved"
    );
    for row in rows {
        // Joules are shown as kilojoules.
        let (unit, scale) = if row.functional == "energy" { ("energy, kJ", 1e-3) } else { ("travel, m", 1.0) };
        let number = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| format!("{:.3}", x * scale));
        let saved = row.saved_percent.map_or_else(|| "–".to_owned(), |p| format!("{p:.1} %"));
        let _ = writeln!(
            out,
            "{:<11} {:<16} {:>6.2}  {:<11} {:<8} {:>9} {:>9} {:>10} {:>7}",
            row.machine,
            row.path,
            row.length_m,
            unit,
            row.pitch,
            number(row.least),
            number(row.minimum_norm),
            number(row.kept_pitch),
            saved
        );
    }
    out + "–: leaves a stroke, the pitch's bounds, or turns the bucket faster than 7.2° a knot\n"
}
