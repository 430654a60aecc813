//! What the fuzzing of a target begins with: bytes as they come in good order, made from the code as it is today.

use firmware::can::message::Sender;
use firmware::can::table::MESSAGES;
use firmware::simulated::link::{Reply, Request};
use firmware::simulated::{SimulatedBoard, Wires};
use hil_sim::place::{Host, Place};
use hil_sim::run::{Injector, Run};

use crate::boards::{approved, record};
use crate::rig::{scenario, scenario_names, workspace};

/// The seeds of a target.
pub fn seeds(target: &str) -> Vec<Vec<u8>> {
    match target {
        "can_frames" => (0..6).map(traffic).collect(),
        "parameter_record" => records(),
        "machine_file" => files("machines"),
        "scenario_file" => files("scenarios"),
        "exchange" => exchanges(),
        other => panic!("no target `{other}`"),
    }
}

/// Every message heard, good and counted on, eight times round, to the controller of scenario `which`.
fn traffic(which: u8) -> Vec<u8> {
    let heard = MESSAGES.iter().filter(|entry| entry.header.sender != Sender::Controller).count() as u8;
    let mut bytes = vec![which];
    for round in 0..8 {
        for message in 0..heard {
            // The first byte of a step that chooses this message.
            let what = (64..216).find(|what| what % heard == message).unwrap_or(64);
            bytes.extend([what, round]);
            bytes.extend([if message < 4 { 100 } else { message }, 0x01, 0x7d, 0x7d, 0, 0, 0, 0]);
        }
        bytes.extend([220, 19]);
    }
    bytes
}

fn records() -> Vec<Vec<u8>> {
    let sealed = approved(0.1);
    let mut seeds = vec![[&[0], sealed.as_bytes()].concat()];
    for name in scenario_names() {
        let mut stored = record(0.1);
        stored.parameters = scenario(&name).parameters;
        let data = postcard::to_stdvec(&stored).expect("a record");
        seeds.push([&[1][..], &data].concat());
    }
    seeds
}

fn files(folder: &str) -> Vec<Vec<u8>> {
    let folder = workspace().join(folder);
    let files = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = files.map(|file| file.expect("a readable folder").path()).collect();
    paths.sort();
    paths.iter().map(|path| std::fs::read(path).expect("a readable file")).collect()
}

/// Keeps what a run puts to the connectors.
#[derive(Default)]
struct Keeper(Vec<Wires>);

impl Injector for Keeper {
    fn wires(&mut self, _: f64, wires: &mut Wires) {
        self.0.push(*wires);
    }

    fn plant(&mut self, _: f64, _: &mut hil_sim::plant::Plant, _: &firmware::simulated::Pins) {}
}

fn exchanges() -> Vec<Vec<u8>> {
    let mut levers = scenario("fence-zx200");
    levers.duration_s = 1.0;
    let mut kept = Keeper::default();
    let mut host = Host::new(&levers.parameters).expect("good parameters");
    let run = Run::new(&levers, 1).expect("it starts");
    run.complete_with(&mut host, &mut kept, |_, _| {}).expect("this process");
    let requests = kept.0.iter().step_by(97).flat_map(|wires| Request::Tick(*wires).to_bytes());
    let mut seeds = vec![[0].into_iter().chain(requests).collect(), vec![0; 1 + 12]];
    let outputs = host.tick(&kept.0[0]).expect("this process").outputs;
    let pins = SimulatedBoard::new().expect("good chips").pins();
    let reply = Reply { outputs, pins, started_ns: 1, instructions: 2 };
    seeds.push([2].into_iter().chain(reply.to_bytes()).collect());
    for name in scenario_names() {
        let parameters = postcard::to_stdvec(&scenario(&name).parameters).expect("a record");
        seeds.push([&[1][..], &parameters].concat());
    }
    seeds
}
