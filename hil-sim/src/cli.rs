//! The `hil` command: one module a subcommand.

pub mod bench;
pub mod calibrate;
mod campaign;
pub mod coil;
pub mod effort;
pub mod faults;
pub mod fence;
pub mod flips;
pub mod icd;
pub mod image;
pub mod machine;
pub mod params;
mod planar_arm;
pub mod plant;
pub mod pose;
mod progress;
pub mod run;
pub mod scenes;
pub mod score;
pub mod soak;

use std::error::Error;
use std::ffi::OsString;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde::Serialize;

/// Desktop harness of the excavator controller.
#[derive(Debug, Parser)]
#[command(name = "hil", version, about)]
struct Hil {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Show one pose as cylinder lengths, joint angles and bucket tip
    Pose(pose::PoseArgs),
    /// Show what a machine can do over all of its stroke: workspace, moment arms, sensitivity, isotropy
    Machine(machine::MachineArgs),
    /// Print what least-effort moves cost against the minimum-norm ones
    Effort(effort::EffortArgs),
    /// Make, show, compare and approve the controller's parameter records
    Params(params::ParamsArgs),
    /// Run a scenario on the host or on the emulated ECU, and report it
    Run(run::RunArgs),
    /// Try fences with random operators on the simulated machine: whole linkage, tip only, none
    Fence(fence::FenceArgs),
    /// Score the motion on drawn plants: the true tip against the path, open loop, proportional alone, uncalibrated, half the flow
    Score(score::ScoreArgs),
    /// Let random operators work for hours on a healthy machine: nothing may trip
    Soak(soak::SoakArgs),
    /// Break everything that can break, in every situation, thousands of times: what is seen, how soon, and the tip's way to standstill
    Faults(faults::FaultsArgs),
    /// Turn bits of the controller's memory in the emulator, and lose its timer's interrupt: what stops it, what has no effect, what goes unseen
    Flips(flips::FlipsArgs),
    /// Reach targets past obstacles in thousands of random scenes, and report how it went
    Scenes(scenes::ScenesArgs),
    /// Show the coil current loop on simulated solenoids: steps, dither, temperature and supply sweeps, fault times
    Coil(coil::CoilArgs),
    /// Search every valve of a machine by command, through the controller's pins: found against true
    Calibrate(calibrate::CalibrateArgs),
    /// Show the hydraulic plant of a machine: strokes at full lever with pressures and flow, and how fast it is
    Plant(plant::PlantArgs),
    /// Print instruction counts of the maps and of the tick on the emulated ECU
    Bench(bench::BenchArgs),
    /// Write the CAN interface page and DBC file from the firmware's tables, or check that they are up to date
    Icd(icd::IcdArgs),
    /// Draw the supervisor and write the page of faults from the firmware's tables, or check that they are up to date
    Supervisor(icd::IcdArgs),
    /// Run the fault campaign and write its table and figure as a page, or check that they are up to date
    FaultTable(icd::IcdArgs),
    /// Write the page of safety requirements with their tests from the tests' sources, or check that it is up to date
    Safety(icd::IcdArgs),
    /// Print what an ARM image's flash and stack are for
    Image(image::ImageArgs),
}

/// Writes to standard output. A reader that has gone away has had what it wanted.
fn print(text: &str) -> std::io::Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// A command's table and, where asked for, its result as JSON: in a file, or with `-` on standard output, where then nothing else stands.
fn print_with_json(table: &str, result: &impl Serialize, json: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let Some(file) = json else { return Ok(print(table)?) };
    let text = serde_json::to_string_pretty(result)? + "\n";
    if file == Path::new("-") {
        eprint!("{table}");
        return Ok(print(&text)?);
    }
    print(table)?;
    std::fs::write(file, text).map_err(|error| format!("cannot write {}: {error}", file.display()))?;
    Ok(())
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    match Hil::try_parse_from(&arguments) {
        Ok(Hil { command: Command::Pose(args) }) => pose::main(&args),
        Ok(Hil { command: Command::Machine(args) }) => machine::main(&args),
        Ok(Hil { command: Command::Effort(args) }) => effort::main(&args),
        Ok(Hil { command: Command::Params(args) }) => params::main(&args),
        Ok(Hil { command: Command::Run(args) }) => run::main(&args),
        Ok(Hil { command: Command::Fence(args) }) => fence::main(&args),
        Ok(Hil { command: Command::Scenes(args) }) => scenes::main(&args),
        Ok(Hil { command: Command::Soak(args) }) => soak::main(&args),
        Ok(Hil { command: Command::Score(args) }) => score::main(&args),
        Ok(Hil { command: Command::Faults(args) }) => faults::main(&args),
        Ok(Hil { command: Command::Flips(args) }) => flips::main(&args),
        Ok(Hil { command: Command::Coil(args) }) => coil::main(&args),
        Ok(Hil { command: Command::Calibrate(args) }) => calibrate::main(&args),
        Ok(Hil { command: Command::Plant(args) }) => plant::main(&args),
        Ok(Hil { command: Command::Bench(args) }) => bench::main(&args),
        Ok(Hil { command: Command::Icd(args) }) => icd::main(&args),
        Ok(Hil { command: Command::Supervisor(args) }) => icd::supervisor(&args),
        Ok(Hil { command: Command::FaultTable(args) }) => icd::fault_table(&args),
        Ok(Hil { command: Command::Safety(args) }) => icd::safety(&args),
        Ok(Hil { command: Command::Image(args) }) => image::main(&args),
        // A script that asked for a pose reads every error from standard output, a wrong option too.
        Err(error) if error.use_stderr() && arguments.get(1).is_some_and(|a| a == "pose") => {
            pose::usage_error(&error, &arguments)
        }
        Err(error) => error.exit(),
    }
}
