//! `hil pose --csv`: many rows, good and bad; the golden values from every description.

mod hil;

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use hil::{hil_in, pose};
use hil_sim::machine_file::MachineFile;

fn csv(args: &[&str], input: &str) -> Vec<Vec<String>> {
    let answer = hil_in(None, &[args, &["--csv", "-"]].concat(), input.as_bytes());
    assert_eq!(answer.code, Some(0), "{}{}", answer.out, answer.err);
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(answer.out.as_bytes());
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

const COLUMNS: &str = "swing_deg,boom_deg,arm_deg,bucket_deg,boom_m,arm_m,bucket_m,x_m,z_m,pitch_deg,\
                       tip_x_from_boom_pin_m,tip_z_from_boom_pin_m,error";

fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or_else(|_| panic!("`{cell}` is not a number"))
}

/// Rows of the golden file: boom, arm, bucket [deg]; the same [m]; tip x and z from the boom pin.
fn golden(machine: &str) -> Vec<[f64; 8]> {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/data/golden/{machine}.csv"));
    let text = fs::read_to_string(file).unwrap();
    let rows = text.lines().skip(1).map(|line| {
        let cells: Vec<f64> = line.split(',').map(number).collect();
        cells[..8].try_into().unwrap()
    });
    rows.collect()
}

const GOLDEN: [&str; 3] = ["exact-mini", "zx200", "zx120"];

