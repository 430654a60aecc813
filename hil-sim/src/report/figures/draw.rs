//! A figure as SVG.

use std::fmt::Write;
use std::io;

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, EmptyElement, PathElement, Rectangle, Text};
use plotters::prelude::{Cartesian2d, SVGBackend};
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle, TRANSPARENT, TextStyle, WHITE};

use super::{Axis, Beside, Figure, Height, Key, Look, Mark, Numbers, Panel, colours};
use crate::report::html::escape;

/// Width of a figure, pixels.
const WIDTH: f64 = 620.0;
/// The backend draws whole units only: so many to a pixel.
const UNITS: f64 = 4.0;
const FONT: f64 = 15.0;
/// Room left of a panel (a margin, the y axis's name and numbers), below (the x axis's), above (the title), at the
/// right, and at the bottom of it all.
const LEFT: f64 = 74.0;
const MARGIN: f64 = 4.0;
const BELOW: f64 = 46.0;
const TITLE: f64 = 30.0;
const RIGHT: f64 = 18.0;
const BOTTOM: f64 = 6.0;
/// A row of the legend, its swatch, and what a letter takes, about.
const LEGEND_ROW: f64 = 22.0;
const SWATCH: f64 = 26.0;
const LETTER: f64 = 0.5 * FONT;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
type DrawError = DrawingAreaErrorKind<io::Error>;

/// The figure as an SVG element that scales with its surroundings.
///
/// # Errors
/// The drawing backend's.
pub(in crate::report) fn svg(figure: &Figure) -> io::Result<String> {
    Ok(element(figure, 0.0)?.0)
}

/// The same with a line across every panel over time, hidden until a script moves it; it says what time is where.
///
/// # Errors
/// The drawing backend's.
pub(in crate::report) fn svg_with_cursors(figure: &Figure) -> io::Result<String> {
    let svg = svg(figure)?;
    let mut cursors = String::new();
    let (_, mut top) = legend_places(&figure.legend);
    for panel in &figure.panels {
        let (from, until) = (top + above(panel), top + above(panel) + inside_height(panel));
        if panel.x.is_time() {
            let (left, right) = (units(LEFT), units(WIDTH - RIGHT));
            // Writing to a string cannot fail.
            let _ = writeln!(
                cursors,
                "<line class=\"cursor\" visibility=\"hidden\" data-from=\"{}\" data-until=\"{}\" data-left=\"{left}\" \
                 data-right=\"{right}\" x1=\"{left}\" x2=\"{left}\" y1=\"{}\" y2=\"{}\" stroke=\"#141414\" stroke-width=\"{}\"/>",
                panel.x.from,
                panel.x.until,
                units(from),
                units(until),
                units(1.2)
            );
        }
        top = until + below(panel);
    }
    Ok(svg.replacen("</svg>", &(cursors + "</svg>"), 1))
}

/// Two figures beside each other as one SVG element, under the left one's name.
///
/// # Errors
/// The drawing backend's.
pub(in crate::report) fn beside(left: &Figure, right: &Figure) -> io::Result<String> {
    let wide = 2.0 * WIDTH;
    let ((left_svg, left_high), (right_svg, right_high)) = (element(left, 0.0)?, element(right, WIDTH)?);
    let height = if left_high > right_high { left_high } else { right_high };
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{}\" width=\"{wide}\" height=\"{height}\" \
         viewBox=\"0 0 {wide} {height}\">\n{left_svg}\n{right_svg}\n</svg>\n",
        escape(left.title)
    ))
}

/// The SVG element of a figure, `x` pixels from the left of what it stands in, and its height, pixels.
fn element(figure: &Figure, x: f64) -> io::Result<(String, f64)> {
    let mut text = String::new();
    let height = draw(figure, &mut text).map_err(|error| io::Error::other(error.to_string()))?;
    // The backend's own opening tag knows neither a name for screen readers nor pixels of several units.
    let (_, body) = text.split_once('>').unwrap_or_default();
    let mut out = String::with_capacity(text.len() + 200);
    let (units_wide, units_high) = (units(WIDTH), units(height));
    let place = if x > 0.0 { format!(" x=\"{x}\"") } else { String::new() };
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{}\"{place} width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {units_wide} {units_high}\" stroke-linejoin=\"round\">",
        escape(figure.title)
    );
    out += body;
    Ok((out, height))
}

fn units(pixels: f64) -> i32 {
    (pixels * UNITS).round() as i32
}

