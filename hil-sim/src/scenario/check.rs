//! Every number of a scenario within its range, by name.

use super::file::{Dig, Obstacle, PitchRule, PlannedMove, Reach, ScenarioFile};

/// The name becomes the report's folder.
fn name(name: &str) -> Result<(), String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if !name.is_empty() && name.len() <= 64 && !name.starts_with('.') && name.chars().all(plain) {
        Ok(())
    } else {
        Err(format!("`name` is {name:?} but must be 1 to 64 of A–Z, a–z, 0–9, `-`, `_`, `.`, the first not `.`"))
    }
}

/// Each value within its range, by its field's name.
pub(crate) fn within(checks: &[(&str, f64, [f64; 2])]) -> Result<(), String> {
    for &(field, value, [low, high]) in checks {
        // Written so that NaN fails.
        if !(value >= low && value <= high) {
            return Err(format!("`{field}` is {value} but must be within {low}…{high}"));
        }
    }
    Ok(())
}

pub(super) fn ranges(s: &ScenarioFile) -> Result<(), String> {
    name(&s.name)?;
    let run = [0.0, s.duration_s];
    let (o, m, p) = (&s.operator, &s.motion, &s.plant);
    within(&[
        ("duration_s", s.duration_s, [0.01, 600.0]),
        ("operator.enable_s", o.enable_s, run),
        ("operator.begin_s", o.begin_s, run),
        ("motion.preview_s", m.preview_s, [0.0, 1.0]),
        ("motion.gain_per_s", m.gain_per_s, [0.0, 20.0]),
        ("motion.smallest_speed_mps", m.smallest_speed_mps, [0.0, 0.1]),
        ("motion.start_tolerance_m", m.start_tolerance_m, [0.001, 0.5]),
        ("motion.following_error_m", m.following_error_m, [m.start_tolerance_m, 0.5]),
    ])?;
    p.check()?;
    if o.begin_s <= o.enable_s {
        return Err(format!(
            "`operator.begin_s` is {} but must be after `operator.enable_s`, {}: enabling needs levers in neutral",
            o.begin_s, o.enable_s
        ));
    }
    let needed_v = p.coil_full_scale_a * p.coil_resistance_ohm;
    if needed_v > p.supply_v {
        return Err(format!(
            "`plant.supply_v` is {} but full-scale current through `plant.coil_resistance_ohm` needs {needed_v} V",
            p.supply_v
        ));
    }
    if let Some(dig) = &s.dig {
        dig_ranges(dig)?;
    }
    if let Some(planned) = &s.planned_move {
        move_ranges(planned)?;
    }
    if let Some(reach) = &s.reach {
        reach_ranges(reach)?;
    }
    for (i, obstacle) in s.obstacle.iter().enumerate() {
        obstacle_ranges(i, obstacle)?;
    }
    s.law.map_or(Ok(()), |law| law.check())?;
    for (i, tip) in s.tip.iter().enumerate() {
        tip.check(s.duration_s).map_err(|what| format!("`tip[{i}]`: {what}"))?;
    }
    for (i, lever) in s.lever.iter().enumerate() {
        lever.check(s.duration_s).map_err(|what| format!("`lever[{i}]`: {what}"))?;
    }
    for (i, event) in s.event.iter().enumerate() {
        event.check(s.duration_s).map_err(|what| format!("`event[{i}]`: {what}"))?;
    }
    Ok(())
}

fn dig_ranges(d: &Dig) -> Result<(), String> {
    let far = [-50.0, 50.0];
    let length = [0.01, 50.0];
    let turn = [-720.0, 720.0];
    within(&[
        ("dig.samples", f64::from(d.samples), [10.0, 100_000.0]),
        ("dig.start_x_m", d.start_x_m, far),
        ("dig.start_z_m", d.start_z_m, far),
        ("dig.ground_z_m", d.ground_z_m, far),
        ("dig.reach_m", d.reach_m, length),
        ("dig.plunge_m", d.plunge_m, length),
        ("dig.scoop_m", d.scoop_m, length),
        ("dig.scoop_end_deg", d.scoop_end_deg, [-360.0, 360.0]),
        ("dig.start_pitch_deg", d.start_pitch_deg, turn),
        ("dig.reach_pitch_deg", d.reach_pitch_deg, turn),
        ("dig.plunge_pitch_deg", d.plunge_pitch_deg, turn),
        ("dig.scoop_pitch_deg", d.scoop_pitch_deg, turn),
        ("dig.scoop_until_s", d.scoop_until_s, [0.1, 600.0]),
        ("dig.plunge_until_s", d.plunge_until_s, [0.05, d.scoop_until_s - 0.01]),
        ("dig.reach_until_s", d.reach_until_s, [0.01, d.plunge_until_s - 0.01]),
    ])
}

