//! The figure of labels in `docs/kinematics.md`: every pin, link, cylinder and angle under the name the equations use.
//!
//! `cargo run -p hil-sim --example labels > docs/kinematics.svg` draws it.

mod canvas;

use kinematics_core::{Joints, PinGeometry, Rotor, Vec2};

use crate::machine_file::{MachineFile, MachineFileError};
use canvas::{Canvas, Ink, View};

/// The machine drawn, and its θ2, θ3, θ4 in degrees: a pose in which no two labels meet.
const MACHINE: &str = "zx200";
const POSE_DEG: [f64; 3] = [38.0, -100.0, 15.0];

type Point = Vec2<f64>;

/// Every pin in the boom's plane, from the swing axis at boom-pin height, m.
#[derive(Clone, Copy, Debug)]
struct Pins {
    boom: Point,
    arm: Point,
    bucket: Point,
    tip: Point,
    a: Point,
    b: Point,
    c: Point,
    d: Point,
    e: Point,
    h: Point,
    i: Point,
    j: Point,
}

/// The directions of boom, arm and bucket line.
#[derive(Clone, Copy, Debug)]
struct Directions {
    boom: Rotor<f64>,
    arm: Rotor<f64>,
    bucket: Rotor<f64>,
}

/// Where the circles about `p` and `q` meet, to the left of the way from `p` to `q`.
fn meet(p: Point, p_radius: f64, q: Point, q_radius: f64) -> Point {
    let way = q - p;
    let square = way.norm_squared();
    let along = (square + p_radius * p_radius - q_radius * q_radius) / (2.0 * square);
    let across = libm::sqrt(p_radius * p_radius / square - along * along);
    p + way.complex_mul(Vec2::new(along, across))
}

fn place(g: &PinGeometry, joints: &Joints<f64>) -> (Pins, Directions) {
    let to = Directions {
        boom: joints.boom,
        arm: joints.boom * joints.arm,
        bucket: joints.boom * joints.arm * joints.bucket,
    };
    let along = |from: Point, rotor: Rotor<f64>, x: f64| from + rotor.to_vec().scale(x);
    let boom = Vec2::new(g.boom_pin_x_m, 0.0);
    let arm = along(boom, to.boom, g.boom_m);
    let bucket = along(arm, to.arm, g.arm_m);
    let h = bucket + to.bucket.rotate(g.bucket.coupler_pin);
    let i = arm + to.arm.rotate(g.bucket.rocker_pivot);
    let pins = Pins {
        boom,
        arm,
        bucket,
        tip: along(bucket, to.bucket, g.bucket_m),
        a: boom + g.boom.base,
        b: boom + to.boom.rotate(g.boom.rod),
        c: boom + to.boom.rotate(g.arm.base),
        d: arm + to.arm.rotate(g.arm.rod),
        e: arm + to.arm.rotate(g.bucket.base),
        h,
        i,
        j: meet(i, g.bucket.rocker_m, h, g.bucket.coupler_m),
    };
    (pins, to)
}

/// The figure as SVG.
///
/// # Errors
/// The machine's file cannot be read, or is no machine.
pub fn svg() -> Result<String, MachineFileError> {
    let geometry = MachineFile::load(MACHINE)?.geometry;
    let [boom, arm, bucket] = POSE_DEG.map(Rotor::from_degrees);
    let (pins, to) = place(&geometry, &Joints { boom, arm, bucket });
    let mut canvas = Canvas::new(1000.0, 570.0, "Pins, links, cylinders and angles of an excavator");
    let whole = View { scale: 82.0, left: -1.0, top: 5.1, at: (0.0, 0.0) };
    equipment(&mut canvas, whole, &pins, &to);
    let close = View { scale: 175.0, left: pins.i.x - 0.34, top: pins.j.z + 0.42, at: (690.0, 90.0) };
    linkage(&mut canvas, close, &pins, &to);
    Ok(canvas.finish())
}

