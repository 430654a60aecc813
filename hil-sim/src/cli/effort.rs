//! `hil effort`: least effort against minimum norm.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use kinematics_core::planning::effort::Piston;

use super::print_with_json;
use super::progress::Progress;
use crate::effort::{Hydraulics, moves, rows, table};
use crate::machine_file::MachineFile;

/// The machines shown when none is named.
const ALL: [&str; 4] = ["frankel", "exact-mini", "zx120", "zx200"];

/// Bores and rods (mm) of the cylinders that are published: boom, arm, bucket of zx200.
const ZX200_MM: [[f64; 2]; 3] = [[120.0, 85.0], [135.0, 95.0], [120.0, 85.0]];

/// Arguments of `hil effort`.
#[derive(Debug, Args)]
pub struct EffortArgs {
    /// A machine's name, or the path of a machine file [default: every reference machine]
    #[arg(long)]
    machine: Option<String>,
    /// Bore and rod of boom (two cylinders), arm and bucket, mm: six numbers [default: zx200's, where the machine is zx200]
    #[arg(long, value_name = "MM", value_delimiter = ',', num_args = 1)]
    bores: Vec<f64>,
    /// Pump pressure, MPa
    #[arg(long, value_name = "MPA", default_value_t = 20.0)]
    pressure: f64,
    /// The pump's share in lowering the boom: 1 fills the rod side, 0 is regenerated
    #[arg(long, value_name = "SHARE", default_value_t = 1.0)]
    lowering: f64,
    /// Write the rows as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

type AnyError = Box<dyn std::error::Error>;

/// Runs the command; its exit status is 0, or 2 bad input or unwritable output.
pub fn main(args: &EffortArgs) -> ExitCode {
    match run(args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn hydraulics(args: &EffortArgs, machine: &str) -> Result<Option<Hydraulics>, AnyError> {
    if !(args.pressure > 0.0 && args.pressure <= 100.0) {
        return Err(format!("`--pressure` is {} but must be above 0 and at most 100 MPa", args.pressure).into());
    }
    if !(0.0..=1.0).contains(&args.lowering) {
        return Err(format!("`--lowering` is {} but must be within 0…1", args.lowering).into());
    }
    let given = match args.bores.as_slice() {
        [] if machine == "zx200" => ZX200_MM,
        [] => return Ok(None),
        &[b, br, a, ar, k, kr] => [[b, br], [a, ar], [k, kr]],
        other => {
            return Err(format!(
                "`--bores` has {} numbers but needs 6: bore and rod of boom, arm, bucket",
                other.len()
            )
            .into());
        }
    };
    for [bore, rod] in given {
        if !(rod > 0.0 && rod < bore && bore <= 1000.0) {
            return Err(format!("`--bores` has bore {bore} and rod {rod} but needs 0 < rod < bore ≤ 1000 mm").into());
        }
    }
    let [boom, arm, bucket] = given;
    let piston = |[bore, rod]: [f64; 2], count| Piston { bore_m: bore * 1e-3, rod_m: rod * 1e-3, count };
    Ok(Some(Hydraulics {
        pistons: [piston(boom, 2), piston(arm, 1), piston(bucket, 1)],
        pressure_pa: args.pressure * 1e6,
        boom_lowering_share: args.lowering,
    }))
}

fn run(args: &EffortArgs) -> Result<(), AnyError> {
    let names: Vec<&str> = args.machine.as_deref().map_or_else(|| ALL.to_vec(), |name| vec![name]);
    let mut progress = Progress::new("effort", (names.len() * moves()) as u64, 1.0, "moves");
    let mut all = Vec::new();
    for name in names {
        let machine = MachineFile::load(name)?;
        let hydraulics = hydraulics(args, &machine.name)?;
        all.extend(rows(&machine, hydraulics.as_ref(), || progress.step()));
    }
    progress.finish();
    let table = table(&all);
    print_with_json(&table, &all, args.json.as_deref())?;
    Ok(())
}
