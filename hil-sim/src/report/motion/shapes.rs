//! SVG elements in millimetres, z and y upwards, and the marks by which the script knows what to move.

use std::fmt::Write;

use super::moments::{Track, mm};
use crate::report::series::{Point, along_path};

/// What a drawing shows: left, right and bottom, top, m.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
}

impl Frame {
    /// Room for these points and a margin.
    pub(super) fn around(points: impl Iterator<Item = [f64; 2]>, margin_m: f64) -> Self {
        let mut frame = Self { x: [0.0; 2], y: [0.0; 2] };
        for [x, y] in points {
            for (range, value) in [(&mut frame.x, x), (&mut frame.y, y)] {
                range[0] = if value < range[0] { value } else { range[0] };
                range[1] = if value > range[1] { value } else { range[1] };
            }
        }
        let wider = |[low, high]: [f64; 2]| [low - margin_m, high + margin_m];
        Self { x: wider(frame.x), y: wider(frame.y) }
    }

    fn wide(&self) -> f64 {
        self.x[1] - self.x[0]
    }

    /// The drawing: a grid of metres with `inside` on it, which has y upwards; letters as high as this share of its width.
    pub(super) fn svg(&self, class: &str, label: &str, letters: f64, inside: &str) -> String {
        let (left, top, wide, high) = (mm(self.x[0]), mm(-self.y[1]), mm(self.wide()), mm(self.y[1] - self.y[0]));
        let letter = letters * self.wide();
        let (mut lines, mut numbers) = (String::new(), String::new());
        let every = if self.wide() > 9.0 { 2 } else { 1 };
        for metre in self.x[0].ceil() as i32..=self.x[1].floor() as i32 {
            let x = metre * 1000;
            // Writing to a string cannot fail.
            let _ = write!(lines, "M{x} {}V{}", -top, -top - high);
            if metre % every == 0 && f64::from(metre) - self.x[0] > 2.0 * letter {
                let _ =
                    write!(numbers, "<text x=\"{x}\" y=\"{}\">{}</text>", top + high - mm(0.4 * letter), number(metre));
            }
        }
        for metre in self.y[0].ceil() as i32..=self.y[1].floor() as i32 {
            let z = metre * 1000;
            let _ = write!(lines, "M{left} {z}H{}", left + wide);
            let room = f64::from(metre) - self.y[0] > 2.0 * letter && self.y[1] - f64::from(metre) > letter;
            if metre % every == 0 && room {
                let (x, y) = (left + mm(0.7 * letter), mm(0.35 * letter) - z);
                let _ = write!(numbers, "<text x=\"{x}\" y=\"{y}\">{}</text>", number(metre));
            }
        }
        format!(
            "<svg class=\"{class}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{label}\" \
             viewBox=\"{left} {top} {wide} {high}\" font-size=\"{}\">\n<g transform=\"scale(1 -1)\">\
             <path class=\"grid\" d=\"{lines}\"/>\n{inside}</g>\n<g class=\"numbers\">{numbers}</g></svg>\n",
            mm(letter)
        )
    }
}

fn number(metre: i32) -> String {
    metre.to_string().replace('-', "−")
}

/// A line that stays.
pub(super) fn still(class: &str, points: impl Iterator<Item = Option<Point>>, spacing_m: f64) -> String {
    let mut d = String::new();
    for piece in along_path(points, spacing_m) {
        for (i, (x, y)) in piece.into_iter().enumerate() {
            let _ = write!(d, "{}{} {}", if i == 0 { 'M' } else { 'L' }, mm(x), mm(y));
        }
    }
    format!("<path class=\"{class}\" d=\"{d}\"/>\n")
}

/// A circle that stays.
pub(super) fn circle(class: &str, [x, y]: [f64; 2], radius_m: f64) -> String {
    format!("<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", mm(x), mm(y), mm(radius_m))
}

/// A line through points that move; this wide in the machine's own measure, or as its class says.
pub(super) fn through(class: &str, points: &[Track], wide_m: Option<f64>) -> String {
    moving("data-through", class, points, wide_m)
}

/// An area between points that move, its edge as wide.
pub(super) fn area(class: &str, points: &[Track], wide_m: Option<f64>) -> String {
    moving("data-around", class, points, wide_m)
}

fn moving(mark: &str, class: &str, points: &[Track], wide_m: Option<f64>) -> String {
    let points: Vec<String> = points.iter().map(ToString::to_string).collect();
    let wide = wide_m.map_or_else(String::new, |wide| format!(" stroke-width=\"{}\"", mm(wide)));
    format!("<path class=\"{class}\" {mark}=\"{}\"{wide}/>\n", points.join(" "))
}

/// A dot at a point that moves.
pub(super) fn dot(class: &str, at: Track, radius_m: f64) -> String {
    format!("<circle class=\"{class}\" data-at=\"{at}\" r=\"{}\"/>\n", mm(radius_m))
}

/// A circle whose middle and rim move.
pub(super) fn growing(class: &str, middle: Track, rim: Track) -> String {
    format!("<circle class=\"{class}\" data-ball=\"{middle} {rim}\"/>\n")
}
