//! `hil plant`: strokes of a machine's hydraulic plant at full lever, as a table, JSON and a page; and how fast the plant is.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;

use super::print_with_json;
use crate::machine_file::MachineFile;
use crate::plant::STEP_S;
use crate::plant::hydraulic::{HydraulicModel, HydraulicPlant};
use crate::plant_trial::{PlantReport, standing};
use crate::report::write_plant;

/// Arguments of `hil plant`.
#[derive(Debug, Args)]
pub struct PlantArgs {
    /// A machine's name, or the path of its file
    #[arg(long, value_name = "NAME|FILE", default_value = "zx200")]
    machine: String,
    /// Draw the plant of this case of its family instead of the nominal one
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Folder of the page and its figures
    #[arg(long, value_name = "DIR", default_value = "report/plant")]
    out: PathBuf,
    /// Write the times as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// Runs the command; its exit status is 0, or 2 when the machine has no hydraulics or the page cannot be written.
pub fn main(args: &PlantArgs) -> ExitCode {
    match plant(args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn plant(args: &PlantArgs) -> Result<(), Box<dyn std::error::Error>> {
    let nominal = HydraulicModel::of(&MachineFile::load(&args.machine)?)?;
    let model = args.seed.map_or_else(|| nominal.clone(), |seed| nominal.drawn(seed));
    let report = PlantReport::new(&args.machine, &model)?;
    write_plant(&report, &args.out).map_err(|error| format!("cannot write {}: {error}", args.out.display()))?;
    let mut table = String::from("full lever          to the cushion   to the stop   top speed\n");
    for stroke in &report.strokes {
        let seconds = |time: Option<f64>| time.map_or_else(|| "never".to_owned(), |s| format!("{s:.2} s"));
        let way = if stroke.extending { "extends" } else { "retracts" };
        table += &format!(
            "{:<8} {way:<10} {:>14} {:>13} {:>7.3} m/s\n",
            stroke.cylinder,
            seconds(stroke.to_cushion_s),
            seconds(stroke.to_stop_s),
            stroke.top_speed_mps
        );
    }
    table += &format!("plant alone: {:.0} × real time on this computer\n", times_real_time(&model)?);
    table += &format!("page: {}\n", args.out.join("plant.html").display());
    print_with_json(&table, &report, args.json.as_deref())
}

/// Simulated over elapsed time with all four functions moving to and fro: the best of several spans, for others use this computer too.
fn times_real_time(model: &HydraulicModel) -> Result<f64, Box<dyn std::error::Error>> {
    const SPANS: u32 = 20;
    const TICKS: u32 = 4000;
    let mut plant = HydraulicPlant::new(model, standing(model, [0.5; 3]))?;
    let half_a = 0.5 * model.spool.full_scale_a;
    let mut least_s = f64::INFINITY;
    for _ in 0..SPANS {
        let started = Instant::now();
        for tick in 0..TICKS {
            let currents = if tick < TICKS / 2 { [half_a, 0.0] } else { [0.0, half_a] };
            plant.step([currents; 4]);
        }
        least_s = started.elapsed().as_secs_f64().clamp(0.0, least_s);
    }
    Ok(f64::from(TICKS) * STEP_S / least_s)
}
