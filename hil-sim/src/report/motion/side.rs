//! The drawing from the side: the swing's plane, reach and height over the boom pin.

use super::Seen;
use super::linkage::Linkage;
use super::moments::Tracks;
use super::shapes::{Frame, area, circle, dot, growing, still, through};

/// The drawing.
pub(super) fn draw(seen: &Seen<'_>, linkage: &Linkage, tracks: &mut Tracks) -> String {
    let reach_m = seen.scenario.machine.geometry.reach_m();
    let ground_m = -seen.scenario.machine.boom_pin_height_m;
    let frame = frame(seen, linkage, tracks, ground_m, 0.05 * reach_m);
    let mut out = ground(seen, &frame, ground_m, reach_m);
    out += &machine(seen, linkage);
    // In front: a path through soil lies inside the bucket.
    out += "<path class=\"ahead\" id=\"ahead\"/>\n<path class=\"done\" id=\"done\"/>\n";
    out += &still("asked", seen.asked.iter().copied(), frame.x[1] / 800.0);
    out += &dot("teeth", linkage.teeth, 0.01 * reach_m);
    out += &limits(seen, &frame, tracks);
    if seen.log.rows.iter().any(|row| row.reference.is_some()) {
        out += &format!("<circle class=\"wanted\" id=\"wanted\" r=\"{}\"/>\n", (8.0 * reach_m) as i32);
    }
    let svg = frame.svg("side", "From the side, turning with the swing", 0.022, &out);
    let legend = legend(seen);
    format!(
        "<h2>The machine moving</h2>\n<p class=\"caption\">From the side, turning with the swing; metres from the swing axis and over the \
         boom pin. Links, cylinders and their thickness are those of the machine file; the body is only hinted at.</p>\n{svg}{legend}"
    )
}

/// Room for everywhere the linkage goes, and for the ground.
fn frame(seen: &Seen<'_>, linkage: &Linkage, tracks: &Tracks, ground_m: f64, margin_m: f64) -> Frame {
    let moving = linkage.pins().into_iter().chain([linkage.knee, linkage.back, linkage.teeth]);
    let places = moving.flat_map(|track| tracks.of(track)).map(|place| place.map(|mm| f64::from(mm) * 1e-3));
    let asked = seen.asked.iter().flatten().map(|&(x, z)| [x, z]);
    let cuts = seen.log.ground.cuts.iter().map(|cut| [0.0, cut.height_m]);
    Frame::around(places.chain(asked).chain(cuts).chain([[-4.0 * margin_m, ground_m - 4.0 * margin_m]]), margin_m)
}

/// The soil, how it was, and what carries the boom.
fn ground(seen: &Seen<'_>, frame: &Frame, ground_m: f64, reach_m: f64) -> String {
    let g = &seen.scenario.machine.geometry;
    let mut out = String::from("<path class=\"soil\" id=\"soil\"/>\n");
    if !seen.log.ground.cuts.is_empty() {
        out += &still("before", [Some((frame.x[0], ground_m)), Some((frame.x[1], ground_m))].into_iter(), 0.0);
    }
    // Only a hint of the body: the file has no more of it than these two pins.
    let (half, pin, base) = (0.09 * reach_m, g.boom_pin_x_m, g.boom.base);
    let body = [(-half, ground_m), (-half, 0.3 * ground_m), (pin, 0.0), (pin + base.x, base.z), (half, ground_m)];
    out += &still("body", body.into_iter().map(Some), 0.0);
    out + &still("axis", [Some((0.0, frame.y[0])), Some((0.0, frame.y[1]))].into_iter(), 0.0)
}

