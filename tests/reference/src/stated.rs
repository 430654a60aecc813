//! What `docs/accuracy.md` states, so that a test can hold the page to it.

/// One row of the table: bounds of one machine in one precision.
#[derive(Clone, Copy, Debug)]
pub struct Stated {
    /// Joint rotors, rad.
    pub joints: f64,
    /// Cylinders → tip, relative to reach.
    pub forward: f64,
    /// Tip → cylinders, m.
    pub inverse: f64,
    /// Cylinders → tip → cylinders, m.
    pub round_trip: f64,
    /// Tip → cylinders → tip, relative to reach.
    pub tip_round_trip: f64,
}

const PAGE: &str = include_str!("../../../docs/accuracy.md");

/// The swing cylinder's rotor, which the page states in a sentence per precision: `swing rotor, f32: 1e-7 rad`.
///
/// # Panics
/// When the page has no such sentence.
pub fn swing(precision: &str) -> f64 {
    let mark = format!("swing rotor, {precision}: ");
    let found = PAGE.split_once(&mark).and_then(|(_, rest)| rest.split_whitespace().next()?.parse().ok());
    found.unwrap_or_else(|| panic!("docs/accuracy.md does not state `{mark}… rad`"))
}

/// The row of `machine` in `precision` (`f32` or `f64`).
///
/// # Panics
/// When the page has no such row, or a cell is no number.
pub fn row(machine: &str, precision: &str) -> Stated {
    let row = PAGE.lines().find_map(|line| {
        let cells: Vec<&str> = line.trim().trim_matches('|').split('|').map(str::trim).collect();
        (cells.len() == 7 && cells[0] == machine && cells[1] == precision).then_some(cells)
    });
    let row = row.unwrap_or_else(|| panic!("docs/accuracy.md has no row `| {machine} | {precision} |`"));
    let number = |column: usize| {
        row[column].parse().unwrap_or_else(|_| panic!("docs/accuracy.md, {machine} {precision}: `{}`", row[column]))
    };
    Stated {
        joints: number(2),
        forward: number(3),
        inverse: number(4),
        round_trip: number(5),
        tip_round_trip: number(6),
    }
}

/// Holds one stated bound to what was measured.
///
/// # Panics
/// When the measured value is above the bound, or the bound is more than twice the measured value: then it tells nothing.
pub fn hold(what: &str, measured: f64, stated: f64) {
    assert!(measured <= stated, "{what}: measured {measured:.3e}, but docs/accuracy.md states {stated:e}");
    assert!(stated <= 2.0 * measured, "{what}: measured {measured:.3e}; docs/accuracy.md states a loose {stated:e}");
}
