//! Many poses: CSV in, CSV out, row by row. A bad row says so in its `error` column; only a bad header stops.

use std::fmt::Write as _;
use std::io::{self, BufRead, Write};

use super::description::{CYLINDER_COLUMNS, Description, JOINT_COLUMNS, TIP_COLUMNS, finite};
use super::progress::Progress;
use super::report::Report;
use super::solver::Solver;
use super::{Failure, Number};

const SWING: &str = "swing_deg";

/// The columns written, in this order. `x_m` is the signed reach, as on input.
pub const COLUMNS: [&str; 13] = [
    SWING,
    "boom_deg",
    "arm_deg",
    "bucket_deg",
    "boom_m",
    "arm_m",
    "bucket_m",
    "x_m",
    "z_m",
    "pitch_deg",
    "tip_x_from_boom_pin_m",
    "tip_z_from_boom_pin_m",
    "error",
];

/// What three numbers under these names make.
type Form = (fn([f64; 3]) -> Description, [&'static str; 3]);

/// Where the header puts the numbers of a row.
#[derive(Debug)]
struct Header {
    form: fn([f64; 3]) -> Description,
    names: [&'static str; 3],
    places: [usize; 3],
    swing: Option<usize>,
    width: usize,
}

/// Reads poses from `input` and writes them all to `output`. Without a column `swing_deg`, every row is swung by
/// `swing_deg`.
///
/// # Errors
/// `invalid_input` for a header that does not name one description (nothing is written then), for a swing given twice,
/// and where reading or writing fails.
pub fn convert<T: Number>(
    solver: &Solver<T>,
    swing_deg: Option<f64>,
    mut input: impl BufRead,
    output: impl Write,
) -> Result<(), Failure> {
    let mut line = Vec::new();
    let header = loop {
        if !next_line(&mut input, &mut line)? {
            return Err(Failure::invalid_input(format!("the CSV is empty; {NEEDED}")));
        }
        let text = line.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&line);
        if !text.trim_ascii().is_empty() {
            break Header::parse(&String::from_utf8_lossy(text))?;
        }
    };
    match (swing_deg, header.swing) {
        (Some(_), Some(_)) => {
            return Err(Failure::invalid_input(
                "the swing is given twice: by --swing and the column `swing_deg`".into(),
            ));
        }
        (Some(swing), None) => finite(SWING, swing)?,
        (None, _) => {}
    }
    let mut writer = Rows { csv: csv::Writer::from_writer(output), cell: String::new() };
    let mut progress = Progress::new("poses");
    let mut write_all = || -> Result<(), Failure> {
        if !open(writer.csv.write_record(COLUMNS))? {
            return Ok(());
        }
        while next_line(&mut input, &mut line)? {
            if line.trim_ascii().is_empty() {
                continue;
            }
            let given = header.row(&line, swing_deg.unwrap_or(0.0));
            let outcome = given.clone().and_then(|(description, swing)| solver.pose(&description, swing));
            if !open(writer.row(given.ok(), outcome))? {
                return Ok(());
            }
            progress.step();
        }
        match writer.csv.flush() {
            Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(write_failed(&e)),
            _ => Ok(()),
        }
    };
    write_all()
}

const NEEDED: &str = "its first line must name boom_m,arm_m,bucket_m or boom_deg,arm_deg,bucket_deg or \
                      x_m,z_m,pitch_deg, with or without swing_deg";

/// The next line without its end; false at the end of the input. A quote left open cannot swallow the lines after it.
fn next_line(input: &mut impl BufRead, line: &mut Vec<u8>) -> Result<bool, Failure> {
    line.clear();
    let read = input.read_until(b'\n', line).map_err(|e| Failure::invalid_input(format!("reading the CSV: {e}")))?;
    Ok(read > 0)
}

/// Cells between commas, without the blanks and quotes around them. Numbers and names contain neither.
fn cells(line: &str) -> impl Iterator<Item = &str> {
    line.trim().split(',').map(|cell| {
        let cell = cell.trim();
        cell.strip_prefix('"').and_then(|c| c.strip_suffix('"')).map_or(cell, str::trim)
    })
}

impl Header {
    fn parse(line: &str) -> Result<Self, Failure> {
        let columns: Vec<&str> = cells(line).collect();
        let bad = |what: String| Failure::invalid_input(format!("CSV header: {what}; {NEEDED}"));
        let forms: [Form; 3] = [
            (Description::Cylinders, CYLINDER_COLUMNS),
            (Description::Joints, JOINT_COLUMNS),
            (Description::Tip, TIP_COLUMNS),
        ];
        for (i, column) in columns.iter().enumerate() {
            if *column != SWING && !forms.iter().any(|(_, names)| names.contains(column)) {
                // What is no header may be anything, of any length.
                let shown: String = column.chars().take(40).flat_map(char::escape_debug).collect();
                return Err(bad(format!("unknown column `{shown}`")));
            }
            if columns[..i].contains(column) {
                return Err(bad(format!("column `{column}` stands twice")));
            }
        }
        let place = |name: &str| columns.iter().position(|column| *column == name);
        let mut found = forms.into_iter().filter_map(|(form, names)| {
            let first = names.iter().find(|name| place(name).is_some())?;
            Some((form, names, *first))
        });
        let Some((form, names, one)) = found.next() else {
            return Err(bad(format!("`{SWING}` alone is no pose")));
        };
        if let Some((.., other)) = found.next() {
            return Err(bad(format!("columns `{one}` and `{other}` belong to different descriptions")));
        }
        let mut places = [0; 3];
        for (slot, name) in places.iter_mut().zip(names) {
            *slot = place(name).ok_or_else(|| bad(format!("column `{name}` is missing")))?;
        }
        Ok(Self { form, names, places, swing: place(SWING), width: columns.len() })
    }

    /// The description and swing of one row.
    fn row(&self, line: &[u8], swing_deg: f64) -> Result<(Description, f64), Failure> {
        let text = String::from_utf8_lossy(line);
        let mut row = [""; 4];
        let mut count = 0;
        for cell in cells(&text) {
            if let Some(slot) = row.get_mut(count) {
                *slot = cell;
            }
            count += 1;
        }
        if count != self.width {
            return Err(Failure::invalid_input(format!("{count} cells where the header has {} columns", self.width)));
        }
        let number = |place: usize, name: &str| {
            let cell = row[place];
            let value =
                cell.parse().map_err(|_| Failure::invalid_input(format!("`{name}`: `{cell}` is not a number")))?;
            finite(name, value).map(|()| value)
        };
        let mut values = [0.0; 3];
        for ((value, place), name) in values.iter_mut().zip(self.places).zip(self.names) {
            *value = number(place, name)?;
        }
        let swing = self.swing.map_or(Ok(swing_deg), |place| number(place, SWING))?;
        Ok(((self.form)(values), swing))
    }
}

struct Rows<W: Write> {
    csv: csv::Writer<W>,
    cell: String,
}

impl<W: Write> Rows<W> {
    /// One row: the whole pose, or what was given of it and the error.
    fn row<T: Number>(
        &mut self,
        given: Option<(Description, f64)>,
        outcome: Result<Report<T>, Failure>,
    ) -> csv::Result<()> {
        let mut numbers: [Option<T>; 12] = [None; 12];
        let mut error = None;
        match outcome {
            Ok(report) => numbers = columns(&report).map(Some),
            Err(failure) => {
                if let Some((description, swing)) = given {
                    numbers[0] = Some(T::from_f64(swing));
                    let (values, names) = description.named();
                    for (value, name) in values.into_iter().zip(names) {
                        if let Some(at) = COLUMNS.iter().position(|column| *column == name) {
                            numbers[at] = Some(T::from_f64(value));
                        }
                    }
                }
                error = Some(failure);
            }
        }
        for number in numbers {
            self.cell.clear();
            if let Some(number) = number.filter(|x| x.to_f64().is_finite()) {
                let _ = write!(self.cell, "{number}");
            }
            self.csv.write_field(&self.cell)?;
        }
        self.cell.clear();
        if let Some(Failure { kind, message }) = error {
            let _ = write!(self.cell, "{}: {message}", kind.name());
        }
        self.csv.write_field(&self.cell)?;
        self.csv.write_record(None::<&[u8]>)
    }
}

/// The numbers under [`COLUMNS`].
fn columns<T: Number>(report: &Report<T>) -> [T; 12] {
    let Report { swing_deg, joints_deg: j, cylinders_m: c, tip, tip_from_boom_pin: p, .. } = *report;
    [swing_deg, j.boom, j.arm, j.bucket, c.boom, c.arm, c.bucket, tip.reach_m, tip.z_m, tip.pitch_deg, p.x_m, p.z_m]
}

/// Whether the output still has a reader: one who has seen enough (`| head`) is no error.
fn open(result: csv::Result<()>) -> Result<bool, Failure> {
    match result {
        Ok(()) => Ok(true),
        Err(error) => match error.kind() {
            csv::ErrorKind::Io(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(false),
            _ => Err(write_failed(&error)),
        },
    }
}

fn write_failed(error: &dyn std::fmt::Display) -> Failure {
    Failure::invalid_input(format!("writing the CSV: {error}"))
}
