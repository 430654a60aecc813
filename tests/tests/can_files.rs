//! `docs/icd.md` and `docs/excavator.dbc` are what the tables say, and an independent parser reads golden frames as we do.

use std::process::Command;

use cross_tests::can::name;
use cross_tests::rig::workspace;
use embedded_can::Frame;
use firmware::can::CanFrame;
use firmware::can::id::Identifier;
use firmware::can::protect;
use firmware::can::signal::Kind;
use firmware::can::table::MESSAGES;

const GOLDEN: &str = include_str!("../data/golden/can_frames.txt");

/// A line of the golden file: `Message identifier bytes | Signal=code …`.
struct Golden {
    name: &'static str,
    frame: CanFrame,
    codes: Vec<(&'static str, u32)>,
}

fn golden() -> Vec<Golden> {
    let lines = GOLDEN.lines().filter(|line| !line.starts_with('#'));
    let all: Vec<Golden> = lines
        .map(|line| {
            let (frame, codes) = line.split_once(" | ").unwrap();
            let [name, id, data] = frame.split(' ').collect::<Vec<_>>().try_into().unwrap();
            let data: Vec<u8> =
                (0..data.len()).step_by(2).map(|i| u8::from_str_radix(&data[i..i + 2], 16).unwrap()).collect();
            let id = embedded_can::ExtendedId::new(u32::from_str_radix(id, 16).unwrap()).unwrap();
            let codes = codes.split(' ').map(|code| code.split_once('=').unwrap());
            let codes = codes.map(|(signal, code)| (signal, code.parse().unwrap())).collect();
            Golden { name, frame: CanFrame::new(id, &data).unwrap(), codes }
        })
        .collect();
    assert_eq!(all.len(), MESSAGES.len(), "one of each message");
    all
}

/// The payload with bytes that are not there as ones.
fn payload(frame: &CanFrame) -> u64 {
    let mut bytes = [0xff; 8];
    bytes[..frame.dlc()].copy_from_slice(frame.data());
    u64::from_le_bytes(bytes)
}

#[test]
fn the_page_and_the_dbc_file_are_up_to_date() {
    for (file, text) in hil_sim::icd::files() {
        let found = std::fs::read_to_string(workspace().join(file)).unwrap();
        assert!(found == text, "{file} is out of date: cargo hil icd");
    }
}

#[test]
fn the_pins_of_the_block_diagram_are_those_of_the_porting_page() {
    let page = std::fs::read_to_string(workspace().join("docs/porting.md")).unwrap();
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| P")).collect();
    let drawn =
        hil_sim::icd::PINS.map(|[pins, function, peripheral]| format!("| {pins} | {function} | {peripheral} |"));
    assert_eq!(rows, drawn);
}

#[test]
fn golden_frames_are_made_and_read_by_the_tables() {
    for (golden, entry) in golden().iter().zip(&MESSAGES) {
        let id = Identifier::of(golden.frame.extended_id());
        assert_eq!((golden.name, name(id.pgn)), (entry.header.name, Some(golden.name)));
        let codes: Vec<_> =
            entry.signals.iter().map(|signal| (signal.name, signal.code_in(payload(&golden.frame)))).collect();
        assert_eq!(codes, golden.codes, "{}", golden.name);
        let made =
            entry.signals.iter().zip(&golden.codes).fold(u64::MAX, |p, (signal, &(_, code))| signal.put(p, code));
        assert_eq!(made, payload(&golden.frame), "{}", golden.name);
        let opens = protect::open(id, made).is_some();
        assert_eq!(opens, entry.header.protected, "{}: its CRC", golden.name);
    }
}

/// Reads frames, codes and values from standard input, has cantools decode the frames, and compares.
const SCRIPT: &str = "
import sys, cantools
database = cantools.database.load_file(sys.argv[1], strict=True)
signals = 0
for line in sys.stdin:
    name, frame_id, data, *expected = line.split()
    message = database.get_message_by_name(name)
    assert message.frame_id == int(frame_id, 16) and message.is_extended_frame and message.protocol == 'j1939', name
    data = bytes.fromhex(data)
    assert len(data) == message.length, name
    codes = database.decode_message(message.frame_id, data, decode_choices=False, scaling=False)
    values = database.decode_message(message.frame_id, data, decode_choices=False)
    assert set(codes) == {e.split('=')[0] for e in expected}, name
    for e in expected:
        signal, rest = e.split('=')
        code, value, near = rest.split(',')
        assert codes[signal] == int(code), (name, signal, codes[signal], code)
        assert value == 'none' or abs(values[signal] - float(value)) <= float(near), (name, signal, values[signal], value)
        signals += 1
print(signals, 'signals of', len(database.messages), 'messages')
";

#[test]
#[ignore = "needs cantools: run cargo xtask test"]
fn an_independent_parser_takes_the_dbc_file_and_decodes_the_golden_frames_alike() {
    let mut lines = String::new();
    let mut signals = 0;
    for (golden, entry) in golden().iter().zip(&MESSAGES) {
        let data: String = golden.frame.data().iter().map(|byte| format!("{byte:02x}")).collect();
        lines += &format!("{} {:x} {data}", golden.name, golden.frame.extended_id().as_raw());
        for signal in entry.signals {
            let code = signal.code_in(payload(&golden.frame));
            let value = match (signal.kind, signal.value(code)) {
                (Kind::Measured, Ok(value)) => value.to_string(),
                (Kind::Measured, Err(_)) => "none".into(),
                _ => code.to_string(),
            };
            // Ours are f32: a hundredth of a code.
            let near = 0.01 * signal.scale.factor;
            lines += &format!(" {}={code},{value},{near}", signal.name);
            signals += 1;
        }
        lines.push('\n');
    }
    let python = workspace().join("target/cantools/bin/python3");
    let input = tempfile(&lines);
    let output = Command::new(&python)
        .args(["-c", SCRIPT])
        .arg(workspace().join("docs/excavator.dbc"))
        .stdin(std::fs::File::open(&input).unwrap())
        .output()
        .unwrap_or_else(|error| panic!("{}: {error}; cargo xtask test installs it", python.display()));
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(said.trim(), format!("{signals} signals of {} messages", MESSAGES.len()));
}

fn tempfile(text: &str) -> std::path::PathBuf {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("can_frames.txt");
    std::fs::write(&path, text).unwrap();
    path
}
