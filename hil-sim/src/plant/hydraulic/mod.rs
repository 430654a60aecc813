//! The hydraulic plant: coil currents in, cylinder positions and pressures out. Fixed step, deterministic, SI.
//!
//! - [`HydraulicModel`] — everything a plant is built from, of a machine file or drawn ([`HydraulicModel::drawn`]);
//! - [`HydraulicPlant`] — the machine in motion;
//! - [`Ledger`] — where oil and energy went, for the tests.
//!
//! What is modelled, what is not, and how well: `docs/plant.md`.

mod body;
mod circuit;
mod cushion;
mod digging;
mod family;
mod friction;
mod function;
mod ground;
mod joints;
mod ledger;
mod matrix;
mod metering;
mod model;
mod oil;
mod plant;
mod pump;
mod soil_factors;
mod spool;

pub use body::{Body, Posture};
pub use cushion::Cushion;
pub use digging::DiggingModel;
pub use friction::Friction;
pub use function::FunctionModel;
pub use ground::Ground;
pub use ledger::Ledger;
pub use metering::conductance;
pub use model::{HydraulicModel, ModelError};
pub use oil::{ATMOSPHERE_PA, Oil};
pub use plant::{HydraulicPlant, StartError};
pub use pump::{Compensation, PumpModel};
pub use soil_factors::Soil;
pub use spool::SpoolModel;
