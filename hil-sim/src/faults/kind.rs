//! Every fault of the campaign, its bound, and why some have none.

use firmware::simulated::FRAMES_IN;
use sim_chips::ads8688::Break;

use crate::plant::Defect;
use crate::plant::coil::Broken;

/// What happens to a position sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensor {
    /// The wire is off: 0 V.
    Off,
    /// Shorted to its supply.
    Shorted,
    /// It stays where it was, without noise.
    Stuck,
    /// Any voltage every millisecond.
    Garbage,
    /// All at once it reads a tenth to a third less.
    Gain,
    /// All at once it reads a twentieth to a fifth of the stroke more or less.
    Offset,
    /// All at once it reads the stroke the wrong way round.
    Sign,
    /// It follows with a time constant of half a second.
    Slow,
    /// It is 0.3 s late.
    Delayed,
    /// Off for 5 ms of every 50.
    Intermittent,
    /// It drifts away, a millimetre a second.
    Drift,
}

/// What happens to the operator's messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bus {
    /// None arrives.
    Lost,
    /// The last ones are repeated, counter and all.
    Frozen,
    /// A bit is wrong in each.
    Garbage,
    /// Gone for 150 of every 300 ms.
    Intermittent,
    /// All are 50 ms late.
    Delayed,
}

/// What is spoilt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// The position sensor of the cylinder in motion.
    Sensor(Sensor),
    /// The solenoid that drives it.
    Coil(Broken),
    /// The operator's messages.
    Bus(Bus),
    /// The supply at its measurement, V.
    Supply(f64),
    /// The sensors' supply, V.
    SensorSupply(f64),
    /// A converter.
    Converter(usize, Break),
    /// Every tick ends too late.
    Overrun,
    /// The spool of the cylinder in motion.
    Spool(Defect),
    /// The pump's pressure: of every spool.
    NoPressure,
    /// Bits of the stored parameter record, in both copies, before the start.
    Record,
}

/// A row of the campaign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// What is spoilt.
    pub cause: Cause,
    /// From the first tick it can be seen to the tick that names it, ms; `None` where nothing promises that it is seen.
    pub bound_ms: Option<f64>,
    /// Why there is no bound, or what it is made of.
    pub reason: Option<&'static str>,
}

const fn row(name: &'static str, cause: Cause, bound_ms: f64) -> Kind {
    Kind { name, cause, bound_ms: Some(bound_ms), reason: None }
}

const fn unseen(name: &'static str, cause: Cause, reason: &'static str) -> Kind {
    Kind { name, cause, bound_ms: None, reason: Some(reason) }
}

/// Every fault.
pub const KINDS: [Kind; 31] = [
    row("sensor_off", Cause::Sensor(Sensor::Off), 20.0),
    row("sensor_shorted", Cause::Sensor(Sensor::Shorted), 20.0),
    row("sensor_stuck", Cause::Sensor(Sensor::Stuck), 200.0),
    row("sensor_garbage", Cause::Sensor(Sensor::Garbage), 20.0),
    row("sensor_gain", Cause::Sensor(Sensor::Gain), 20.0),
    row("sensor_offset", Cause::Sensor(Sensor::Offset), 20.0),
    row("sensor_sign", Cause::Sensor(Sensor::Sign), 100.0),
    row("sensor_intermittent", Cause::Sensor(Sensor::Intermittent), 20.0),
    unseen(
        "sensor_slow",
        Cause::Sensor(Sensor::Slow),
        "a reading half a second behind is what a slow valve shows too; there is no second sensor to tell them apart",
    ),
    unseen(
        "sensor_delayed",
        Cause::Sensor(Sensor::Delayed),
        "0.3 s late lies within what a healthy machine's dead time and running-on may be",
    ),
    unseen(
        "sensor_drift",
        Cause::Sensor(Sensor::Drift),
        "a millimetre a second is slower than a healthy cylinder's leakage and noise show; there is no second sensor",
    ),
    row("coil_open", Cause::Coil(Broken::Open), 50.0),
    row("coil_short_to_supply", Cause::Coil(Broken::ShortToSupply), 20.0),
    row("coil_short_to_ground", Cause::Coil(Broken::ShortToGround), 20.0),
    unseen(
        "coil_shorted_turns",
        Cause::Coil(Broken::Resistance(0.3)),
        "the current loop holds the current all the same; it is seen only where the current is more than a cold winding could draw",
    ),
    unseen(
        "coil_corroded_plug",
        Cause::Coil(Broken::Resistance(2.0)),
        "the current loop makes up for it as long as the supply can",
    ),
    row("command_lost", Cause::Bus(Bus::Lost), 100.0),
    row("command_frozen", Cause::Bus(Bus::Frozen), 100.0),
    row("command_garbage", Cause::Bus(Bus::Garbage), 100.0),
    row("command_intermittent", Cause::Bus(Bus::Intermittent), 100.0),
    unseen(
        "command_delayed",
        Cause::Bus(Bus::Delayed),
        "counters and checksums of late messages are good; a delay below the time-out cannot be told from a slow operator",
    ),
    row("supply_low", Cause::Supply(7.0), 20.0),
    row("supply_high", Cause::Supply(34.0), 20.0),
    row("sensor_supply_off", Cause::SensorSupply(0.0), 20.0),
    row("sensor_converter_dead", Cause::Converter(0, Break::StuckHigh), 20.0),
    row("coil_converter_dead", Cause::Converter(1, Break::StuckLow), 20.0),
    row("tick_overrun", Cause::Overrun, 5.0),
    row("record_corrupt", Cause::Record, 0.0),
    Kind {
        name: "spool_stuck",
        cause: Cause::Spool(Defect::Stuck),
        bound_ms: Some(2350.0),
        reason: Some(
            "100 ms after the speed leaves what a healthy machine may do, which may start 250 ms late and run on for 2 s after its release; \
             a cylinder that is at its stop before its true speed has left that for half a swing shows nothing",
        ),
    },
    unseen(
        "spool_leaking",
        Cause::Spool(Defect::Leaking(0.05)),
        "50 mm/s hide in the speeds a healthy machine may have while it moves and is shaken; at rest it is seen",
    ),
    unseen(
        "pressure_lost",
        Cause::NoPressure,
        "a machine that stands against its command looks stalled, unless the pressure on the driven side says otherwise",
    ),
];

/// Faults that no run on the host can have, and where they are tried.
pub const ELSEWHERE: [(&str, &str); 3] = [
    (
        "constants_bit_flip",
        "in emulation, `cargo hil flips`: a turned bit among the watched constants that parameters became is named within a round of the watch",
    ),
    (
        "state_bit_flip",
        "in emulation, `cargo hil flips`: of the state there is one copy; what a turned bit makes of it is seen only where another check meets it",
    ),
    ("timer_lost", "in emulation, `cargo hil flips`: the watchdog resets the chip after 50 ms"),
];

/// Frames that the operator's panel takes up: the first of a tick.
pub(super) const PANEL_FRAME: usize = 0;
const _: () = assert!(PANEL_FRAME < FRAMES_IN);
