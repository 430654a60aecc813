//! The linkage's outline and its clearances: pins where the cylinders put them, distances as sampling finds them, rows as
//! differences find them.

use cross_tests::machines;
use cross_tests::sweep::Random;
use kinematics_core::planning::clearance::{Clearance, HalfSpace, Sphere};
use kinematics_core::planning::outline::{Outline, OutlineShape, PlacedOutline, Strip};
use kinematics_core::world::BasePlacement;
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, Rotor};

/// A machine somewhere on uneven ground, at a pose within its strokes.
struct Stand {
    machine: Machine<f64>,
    outline: Outline<f64>,
    base: BasePlacement<f64>,
    lengths: Cylinders<f64>,
    /// θ1…θ4, rad.
    angles: [f64; 4],
}

fn random(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

impl Stand {
    fn new(g: &PinGeometry, r: &mut Random) -> Self {
        let machine = Machine::new(g).unwrap();
        let mut length = |stroke: kinematics_core::geometry::Stroke| {
            // Away from the ends, so that differences stay where the linkage closes.
            random(r, stroke.min_m + 1e-3, stroke.max_m - 1e-3)
        };
        let lengths =
            Cylinders { boom: length(g.boom.stroke), arm: length(g.arm.stroke), bucket: length(g.bucket.stroke) };
        let joints = machine.cylinders_to_joints(&lengths).unwrap();
        let base = BasePlacement {
            heading: Rotor::from_turns(random(r, -0.5, 0.5)),
            pitch: Rotor::from_degrees(random(r, -20.0, 20.0)),
            roll: Rotor::from_degrees(random(r, -20.0, 20.0)),
            origin: [random(r, -5.0, 5.0), random(r, -5.0, 5.0), random(r, 0.0, 2.0)],
        };
        let angles = [random(r, -3.1, 3.1), joints.boom.angle(), joints.arm.angle(), joints.bucket.angle()];
        Self { machine, outline: Outline::new(g, &OutlineShape::of(g)).unwrap(), base, lengths, angles }
    }

    fn place(&self, angles: [f64; 4]) -> (Rotor<f64>, PlacedOutline<f64>) {
        let [swing, boom, arm, bucket] = angles.map(Rotor::from_angle);
        let placed = self.outline.place(&self.machine, &Joints { boom, arm, bucket }).unwrap();
        (swing, placed)
    }

    /// A point beside the plane, in the world.
    fn in_world(&self, swing: Rotor<f64>, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let across = swing.rotate(kinematics_core::Vec2::new(x, y));
        self.base.to_world([across.x, across.z, z])
    }

    /// Minus the distance's central difference by each angle.
    fn difference(&self, distance: impl Fn(Rotor<f64>, &PlacedOutline<f64>) -> f64) -> [f64; 4] {
        let h = 1e-6;
        core::array::from_fn(|i| {
            let at = |step: f64| {
                let mut angles = self.angles;
                angles[i] += step;
                let (swing, placed) = self.place(angles);
                distance(swing, &placed)
            };
            (at(-h) - at(h)) / (2.0 * h)
        })
    }
}

fn for_every_stand(seed: u64, each: usize, mut check: impl FnMut(&str, &Stand, &mut Random)) {
    let mut r = Random::new(seed);
    for (name, geometry) in machines::all().unwrap() {
        for _ in 0..each {
            let stand = Stand::new(&geometry, &mut r);
            check(name, &stand, &mut r);
        }
    }
}

fn unit(r: &mut Random) -> [f64; 3] {
    loop {
        let v: [f64; 3] = core::array::from_fn(|_| random(r, -1.0, 1.0));
        let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        if norm > 0.1 && norm < 1.0 {
            return v.map(|x| x / norm);
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Points of a strip at even steps, along it and across.
fn samples(strip: &Strip<f64>) -> impl Iterator<Item = [f64; 3]> + '_ {
    const STEPS: i32 = 60;
    let [from, to] = strip.ends.map(|end| end.at);
    (0..=STEPS).flat_map(move |i| {
        let part = f64::from(i) / f64::from(STEPS);
        let at = from.scale(1.0 - part) + to.scale(part);
        (-STEPS..=STEPS).map(move |j| [at.x, strip.lateral * f64::from(j) / f64::from(STEPS), at.z])
    })
}

fn near(a: [f64; 4], b: [f64; 4], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance)
}

#[test]
fn the_cylinders_and_the_four_bar_have_their_lengths_in_the_outline() {
    let mut r = Random::new(1);
    for (name, g) in machines::all().unwrap() {
        for _ in 0..200 {
            let stand = Stand::new(&g, &mut r);
            let (_, placed) = stand.place(stand.angles);
            let [.., boom_cylinder, arm_cylinder, bucket_cylinder, rocker, coupler, _, _, _] = placed.strips;
            let long = |strip: Strip<f64>| (strip.ends[1].at - strip.ends[0].at).norm();
            let lengths = stand.lengths;
            for (found, is) in [
                (long(boom_cylinder), lengths.boom),
                (long(arm_cylinder), lengths.arm),
                (long(bucket_cylinder), lengths.bucket),
                (long(rocker), g.bucket.rocker_m),
                (long(coupler), g.bucket.coupler_m),
            ] {
                assert!((found - is).abs() < 1e-11, "{name}: {found} {is}");
            }
        }
    }
}

#[test]
fn distances_are_those_that_sampling_the_strips_in_the_world_finds() {
    for_every_stand(2, 6, |name, stand, r| {
        let (swing, placed) = stand.place(stand.angles);
        let normal = unit(r);
        let space = HalfSpace { normal, offset: random(r, -5.0, 10.0) };
        let ball = Sphere { centre: core::array::from_fn(|_| random(r, -5.0, 5.0)), radius: random(r, 0.0, 1.0) };
        let (seen_space, seen_ball) = (space.seen(&stand.base, swing), ball.seen(&stand.base, swing));
        for strip in &placed.strips {
            let [a, b] = strip.to_half_space(&seen_space).map(|end| end.distance);
            let (plane, exact) = (if a < b { a } else { b }, strip.to_sphere(&seen_ball).distance);
            let (mut least_plane, mut least_ball) = (f64::INFINITY, f64::INFINITY);
            for point in samples(strip) {
                let p = stand.in_world(swing, point);
                let to_plane = space.offset - dot(normal, p) - strip.radius;
                let away = [p[0] - ball.centre[0], p[1] - ball.centre[1], p[2] - ball.centre[2]];
                let to_ball = dot(away, away).sqrt() - ball.radius - strip.radius;
                least_plane = if to_plane < least_plane { to_plane } else { least_plane };
                least_ball = if to_ball < least_ball { to_ball } else { least_ball };
            }
            // A half-space's nearest point is a corner, which is among the samples; a ball's lies between them.
            assert!((plane - least_plane).abs() < 1e-12, "{name}: {plane} {least_plane}");
            assert!(exact <= least_ball + 1e-12 && exact > least_ball - 5e-2, "{name}: {exact} {least_ball}");
            let apart = exact + ball.radius + strip.radius;
            // Half a step along or across, seen at a distance, makes no more than this.
            let step = ((strip.ends[1].at - strip.ends[0].at).norm() + strip.lateral) / 120.0;
            assert!(least_ball - exact <= (apart * apart + step * step).sqrt() - apart + 1e-12, "{name}");
        }
    });
}

#[test]
fn rows_are_the_distances_derivatives_by_every_joint() {
    for_every_stand(3, 60, |name, stand, r| {
        let (swing, placed) = stand.place(stand.angles);
        let space = HalfSpace { normal: unit(r), offset: random(r, -5.0, 10.0) };
        let ball = Sphere { centre: core::array::from_fn(|_| random(r, -8.0, 8.0)), radius: 0.3 };
        for i in 0..placed.strips.len() {
            for end in [0, 1] {
                let at = |swing: Rotor<f64>, placed: &PlacedOutline<f64>| {
                    placed.strips[i].to_half_space(&space.seen(&stand.base, swing))[end]
                };
                let (row, found) = (at(swing, &placed).approach, stand.difference(|s, p| at(s, p).distance));
                assert!(near(row, found, 1e-6), "{name}, strip {i}, end {end}: {row:?} {found:?}");
            }
            let at = |swing: Rotor<f64>, placed: &PlacedOutline<f64>| -> Clearance<f64> {
                placed.strips[i].to_sphere(&ball.seen(&stand.base, swing))
            };
            let here = at(swing, &placed);
            // Next to the centre itself the distance has a kink, which differences step over.
            if here.distance > -0.3 {
                let found = stand.difference(|s, p| at(s, p).distance);
                assert!(near(here.approach, found, 1e-5), "{name}, strip {i}: {:?} {found:?}", here.approach);
            }
        }
    });
}

#[test]
fn single_precision_finds_the_same_clearances_to_a_few_micrometres() {
    for_every_stand(4, 60, |name, stand, r| {
        let g = machines::all().unwrap().into_iter().find(|(n, _)| *n == name).unwrap().1;
        let (swing, placed) = stand.place(stand.angles);
        let (machine, outline) =
            (Machine::<f32>::new(&g).unwrap(), Outline::<f32>::new(&g, &OutlineShape::of(&g)).unwrap());
        let round = |rotor: Rotor<f64>| Rotor { cos: rotor.cos as f32, sin: rotor.sin as f32 };
        let [_, boom, arm, bucket] = stand.angles.map(|angle| round(Rotor::from_angle(angle)));
        let single = outline.place(&machine, &Joints { boom, arm, bucket }).unwrap();
        let centre: [f64; 3] = core::array::from_fn(|_| random(r, -8.0, 8.0));
        let level = BasePlacement::level(Rotor::IDENTITY, [0.0; 3]);
        let level_single = BasePlacement::<f32>::level(Rotor::IDENTITY, [0.0; 3]);
        for (wide, narrow) in placed.strips.iter().zip(&single.strips) {
            let wide = wide.to_sphere(&Sphere { centre, radius: 0.3 }.seen(&level, swing)).distance;
            let ball = Sphere { centre: centre.map(|x| x as f32), radius: 0.3_f32 }.seen(&level_single, round(swing));
            let narrow = narrow.to_sphere(&ball).distance;
            assert!((wide - f64::from(narrow)).abs() < 1e-5, "{name}: {wide} {narrow}");
        }
    });
}

#[test]
fn an_outline_not_given_is_that_of_a_20_t_excavator_in_shares_of_the_reach() {
    for (name, g) in machines::all().unwrap() {
        let shape = OutlineShape::of(&g);
        // Of 10 m of reach: boom 0.6 m thick, arm 0.44 m, cylinders 0.2 m, links 0.2 m, plates 6 cm; widths likewise.
        let in_ten_metres = [
            (shape.boom_radius_m, 0.3),
            (shape.boom_half_width_m, 0.3),
            (shape.arm_radius_m, 0.22),
            (shape.arm_half_width_m, 0.22),
            (shape.cylinder_radius_m, 0.1),
            (shape.boom_cylinder_half_width_m, 0.45),
            (shape.link_radius_m, 0.1),
            (shape.link_half_width_m, 0.3),
            (shape.bucket_radius_m, 0.03),
            (shape.bucket_half_width_m, 0.6),
        ];
        for (found, wanted) in in_ten_metres {
            assert!((found * 10.0 / g.reach_m() - wanted).abs() < 1e-12, "{name}: {found}");
        }
        let knee = [0.5 * (g.boom.rod.x + g.arm.base.x), 0.5 * (g.boom.rod.z + g.arm.base.z)];
        assert_eq!([shape.boom_knee.x, shape.boom_knee.z], knee);
        assert_eq!([shape.bucket_back.x, shape.bucket_back.z], [0.6 * g.bucket_m, 0.45 * g.bucket_m]);
    }
}

#[test]
fn a_ball_about_a_point_of_the_strips_own_plane_still_has_a_direction_to_leave_by() {
    for_every_stand(97, 5, |name, stand, _| {
        let (swing, placed) = stand.place(stand.angles);
        for strip in &placed.strips {
            let [from, to] = &strip.ends;
            // Of a strip in the plane, half-way along it.
            let strip = Strip { lateral: 0.0, ..*strip };
            let centre = stand.in_world(swing, [0.5 * (from.at.x + to.at.x), 0.0, 0.5 * (from.at.z + to.at.z)]);
            let clearance = strip.to_sphere(&Sphere { centre, radius: 0.1 }.seen(&stand.base, swing));
            assert!((clearance.distance + 0.1 + strip.radius).abs() < 1e-9, "{name}: {clearance:?}");
            assert!(clearance.approach.iter().all(|a| a.is_finite()), "{name}: {clearance:?}");
        }
        let at = placed.strips[0].ends[0];
        let point = Strip { ends: [at, at], lateral: 0.0, radius: 0.05 };
        let inside = point.to_sphere(&Sphere { centre: [at.at.x, 0.0, at.at.z], radius: 0.1 });
        assert!((inside.distance + 0.15).abs() < 1e-15 && inside.approach.iter().all(|a| a.is_finite()), "{inside:?}");
    });
}
