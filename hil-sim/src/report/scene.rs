//! The page of one random scene.

use std::fs;
use std::io;
use std::path::Path;

use super::figures::{avoidance, svg};
use super::html::Page;
use crate::scenes::{Kit, Outcome, Sample, Scene};

/// Writes `scene.html` and `avoidance.svg` into `folder`.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn write_scene(
    machine: &str,
    kit: &Kit,
    scene: &Scene,
    samples: &[Sample],
    outcome: &Outcome,
    folder: &Path,
) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let mut page = Page::new(&format!("Scene {} of {machine}", scene.number));
    page.note(super::SIMULATION);
    page.facts(&[
        ("Ended", format!("{:?}", outcome.ended)),
        ("Smallest clearance", {
            let clearance_m = outcome.smallest_clearance_m;
            if clearance_m.is_finite() { format!("{:.1} mm", 1e3 * clearance_m) } else { "it did not move".to_owned() }
        }),
        ("Planning before motion", format!("{:.2} s", outcome.planning_s)),
        ("Motion", format!("{:.2} s", outcome.motion_s)),
    ]);
    let figure = avoidance::figure(&avoidance::Drawn {
        chain: kit.machine.chain(),
        samples,
        obstacles: &scene.obstacles,
        target: scene.target,
    });
    let drawing = svg(&figure)?;
    fs::write(folder.join("avoidance.svg"), &drawing)?;
    page.figure(figure.title, &figure.caption, &drawing);
    fs::write(folder.join("scene.html"), page.finish())
}
