//! The supervisor's states and arrows as SVG. What is drawn comes from the table; only where the boxes stand is said here.

use firmware::State;
use firmware::supervisor::machine::{Facts, Transition, transitions};

const WIDTH: f64 = 1000.0;
const HEIGHT: f64 = 520.0;
/// Half a box.
const HALF: (f64, f64) = (62.0, 24.0);
/// Around the states on the way to running: left, top, right, bottom.
const FRAME: [f64; 4] = [20.0, 20.0, 980.0, 290.0];
const LINE: f64 = 14.0;

type Point = (f64, f64);

/// Middle of a state's box.
const fn place(state: State) -> Point {
    match state {
        State::SelfTest => (110.0, 130.0),
        State::Locked => (370.0, 130.0),
        State::Ready => (630.0, 130.0),
        State::Running => (890.0, 130.0),
        State::Fault => (370.0, 440.0),
        State::Stopped => (110.0, 440.0),
    }
}

fn in_frame(state: State) -> bool {
    place(state).1 < FRAME[3]
}

/// What must hold and what must not, a line each.
fn condition(arrow: &Transition) -> Vec<String> {
    let named = |facts: Facts| Facts::NAMED.into_iter().filter(move |(fact, _)| facts.has(*fact)).map(|(_, name)| name);
    let must = named(arrow.all).map(str::to_owned);
    let must_not = named(arrow.none).map(|name| format!("no {name}"));
    must.chain(must_not)
        .map(|line| line.replace("no enable on", "enable off").replace("no neutral", "not neutral"))
        .collect()
}

fn text(out: &mut String, (x, y): Point, anchor: &str, lines: &[String]) {
    for (i, line) in lines.iter().enumerate() {
        let y = y + LINE * i as f64;
        out.push_str(&format!("<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{line}</text>\n"));
    }
}

fn path(out: &mut String, d: &str) {
    out.push_str(&format!(
        "<path d=\"{d}\" fill=\"none\" stroke=\"#141414\" stroke-width=\"1.5\" marker-end=\"url(#head)\"/>\n"
    ));
}

/// One arrow between two boxes.
fn arrow(out: &mut String, from: State, to: State, lines: &[String]) {
    let ((x, y), (u, v)) = (place(from), place(to));
    let side = if u > x { 1.0 } else { -1.0 };
    if y == v && (u - x).abs() < 300.0 {
        // Neighbours: onward above, back below.
        let lift = -8.0 * side;
        path(out, &format!("M{} {} L{} {}", x + side * HALF.0, y + lift, u - side * HALF.0, v + lift));
        let middle = 0.5 * (x + u);
        let first = if side > 0.0 { y - 14.0 - LINE * (lines.len() - 1) as f64 } else { y + 24.0 };
        text(out, (middle, first), "middle", lines);
    } else if y == v {
        path(out, &format!("M{x} {} Q{} {} {u} {}", y + HALF.1, 0.5 * (x + u), y + 170.0, v + HALF.1));
        text(out, (0.5 * (x + u), y + 116.0), "middle", lines);
    } else {
        path(out, &format!("M{} {y} L{u} {}", x + HALF.0, v + HALF.1));
        text(out, (0.5 * (x + u) - 8.0, y - 60.0), "start", lines);
    }
}

/// The drawing.
pub fn drawing() -> String {
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"The supervisor's states\" width=\"{WIDTH}\" \
         height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <defs><marker id=\"head\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"8\" markerHeight=\"8\" \
         orient=\"auto\"><path d=\"M0 0 L10 5 L0 10 z\" fill=\"#141414\"/></marker></defs>\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#FFFFFF\"/>\n"
    );
    let [left, top, right, bottom] = FRAME;
    out.push_str(&format!(
        "<rect x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\" rx=\"10\" fill=\"#F6F6F6\" stroke=\"#7D7D7D\" \
         stroke-dasharray=\"6 5\"/>\n",
        right - left,
        bottom - top
    ));
    let framed: Vec<State> = State::ALL.into_iter().filter(|state| in_frame(*state)).collect();
    // An arrow that leaves every state of the frame leaves the frame.
    let common: Vec<Transition> = framed.first().map_or(Vec::new(), |first| {
        let of_all = |arrow: &&Transition| framed.iter().all(|state| transitions(*state).contains(arrow));
        transitions(*first).iter().filter(of_all).copied().collect()
    });
    for shared in &common {
        let (x, y) = place(shared.to);
        path(&mut out, &format!("M{x} {bottom} L{x} {}", y - HALF.1));
        text(&mut out, (x + 8.0, 0.5 * (bottom + y) - 10.0), "start", &condition(shared));
    }
    for from in State::ALL {
        let own = transitions(from).iter().filter(|arrow| !(in_frame(from) && common.contains(arrow)));
        let mut drawn: Vec<(State, Vec<String>)> = Vec::new();
        for arrow in own {
            let lines = condition(arrow);
            match drawn.iter_mut().find(|(to, _)| *to == arrow.to) {
                Some((_, known)) => known.push(format!("or {}", lines.join(", "))),
                None => drawn.push((arrow.to, lines)),
            }
        }
        for (to, lines) in drawn {
            arrow(&mut out, from, to, &lines);
        }
    }
    for state in State::ALL {
        let (x, y) = place(state);
        let fill = match state {
            State::Running => "#CFE8D8",
            State::Fault | State::Stopped => "#F5D5C8",
            _ => "#FFFFFF",
        };
        out.push_str(&format!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"6\" fill=\"{fill}\" stroke=\"#141414\" \
             stroke-width=\"1.5\"/>\n<text x=\"{x}\" y=\"{}\" text-anchor=\"middle\" font-size=\"15\">{}</text>\n",
            x - HALF.0,
            y - HALF.1,
            2.0 * HALF.0,
            2.0 * HALF.1,
            y + 5.0,
            state.name().replace('_', " ")
        ));
    }
    out.push_str("</svg>\n");
    out
}