/// Links and cylinders, what lies in front last.
fn machine(seen: &Seen<'_>, linkage: &Linkage) -> String {
    let shape = &seen.scenario.machine.outline;
    let l = linkage;
    let [boom, arm, bucket] = l.cylinders;
    let (thick, thin) = (2.0 * shape.boom_radius_m, 2.0 * shape.arm_radius_m);
    let (tube, link) = (2.0 * shape.cylinder_radius_m, 2.0 * shape.link_radius_m);
    let mut out = String::new();
    // Each body twice: a dark one, and a slightly thinner light one in it.
    for (class, less) in [("rim", 0.0), ("body-of", 0.06)] {
        let wide = |wide: f64| Some(wide * (1.0 - less) - 0.4 * less * link);
        for pin in [boom.eye, arm.base] {
            out += &area(class, &[l.boom_pin, pin, l.arm_pin], wide(0.5 * thin));
        }
        out += &through(class, &[l.boom_pin, l.knee, l.arm_pin], wide(thick));
    }
    for (class, less) in [("rim", 0.0), ("body-of", 0.06)] {
        let wide = |wide: f64| Some(wide * (1.0 - less) - 0.4 * less * link);
        out += &area(class, &[l.arm_pin, arm.eye, l.bucket_pin], wide(thin));
    }
    out += &area("bucket", &[l.bucket_pin, l.coupler_pin, l.back, l.teeth], None);
    out += &through("shell", &[l.bucket_pin, l.coupler_pin, l.back, l.teeth], Some(3.0 * shape.bucket_radius_m));
    out += &through("link", &[l.rocker_pivot, bucket.eye], Some(link));
    out += &through("link", &[bucket.eye, l.coupler_pin], Some(link));
    for (name, cylinder) in ["boom", "arm", "bucket"].into_iter().zip(l.cylinders) {
        out += &through("rod", &[cylinder.base, cylinder.eye], Some(0.5 * tube));
        out += &through(&format!("barrel of-{name}"), &[cylinder.base, cylinder.barrel], Some(tube));
    }
    out + &l.pins().into_iter().map(|pin| dot("pin", pin, 0.35 * link)).collect::<String>()
}

/// Fence, obstacles and target where the swing's plane meets them.
fn limits(seen: &Seen<'_>, frame: &Frame, tracks: &mut Tracks) -> String {
    let swings: Vec<_> =
        seen.moments.rows.iter().map(|row| row.swing.unwrap_or(kinematics_core::Rotor::IDENTITY)).collect();
    let mut out = String::new();
    for plane in &seen.limits.planes {
        let ends = [0, 1].map(|end| tracks.add(swings.iter().map(|s| plane.section(*s, [frame.x, frame.y])[end])));
        out += &through("limit", &ends, None);
    }
    for ball in &seen.limits.balls {
        let [x, y, z] = ball.centre_m;
        out += &circle("elsewhere", [libm::hypot(x, y), z], ball.radius_m);
        let middle = tracks.add(swings.iter().map(|s| ball.section(*s).0));
        let rim = tracks.add(swings.iter().map(|s| {
            let ([along, z], radius) = ball.section(*s);
            [along + radius, z]
        }));
        out += &growing("limit", middle, rim);
    }
    if let Some([x, y, z]) = seen.limits.target_m {
        out += &circle("target", [libm::hypot(x, y), z], 0.012 * frame.x[1]);
    }
    out
}

fn legend(seen: &Seen<'_>) -> String {
    let mut keys = vec![("done", "tip's way so far"), ("ahead", "to come")];
    if seen.asked.iter().any(Option::is_some) {
        keys.push(("asked", "path asked of it"));
    }
    keys.extend([("of-boom", "boom cylinder"), ("of-arm", "arm cylinder"), ("of-bucket", "bucket cylinder")]);
    let soil = if seen.log.ground.start.is_empty() { "ground (not cut: this plant has no soil)" } else { "soil" };
    keys.push(("soil", soil));
    if !seen.limits.planes.is_empty() || !seen.limits.balls.is_empty() {
        keys.push(("limit", "to keep clear of, where the swing points"));
    }
    if !seen.limits.balls.is_empty() {
        keys.push(("elsewhere", "an obstacle at another swing"));
    }
    if seen.limits.target_m.is_some() {
        keys.push(("target", "target"));
    }
    let keys: String = keys
        .iter()
        .map(|(class, text)| {
            format!(
                "<li><svg viewBox=\"0 0 26 10\" class=\"key\"><path class=\"{class}\" d=\"M1 5H25\"/></svg>{text}</li>"
            )
        })
        .collect();
    format!("<ul class=\"legend\">{keys}</ul>\n")
}
