//! `log.csv` and `dig.csv`: every column with its name, its unit in the name.

use std::fmt::Write;
use std::io;
use std::path::Path;

use firmware::io::SPOOLS;
use kinematics_core::Cylinders;

use crate::place::Timing;
use crate::run::{Log, Row};

/// A cell; numbers of the simulation to a nanometre, the controller's f32 numbers to the bit.
enum Cell {
    Double(f64),
    Single(f32),
    Whole(u64),
    Word(&'static str),
    Empty,
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Empty, Self::Double)
    }
}

type Value = Box<dyn Fn(&Row, &Timing) -> Cell>;

/// Boom, arm, bucket.
pub(super) fn lengths<T: Copy>(c: &Cylinders<T>) -> [T; 3] {
    [c.boom, c.arm, c.bucket]
}

const CYLINDERS: [&str; 3] = ["boom", "arm", "bucket"];

/// The columns of `log.csv`, in order.
fn columns() -> Vec<(String, Value)> {
    let mut all = Vec::new();
    let mut add = |name: &str, cell: Value| all.push((name.to_owned(), cell));
    add("time_s", Box::new(|row, _| Cell::Double(row.time_s)));
    add("state", Box::new(|row, _| Cell::Word(row.outputs.state.name())));
    add("fault", Box::new(|row, _| row.outputs.fault.map_or(Cell::Empty, |fault| Cell::Word(fault.name()))));
    add("dig_tick", Box::new(|row, _| Cell::Whole(row.outputs.dig_tick.into())));
    add("swing_true_deg", Box::new(|row, _| row.swing.map(|swing| swing.angle().to_degrees()).into()));
    for (i, name) in CYLINDERS.into_iter().enumerate() {
        add(&format!("{name}_true_m"), Box::new(move |row, _| Cell::Double(lengths(&row.lengths)[i])));
    }
    for (i, name) in CYLINDERS.into_iter().enumerate() {
        add(&format!("{name}_measured_m"), Box::new(move |row, _| Cell::Single(lengths(&row.outputs.lengths)[i])));
    }
    for (i, name) in CYLINDERS.into_iter().enumerate() {
        let cell = move |row: &Row, _: &Timing| Cell::Single(lengths(&row.outputs.reference)[i]);
        add(&format!("{name}_reference_m"), Box::new(cell));
    }
    for (i, axis) in ["x", "z"].into_iter().enumerate() {
        add(&format!("tip_{axis}_true_m"), Box::new(move |row, _| row.tip.map(|tip| tip[i]).into()));
    }
    for (i, axis) in ["x", "z"].into_iter().enumerate() {
        add(&format!("tip_{axis}_reference_m"), Box::new(move |row, _| row.reference.map(|tip| tip[i]).into()));
    }
    add("tip_error_m", Box::new(|row, _| row.tip_error_m().into()));
    add("pose_valid", Box::new(|row, _| Cell::Whole(row.outputs.pose_valid.into())));
    add("tip_x_estimate_m", Box::new(|row, _| Cell::Single(row.outputs.pose.plane.reach)));
    add("tip_z_estimate_m", Box::new(|row, _| Cell::Single(row.outputs.pose.plane.height)));
    for (i, name) in ["swing_asked", "boom_asked_mps", "arm_asked_mps", "bucket_asked_mps"].into_iter().enumerate() {
        add(name, Box::new(move |row, _| Cell::Single(row.outputs.asked.to_array()[i])));
    }
    add(
        "fence_clearance_estimate_m",
        Box::new(|row, _| match row.outputs.clearance_m {
            // Nothing to be clear of.
            f32::MAX => Cell::Empty,
            clearance => Cell::Single(clearance),
        }),
    );
    // A swing motor's is in rad/s.
    for (i, name) in ["swing_speed", "boom_speed_mps", "arm_speed_mps", "bucket_speed_mps"].into_iter().enumerate() {
        add(name, Box::new(move |row, _| Cell::Single(row.outputs.speeds.to_array()[i])));
    }
    for (spool, name) in SPOOLS.into_iter().enumerate() {
        for (side, direction) in ["extend", "retract"].into_iter().enumerate() {
            let current = move |row: &Row, _: &Timing| Cell::Single(row.outputs.currents[spool][side]);
            add(&format!("{name}_{direction}_a"), Box::new(current));
        }
    }
    for (spool, name) in SPOOLS.into_iter().enumerate() {
        for (side, direction) in ["extend", "retract"].into_iter().enumerate() {
            let duty = move |row: &Row, _: &Timing| Cell::Whole(row.outputs.duties[spool][side].into());
            add(&format!("{name}_{direction}_duty_of_65535"), Box::new(duty));
        }
    }
    add(
        "host_wall_ns",
        Box::new(|_, timing| match *timing {
            Timing::Host { wall_ns } => Cell::Whole(wall_ns.into()),
            Timing::Emulator { .. } => Cell::Empty,
        }),
    );
    add(
        "emulator_instructions",
        Box::new(|_, timing| match *timing {
            Timing::Emulator { instructions, .. } => Cell::Whole(instructions.into()),
            Timing::Host { .. } => Cell::Empty,
        }),
    );
    add(
        "emulator_started_ns",
        Box::new(|_, timing| match *timing {
            Timing::Emulator { started_ns, .. } => Cell::Whole(started_ns.into()),
            Timing::Host { .. } => Cell::Empty,
        }),
    );
    all
}

