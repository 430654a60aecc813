//! `docs/ecu.svg`: the reference ECU as blocks, and the pins they hang on, which `docs/porting.md` lists.

use std::fmt::Write;

use firmware::board::signals::{SIGNALS, Signal};
use firmware::can::message::Sender;
use firmware::io::SPOOLS;

/// Pins, function, peripheral: a row of the table in `docs/porting.md` each.
pub const PINS: [[&str; 3]; 11] = [
    ["PA5, PA6, PA7", "SCLK, MISO, MOSI of both converters", "SPI1, mode 1, 10.5 MHz"],
    ["PA4, PC4", "chip selects of converter 1 and 2", "GPIO"],
    ["PC6, PC7", "swing: extend, retract", "TIM3 CH1, CH2"],
    ["PC8, PC9", "boom: extend, retract", "TIM3 CH3, CH4"],
    ["PB6, PB7", "arm: extend, retract", "TIM4 CH1, CH2"],
    ["PB8, PB9", "bucket: extend, retract", "TIM4 CH3, CH4"],
    ["PB0", "master cut-off, high closes it", "GPIO, pulled down"],
    ["PB1", "read-back: the cut-off's own contact, high when closed", "GPIO"],
    ["PB10", "enable switch, high when on", "GPIO, pulled down"],
    ["PB11", "emergency-stop chain, high while released", "GPIO, pulled down"],
    ["PA11, PA12", "CAN RX, TX", "CAN1"],
];

/// Width of the picture.
const WIDTH: i32 = 1180;
const HEIGHT: i32 = 640;
const LINE: i32 = 17;

/// A block: its place, its heading, the lines below it.
struct Block {
    x: i32,
    y: i32,
    width: i32,
    colour: &'static str,
    title: String,
    lines: Vec<String>,
}

impl Block {
    fn new(x: i32, y: i32, width: i32, colour: &'static str, title: &str, lines: Vec<String>) -> Self {
        Self { x, y, width, colour, title: title.to_owned(), lines }
    }

    fn height(&self) -> i32 {
        30 + LINE * self.lines.len() as i32
    }

    fn write(&self, out: &mut String) -> std::fmt::Result {
        let Self { x, y, width, colour, title, lines } = self;
        let height = self.height();
        writeln!(
            out,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"6\" fill=\"{colour}\" stroke=\"#333\"/>\n\
             <text x=\"{}\" y=\"{}\" font-weight=\"600\">{title}</text>",
            x + 10,
            y + 20
        )?;
        for (index, line) in (1..).zip(lines) {
            writeln!(out, "<text x=\"{}\" y=\"{}\" font-size=\"12\">{line}</text>", x + 10, y + 20 + LINE * index)?;
        }
        Ok(())
    }
}

/// A line with an arrow at its end, and what runs on it.
fn arrow(out: &mut String, from: (i32, i32), to: (i32, i32), text: &str) -> std::fmt::Result {
    let ((x1, y1), (x2, y2)) = (from, to);
    writeln!(
        out,
        "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" stroke=\"#333\" stroke-width=\"1.5\" marker-end=\"url(#to)\"/>\n\
         <text x=\"{}\" y=\"{}\" font-size=\"12\" text-anchor=\"middle\">{text}</text>",
        (x1 + x2) / 2,
        (y1 + y2) / 2 - 6
    )
}

/// Channels of a converter, as the drivers sort them.
fn channels(chip: usize) -> Vec<String> {
    let name = |signal: &Signal| match signal {
        Signal::Position(spool) => format!("position, {}", SPOOLS[*spool]),
        Signal::Supply => "battery voltage".to_owned(),
        Signal::SensorSupply => "sensor supply".to_owned(),
        Signal::Coil(spool, side) => format!("current, {} {}", SPOOLS[*spool], ["extend", "retract"][*side]),
        Signal::Spare => "analogue ground".to_owned(),
    };
    SIGNALS[chip].iter().enumerate().map(|(channel, signal)| format!("{channel}  {}", name(signal))).collect()
}

