//! One run with one thing spoilt.

use std::path::Path;

use firmware::State;
use firmware::simulated::link::{Spoil, Zone};
use firmware::simulated::{Pins, Wires};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

use super::SCENARIOS;
use super::place::Spoilt;
use crate::place::{Emulator, Host, Image, Place, PlaceError, Reply};
use crate::run::{Log, Run};
use crate::scenario::Scenario;

/// What is run of each scenario, s.
const DURATION_S: f64 = 3.2;
/// Something breaks in one of these ticks.
const BREAKS: [u32; 2] = [1500, 2200];
/// A tip that stays this near to where it would have been has not gone astray, m.
pub const SLIGHT_M: f64 = 0.02;

/// What came of a run.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Came {
    /// Every duty of every tick as if nothing had happened.
    Nothing,
    /// Outputs off: by what, and after how many ticks.
    Off { by: &'static str, after: u32 },
    /// Other duties, but the tip never farther than [`SLIGHT_M`] from where it would have been.
    Slight { astray_m: f64 },
    /// It went elsewhere, and nobody noticed.
    Astray { astray_m: f64 },
}

/// A run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    /// Which case it was, and of which scenario.
    pub(super) case: u64,
    pub(super) scenario: &'static str,
    pub(super) what: What,
    pub(super) came: Came,
    /// How far the tip was from where it would have been while the outputs were on, m.
    pub(super) astray_m: f64,
    /// The most instructions of a tick's watch over the constants.
    pub(super) watch_instructions: Option<u32>,
}

/// What was spoilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum What {
    Bit(Zone),
    OneTick,
    Timer,
}

/// A scenario, and how it goes when nothing happens.
pub(super) struct Stage {
    scenario: Scenario,
    log: Log,
    pins: Vec<Pins>,
}

/// Every stage: the host's runs have the emulator's bits.
pub(super) fn stages() -> Result<Vec<Stage>, String> {
    SCENARIOS.iter().map(|name| stage(name)).collect()
}

fn stage(name: &str) -> Result<Stage, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let mut scenario = Scenario::load(&folder.join(name).with_extension("toml")).map_err(|error| error.to_string())?;
    scenario.duration_s = DURATION_S;
    let host = Host::new(&scenario.parameters).map_err(|error| error.to_string())?;
    let mut place = Kept { host, pins: Vec::new() };
    let log = complete(&scenario, &mut place)?;
    let state = log.rows.get(BREAKS[0] as usize).map(|row| row.outputs.state);
    if state != Some(State::Running) || !log.faults.is_empty() {
        return Err(format!("{name}: {state:?} where something shall break, {:?}", log.faults));
    }
    let Kept { pins, .. } = place;
    Ok(Stage { scenario, log, pins })
}

/// The host, and what it puts on its pins.
struct Kept {
    host: Host,
    pins: Vec<Pins>,
}

impl Place for Kept {
    fn tick(&mut self, wires: &Wires) -> Result<Reply, PlaceError> {
        let reply = self.host.tick(wires)?;
        self.pins.push(reply.pins);
        Ok(reply)
    }
}

fn complete(scenario: &Scenario, place: &mut dyn Place) -> Result<Log, String> {
    let run = Run::new(scenario, 1).map_err(|error| error.to_string())?;
    run.complete(place, |_, _| {}).map_err(|error| error.to_string())
}

/// Case `index` of the campaign of `seed`: the same whatever else is run.
pub(super) fn run(stages: &[Stage], image: &Image, seed: u64, index: u64) -> Result<Found, String> {
    let mut dice = ChaCha8Rng::seed_from_u64(seed ^ (index << 20));
    let stage = &stages[index as usize % stages.len()];
    let spoil = match index as usize / stages.len() {
        0 => Spoil::LoseTicks(1),
        1 => Spoil::LoseTicks(u32::MAX),
        _ => Spoil::Flip { byte: dice.next_u32(), bit: (dice.next_u32() % 8) as u8 },
    };
    let [first, last] = BREAKS;
    let at_tick = first + dice.next_u32() % (last - first);
    let emulator = Emulator::with_parameters(image, &stage.scenario.parameters).map_err(|error| error.to_string())?;
    let mut place = Spoilt::new(emulator, spoil, at_tick);
    let log = complete(&stage.scenario, &mut place)?;
    let zone = place.zone.ok_or("nothing was spoilt")?;
    let what = match spoil {
        Spoil::LoseTicks(u32::MAX) => What::Timer,
        Spoil::LoseTicks(_) => What::OneTick,
        Spoil::Flip { .. } => What::Bit(zone),
    };
    let (came, astray_m) = judged(stage, &place, &log, at_tick);
    let watch_instructions = place.finish().map_err(|error| error.to_string())?;
    let scenario = SCENARIOS[index as usize % SCENARIOS.len()];
    Ok(Found { case: index, scenario, what, came, astray_m, watch_instructions })
}

/// What came of it, and how far the tip was from where it would have been while the outputs were on, m.
fn judged(stage: &Stage, place: &Spoilt, log: &Log, at_tick: u32) -> (Came, f64) {
    let off_at = place.pins.iter().zip(&stage.pins).position(|(pins, healthy)| is_off(pins) && !is_off(healthy));
    let until = off_at.unwrap_or(log.rows.len());
    let pairs = log.rows.iter().zip(&stage.log.rows).take(until);
    // A tip that is nowhere has no distance: cylinders end at their stops, so there is one.
    let astray = pairs.filter_map(|(row, healthy)| {
        let ([x, z], [healthy_x, healthy_z]) = (row.tip?, healthy.tip?);
        Some(libm::hypot(x - healthy_x, z - healthy_z))
    });
    let astray_m = astray.fold(0.0, f64::max);
    let driven = |pins: &Pins| (pins.duties, pins.cut_off_closed);
    let same = place.pins.iter().map(driven).eq(stage.pins.iter().map(driven));
    let came = match off_at {
        Some(at) => Came::Off { by: by(place, log), after: (at as u32).saturating_sub(at_tick) },
        None if same => Came::Nothing,
        None if astray_m <= SLIGHT_M => Came::Slight { astray_m },
        None => Came::Astray { astray_m },
    };
    (came, astray_m)
}

fn is_off(pins: &Pins) -> bool {
    !pins.cut_off_closed && pins.duties.iter().flatten().all(|&duty| duty == 0)
}

/// What took the outputs off.
fn by(place: &Spoilt, log: &Log) -> &'static str {
    match place.ended {
        None => log.faults.first().map_or("no longer running", |fault| fault.fault.name()),
        Some((10, _)) => "panic or halt",
        Some((11 | 12, _)) => "hard fault",
        Some((13, _)) => "panic or halt in the tick",
        Some((14, _)) => "watchdog",
        Some((134, _)) => "lock-up, watchdog",
        Some(_) => "the image ended",
    }
}