/// Writes `log.csv`: a row a tick.
///
/// # Errors
/// The file cannot be written.
pub(super) fn write_log(log: &Log, file: &Path) -> io::Result<()> {
    let columns = columns();
    let mut writer = ::csv::Writer::from_path(file)?;
    writer.write_record(columns.iter().map(|(name, _)| name))?;
    let rows = log.rows.iter().zip(&log.timing);
    write_rows(writer, rows, |(row, timing), out| columns.iter().for_each(|(_, cell)| out(cell(row, timing))))
}

/// A moment of a dig that is only drawn.
pub(super) struct Moment {
    pub(super) time_s: f64,
    pub(super) tip: [f64; 2],
    pub(super) pitch_deg: f64,
    /// The lengths it needs, whatever the strokes; `None` where the machine has no such pose.
    pub(super) lengths: Option<Cylinders<f64>>,
}

/// Writes `dig.csv`: a row a control tick.
///
/// # Errors
/// The file cannot be written.
pub(super) fn write_dig(dig: &[Moment], file: &Path) -> io::Result<()> {
    let mut writer = ::csv::Writer::from_path(file)?;
    writer.write_record(["time_s", "tip_x_m", "tip_z_m", "pitch_deg", "boom_m", "arm_m", "bucket_m"])?;
    write_rows(writer, dig.iter(), |moment, out| {
        [moment.time_s, moment.tip[0], moment.tip[1], moment.pitch_deg]
            .map(Cell::Double)
            .into_iter()
            .for_each(&mut *out);
        (0..3).for_each(|i| out(moment.lengths.as_ref().map(|c| lengths(c)[i]).into()));
    })
}

/// Writes rows of cells through one record, so that a row allocates nothing.
fn write_rows<R>(
    mut writer: ::csv::Writer<std::fs::File>,
    rows: impl Iterator<Item = R>,
    cells: impl Fn(R, &mut dyn FnMut(Cell)),
) -> io::Result<()> {
    let mut record = ::csv::StringRecord::new();
    let mut text = String::new();
    for row in rows {
        record.clear();
        cells(row, &mut |cell| {
            text.clear();
            // Writing to a string cannot fail.
            let _ = match cell {
                Cell::Double(value) => write!(text, "{value:.9}"),
                Cell::Single(value) => write!(text, "{value}"),
                Cell::Whole(value) => write!(text, "{value}"),
                Cell::Word(word) => write!(text, "{word}"),
                Cell::Empty => Ok(()),
            };
            record.push_field(&text);
        });
        writer.write_record(&record)?;
    }
    writer.flush()
}
