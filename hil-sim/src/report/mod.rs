//! What a run looks like: the short table, and the report folder.
//!
//! - [`table()`] — the short table after a run;
//! - [`write_calibration`] — the folder of a calibration by command: `calibration.html`, `calibration.json`;
//! - [`write_coil`] — the folder of the coil current loop: `coil.html`, `coil.json`;
//! - [`write_plant`] — the folder of a hydraulic plant: `plant.html`, `plant.json`, an SVG a stroke;
//! - [`write`](fn@write) — the folder of a run: `report.html`, `linkage.svg`, `log.csv`, `summary.json`;
//! - [`draw_only`] — the folder of a dig that is drawn but not run: `report.html`, `linkage.svg`, `dig.csv`.
//!
//! Inside, a `figures` module says what each figure shows and one file of it draws them all; `series` makes long series
//! short; `motion` shows the machine moving; `html` is the page and escapes every text; `run` and `dig` put it together.

mod calibration;
mod coil;
mod csv;
mod dig;
mod figures;
mod html;
mod machine;
mod motion;
mod planar_arm;
mod plant;
mod run;
mod scene;
mod series;
mod table;
#[cfg(test)]
mod tests;

pub use calibration::write_calibration;
pub use coil::write_coil;
pub use dig::draw_only;
pub use machine::write_machine;
pub use planar_arm::{planar_arm_table, write_planar_arm};
pub use plant::write_plant;
pub use run::write;
pub use scene::write_scene;
pub use table::table;

/// Nobody shall take a report for proof of a machine.
const SIMULATION: &str = "A simulation: no board has been flashed and no machine has moved.";