/// Draws it; gives its height, pixels.
fn draw(figure: &Figure, text: &mut String) -> Result<f64, DrawError> {
    let (places, legend_height) = legend_places(&figure.legend);
    let heights: Vec<f64> = figure.panels.iter().map(inside_height).collect();
    let outside = figure.panels.iter().zip(&heights).map(|(panel, inside)| above(panel) + inside + below(panel));
    let height = (legend_height + outside.clone().sum::<f64>() + BOTTOM).ceil();
    let root = SVGBackend::with_string(text, (units(WIDTH) as u32, units(height) as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    for (key, &place) in figure.legend.iter().zip(&places) {
        legend_entry(&root, key, place)?;
    }
    let mut top = legend_height;
    for (panel, outside) in figure.panels.iter().zip(outside) {
        let area = root.clone().shrink((0, units(top)), (units(WIDTH), units(outside)));
        draw_panel(&area, panel)?;
        top += outside;
    }
    root.present()?;
    Ok(height)
}

fn inside_height(panel: &Panel) -> f64 {
    let Panel { x, y, .. } = panel;
    match panel.height {
        Height::Pixels(pixels) => pixels,
        Height::EqualScale => (WIDTH - LEFT - RIGHT) * (y.until - y.from) / (x.until - x.from),
    }
}

fn above(panel: &Panel) -> f64 {
    if panel.title.is_empty() { 10.0 } else { TITLE }
}

fn below(panel: &Panel) -> f64 {
    if panel.x.name.is_empty() { 4.0 } else { BELOW }
}

/// Left end and middle of each entry, rows filled from the left; the height of all rows.
fn legend_places(keys: &[Key]) -> (Vec<(f64, f64)>, f64) {
    let (mut left, mut row) = (LEFT, 0.0);
    let places = keys
        .iter()
        .map(|key| {
            let wide = SWATCH + 8.0 + LETTER * key.text.chars().count() as f64 + 14.0;
            if left > LEFT && left + wide > WIDTH {
                (left, row) = (LEFT, row + 1.0);
            }
            let place = (left, LEGEND_ROW * (row + 0.5) + 4.0);
            left += wide;
            place
        })
        .collect();
    (places, if keys.is_empty() { 0.0 } else { LEGEND_ROW * (row + 1.0) + 4.0 })
}

fn legend_entry(root: &Area<'_>, key: &Key, (left, middle): (f64, f64)) -> Result<(), DrawError> {
    let at = |x: f64, y: f64| (units(left + x), units(middle + y));
    let style = style(key.look);
    match key.look {
        Look::Line(..) => root.draw(&PathElement::new([at(0.0, 0.0), at(SWATCH, 0.0)], style))?,
        Look::Dashed(..) => {
            for from in [0.0, 10.0, 20.0] {
                root.draw(&PathElement::new([at(from, 0.0), at(from + 6.0, 0.0)], style))?;
            }
        }
        Look::Filled(..) => root.draw(&Rectangle::new([at(0.0, -6.0), at(SWATCH, 6.0)], style))?,
        Look::Dot(_, radius) => root.draw(&Circle::new(at(SWATCH / 2.0, 0.0), units(radius), style))?,
    }
    root.draw_text(key.text, &font(colours::BLACK, Beside::RIGHT), at(SWATCH + 6.0, 0.0))
}

fn draw_panel(area: &Area<'_>, panel: &Panel) -> Result<(), DrawError> {
    let left = Beside(HPos::Left, VPos::Bottom);
    area.draw_text(&panel.title, &font(colours::BLACK, left), (units(LEFT), units(TITLE - 3.0)))?;
    let (x, y) = (&panel.x, &panel.y);
    let mut chart = ChartBuilder::on(area)
        .margin_top(units(above(panel)))
        .margin_left(units(MARGIN))
        .margin_right(units(RIGHT))
        .x_label_area_size(units(below(panel)))
        .y_label_area_size(units(LEFT - MARGIN))
        .build_cartesian_2d(x.from..x.until, y.from..y.until)?;
    let (x_count, y_count) = (9, (inside_height(panel) / 34.0).round().clamp(2.0, 12.0) as usize);
    chart
        .configure_mesh()
        .x_labels(x_count)
        .y_labels(y_count)
        .x_desc(x.name)
        .y_desc(y.name)
        .x_label_formatter(&|value| number(x, x_count, *value))
        .y_label_formatter(&|value| number(y, y_count, *value))
        .label_style(font(colours::BLACK, Beside::RIGHT))
        .axis_desc_style(font(colours::BLACK, Beside::RIGHT))
        .axis_style(ShapeStyle::from(colours::GREY).stroke_width(units(1.0) as u32))
        .bold_line_style(ShapeStyle::from(colours::GREY.mix(0.22)).stroke_width(units(1.0) as u32))
        .light_line_style(TRANSPARENT)
        .set_all_tick_mark_size(units(4.0))
        .draw()?;
    panel.marks.iter().try_for_each(|mark| draw_mark(&mut chart, mark))
}

fn draw_mark(chart: &mut Chart<'_, '_>, mark: &Mark) -> Result<(), DrawError> {
    match mark {
        Mark::Lines(pieces, look) => {
            for piece in pieces {
                if let Look::Dashed(..) = look {
                    let dashes = DashedLineSeries::new(piece.iter().copied(), units(7.0), units(5.0), style(*look));
                    chart.draw_series(dashes)?;
                } else {
                    chart.draw_series([PathElement::new(piece.clone(), style(*look))])?;
                }
            }
        }
        Mark::Area(corners, look) => {
            chart.draw_series([Rectangle::new(*corners, style(*look))])?;
        }
        Mark::Dots(points, look) => {
            let radius = if let Look::Dot(_, radius) = look { *radius } else { 3.0 };
            chart.draw_series(points.iter().map(|&point| Circle::new(point, units(radius), style(*look))))?;
        }
        Mark::Text(point, beside, colour, text) => {
            // A little away from its point, in whatever direction it stands.
            let right = match beside.0 {
                HPos::Left => units(6.0),
                HPos::Center => 0,
                HPos::Right => units(-6.0),
            };
            let down = match beside.1 {
                VPos::Top => units(5.0),
                VPos::Center => 0,
                VPos::Bottom => units(-2.0),
            };
            let word = Text::new(text.clone(), (right, down), font(*colour, *beside));
            chart.draw_series([EmptyElement::at(*point) + word])?;
        }
    }
    Ok(())
}

fn style(look: Look) -> ShapeStyle {
    match look {
        Look::Line(colour, width) | Look::Dashed(colour, width) => {
            ShapeStyle::from(colour).stroke_width(units(width) as u32)
        }
        Look::Filled(colour, opacity) => colour.mix(opacity).filled(),
        Look::Dot(colour, _) => colour.filled(),
    }
}

fn font(colour: RGBColor, beside: Beside) -> TextStyle<'static> {
    // The backend divides by 1.24.
    let mut style: TextStyle<'static> = ("sans-serif", FONT * UNITS * 1.24).into_font().into();
    style.color = colour.to_backend_color();
    style.pos(Pos::new(beside.0, beside.1))
}

/// A number beside an axis, with as many decimals as its steps need.
fn number(axis: &Axis, count: usize, value: f64) -> String {
    if axis.name.is_empty() {
        return String::new();
    }
    if let Numbers::PowersOfTen = axis.numbers {
        let whole = (value - value.round()).abs() < 1e-9 && value >= 0.0;
        return if whole { format!("{:.0}", libm::exp10(value)) } else { String::new() };
    }
    // The steps are 1, 2 or 5 times a power of ten, the smallest of these that gives no more than `count` numbers.
    let step = (axis.until - axis.from) / count as f64;
    let power = libm::floor(libm::log10(step));
    let power = if step > 5.0 * libm::exp10(power) { power + 1.0 } else { power };
    let decimals = (-power).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    // No minus before a zero that rounding left.
    let zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if zero { text.replace('-', "") } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_decimals_their_steps_need() {
        let axis = Axis::new("length [m]", 0.7, 1.2);
        assert_eq!(number(&axis, 5, 0.8), "0.8");
        let axis = Axis::new("current [A]", -0.33, 0.01);
        assert_eq!(number(&axis, 5, -0.1), "−0.1");
        let axis = Axis::new("error [mm]", -30.0, 30.0);
        assert_eq!(number(&axis, 5, -20.0), "−20");
        assert_eq!(number(&axis, 5, -1e-15), "0");
        let axis = Axis { numbers: Numbers::PowersOfTen, ..Axis::new("ticks", -0.2, 4.0) };
        assert_eq!([number(&axis, 5, 3.0), number(&axis, 5, 2.5)], ["1000", ""]);
    }

    #[test]
    fn a_legend_too_wide_for_one_row_takes_two() {
        let key = Key { look: Look::Line(colours::BLUE, 2.0), text: "a rather long entry of a legend" };
        let (places, height) = legend_places(&[key; 4]);
        assert!(places[3].1 > places[0].1 && places.iter().all(|p| p.1 < height && p.0 < WIDTH));
    }
}
