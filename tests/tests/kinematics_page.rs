//! `docs/kinematics.md`: its figure is what the code draws, its table of labels is right, and every equation has its function.

use core::f64::consts::PI;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use cross_tests::machines::{INCH_M, frankel_distances};
use cross_tests::papers::agree;
use cross_tests::papers::frankel::{corner, t23d, tdfe, tg34};
use cross_tests::papers::koivo::distances;

const PAGE: &str = include_str!("../../docs/kinematics.md");
const FIGURE: &str = include_str!("../../docs/kinematics.svg");

/// The lines of a section, up to the next heading.
fn section(heading: &str) -> Vec<&'static str> {
    let after = PAGE.lines().skip_while(|line| *line != heading).skip(1);
    let lines: Vec<&str> = after.take_while(|line| !line.starts_with('#')).collect();
    assert!(!lines.is_empty(), "no section `{heading}`");
    lines
}

/// The cells of the rows of a section's table, without its head.
fn rows(heading: &str) -> Vec<Vec<&'static str>> {
    let lines = section(heading).into_iter().filter(|line| line.starts_with('|')).skip(2);
    lines.map(|line| line.trim_matches('|').split(" | ").map(str::trim).collect()).collect()
}

/// What stands in backticks and looks like `Type::function` or `module::function`.
fn functions(text: &str) -> BTreeSet<(String, String)> {
    let quoted = text.split('`').skip(1).step_by(2).filter(|word| !word.contains(' '));
    quoted.filter_map(|word| word.split_once("::")).map(|(of, name)| (of.to_owned(), name.to_owned())).collect()
}

fn sources(folder: &Path, into: &mut Vec<(PathBuf, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, into);
        } else if path.extension().is_some_and(|e| e == "rs") {
            into.push((path.clone(), fs::read_to_string(&path).unwrap()));
        }
    }
}

/// Whether a file has the public function in the named module, or beside an `impl` of the named type.
fn has(path: &Path, text: &str, (of, name): &(String, String)) -> bool {
    let function = text.contains(&format!("pub fn {name}(")) || text.contains(&format!("pub fn {name}<"));
    let implements = text
        .lines()
        .any(|line| line.starts_with("impl") && line.split(|c: char| !c.is_alphanumeric()).any(|word| word == of));
    function && (implements || path.file_stem().is_some_and(|stem| stem == of.as_str()))
}

#[test]
fn the_figure_is_what_the_code_draws() {
    let drawn = hil_sim::labels::svg().unwrap();
    assert!(drawn == FIGURE, "draw it again: cargo run -p hil-sim --example labels > docs/kinematics.svg");
}

#[test]
fn the_figure_names_every_pin_length_and_angle() {
    for label in ["A", "B", "C", "D", "E", "I", "J", "H, K", "P", "N", "a1", "a2", "a3", "a4", "θ2", "θ3", "θ4", "φ"]
    {
        assert!(FIGURE.contains(&format!(">{label}</text>")), "{label}");
    }
}

#[test]
fn every_function_the_page_names_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut files = Vec::new();
    for folder in ["kinematics-core/src", "firmware/src"] {
        sources(&root.join(folder), &mut files);
    }
    let named = functions(PAGE);
    assert!(named.len() > 20, "{named:?}");
    for function in &named {
        assert!(files.iter().any(|(path, text)| has(path, text, function)), "{function:?}");
    }
    let missing = ("Machine".to_owned(), "no_such_map".to_owned());
    assert!(!files.iter().any(|(path, text)| has(path, text, &missing)));
}

/// The numbers in a cell such as "(4), (5)" or "(15)–(18)".
fn numbers(cell: &str) -> Vec<u32> {
    let mut all = Vec::new();
    for part in cell.split(", ") {
        let ends: Vec<u32> = part.split('–').map(|n| n.trim_matches(['(', ')']).parse().unwrap()).collect();
        all.extend(ends[0]..=ends[ends.len() - 1]);
    }
    all
}

#[test]
fn every_numbered_equation_stands_in_its_table_once() {
    let tables = [
        ("### Koivo 1994", 37),
        ("### Hareesha and Umesh 2015", 21),
        ("### Frankel 2003, reverse displacement", 24),
        ("### Frankel 2003, joint angles to cylinders", 18),
        ("### Park et al. 2008", 18),
    ];
    for (heading, last) in tables {
        let found: Vec<u32> = rows(heading).iter().flat_map(|cells| numbers(cells[0])).collect();
        assert_eq!(found, (1..=last).collect::<Vec<u32>>(), "{heading}");
    }
}

#[test]
fn every_equation_has_a_function_or_a_reason() {
    let headings = PAGE.lines().filter(|line| line.starts_with("### "));
    for cells in headings.flat_map(rows) {
        assert_eq!(cells.len(), 3, "{cells:?}");
        let said = !functions(cells[2]).is_empty() || cells[2].contains("tests only") || cells[2].contains("because");
        assert!(said, "{cells:?}");
    }
}

#[test]
fn the_table_of_labels_is_right() {
    // Frankel's machine under Koivo's labels: the two columns of the table say the same.
    let k = distances(&frankel_distances().to_pins().unwrap());
    let pairs = [
        ("L_HE", k.l_he_m, 7.5 - 8.5),
        ("−L_AH", -k.l_ah_m, 10.5),
        ("L_AB, R1B", k.l_ab_m, 36.0),
        ("L_CI, R2C", k.l_ci_m, 36.25),
        ("L_FC, R2D", k.l_fc_m, 9.1875),
        ("L_JL, REF", k.l_jl_m, 30.77),
        ("L_LD, R3F", k.l_ld_m, 4.5),
        ("L_GD, R3G", k.l_gd_m, 5.5),
        ("L_KL, RFH", k.l_kl_m, 9.5),
        ("L_KG, RGH", k.l_kg_m, 9.5),
    ];
    for (what, metres, inches) in pairs {
        agree(what, metres / INCH_M, inches, 1e-9);
    }
    agree("β, TB12", k.beta_rad, corner(36.0, 48.0, 12.35), 1e-9);
    agree("γ1, T12C", k.gamma1_rad, corner(48.0, 36.25, 17.5), 1e-9);
    agree("γ2, TD23", k.gamma2_rad, corner(9.1875, 38.5, 47.25), 1e-9);
    agree("ν1, 180° − TDFE", k.nu1_rad, PI - tdfe(), 1e-9);
    agree("ν2, T23D", k.nu2_rad, t23d(), 1e-9);
    agree("ν3, TG34", k.nu3_rad, tg34(), 1e-9);
}
