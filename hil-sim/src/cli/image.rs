//! `hil image`: what an ARM image's flash and stack are for.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;

use super::print_with_json;
use crate::elf::{Deepest, Graph};
use crate::place::Image;

/// Arguments of `hil image`.
#[derive(Debug, Args)]
pub struct ImageArgs {
    /// The image: a binary of package images
    #[arg(default_value = "ecu-stm32f405")]
    name: String,
    /// How many of the largest functions to list
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u16).range(0..=1000))]
    largest: u16,
    /// Write the numbers as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// What is reported.
#[derive(Debug, Serialize)]
struct Report {
    flash_bytes: u64,
    ram_bytes: u64,
    /// Code the tick reaches, code that only start-up and the idle loop reach, code only handlers reach, constants and the rest.
    tick_bytes: u64,
    start_bytes: u64,
    handler_bytes: u64,
    constant_bytes: u64,
    tick_stack_bytes: u32,
    start_stack_bytes: u32,
}

/// Runs the command; its exit status is 0, or 2 when there is no such image.
pub fn main(args: &ImageArgs) -> ExitCode {
    match report(args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn report(args: &ImageArgs) -> Result<(), Box<dyn Error>> {
    let image = Image::build(&args.name)?;
    let graph = Graph::new(&std::fs::read(&image.path)?)?;
    let (tick, start) = (graph.named("TIM2")?, graph.named("main")?);
    let (in_tick, in_start) = (graph.reached(tick), graph.reached(start));
    let mut places: [BTreeMap<&str, u64>; 3] = Default::default();
    let mut largest = Vec::new();
    for (at, function) in graph.functions() {
        let place = match (in_tick.contains_key(&at), in_start.contains_key(&at)) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        *places[place].entry(owner(&function.name)).or_default() += function.size;
        largest.push((function.size, PLACES[place], &function.name));
    }
    largest.sort_unstable_by(|a, b| b.cmp(a));
    let [tick_bytes, start_bytes, handler_bytes] = places.each_ref().map(|owners| owners.values().sum());
    let (tick_stack, start_stack) = (graph.deepest(tick)?, graph.deepest(start)?);
    let report = Report {
        flash_bytes: image.flash_bytes,
        ram_bytes: image.ram_bytes,
        tick_bytes,
        start_bytes,
        handler_bytes,
        constant_bytes: image.flash_bytes.saturating_sub(tick_bytes + start_bytes + handler_bytes),
        tick_stack_bytes: tick_stack.bytes,
        start_stack_bytes: start_stack.bytes,
    };
    let mut table =
        format!("{}: {} bytes of flash, {} of static memory\n\n", args.name, report.flash_bytes, report.ram_bytes);
    for (place, owners) in PLACES.iter().zip(&places) {
        writeln!(table, "{place:<12} {:>8}", owners.values().sum::<u64>())?;
        let mut owners: Vec<_> = owners.iter().filter(|&(_, &bytes)| bytes > 0).collect();
        owners.sort_unstable_by_key(|&(_, bytes)| std::cmp::Reverse(bytes));
        for (owner, bytes) in owners {
            writeln!(table, "  {owner:<20} {bytes:>8}")?;
        }
    }
    writeln!(table, "{:<12} {:>8}", "constants", report.constant_bytes)?;
    for (name, Deepest { bytes, way }) in [("tick", tick_stack), ("start", start_stack)] {
        writeln!(table, "\nstack of the {name}: {bytes} bytes at most")?;
        for (function, frame) in way {
            writeln!(table, "{frame:>8} {function}")?;
        }
    }
    writeln!(table, "\nlargest functions")?;
    for (bytes, place, name) in largest.iter().take(args.largest.into()) {
        writeln!(table, "{bytes:>8} {place:<12} {name}")?;
    }
    print_with_json(&table, &report, args.json.as_deref())
}

/// When code runs: in the tick; only before it and beside it; only when something has failed.
const PLACES: [&str; 3] = ["tick", "start", "handlers"];

/// The crate a function belongs to, by its name.
fn owner(name: &str) -> &str {
    let known = [
        "kinematics_core",
        "firmware",
        "control_tick",
        "ecu_stm32f405",
        "ecu_emulated",
        "stm32f4xx_hal",
        "compiler_builtins",
    ];
    let before = |owner: &&str| name.find(*owner);
    let first = known.into_iter().filter(|owner| before(owner).is_some()).min_by_key(before);
    first
        .or_else(|| name.split_once("::").map(|(owner, _)| owner.trim_start_matches('<')))
        .unwrap_or("(entry, assembly)")
}