fn pins(row: usize) -> String {
    let [pins, function, peripheral] = PINS[row];
    format!("{pins}: {function} ({peripheral})")
}

/// The picture.
pub fn diagram() -> String {
    let mut out = String::new();
    let written = write(&mut out);
    debug_assert!(written.is_ok(), "a string takes everything");
    out
}

fn write(out: &mut String) -> std::fmt::Result {
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"Block diagram of the reference ECU\" \
         viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"system-ui, sans-serif\" font-size=\"14\">\n\
         <defs><marker id=\"to\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"8\" markerHeight=\"8\" \
         orient=\"auto-start-reverse\"><path d=\"M0 0 L8 4 L0 8 z\" fill=\"#333\"/></marker></defs>\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>"
    )?;
    let owned = |lines: &[&str]| lines.iter().map(|&line| line.to_owned()).collect::<Vec<_>>();
    let (input, chip, power) = ("#e8f1fa", "#eef6ec", "#fdf1e0");
    let blocks = [
        Block::new(20, 20, 220, input, "ADS8688 converter 1", channels(0)),
        Block::new(20, 220, 220, input, "ADS8688 converter 2", channels(1)),
        Block::new(20, 420, 220, input, "Operator's switches", owned(&["enable switch", "emergency-stop chain"])),
        Block::new(20, 520, 220, input, "CAN bus, 500 kbit/s", bus()),
        Block::new(330, 20, 480, chip, "STM32F405RG", (0..PINS.len()).map(pins).collect()),
        Block::new(
            330,
            280,
            480,
            chip,
            "firmware::Controller, 1 kHz",
            owned(&[
                "read: CAN in, scan of both converters, switches",
                "tick: sensing, pose, motion or service, fence, valves;",
                "the supervisor alone opens the gate",
                "write: duties, cut-off, CAN out, watchdog last",
            ]),
        ),
        Block::new(
            330,
            420,
            480,
            chip,
            "Independent watchdog (IWDG)",
            owned(&["resets the ECU unless a whole sequence ran"]),
        ),
        Block::new(
            330,
            520,
            480,
            chip,
            "Flash sectors 2 and 3",
            owned(&["parameters, two approved copies", "written only with the cut-off open"]),
        ),
        Block::new(
            920,
            20,
            240,
            power,
            "Eight solenoid drivers",
            SPOOLS.map(|spool| format!("{spool}: extend, retract")).to_vec(),
        ),
        Block::new(
            920,
            270,
            240,
            power,
            "Master cut-off relay",
            owned(&["opens the solenoids' supply", "its own contact is read back"]),
        ),
        Block::new(920, 170, 180, power, "Valve block", owned(&["four proportional spools"])),
    ];
    for block in &blocks {
        block.write(out)?;
    }
    arrow(out, (240, 60), (330, 60), "SPI")?;
    arrow(out, (240, 260), (330, 130), "SPI")?;
    arrow(out, (240, 450), (330, 190), "GPIO")?;
    arrow(out, (240, 570), (330, 225), "CAN")?;
    arrow(out, (570, 237), (570, 280), "")?;
    arrow(out, (570, 378), (570, 420), "")?;
    arrow(out, (810, 70), (920, 70), "PWM 20 kHz")?;
    arrow(out, (810, 200), (920, 290), "GPIO")?;
    arrow(out, (920, 320), (810, 230), "read-back")?;
    arrow(out, (1000, 118), (1000, 170), "")?;
    arrow(out, (1130, 270), (1130, 118), "supply")?;
    out.push_str("</svg>\n");
    Ok(())
}

/// Everybody on the bus but the controller.
fn bus() -> Vec<String> {
    [Sender::Operator, Sender::SlopeSensor, Sender::PressureSensors, Sender::ServiceTool]
        .map(|sender| sender.name().to_owned())
        .to_vec()
}
