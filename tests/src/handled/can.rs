//! CAN frames: raw ones, ones with a good CRC and any payload, from the right sender and from others, with silence between them.
//!
//! Each step of the bytes: what comes, then what it needs. They go to a node alone, and to controllers in the middle of their work.

use embedded_can::{ExtendedId, Frame};
use firmware::board::Controller;
use firmware::can::address::Addresses;
use firmware::can::command::{Mode, Slope, TipVelocity, ValveCommand};
use firmware::can::dm1::ActiveFaults;
use firmware::can::id::Identifier;
use firmware::can::inbox::Inbox;
use firmware::can::message::{Entry, Sender};
use firmware::can::receive::{Reading, Validity};
use firmware::can::table::MESSAGES;
use firmware::can::{CanFrame, Node, protect};
use firmware::service::ServiceRequest;
use firmware::simulated::link::NAME;
use firmware::simulated::{FRAMES_IN, SimulatedBoard, Wires};
use firmware::{Intent, Outputs, SelfTest, State};
use hil_sim::place::{Place, PlaceError, Reply, Timing};
use hil_sim::run::Run;

use super::{Cursor, sound};
use crate::rig::scenario;

/// Scenarios of which each holds something that can be asked for.
const RUNNING: [&str; 6] = ["dig", "level-zx200", "grade-zx200", "tip-velocity-zx200", "obstacle-plane", "fence-zx200"];
/// Frames and silences looked at.
const STEPS: usize = 200;

/// A controller in the middle of its work, and what was at its connectors last.
struct Working {
    controller: Controller,
    board: SimulatedBoard,
    last: Option<(Wires, Outputs)>,
}

impl Place for Working {
    fn tick(&mut self, wires: &Wires) -> Result<Reply, PlaceError> {
        self.board.connect(wires);
        let outputs = self.controller.cycle(self.board.parts(), wires.overrun);
        self.last = Some((*wires, outputs));
        Ok(Reply { outputs, pins: self.board.pins(), timing: Timing::Host { wall_ns: 0 } })
    }
}

impl Working {
    fn with(controller: Controller) -> Self {
        Self { controller, board: SimulatedBoard::new().expect("good chips"), last: None }
    }

    fn in_scenario(name: &str) -> Self {
        let mut scenario = scenario(name);
        scenario.duration_s = 1.6;
        let mut controller = Controller::new(&scenario.parameters, Addresses::DEFAULT, &NAME).expect("good parameters");
        controller.self_tested(&SelfTest::PASSED);
        let mut working = Self::with(controller);
        let run = Run::new(&scenario, 1).unwrap_or_else(|error| panic!("{name}: {error}"));
        run.complete(&mut working, |_, _| {}).unwrap_or_else(|error| panic!("{name}: {error}"));
        let state = working.last.map(|(_, outputs)| outputs.state);
        assert_eq!(state, Some(State::Running), "{name}");
        working
    }

    fn now(self) -> (Controller, Wires) {
        (self.controller, self.last.expect("it ran").0)
    }
}

/// Frames to a node, and to a controller at work.
pub fn can_frames(bytes: &[u8]) {
    thread_local! {
        static WORKING: Vec<(Controller, Wires)> = RUNNING.iter().map(|name| Working::in_scenario(name).now()).collect();
    }
    let mut cursor = Cursor(bytes);
    let which = usize::from(cursor.byte()) % RUNNING.len();
    let (controller, mut wires) = WORKING.with(|working| working[which].clone());
    let mut working = Working::with(controller);
    let mut node = Node::new(Addresses::DEFAULT, &NAME).expect("good addresses");
    let (mut frames, mut outputs) = ([None; FRAMES_IN], None);
    let mut waiting = 0;
    for _ in 0..STEPS {
        if cursor.is_empty() {
            break;
        }
        let step = step(&mut cursor);
        if let Step::Frame(frame) = step {
            hear(&mut node, &frame);
            frames[waiting] = Some(frame);
            waiting += 1;
        }
        let ticks = match step {
            Step::Ticks(ticks) => ticks,
            Step::Frame(_) if waiting < FRAMES_IN => continue,
            Step::Frame(_) => 1,
            Step::Switches([enable, released]) => {
                (wires.enable, wires.emergency_stop_released) = (enable, released);
                1
            }
        };
        for _ in 0..ticks {
            node.aged();
            readings_are_sound(node.inbox());
            wires.frames = std::mem::take(&mut frames);
            waiting = 0;
            let reply = working.tick(&wires).expect("this process");
            sound(&reply.outputs);
            wires.cut_off_closed = reply.pins.cut_off_closed;
            let sent = node.due(outputs.get_or_insert(reply.outputs), ActiveFaults::NONE);
            sent.iter().chain(&reply.pins.frames).flatten().for_each(is_ours);
            outputs = Some(reply.outputs);
        }
    }
}

/// What comes next.
enum Step {
    Frame(CanFrame),
    Ticks(u8),
    /// Enable, emergency stop released.
    Switches([bool; 2]),
}

