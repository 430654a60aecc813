//! The drawing from above, where the swing moves or something stands beside the machine.

use kinematics_core::Rotor;

use super::Seen;
use super::linkage::Linkage;
use super::moments::Tracks;
use super::shapes::{Frame, circle, dot, still, through};

/// Less swing than this is not worth a second drawing, sine.
const SMALL: f64 = 0.01;

/// The drawing; empty where it would show nothing.
pub(super) fn draw(seen: &Seen<'_>, linkage: &Linkage, tracks: &mut Tracks) -> String {
    let swings: Vec<Rotor<f64>> = seen.moments.rows.iter().map(|row| row.swing.unwrap_or(Rotor::IDENTITY)).collect();
    let turns = swings.iter().any(|swing| swing.sin.abs() > SMALL || swing.cos < 0.0);
    let upright: Vec<_> = seen.limits.planes.iter().filter(|plane| plane.normal[2].abs() <= 0.9).collect();
    if !turns && upright.is_empty() && seen.limits.balls.is_empty() && seen.limits.swing.is_none() {
        return String::new();
    }
    let [pin, knee, elbow, wrist, teeth] =
        [linkage.boom_pin, linkage.knee, linkage.arm_pin, linkage.bucket_pin, linkage.teeth].map(|track| {
            let places: Vec<[f64; 2]> = tracks
                .of(track)
                .iter()
                .zip(&swings)
                .map(|([reach, _], swing)| [swing.cos, swing.sin].map(|part| part * f64::from(*reach) * 1e-3))
                .collect();
            tracks.add(places.into_iter())
        });
    let reach_m = seen.scenario.machine.geometry.reach_m();
    let way: Vec<[f64; 2]> = tracks.of(teeth).iter().map(|place| place.map(|mm| f64::from(mm) * 1e-3)).collect();
    let balls = seen.limits.balls.iter().flat_map(|ball| {
        let [x, y, _] = ball.centre_m;
        [[x - ball.radius_m, y - ball.radius_m], [x + ball.radius_m, y + ball.radius_m]]
    });
    let all = way.iter().copied().chain(balls).chain([[0.1 * reach_m; 2], [-0.1 * reach_m; 2]]);
    let frame = Frame::around(all, 0.06 * reach_m);
    let far = 2.0 * reach_m;

    let mut out = still("ahead", way.iter().map(|[x, y]| Some((*x, *y))), 0.01);
    for plane in upright {
        let [x, y, _] = plane.normal;
        let foot = (plane.offset_m * x, plane.offset_m * y);
        let ends = [far, -far].map(|far| Some((foot.0 - far * y, foot.1 + far * x)));
        out += &still("limit", ends.into_iter(), 0.0);
    }
    for end in seen.limits.swing.iter().flat_map(|range| [range.right_deg, range.left_deg]) {
        let end = Rotor::from_degrees(end);
        out += &still("limit", [Some((0.0, 0.0)), Some((far * end.cos, far * end.sin))].into_iter(), 0.0);
    }
    for ball in &seen.limits.balls {
        out += &circle("limit", [ball.centre_m[0], ball.centre_m[1]], ball.radius_m);
    }
    if let Some([x, y, _]) = seen.limits.target_m {
        out += &circle("target", [x, y], 0.015 * reach_m);
    }
    let shape = &seen.scenario.machine.outline;
    out += &circle("body", [0.0, 0.0], 0.09 * reach_m);
    out += &through("rim", &[pin, knee, elbow, wrist], Some(2.0 * shape.arm_half_width_m));
    out += &through("barrel", &[wrist, teeth], Some(2.0 * shape.bucket_half_width_m));
    out += &dot("teeth", teeth, 0.01 * reach_m);
    let svg = frame.svg("above", "From above", 0.045, &out);
    format!(
        "<div class=\"from-above\"><p class=\"caption\">From above: x forward, y to the left, metres from the swing axis.</p>\n{svg}</div>"
    )
}