/// Left: boom, arm and bucket with their cylinders.
fn equipment(canvas: &mut Canvas, view: View, p: &Pins, to: &Directions) {
    let mut on = canvas.on(view);
    on.body(&[p.boom, p.b, p.c, p.arm]);
    on.body(&[p.arm, p.d, p.e, p.i, p.bucket]);
    on.body(&[p.bucket, p.h, p.tip]);
    on.body(&[p.boom, p.a, Vec2::new(0.0, p.a.z)]);
    let level = Rotor::IDENTITY;
    let ahead = |from: Point, rotor: Rotor<f64>, x: f64| from + rotor.to_vec().scale(x);
    // What angles and lengths are measured from.
    on.thin(Vec2::new(0.0, -1.6), Vec2::new(0.0, 1.1));
    on.thin(Vec2::new(0.0, 0.0), ahead(p.boom, level, 2.0));
    on.thin(p.arm, ahead(p.arm, to.boom, 1.1));
    on.thin(p.bucket, ahead(p.bucket, level, 0.9));
    for (from, until) in [(p.a, p.b), (p.c, p.d), (p.e, p.j)] {
        on.cylinder(from, until);
    }
    on.line(p.boom, p.arm, Ink::Link);
    on.line(p.arm, p.bucket, Ink::Link);
    on.line(p.bucket, p.tip, Ink::Link);
    on.line(p.i, p.j, Ink::Rocker);
    on.line(p.j, p.h, Ink::Rocker);
    on.arc(p.boom, level, to.boom, 1.7, "θ2", (0.28, 0.0));
    on.arc(p.arm, to.boom, to.arm, 0.62, "θ3", (-0.27, 0.03));
    on.arc(p.bucket, level, to.bucket, 0.55, "φ", (0.22, -0.05));
    for pin in [p.boom, p.arm, p.bucket, p.a, p.b, p.c, p.d, p.e, p.h, p.i, p.j, p.tip] {
        on.pin(pin);
    }
    let middle = |one: Point, other: Point| (one + other).scale(0.5);
    on.length(ahead(p.boom, to.boom, 3.0), (0.22, -0.2), "a2");
    on.length(middle(p.arm, p.bucket), (-0.3, -0.05), "a3");
    on.length(middle(p.bucket, p.tip), (-0.28, -0.05), "a4");
    on.measure(Vec2::new(0.0, -1.35), Vec2::new(p.boom.x, -1.35), p.boom, "a1");
    on.name(p.a, (0.22, -0.1), "A");
    on.name(p.b, (-0.24, 0.14), "B");
    on.name(p.c, (-0.22, 0.16), "C");
    on.name(p.d, (-0.02, 0.26), "D");
    on.name(p.e, (0.26, 0.08), "E");
    on.name(p.bucket, (-0.2, 0.02), "P");
    on.name(p.tip, (0.22, -0.08), "N");
    on.words(Vec2::new(0.0, 1.25), (0.0, 0.0), "swing axis, θ1");
    on.words(p.boom, (-0.66, 0.16), "boom pin");
    on.words(p.arm, (-0.48, 0.1), "arm pin");
    on.words(p.a, (0.95, 0.25), "boom cylinder");
    on.words(middle(p.c, p.d), (-0.35, 0.3), "arm cylinder");
    on.words(middle(p.e, p.j), (0.85, 0.05), "bucket cylinder");
}

/// Right: the bucket's linkage, larger.
fn linkage(canvas: &mut Canvas, view: View, p: &Pins, to: &Directions) {
    let mut on = canvas.on(view);
    on.body(&[p.i + to.arm.to_vec().scale(-0.2), p.i, p.bucket]);
    on.body(&[p.bucket, p.h, p.tip]);
    on.thin(p.bucket, p.bucket + to.arm.to_vec().scale(0.75));
    on.cylinder(p.j + (p.e - p.j).scale(0.22), p.j);
    on.line(p.bucket + to.arm.to_vec().scale(-0.68), p.bucket, Ink::Link);
    on.line(p.bucket, p.tip, Ink::Link);
    on.line(p.i, p.j, Ink::Rocker);
    on.line(p.j, p.h, Ink::Rocker);
    on.line(p.bucket, p.h, Ink::Side);
    on.arc(p.bucket, to.arm, to.bucket, 0.5, "θ4", (0.05, -0.1));
    for pin in [p.bucket, p.h, p.i, p.j, p.tip] {
        on.pin(pin);
    }
    on.name(p.i, (0.1, -0.03), "I");
    on.name(p.j, (0.03, 0.11), "J");
    on.name(p.h, (0.17, 0.03), "H, K");
    on.name(p.bucket, (-0.1, -0.02), "P");
    on.name(p.tip, (0.09, 0.06), "N");
    let middle = |one: Point, other: Point| (one + other).scale(0.5);
    on.words(middle(p.i, p.j), (-0.26, 0.1), "rocker r");
    on.words(middle(p.j, p.h), (0.22, 0.02), "coupler c");
    on.length(middle(p.bucket, p.tip), (0.0, -0.14), "a4");
}

#[cfg(test)]
mod tests {
    use kinematics_core::Machine;

    use super::*;

    #[test]
    fn the_pins_stand_where_the_maps_say() {
        let geometry = MachineFile::load(MACHINE).unwrap().geometry;
        let machine = Machine::<f64>::new(&geometry).unwrap();
        let [boom, arm, bucket] = POSE_DEG.map(Rotor::from_degrees);
        let joints = Joints { boom, arm, bucket };
        let (pins, _) = place(&geometry, &joints);
        let cylinders = machine.joints_to_cylinders(&joints).unwrap();
        let off = |p: Point, q: Point, length: f64| ((p - q).norm() - length).abs();
        assert!(off(pins.a, pins.b, cylinders.boom) < 1e-9);
        assert!(off(pins.c, pins.d, cylinders.arm) < 1e-9);
        assert!(off(pins.e, pins.j, cylinders.bucket) < 1e-9);
        assert!(off(pins.j, pins.h, geometry.bucket.coupler_m) < 1e-9);
        let tip = machine.chain().tip(&joints);
        assert!(off(pins.tip, Vec2::new(tip.reach, tip.height), 0.0) < 1e-9);
    }
}
