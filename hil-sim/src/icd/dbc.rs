//! The DBC file.

use std::fmt::Write;

use firmware::can::address::Addresses;
use firmware::can::id::NULL;
use firmware::can::message::{Entry, Rate, Sender};
use firmware::can::signal::{Kind, Signal};
use firmware::can::table::MESSAGES;

use super::numbers::number;

const NODES: [Sender; 5] =
    [Sender::Controller, Sender::Operator, Sender::SlopeSensor, Sender::PressureSensors, Sender::ServiceTool];

/// Marks a 29-bit identifier.
const EXTENDED: u32 = 1 << 31;

/// `VFrameFormat`'s value for J1939.
const J1939_FORMAT: u32 = 3;

fn id(entry: &Entry) -> u32 {
    let source = Addresses::DEFAULT.of(entry.header.sender).unwrap_or(NULL);
    entry.header.identifier(source).raw() | EXTENDED
}

/// The file.
pub fn dbc() -> String {
    let mut out = String::new();
    let written = write(&mut out);
    debug_assert!(written.is_ok(), "a string takes everything");
    out
}

fn write(out: &mut String) -> std::fmt::Result {
    let nodes = NODES.map(Sender::name).join(" ");
    writeln!(out, "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: {nodes}\n")?;
    for entry in &MESSAGES {
        let header = entry.header;
        writeln!(out, "BO_ {} {}: {} {}", id(entry), header.name, header.bytes, header.sender.name())?;
        let receiver = if header.sender == Sender::Controller { "Vector__XXX" } else { Sender::Controller.name() };
        for signal in entry.signals {
            writeln!(out, " {} {receiver}", line(signal))?;
        }
        writeln!(out)?;
    }
    for entry in &MESSAGES {
        writeln!(out, "CM_ BO_ {} \"{}\";", id(entry), entry.header.about)?;
    }
    out.push_str(
        "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\",\"J1939PG\";\n\
         BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n\
         BA_DEF_ \"ProtocolType\" STRING ;\n\
         BA_DEF_ \"Baudrate\" INT 0 1000000;\n\
         BA_DEF_DEF_ \"VFrameFormat\" \"J1939PG\";\n\
         BA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n\
         BA_DEF_DEF_ \"ProtocolType\" \"J1939\";\n\
         BA_DEF_DEF_ \"Baudrate\" 500000;\n",
    );
    writeln!(out, "BA_ \"ProtocolType\" \"J1939\";\nBA_ \"Baudrate\" {};", firmware::can::load::BIT_RATE)?;
    for entry in &MESSAGES {
        writeln!(out, "BA_ \"VFrameFormat\" BO_ {} {J1939_FORMAT};", id(entry))?;
        if let Rate::Every { ms, .. } = entry.header.rate {
            writeln!(out, "BA_ \"GenMsgCycleTime\" BO_ {} {ms};", id(entry))?;
        }
    }
    for entry in &MESSAGES {
        for signal in entry.signals {
            if let Kind::States(states) = signal.kind {
                let named: String = states.iter().map(|(code, name)| format!(" {code} \"{name}\"")).collect();
                let (error, none) = (signal.error(), signal.not_available());
                let rest = format!(" {error} \"error\" {none} \"not_available\"");
                writeln!(out, "VAL_ {} {}{named}{rest} ;", id(entry), signal.name)?;
            }
        }
    }
    Ok(())
}

/// `SG_ name : start|length@1+ (factor,offset) [low|high] "unit"`, little-endian and unsigned.
fn line(signal: &Signal) -> String {
    let Signal { name, start, length, scale, .. } = signal;
    let [low, high] = match signal.kind {
        Kind::Measured => signal.range.map(number),
        Kind::States(_) | Kind::Bits => ["0".into(), signal.not_available().to_string()],
    };
    let (factor, offset, unit) = (number(scale.factor), number(scale.offset), scale.unit);
    format!("SG_ {name} : {start}|{length}@1+ ({factor},{offset}) [{low}|{high}] \"{unit}\"")
}
