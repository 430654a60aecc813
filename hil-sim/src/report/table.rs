//! The short table after a run.

use std::fmt::Write;
use std::path::Path;

use crate::run::Summary;

/// The summary as a table for people, and where the report is.
pub fn table(summary: &Summary, folder: &Path) -> String {
    let mut out = format!("{} on the {} ({}, seed {})\n", summary.scenario, summary.on, summary.machine, summary.seed);
    let mut row = |name: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  {name:<24} {value}");
    };
    row("ticks", summary.ticks.to_string());
    if let Some(hash) = &summary.output_hash {
        row("output hash", hash.clone());
    }
    if let Some(completed) = summary.dig_completed {
        row("dig completed", if completed { "yes" } else { "no" }.to_owned());
    }
    if let (Some(rms), Some(max)) = (summary.tip_error_rms_m, summary.tip_error_max_m) {
        row("tip error", format!("{:.1} mm RMS, {:.1} mm max", rms * 1e3, max * 1e3));
    }
    if let (Some(error), Some(clearance)) = (summary.target_error_m, summary.smallest_clearance_m) {
        row("tip from the target", format!("{:.1} mm at the end", error * 1e3));
        row("smallest clearance", format!("{:.1} mm", clearance * 1e3));
    }
    if let Some(closest) = summary.fence_clearance_min_m {
        row(if closest < 0.0 { "FENCE VIOLATED" } else { "closest to the fence" }, format!("{:.1} mm", closest * 1e3));
    }
    if let Some(room) = summary.fence_swing_room_min_deg {
        row(if room < 0.0 { "SWING BEYOND ITS RANGE" } else { "closest to a swing end" }, format!("{room:.2}°"));
    }
    if let Some(factor) = summary.real_time_factor {
        row("speed", format!("{factor:.0} × real time"));
    }
    if let Some(e) = &summary.emulator {
        let counts = e.instructions_per_tick;
        row("instructions per tick", format!("{} median, {} max", counts.median, counts.max));
        row("tick period jitter", format!("{} ns", e.tick_period_jitter_ns));
        row("stack", format!("{} bytes at its deepest", e.stack_peak_bytes));
        row("image", format!("{} bytes flash, {} bytes static RAM", e.flash_bytes, e.ram_bytes));
    }
    for violation in summary.refused.iter().flatten() {
        row("outside travel limits", violation.to_string());
    }
    for fault in summary.faults.iter().flatten() {
        row("FAULT", format!("{} (code {}) at {:.3} s", fault.fault, fault.code, fault.at_s));
    }
    for hit in summary.stop_hits.iter().flatten() {
        row("STOP HIT", format!("{} at {:.3} s", hit.cylinder, hit.at_s));
    }
    row("report", folder.display().to_string());
    out
}