#[test]
fn golden_rows_come_out_from_every_description() {
    for machine in GOLDEN {
        let file = MachineFile::load(machine).unwrap();
        let reach = file.geometry.reach_m();
        let rows = golden(machine);
        assert_eq!(rows.len(), 40);
        for (precision, length_tolerance, angle_tolerance) in [("f64", 1e-9, 1e-7), ("f32", 1e-6 * reach, 1e-3)] {
            let mut given = ["boom_deg,arm_deg,bucket_deg\n".to_owned(), "boom_m,arm_m,bucket_m\n".to_owned()];
            for row in &rows {
                let _ = writeln!(given[0], "{},{},{}", row[0], row[1], row[2]);
                let _ = writeln!(given[1], "{},{},{}", row[3], row[4], row[5]);
            }
            let mut tips = "x_m,z_m,pitch_deg\n".to_owned();
            for row in &rows {
                let pitch = row[0] + row[1] + row[2];
                let _ = writeln!(tips, "{},{},{pitch}", row[6] + file.geometry.boom_pin_x_m, row[7]);
            }
            for given in [&given[0], &given[1], &tips] {
                let answer = csv(&["--machine", machine, "--precision", precision], given);
                assert_eq!(answer.len(), rows.len() + 1);
                for (got, want) in answer[1..].iter().zip(&rows) {
                    assert_eq!(got[12], "", "{machine} {precision}");
                    for (at, column) in (1..=3).zip(&want[..3]) {
                        assert!((number(&got[at]) - column).abs() < angle_tolerance, "{machine} {precision} {got:?}");
                    }
                    for (at, column) in [4, 5, 6, 10, 11].into_iter().zip(&want[3..]) {
                        assert!((number(&got[at]) - column).abs() < length_tolerance, "{machine} {precision} {got:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_single_pose_and_its_csv_row_agree() {
    let json = pose(&["--machine", "frankel", "--joints", "20,-80,-60", "--swing", "45", "--json"]).json();
    let rows = csv(&["--machine", "frankel"], "boom_deg,arm_deg,bucket_deg,swing_deg\n20,-80,-60,45\n");
    let in_json = [
        &json["swing_deg"],
        &json["joints_deg"]["boom"],
        &json["joints_deg"]["arm"],
        &json["joints_deg"]["bucket"],
        &json["cylinders_m"]["boom"],
        &json["cylinders_m"]["arm"],
        &json["cylinders_m"]["bucket"],
        &json["tip"]["reach_m"],
        &json["tip"]["z_m"],
        &json["tip"]["pitch_deg"],
        &json["tip_from_boom_pin"]["x_m"],
        &json["tip_from_boom_pin"]["z_m"],
    ];
    assert_eq!(rows[0].join(","), COLUMNS);
    for (value, cell) in in_json.into_iter().zip(&rows[1]) {
        assert_eq!(value.as_f64().unwrap(), number(cell));
    }
    // Frankel's seed prints 31.97 in for the bucket cylinder here, at any swing.
    assert!((number(&rows[1][6]) / 0.0254 - 31.97).abs() < 5e-3, "{:?}", rows[1]);
}

#[test]
fn every_joint_printed_as_possible_comes_back_from_its_cylinders() {
    for machine in ["exact-mini", "zx200", "zx120", "frankel"] {
        let mut given = "boom_deg,arm_deg,bucket_deg\n".to_owned();
        for degrees in (-180..180).step_by(7) {
            let _ = writeln!(given, "{degrees},-80,-60\n10,{degrees},-60\n10,-80,{degrees}");
        }
        let args = ["--machine", machine, "--precision", "f64", "--allow-outside"];
        let rows = csv(&args, &given);
        let possible: Vec<_> = rows[1..].iter().filter(|row| row[12].is_empty()).collect();
        assert!(possible.len() > 50 && possible.len() < rows.len() - 1, "{machine}: {}", possible.len());
        // Half a turn has two signs.
        let turned = |degrees: f64| (degrees.abs() - 360.0).abs().min(degrees.abs());
        let mut cylinders = "boom_m,arm_m,bucket_m\n".to_owned();
        for row in &possible {
            let _ = writeln!(cylinders, "{},{},{}", row[4], row[5], row[6]);
        }
        for (there, back) in possible.into_iter().zip(&csv(&args, &cylinders)[1..]) {
            assert_eq!(back[12], "");
            for at in 1..=3 {
                assert!(turned(number(&there[at]) - number(&back[at])) < 1e-6, "{machine} {there:?} {back:?}");
            }
        }
    }
}

#[test]
fn csv_comes_back_from_every_description() {
    let zx120: String = golden("zx120").iter().fold("boom_m,arm_m,bucket_m,swing_deg\n".into(), |mut text, row| {
        let _ = writeln!(text, "{},{},{},{}", row[3], row[4], row[5], row[0]);
        text
    });
    let args = ["--machine", "zx120", "--precision", "f64"];
    let first = csv(&args, &zx120);
    for columns in [[1, 2, 3], [4, 5, 6], [7, 8, 9]] {
        let again: String = first.iter().fold(String::new(), |mut text, row| {
            let [a, b, c] = columns.map(|at| row[at].as_str());
            let _ = writeln!(text, "{a},{b},{c},{}", row[0]);
            text
        });
        for (there, back) in first[1..].iter().zip(&csv(&args, &again)[1..]) {
            assert_eq!(back[12], "");
            for at in 0..12 {
                assert!((number(&there[at]) - number(&back[at])).abs() < 1e-9, "{there:?} {back:?}");
            }
            // What was given is printed as given.
            assert_eq!(columns.map(|at| &there[at]), columns.map(|at| &back[at]));
        }
    }
}

#[test]
fn a_bad_row_says_why_and_the_run_goes_on() {
    let given = "boom_m,arm_m,bucket_m,swing_deg\n\
                 1.1,1.3,1.0,0\n\
                 1.1,1.3,1.0\n\
                 1.1,1.3,1.0,0,\n\
                 1.1,,1.0,0\n\
                 1.1,one,1.0,0\n\
                 1.1,1.3,NaN,0\n\
                 1.1,1.3,1.0,inf\n\
                 -1.1,1.3,1.0,0\n\
                 1.4,1.3,1.0,0\n\
                 \"1.1,1.3,1.0,0\n\
                 1.1,1.3,1.0,0\n";
    let rows = csv(&["--machine", "exact-mini"], given);
    let errors = [
        "",
        "invalid_input: 3 cells where the header has 4",
        "invalid_input: 5 cells where the header has 4",
        "invalid_input: `arm_m`: `` is not a number",
        "invalid_input: `arm_m`: `one` is not a number",
        "invalid_input: `bucket_m` must be a finite number, not NaN",
        "invalid_input: `swing_deg` must be a finite number, not inf",
        "invalid_input: `boom_m` is a length",
        "out_of_stroke: boom cylinder: a length of 1.4 m is 0.095 m above",
        "invalid_input: `boom_m`: `\"1.1` is not a number",
        "",
    ];
    assert_eq!(rows.len(), errors.len() + 1);
    for (row, error) in rows[1..].iter().zip(errors) {
        assert_eq!(row.len(), 13);
        assert!(row[12].starts_with(error), "{row:?}");
        assert_eq!(row[12].is_empty(), error.is_empty(), "{row:?}");
        assert_eq!(row[7].is_empty(), !error.is_empty(), "{row:?}");
    }
    assert_eq!(rows[1], rows[11]);
    // What was given stays beside the error.
    assert_eq!(rows[9][4], "1.4");
    let rows = csv(&["--machine", "exact-mini"], "x_m,z_m,pitch_deg\n9,0,0\n");
    assert!(rows[1][12].starts_with("unreachable: "), "{rows:?}");
    let rows = csv(&["--machine", "exact-mini"], "boom_deg,arm_deg,bucket_deg\n150,-60,-30\n");
    assert!(rows[1][12].starts_with("no_assembly: boom cylinder"), "{rows:?}");
}

#[test]
fn outside_the_stroke_rows_are_complete_when_allowed() {
    let rows = csv(&["--machine", "exact-mini", "--allow-outside"], "boom_m,arm_m,bucket_m\n1.1,1.59,1.0\n");
    assert!(rows[1][..12].iter().all(|cell| !cell.is_empty()) && rows[1][12].is_empty(), "{rows:?}");
}

#[test]
fn csv_as_spreadsheets_write_it_is_understood() {
    let plain = csv(&["--machine", "exact-mini"], "boom_m,arm_m,bucket_m\n1.1,1.3,1.0\n");
    for given in [
        "\u{feff}boom_m,arm_m,bucket_m\r\n1.1,1.3,1.0\r\n\r\n",
        "  boom_m , arm_m ,bucket_m  \n 1.1 ,\t1.3, 1.0 \n   \n\n",
        "\"boom_m\",\"arm_m\",\"bucket_m\"\n\"1.1\",\" 1.3 \",\"1.0\"",
        "\nbucket_m,boom_m,arm_m\n1,1.10,13e-1\n",
    ] {
        assert_eq!(csv(&["--machine", "exact-mini"], given), plain, "{given:?}");
    }
    let swung = csv(&["--machine", "exact-mini", "--swing", "-20"], "boom_m,arm_m,bucket_m\n1.1,1.3,1.0\n");
    assert_eq!(swung[1][0], "-20");
    let header_alone = csv(&["--machine", "exact-mini"], "boom_m,arm_m,bucket_m\n");
    assert_eq!(header_alone.len(), 1);
}

#[test]
fn a_csv_file_is_read_like_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("poses.csv");
    let text = "x_m,z_m,pitch_deg\n2.0,-1.0,-90\n";
    fs::write(&file, text).unwrap();
    let answer = pose(&["--machine", "exact-mini", "--csv", file.to_str().unwrap()]);
    assert_eq!(answer.out, hil_in(None, &["--machine", "exact-mini", "--csv", "-"], text.as_bytes()).out);
    assert_eq!(answer.err, "");
}

#[test]
fn a_bad_header_is_refused_by_its_column() {
    let cases = [
        ("", "empty"),
        ("\n\n", "empty"),
        ("boom_m,arm_m\n1,2\n", "column `bucket_m` is missing"),
        ("boom_m,arm_m,bukket_m\n1,2,3\n", "unknown column `bukket_m`"),
        ("boom_m,arm_m,bucket_m,note\n1,2,3,x\n", "unknown column `note`"),
        ("boom_m,arm_m,bucket_m,\n1,2,3,\n", "unknown column ``"),
        ("boom_m,arm_m,bucket_m,arm_m\n1,2,3,4\n", "column `arm_m` stands twice"),
        ("boom_m,arm_deg,bucket_m\n1,2,3\n", "`boom_m` and `arm_deg`"),
        ("boom_m,arm_m,bucket_m,x_m,z_m,pitch_deg\n", "`boom_m` and `x_m`"),
        ("swing_deg\n1\n", "`swing_deg`"),
        ("boom_m;arm_m;bucket_m\n", "`boom_m;arm_m;bucket_m`"),
        ("1.1,1.3,1.0\n", "unknown column `1.1`"),
    ];
    for (given, part) in cases {
        let (kind, message) = hil_in(None, &["--machine", "exact-mini", "--csv", "-"], given.as_bytes()).refusal();
        assert!(kind == "invalid_input" && message.contains(part), "{given:?}: {message}");
    }
    let args = ["--machine", "exact-mini", "--swing", "3", "--csv", "-"];
    let (_, message) = hil_in(None, &args, b"boom_m,arm_m,bucket_m,swing_deg\n").refusal();
    assert!(message.contains("`swing_deg`"), "{message}");
}

#[test]
fn bytes_that_are_no_text_spoil_only_their_row() {
    let given = b"boom_m,arm_m,bucket_m\n\xff\xfe,1.3,1.0\n1.1,1.3,1.0\n";
    let answer = hil_in(None, &["--machine", "exact-mini", "--csv", "-"], given);
    let lines: Vec<&str> = answer.out.lines().collect();
    assert_eq!((answer.code, lines.len()), (Some(0), 3));
    assert!(lines[1].contains("`boom_m`") && lines[2].ends_with(','), "{}", answer.out);
}
