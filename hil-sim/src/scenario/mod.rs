//! Scenario files: a machine, a task, an operator, a plant, and what goes wrong when.
//!
//! The format is described in `docs/scenarios.md`.

mod build;
mod check;
mod event;
mod fence;
mod file;
mod modes;
mod plant;
mod task;

use std::path::{Path, PathBuf};

use firmware::Parameters;

use crate::machine_file::{MachineFile, MachineFileError};
use crate::plant::hydraulic::HydraulicModel;
use crate::plant::{ActuatorModel, CoilModel};

pub(crate) use check::within;
pub use event::{Event, Events, Kind};
pub use task::{LeverMove, Start, Task, TipMove};

/// A scenario, checked, with everything a run needs.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// The machine.
    pub machine: MachineFile,
    /// How long to simulate, s.
    pub duration_s: f64,
    /// When the operator switches enable on, s.
    pub enable_s: f64,
    /// When the operator begins the task, s.
    pub begin_s: f64,
    /// What the operator does.
    pub task: Task,
    /// Everything the controller is built from.
    pub parameters: Parameters,
    /// Swing, boom, arm, bucket of the simulated machine.
    pub plant: [ActuatorModel; 4],
    /// The hydraulic machine in their place, where the scenario asks for one; `plant` is then what a calibration would say of it.
    pub hydraulic: Option<HydraulicModel>,
    /// Their coils.
    pub coil: CoilModel,
    /// Nominal supply, V.
    pub supply_v: f64,
    /// Standard deviation of the position sensors, m.
    pub sensor_noise_m: f64,
    /// What goes wrong when.
    pub events: Events,
}

/// Why a scenario cannot be used; every message names the file and the field.
#[derive(Debug, thiserror::Error)]
pub enum ScenarioError {
    /// The file cannot be read.
    #[error("cannot read the scenario {}: {source}", file.display())]
    Read {
        /// Its path.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A field is missing, unknown, of the wrong kind or outside its range.
    #[error("{}: {what}", file.display())]
    Invalid {
        /// The scenario's path.
        file: PathBuf,
        /// Field and allowed range.
        what: String,
    },
    /// The machine it names.
    #[error("{}: `machine`: {source}", file.display())]
    Machine {
        /// The scenario's path.
        file: PathBuf,
        /// What is wrong with the machine.
        source: MachineFileError,
    },
}

impl Scenario {
    /// Loads a scenario and the machine it names.
    ///
    /// # Errors
    /// A fault named by file and field.
    pub fn load(file: &Path) -> Result<Self, ScenarioError> {
        let text =
            std::fs::read_to_string(file).map_err(|source| ScenarioError::Read { file: file.to_owned(), source })?;
        Self::from_toml(&text, file)
    }

    /// A scenario from the text of a file; `file` is how messages call it.
    ///
    /// # Errors
    /// As [`Scenario::load`].
    pub fn from_toml(text: &str, file: &Path) -> Result<Self, ScenarioError> {
        let invalid = |what| ScenarioError::Invalid { file: file.to_owned(), what };
        let scenario = file::parse(text).map_err(invalid)?;
        check::ranges(&scenario).map_err(invalid)?;
        let machine = MachineFile::load(&machine_path(&scenario.machine, file))
            .map_err(|source| ScenarioError::Machine { file: file.to_owned(), source })?;
        build::scenario(scenario, machine).map_err(invalid)
    }

    /// A scenario from text that is known to be right, of this machine in place of the one it names and from this start.
    pub(crate) fn of_machine(text: &str, machine: MachineFile, start: Start) -> Result<Self, String> {
        Self::of_text(text, machine, Some(start))
    }

    /// A scenario from text, of this machine in place of the one it names; without a start the text says where it is.
    ///
    /// # Errors
    /// The field at fault and its allowed range.
    pub fn of_text(text: &str, machine: MachineFile, start: Option<Start>) -> Result<Self, String> {
        let mut scenario = file::parse(text)?;
        check::ranges(&scenario)?;
        scenario.start = start.or(scenario.start);
        build::scenario(scenario, machine)
    }
}

/// A machine given by path stands where the scenario's folder says; a bare name is left to the machine folders.
fn machine_path(machine: &str, scenario: &Path) -> String {
    let is_path = machine.contains(['/', '\\']) || machine.ends_with(".toml");
    match scenario.parent() {
        Some(folder) if is_path => folder.join(machine).display().to_string(),
        _ => machine.to_owned(),
    }
}
