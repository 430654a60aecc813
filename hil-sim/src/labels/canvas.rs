//! SVG by hand: the few strokes the figure of labels needs.

use std::fmt::Write;

use kinematics_core::Rotor;

use super::Point;

/// Which part of the plane is drawn where: metres to pixels, z upwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Pixels a metre.
    pub(super) scale: f64,
    /// What lies at the view's left end and at its top, m.
    pub(super) left: f64,
    pub(super) top: f64,
    /// Where the view begins, pixels.
    pub(super) at: (f64, f64),
}

/// How a line looks.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ink {
    /// The line from pin to pin, a1…a4.
    Link,
    /// Rocker and coupler.
    Rocker,
    /// A side of a triangle.
    Side,
}

impl Ink {
    fn style(self) -> &'static str {
        match self {
            Self::Link => "stroke=\"#141414\" stroke-width=\"2.6\"",
            Self::Rocker => "stroke=\"#0072B2\" stroke-width=\"4\"",
            Self::Side => "stroke=\"#7D7D7D\" stroke-width=\"1.4\"",
        }
    }
}

/// An SVG document that grows.
#[derive(Debug)]
pub(super) struct Canvas {
    text: String,
}

/// The canvas through a view.
#[derive(Debug)]
pub(super) struct Brush<'a> {
    text: &'a mut String,
    view: View,
}

impl Canvas {
    pub(super) fn new(width: f64, height: f64, title: &str) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{title}\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"17\" stroke-linejoin=\"round\" \
             stroke-linecap=\"round\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n"
        );
        Self { text }
    }

    pub(super) fn on(&mut self, view: View) -> Brush<'_> {
        Brush { text: &mut self.text, view }
    }

    pub(super) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

impl Brush<'_> {
    /// Pixels, to a tenth.
    fn pixels(&self, p: Point) -> (f64, f64) {
        let View { scale, left, top, at } = self.view;
        let tenth = |x: f64| libm::round(x * 10.0) / 10.0;
        (tenth(at.0 + (p.x - left) * scale), tenth(at.1 + (top - p.z) * scale))
    }

    fn put(&mut self, element: &str) {
        self.text.push_str(element);
        self.text.push('\n');
    }

    fn stroke(&mut self, from: Point, until: Point, style: &str) {
        let ((x1, y1), (x2, y2)) = (self.pixels(from), self.pixels(until));
        self.put(&format!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {style}/>"));
    }

    /// A rigid body between its pins.
    pub(super) fn body(&mut self, corners: &[Point]) {
        let mut points = String::new();
        for &corner in corners {
            let (x, y) = self.pixels(corner);
            // Writing to a string cannot fail.
            let _ = write!(points, "{x},{y} ");
        }
        let points = points.trim_end().to_owned();
        self.put(&format!("<polygon points=\"{points}\" fill=\"#F3E3C3\" stroke=\"#F3E3C3\" stroke-width=\"14\"/>"));
    }

    /// A construction line.
    pub(super) fn thin(&mut self, from: Point, until: Point) {
        self.stroke(from, until, "stroke=\"#7D7D7D\" stroke-width=\"1\" stroke-dasharray=\"6 5\"");
    }

    pub(super) fn line(&mut self, from: Point, until: Point, ink: Ink) {
        self.stroke(from, until, ink.style());
    }

    /// A cylinder: its body over six tenths of the way from its base, the rod beyond.
    pub(super) fn cylinder(&mut self, base: Point, rod: Point) {
        self.stroke(base, rod, "stroke=\"#E69F00\" stroke-width=\"3.5\"");
        let middle = base + (rod - base).scale(0.6);
        self.stroke(base, middle, "stroke=\"#E69F00\" stroke-width=\"8\" stroke-linecap=\"butt\"");
    }

    /// A pin.
    pub(super) fn pin(&mut self, at: Point) {
        let (x, y) = self.pixels(at);
        self.put(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"4.2\" fill=\"#FFFFFF\" stroke=\"#141414\" stroke-width=\"1.8\"/>"
        ));
    }

    /// An angle of less than half a turn at `corner`, from one direction to another, with an arrow and its name beside its middle.
    pub(super) fn arc(
        &mut self,
        corner: Point,
        from: Rotor<f64>,
        until: Rotor<f64>,
        radius: f64,
        name: &str,
        aside: (f64, f64),
    ) {
        let at = |rotor: Rotor<f64>| corner + rotor.to_vec().scale(radius);
        let turn = until * from.inverse();
        let pixels = radius * self.view.scale;
        let ((x1, y1), (x2, y2)) = (self.pixels(at(from)), self.pixels(at(until)));
        let sweep = u8::from(turn.sin < 0.0);
        let style = "fill=\"none\" stroke=\"#AA508C\" stroke-width=\"1.8\"";
        self.put(&format!("<path d=\"M{x1} {y1} A{pixels:.1} {pixels:.1} 0 0 {sweep} {x2} {y2}\" {style}/>"));
        // The arrow's two sides, a little back along the arc and to either side of it.
        let back = Rotor::from_angle(if turn.sin < 0.0 { 9.0 / pixels } else { -9.0 / pixels });
        for side in [4.0, -4.0] {
            let barb = corner + (until * back).to_vec().scale(radius + side / self.view.scale);
            self.stroke(at(until), barb, "stroke=\"#AA508C\" stroke-width=\"1.8\"");
        }
        let half = (from.to_vec() + until.to_vec()).direction().unwrap_or(Rotor::IDENTITY);
        self.write(at(half), aside, name, "fill=\"#AA508C\" font-style=\"italic\" font-weight=\"bold\"");
    }

    /// The distance between two verticals, with a line down from `pin`.
    pub(super) fn measure(&mut self, from: Point, until: Point, pin: Point, name: &str) {
        self.thin(pin, Point::new(until.x, until.z - 0.1));
        self.stroke(from, until, "stroke=\"#141414\" stroke-width=\"2.6\"");
        self.length(until, (0.22, 0.0), name);
    }

    /// The name of a length.
    pub(super) fn length(&mut self, at: Point, aside: (f64, f64), name: &str) {
        self.write(at, aside, name, "fill=\"#141414\" font-style=\"italic\"");
    }

    /// The name of a pin.
    pub(super) fn name(&mut self, at: Point, aside: (f64, f64), name: &str) {
        self.write(at, aside, name, "fill=\"#141414\" font-weight=\"bold\"");
    }

    /// Words beside a point.
    pub(super) fn words(&mut self, at: Point, aside: (f64, f64), words: &str) {
        self.write(at, aside, words, "fill=\"#505050\" font-size=\"14\"");
    }

    fn write(&mut self, at: Point, (right, up): (f64, f64), text: &str, style: &str) {
        let (x, y) = self.pixels(Point::new(at.x + right, at.z + up));
        self.put(&format!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\" dominant-baseline=\"central\" paint-order=\"stroke\" \
             stroke=\"#FFFFFF\" stroke-width=\"4\" {style}>{text}</text>"
        ));
    }
}
