//! `hil scenes`: obstacle avoidance in thousands of random scenes.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;

use clap::Args;
use rayon::prelude::*;

use super::print;
use super::progress::Progress;
use crate::machine_file::MachineFile;
use crate::report::write_scene;
use crate::scenes::{Kit, Outcome, Sample, Tally};

/// Arguments of `hil scenes`.
#[derive(Debug, Args)]
pub struct ScenesArgs {
    /// A machine's name or file; repeat for more [default: frankel, exact-mini, zx120, zx200]
    #[arg(long, value_name = "NAME|FILE")]
    machine: Vec<String>,
    /// How many scenes a machine
    #[arg(long, default_value_t = 10_000)]
    scenes: u64,
    /// Seed of all scenes
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Play and draw this one scene of the first machine
    #[arg(long, value_name = "NUMBER")]
    scene: Option<u64>,
    /// Folder of its page [default: report/scene-MACHINE-NUMBER]
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Write the report as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

type AnyError = Box<dyn std::error::Error>;

/// Runs the command; its exit status is 0, 1 it could not write, 2 bad input, or 3 a collision.
pub fn main(args: &ScenesArgs) -> ExitCode {
    match scenes(args) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::from(3),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

const MACHINES: [&str; 4] = ["frankel", "exact-mini", "zx120", "zx200"];

/// All tallies; how many scenes collided.
fn scenes(args: &ScenesArgs) -> Result<usize, AnyError> {
    if !(1..=10_000_000).contains(&args.scenes) {
        return Err(format!("`--scenes` is {} but must be within 1…10000000", args.scenes).into());
    }
    let named = if args.machine.is_empty() { MACHINES.map(String::from).to_vec() } else { args.machine.clone() };
    let kits = named
        .iter()
        .map(|name| {
            let file = MachineFile::load(name)?;
            Ok((file.name.clone(), Kit::new(&file.geometry)?))
        })
        .collect::<Result<Vec<_>, AnyError>>()?;
    if let (Some(number), Some((name, kit))) = (args.scene, kits.first()) {
        draw(args, name, kit, number)?;
        return Ok(0);
    }
    let mut tallies = Vec::new();
    for (name, kit) in &kits {
        let tally = Tally::of(name, &play(args, name, kit));
        let table = tally.to_table();
        if args.json.as_deref() == Some(Path::new("-")) {
            eprint!("{table}")
        } else {
            print(&table)?
        }
        tallies.push(tally);
    }
    if let Some(file) = &args.json {
        let text = serde_json::to_string_pretty(&tallies)? + "\n";
        if file == Path::new("-") {
            print(&text)?;
        } else {
            std::fs::write(file, text).map_err(|e| format!("cannot write {}: {e}", file.display()))?;
        }
    }
    Ok(tallies.iter().map(|tally| tally.collisions).sum())
}

/// Plays one scene and draws it.
fn draw(args: &ScenesArgs, name: &str, kit: &Kit, number: u64) -> Result<(), AnyError> {
    let scene = kit.scene(args.seed, number);
    let mut samples = Vec::new();
    let outcome = kit.play(&scene, |sample| samples.push(sample));
    if samples.is_empty() {
        let clearance_m = kit.clearance(&scene.start, &scene.obstacles);
        samples.push(Sample { time_s: 0.0, joints: scene.start, clearance_m });
    }
    let folder = args.report.clone().unwrap_or_else(|| Path::new("report").join(format!("scene-{name}-{number}")));
    write_scene(name, kit, &scene, &samples, &outcome, &folder)
        .map_err(|e| format!("cannot write {}: {e}", folder.display()))?;
    print(&(serde_json::to_string_pretty(&outcome)? + "\n"))?;
    eprintln!("drawn in {}", folder.join("scene.html").display());
    Ok(())
}

fn play(args: &ScenesArgs, name: &str, kit: &Kit) -> Vec<Outcome> {
    let progress = Mutex::new((Progress::new(name, args.scenes, 1.0, "scenes"), 0));
    let one = |number| {
        let outcome = kit.play(&kit.scene(args.seed, number), |_| {});
        if let Ok(mut progress) = progress.lock() {
            progress.1 += 1;
            let done = progress.1;
            progress.0.at(done, args.scenes as u32);
        }
        outcome
    };
    let outcomes = (0..args.scenes).into_par_iter().map(one).collect();
    if let Ok((progress, _)) = progress.into_inner() {
        progress.finish();
    }
    outcomes
}