fn move_ranges(m: &PlannedMove) -> Result<(), String> {
    let far = [-50.0, 50.0];
    let bore = [0.01, 1.0];
    within(&[
        ("move.start_x_m", m.start_x_m, far),
        ("move.start_z_m", m.start_z_m, far),
        ("move.start_pitch_deg", m.start_pitch_deg, [-720.0, 720.0]),
        ("move.target_x_m", m.target_x_m, far),
        ("move.target_z_m", m.target_z_m, far),
        ("move.turn_per_knot_deg", m.turn_per_knot_deg, [0.01, 90.0]),
        ("move.speed_share", m.speed_share, [0.01, 1.0]),
        ("move.acceleration_mps2", m.acceleration_mps2, [0.01, 100.0]),
        ("move.jerk_mps3", m.jerk_mps3, [0.01, 1000.0]),
        ("move.boom_bore_m", m.boom_bore_m, bore),
        ("move.boom_rod_m", m.boom_rod_m, [0.0, m.boom_bore_m]),
        ("move.boom_cylinders", f64::from(m.boom_cylinders), [1.0, 4.0]),
        ("move.arm_bore_m", m.arm_bore_m, bore),
        ("move.arm_rod_m", m.arm_rod_m, [0.0, m.arm_bore_m]),
        ("move.bucket_bore_m", m.bucket_bore_m, bore),
        ("move.bucket_rod_m", m.bucket_rod_m, [0.0, m.bucket_bore_m]),
        ("move.flow_lpm", m.flow_lpm, [0.1, 10_000.0]),
    ])?;
    match (m.pitch, m.lower_deg, m.upper_deg) {
        (PitchRule::Bounded, Some(lower), Some(upper)) => within(&[
            ("move.lower_deg", lower, [-720.0, m.start_pitch_deg]),
            ("move.upper_deg", upper, [m.start_pitch_deg, 720.0]),
        ]),
        (PitchRule::Bounded, ..) => {
            Err("`move.lower_deg` and `move.upper_deg` are needed with `pitch = \"bounded\"`".to_owned())
        }
        (_, None, None) => Ok(()),
        _ => Err("`move.lower_deg` and `move.upper_deg` go with `pitch = \"bounded\"` alone".to_owned()),
    }
}

fn reach_ranges(r: &Reach) -> Result<(), String> {
    let far = [-50.0, 50.0];
    let speed = [0.001, 4.0];
    within(&[
        ("reach.target_x_m", r.target_x_m, far),
        ("reach.target_y_m", r.target_y_m, far),
        ("reach.target_z_m", r.target_z_m, far),
        ("reach.tolerance_m", r.tolerance_m, [0.001, 1.0]),
        ("reach.swing_rad_s", r.swing_rad_s, speed),
        ("reach.boom_rad_s", r.boom_rad_s, speed),
        ("reach.arm_rad_s", r.arm_rad_s, speed),
        ("reach.bucket_rad_s", r.bucket_rad_s, speed),
    ])
}

fn obstacle_ranges(number: usize, o: &Obstacle) -> Result<(), String> {
    let far = [-50.0, 50.0];
    let fields = [("x_m", o.x_m, far), ("y_m", o.y_m, far), ("z_m", o.z_m, far), ("radius_m", o.radius_m, [0.0, 50.0])];
    fields
        .into_iter()
        .try_for_each(|(field, value, range)| within(&[(&format!("obstacle[{number}].{field}"), value, range)]))
}
