//! Figures as data: what stands in each panel. [`draw`] alone knows how it becomes SVG.

pub(super) mod avoidance;
mod draw;
pub(super) mod events;
pub(super) mod fence;
pub(super) mod lengths;
pub(super) mod linkage;
pub(super) mod oil;
pub(super) mod timing;
pub(super) mod tracking;
pub(super) mod valves;

use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::series::{Piece, Point};

pub(super) use draw::{beside, svg, svg_with_cursors};

/// Colours that stay apart for colour-blind eyes: Okabe and Ito 2008.
pub(super) mod colours {
    use plotters::style::RGBColor;

    pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
    pub(crate) const ORANGE: RGBColor = RGBColor(230, 159, 0);
    pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
    pub(crate) const SKY: RGBColor = RGBColor(86, 180, 233);
    /// Limits, violations, faults: nothing else.
    pub(crate) const RED: RGBColor = RGBColor(200, 30, 20);
    pub(crate) const PURPLE: RGBColor = RGBColor(170, 80, 140);
    pub(crate) const GREY: RGBColor = RGBColor(125, 125, 125);
    pub(crate) const BLACK: RGBColor = RGBColor(20, 20, 20);
    pub(crate) const EARTH: RGBColor = RGBColor(150, 110, 60);
}

/// A figure: a legend above panels one under the other.
#[derive(Clone)]
pub(super) struct Figure {
    /// Its heading.
    pub(super) title: &'static str,
    /// What it shows, for the caption.
    pub(super) caption: String,
    pub(super) legend: Vec<Key>,
    pub(super) panels: Vec<Panel>,
}

/// One entry of a legend.
#[derive(Clone, Copy, Debug)]
pub(super) struct Key {
    pub(super) look: Look,
    pub(super) text: &'static str,
}

/// Axes with marks in them.
#[derive(Clone)]
pub(super) struct Panel {
    /// Above its left end.
    pub(super) title: String,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) height: Height,
    /// Drawn in this order.
    pub(super) marks: Vec<Mark>,
}

/// How high the inside of a panel is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Height {
    /// Pixels.
    Pixels(f64),
    /// One unit of y is as long as one unit of x.
    EqualScale,
}

/// An axis.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    /// Quantity and unit; an axis without a name has no numbers either.
    pub(super) name: &'static str,
    pub(super) from: f64,
    pub(super) until: f64,
    pub(super) numbers: Numbers,
}

/// How an axis says its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Numbers {
    /// As they are.
    Plain,
    /// The axis is the decimal logarithm of the number.
    PowersOfTen,
}

impl Axis {
    /// From `from` until `until`, or one unit on where that is nothing.
    pub(super) fn new(name: &'static str, from: f64, until: f64) -> Self {
        let until = if until > from { until } else { from + 1.0 };
        Self { name, from, until, numbers: Numbers::Plain }
    }

    /// Room for every finite value and a little more; from 0 to 1 without any.
    pub(super) fn around(name: &'static str, values: impl Iterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|v| v.is_finite()) {
            low = if value < low { value } else { low };
            high = if value > high { value } else { high };
        }
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        let room = if high > low { 0.06 * (high - low) } else { 0.5 };
        Self::new(name, low - room, high + room)
    }

    /// An axis of time: panels over time name it below the last of them only.
    pub(super) fn is_time(&self) -> bool {
        matches!(self.name, "" | "time [s]")
    }

    /// The value this part of the way along it, 0 at its beginning.
    pub(super) fn part(&self, part: f64) -> f64 {
        self.from + part * (self.until - self.from)
    }
}

/// How a line or an area looks.
#[derive(Clone, Copy, Debug)]
pub(super) enum Look {
    /// A line of this width, pixels.
    Line(RGBColor, f64),
    /// The same, dashed.
    Dashed(RGBColor, f64),
    /// A filled area of this opacity.
    Filled(RGBColor, f64),
    /// A dot of this radius, pixels.
    Dot(RGBColor, f64),
}

/// Something inside a panel, in the units of its axes.
#[derive(Clone)]
pub(super) enum Mark {
    /// Lines.
    Lines(Vec<Piece>, Look),
    /// A rectangle between two corners.
    Area([Point; 2], Look),
    /// Dots.
    Dots(Vec<Point>, Look),
    /// A word beside a point.
    Text(Point, Beside, RGBColor, String),
}

/// Where a text stands as seen from its point.
#[derive(Clone, Copy)]
pub(super) struct Beside(pub(super) HPos, pub(super) VPos);

impl Beside {
    pub(super) const ABOVE: Self = Self(HPos::Center, VPos::Bottom);
    pub(super) const BELOW: Self = Self(HPos::Center, VPos::Top);
    pub(super) const RIGHT: Self = Self(HPos::Left, VPos::Center);
}

/// A circle as a closed line.
fn circle((x, y): Point, radius: f64) -> Piece {
    (0..=60)
        .map(|i| {
            let angle = f64::from(i) * std::f64::consts::TAU / 60.0;
            (x + radius * libm::cos(angle), y + radius * libm::sin(angle))
        })
        .collect()
}

/// Every y of these lines.
pub(super) fn values(lines: &[Piece]) -> impl Iterator<Item = f64> {
    lines.iter().flatten().map(|point| point.1)
}
