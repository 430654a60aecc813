//! `hil bench`: instruction counts on the emulated Cortex-M4F and on the host, against the papers' formulas and peer libraries.

mod emulated;
mod host;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use serde::Serialize;

use super::print_with_json;

/// Arguments of `hil bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Write the counts as JSON to a file, or to standard output with `-`
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
    /// Build the peer libraries too and compare with them (slow the first time)
    #[arg(long)]
    peers: bool,
}

/// One row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Row {
    name: String,
    median: u32,
    max: u32,
}

/// The JSON: the largest count of each row, and what callgrind counts on the host.
#[derive(Debug, Serialize)]
struct Counts {
    emulator: BTreeMap<String, u32>,
    emulator_median: BTreeMap<String, u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    host: Option<BTreeMap<String, u64>>,
    /// How many times as many instructions as ours the others take.
    ratios: BTreeMap<String, f64>,
}

/// Runs the command; its exit status is 0, or 2 when it cannot measure.
pub fn main(args: &BenchArgs) -> ExitCode {
    match bench(args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

type AnyError = Box<dyn std::error::Error>;

fn bench(args: &BenchArgs) -> Result<(), AnyError> {
    let mut rows = emulated::maps()?;
    for tick in emulated::TICKS {
        rows.push(emulated::tick(tick)?);
    }
    let host = host::maps(args.peers)?;
    if host.is_none() {
        eprintln!("valgrind is not installed: no counts on the host (apt-get install valgrind)");
    }
    let by_name = |count: fn(&Row) -> u32| rows.iter().map(|row| (row.name.clone(), count(row))).collect();
    let emulator: BTreeMap<String, u32> = by_name(|row| row.max);
    let ratios = ratios(&emulator, host.as_ref());
    let table = table(&rows, host.as_ref(), &ratios);
    let counts = Counts { emulator, emulator_median: by_name(|row| row.median), host, ratios };
    print_with_json(&table, &counts, args.json.as_deref())?;
    Ok(())
}

/// The maps that others are compared with, and who the others are; a name is `OTHER_MAP`.
const COMPARED: [&str; 2] = ["cylinders_to_tip", "tip_to_cylinders"];
const OTHERS: [&str; 3] = ["angles", "k", "opw"];

/// `host.k_cylinders_to_tip` and so on: others' instructions over ours, in the same place and number type.
fn ratios(emulator: &BTreeMap<String, u32>, host: Option<&BTreeMap<String, u64>>) -> BTreeMap<String, f64> {
    let on_emulator = emulator.iter().map(|(name, &count)| (format!("emulator.{name}"), u64::from(count)));
    let on_host = host.into_iter().flatten().map(|(name, &count)| (format!("host.{name}"), count));
    let all: BTreeMap<String, u64> = on_emulator.chain(on_host).collect();
    let ours_of = |name: &str| {
        let (place, map) = name.split_once('.')?;
        let (other, ours) = map.split_once('_')?;
        let compared = OTHERS.contains(&other) && COMPARED.iter().any(|map| ours.starts_with(map));
        all.get(&format!("{place}.{ours}")).filter(|_| compared)
    };
    let ratio = |(name, &count): (&String, &u64)| Some((name.clone(), count as f64 / *ours_of(name)? as f64));
    all.iter().filter_map(ratio).collect()
}

fn table(rows: &[Row], host: Option<&BTreeMap<String, u64>>, ratios: &BTreeMap<String, f64>) -> String {
    let against = |name: String| ratios.get(&name).map(|r| format!("{r:>9.1} × ours")).unwrap_or_default();
    let mut table = String::from("instructions on the emulated Cortex-M4F     median      max\n");
    for Row { name, median, max } in rows {
        table += &format!("{name:<40} {median:>9} {max:>8} {}\n", against(format!("emulator.{name}")));
    }
    if let Some(host) = host {
        table += "\ninstructions on the host, by callgrind         a call\n";
        for (name, count) in host {
            table += &format!("{name:<40} {count:>12}      {}\n", against(format!("host.{name}")));
        }
        table +=
            "angles: the papers' formulas with libm; k, opw: peer libraries, with those formulas for the cylinders\n";
    }
    table
}
