//! The `hil` command: one module a subcommand.

pub mod bench;
pub mod effort;
pub mod fence;
pub mod machine;
mod planar_arm;
pub mod pose;
mod progress;
pub mod run;
pub mod scenes;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

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
    /// Run a scenario on the host or on the emulated ECU, and report it
    Run(run::RunArgs),
    /// Try fences with random operators on the simulated machine: whole linkage, tip only, none
    Fence(fence::FenceArgs),
    /// Reach targets past obstacles in thousands of random scenes, and report how it went
    Scenes(scenes::ScenesArgs),
    /// Print instruction counts of the maps and of the tick on the emulated ECU
    Bench(bench::BenchArgs),
}

/// Writes to standard output. A reader that has gone away has had what it wanted.
fn print(text: &str) -> std::io::Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    match Hil::try_parse_from(&arguments) {
        Ok(Hil { command: Command::Pose(args) }) => pose::main(&args),
        Ok(Hil { command: Command::Machine(args) }) => machine::main(&args),
        Ok(Hil { command: Command::Effort(args) }) => effort::main(&args),
        Ok(Hil { command: Command::Run(args) }) => run::main(&args),
        Ok(Hil { command: Command::Fence(args) }) => fence::main(&args),
        Ok(Hil { command: Command::Scenes(args) }) => scenes::main(&args),
        Ok(Hil { command: Command::Bench(args) }) => bench::main(&args),
        // A script that asked for a pose reads every error from standard output, a wrong option too.
        Err(error) if error.use_stderr() && arguments.get(1).is_some_and(|a| a == "pose") => {
            pose::usage_error(&error, &arguments)
        }
        Err(error) => error.exit(),
    }
}