fn step(cursor: &mut Cursor<'_>) -> Step {
    match cursor.byte() {
        0..64 => {
            let id = Identifier::of(ExtendedId::new(u32::from_le_bytes(cursor.take()) >> 3).expect("29 bits"));
            let length = usize::from(cursor.byte());
            let data = cursor.take::<8>();
            match data.get(..length).and_then(|data| CanFrame::new(id.extended(), data)) {
                Some(frame) => Step::Frame(frame),
                None => Step::Ticks(1),
            }
        }
        // A message that is heard, with a good CRC; some of them from elsewhere.
        what @ 64..216 => {
            let heard: Vec<&Entry> =
                MESSAGES.iter().filter(|entry| entry.header.sender != Sender::Controller).collect();
            let header = heard[usize::from(what) % heard.len()].header;
            let counter = cursor.byte();
            let elsewhere = counter & 0xf0 == 0xf0;
            let source = Addresses::DEFAULT.of(header.sender).filter(|_| !elsewhere).unwrap_or(counter);
            let id = header.identifier(source);
            let payload = u64::from_le_bytes(cursor.take());
            let payload = if header.protected { protect::seal(id, counter & 0xf, payload) } else { payload };
            Step::Frame(CanFrame::of_payload(id.extended(), payload))
        }
        216..250 => Step::Ticks(cursor.byte() % 32),
        250.. => Step::Switches([cursor.byte() & 1 != 0, cursor.byte() & 7 != 0]),
    }
}

/// A frame is taken in; one that is of no message, or not from its sender, changes no reading.
fn hear(node: &mut Node, frame: &CanFrame) {
    let id = Identifier::of(frame.extended_id());
    assert_eq!(id.extended(), frame.extended_id());
    let is_message =
        |entry: &&Entry| entry.header.pgn == id.pgn && Addresses::DEFAULT.of(entry.header.sender) == Some(id.source);
    let before = All::of(node.inbox());
    node.receive(frame);
    let after = All::of(node.inbox());
    let most = usize::from(MESSAGES.iter().any(|entry| is_message(&entry)));
    assert!(before.changed(&after) <= most, "{frame:?}: {before:?} became {after:?}");
    for Entry { header, signals } in MESSAGES.iter().filter(is_message) {
        let Some(payload) = frame.payload() else { continue };
        for signal in *signals {
            let code = signal.code_in(payload);
            assert_eq!(signal.code_in(signal.put(payload, code)), code, "{}", header.name);
            if let Ok(value) = signal.value(code) {
                assert!(value.is_finite() && signal.code(value) == code, "{}: {code} is {value}", header.name);
            }
        }
    }
}

/// Every reading.
#[derive(Debug)]
struct All {
    valves: [Reading<ValveCommand>; 4],
    tip: Reading<TipVelocity>,
    mode: Reading<Mode>,
    slope: Reading<Slope>,
    service: Reading<ServiceRequest>,
    pressures: [[Reading<f32>; 2]; 3],
}

impl All {
    fn of(inbox: &Inbox) -> Self {
        Self {
            valves: inbox.valves(),
            tip: inbox.tip_velocity(),
            mode: inbox.mode(),
            slope: inbox.slope(),
            service: inbox.service(),
            pressures: inbox.pressures_pa(),
        }
    }

    /// Messages whose readings differ.
    fn changed(&self, other: &Self) -> usize {
        let valves = self.valves.iter().zip(&other.valves).filter(|(one, other)| one != other).count();
        let pressures = self.pressures.iter().zip(&other.pressures).filter(|(one, other)| one != other).count();
        let alone =
            [self.tip != other.tip, self.mode != other.mode, self.slope != other.slope, self.service != other.service];
        valves + pressures + alone.into_iter().filter(|changed| *changed).count()
    }
}

/// A value is there exactly when it is fresh, and none is NaN.
fn readings_are_sound(inbox: &Inbox) {
    fn is_there<T>(reading: Reading<T>) -> Option<T> {
        assert_eq!(reading.value.is_some(), reading.validity == Validity::Fresh);
        reading.value
    }
    for command in inbox.valves().into_iter().filter_map(is_there) {
        assert!((0.0..=1.0).contains(&command.flow), "{command:?}");
    }
    let tip = is_there(inbox.tip_velocity()).map(|tip| [tip.x_mps, tip.z_mps, tip.pitch_radps]);
    let slope = is_there(inbox.slope()).map(|slope| [slope.roll.cos, slope.roll.sin, slope.pitch.cos, slope.pitch.sin]);
    let pressures = inbox.pressures_pa().into_iter().flatten().filter_map(is_there);
    let current = is_there(inbox.service()).map(|request| request.current_a);
    let numbers = tip.into_iter().flatten().chain(slope.into_iter().flatten()).chain(pressures).chain(current);
    assert!(numbers.into_iter().all(f32::is_finite), "{inbox:?}");
    if let Some(Intent { tip, levers, .. }) = Intent::of(inbox) {
        assert!([tip.x_mps, tip.z_mps, tip.pitch_radps].into_iter().all(f32::is_finite));
        assert!(levers.iter().all(|lever| lever.unsigned_abs() <= 32_767), "{levers:?}");
    }
}

/// A frame that the controller sends has its address, or none while it has none.
fn is_ours(frame: &CanFrame) {
    let source = Identifier::of(frame.extended_id()).source;
    assert!([Addresses::DEFAULT.own, firmware::can::id::NULL].contains(&source), "{frame:?}");
}
