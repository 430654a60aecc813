//! Machine files: one machine's geometry as TOML, from pins or from the papers' distances, checked as it is read.
//!
//! The format is described in `docs/machine-files.md`.

mod dynamics;
mod error;
mod find;
mod frankel;
mod hydraulics;
mod koivo;
mod outline;
mod parse;
mod pins;
mod value;

use std::fs;

use kinematics_core::PinGeometry;
use kinematics_core::planning::outline::{Outline, OutlineShape};

pub use dynamics::{Dynamics, Link};
use error::Layout;
pub use error::MachineFileError;
pub use hydraulics::Hydraulics;
use parse::{Parsed, parse};

/// A machine as its file gives it, validated.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineFile {
    /// The machine's name.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Its pins and strokes, m.
    pub geometry: PinGeometry,
    /// Height of the boom pin above the ground, m.
    pub boom_pin_height_m: f64,
    /// Masses and inertias, where the file has them.
    pub dynamics: Option<Dynamics>,
    /// Pump, oil, spools and functions, where the file has them.
    pub hydraulics: Option<Hydraulics>,
    /// Sizes of the linkage's outline: the defaults of its pins where the file does not state them.
    pub outline: OutlineShape,
}

impl MachineFile {
    /// Loads a machine by its bare name (from `machines/` in the current directory, else from the workspace's) or from
    /// the file at a path.
    ///
    /// # Errors
    /// An unknown name with those available, a file that cannot be read, or a fault named by file, line and field.
    pub fn load(name_or_path: &str) -> Result<Self, MachineFileError> {
        let file = find::find(name_or_path)?;
        match fs::read_to_string(&file) {
            Ok(text) => Self::from_toml(&text, &file.display().to_string()),
            Err(source) => Err(MachineFileError::Read { file, source }),
        }
    }

    /// A machine from the text of a file; `file` is how messages call it.
    ///
    /// # Errors
    /// As [`MachineFile::load`].
    pub fn from_toml(text: &str, file: &str) -> Result<Self, MachineFileError> {
        let invalid = |line, what| MachineFileError::Invalid { file: file.to_owned(), line, what };
        let parsed = parse(text).map_err(|fault| invalid(fault.line, fault.what))?;
        let (layout, boom_pin_height_m, geometry) = match &parsed {
            Parsed::Pins(f) => (Layout::Pins, f.boom_pin_height_m(), Ok(f.geometry())),
            Parsed::Frankel(f) => (Layout::Frankel, f.boom_pin_height_m(), f.geometry()),
            Parsed::Koivo(f) => (Layout::Koivo, f.boom_pin_height_m(), f.geometry()),
        };
        let geometry = geometry
            .and_then(|geometry| geometry.validate().map(|()| geometry))
            .map_err(|error| invalid(None, layout.explain(&error)))?;
        let (name, description, dynamics, hydraulics, outline) = match parsed {
            Parsed::Pins(f) => (f.name, f.description, f.dynamics, f.hydraulics, f.outline),
            Parsed::Frankel(f) => (f.name, f.description, f.dynamics, f.hydraulics, f.outline),
            Parsed::Koivo(f) => (f.name, f.description, f.dynamics, f.hydraulics, f.outline),
        };
        let dynamics = dynamics.map(|table| table.dynamics());
        let hydraulics = hydraulics.map(|table| table.hydraulics(&geometry)).transpose();
        let hydraulics = hydraulics.map_err(|what| invalid(None, what))?;
        let outline = outline.unwrap_or_default().shape(&geometry);
        Outline::<f64>::new(&geometry, &outline).map_err(|error| invalid(None, error.to_string()))?;
        Ok(Self { name, description, geometry, boom_pin_height_m, dynamics, hydraulics, outline })
    }
}
