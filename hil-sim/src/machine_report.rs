//! What an engineer asks of a machine as a whole, over all of its stroke.
//!
//! - [`outline`] — what the tip reaches;
//! - [`levers`] — moment arms and transmission over each stroke;
//! - [`sweep`] — a millimetre of stroke at the tip, f32 against f64;
//! - [`isotropic`] — isotropic points, best and worst condition number.

pub mod isotropic;
pub mod levers;
pub mod outline;
pub mod sweep;

use std::fmt::Write;

use kinematics_core::geometry::Stroke;
use kinematics_core::{GeometryError, Machine, PoseError};
use serde::Serialize;

use crate::machine_file::MachineFile;
use isotropic::Isotropy;
use levers::Levers;
use outline::Outline;
use sweep::Sweep;

/// Even points over a stroke, both ends exactly.
fn grid(stroke: Stroke, points: usize) -> impl Iterator<Item = f64> {
    let Stroke { min_m, max_m } = stroke;
    let last = points - 1;
    (0..points).map(move |i| if i == last { max_m } else { min_m + (max_m - min_m) * i as f64 / last as f64 })
}

/// Everything about one machine.
#[derive(Clone, Debug, Serialize)]
pub struct MachineReport {
    /// Its name.
    pub machine: String,
    /// One line for people.
    pub description: String,
    /// The tip accuracy the resolutions are for, m.
    pub wanted_accuracy_m: f64,
    /// What the tip reaches.
    pub workspace: Outline,
    /// Moment arms and transmission: boom, arm, bucket.
    pub levers: [Levers; 3],
    /// Condition number of the tip's 2 × 3 Jacobian, isotropic points.
    pub isotropy: Isotropy,
    /// Sensitivity and f32 accuracy.
    #[serde(flatten)]
    pub sweep: Sweep,
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum MachineReportError {
    /// The geometry, which loading has checked.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// A pose inside the strokes that a map refuses.
    #[error("inside the strokes: {0}")]
    Pose(#[from] PoseError<f64>),
    /// The outline needs poses everywhere.
    #[error("the tip's outline cannot be drawn: a pose inside the strokes has no tip")]
    Outline,
}

impl MachineReport {
    /// Of a machine; `progress` hears of steps done out of all.
    ///
    /// # Errors
    /// [`MachineReportError`], which a validated geometry does not give.
    pub fn new(
        file: &MachineFile,
        wanted_accuracy_m: f64,
        progress: impl FnMut(u32, u32),
    ) -> Result<Self, MachineReportError> {
        let geometry = &file.geometry;
        let machine = Machine::new(geometry)?;
        Ok(Self {
            machine: file.name.clone(),
            description: file.description.clone(),
            wanted_accuracy_m,
            workspace: outline::outline(geometry, &machine).ok_or(MachineReportError::Outline)?,
            levers: levers::levers(geometry, &machine)?,
            isotropy: isotropic::isotropy(geometry)?,
            sweep: sweep::sweep(geometry, &machine, wanted_accuracy_m, progress)?,
        })
    }

    /// The table for people.
    pub fn to_table(&self) -> String {
        let mut out = format!("{}: {}\n", self.machine, self.description);
        let w = &self.workspace;
        // Writing to a string cannot fail.
        let mut row = |name: &str, value: String| {
            let _ = writeln!(out, "  {name:<26} {value}");
        };
        row("tip from the boom pin", format!("{:.3} to {:.3} m", w.nearest_m, w.farthest_m));
        row("reach, height, depth", format!("{:.3}, {:+.3}, {:+.3} m", w.reach_m, w.highest_m, w.lowest_m));
        for l in &self.levers {
            let (first, last) = (l.points.first(), l.points.last());
            if let (Some(a), Some(b)) = (first, last) {
                let joints = format!("{:+.2}° to {:+.2}°", a.joint_deg, b.joint_deg);
                let arms = format!("moment arm {:.4} to {:.4} m", l.smallest_m, l.largest_m);
                row(&format!("{} over its stroke", l.cylinder), format!("{joints}, {arms}"));
            }
        }
        let names = self.levers.iter().map(|l| l.cylinder);
        for (name, s) in names.zip(&self.sweep.sensitivity) {
            row(
                &format!("1 mm of {name} stroke"),
                format!("{:.1} mm at the tip at most, {:.1} mm at full reach", s.worst, s.at_full_reach),
            );
        }
        let wanted = self.wanted_accuracy_m * 1e3;
        let resolutions: Vec<_> =
            self.sweep.sensitivity.iter().map(|s| format!("{:.3}", s.resolution_m * 1e3)).collect();
        row(&format!("sensors for {wanted} mm"), format!("{} mm (boom, arm, bucket)", resolutions.join(", ")));
        let single = &self.sweep.single_precision;
        row(
            "f32 against f64",
            format!("{:.2e} m at the tip at most, {:.1e} of reach", single.worst_m, single.of_reach),
        );
        for line in self.isotropy.to_string().lines() {
            let _ = writeln!(out, "  {line}");
        }
        out
    }
}
