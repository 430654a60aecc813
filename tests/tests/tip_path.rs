//! Paths of the tip: knots evenly along a line, an arc or a row of sides.

use kinematics_core::Vec2;
use kinematics_core::planning::tip_path::TipPath;
use libm::{cos, hypot, sin};

const K: usize = 13;

fn near(found: Vec2<f64>, x: f64, z: f64) -> bool {
    hypot(found.x - x, found.z - z) < 1e-12
}

#[test]
fn a_line_has_its_knots_evenly_from_end_to_end() {
    let path = TipPath::<f64, K>::line(Vec2::new(1.0, 2.0), Vec2::new(4.0, -2.0));
    for (i, knot) in path.knots().iter().enumerate() {
        let share = i as f64 / 12.0;
        assert!(near(*knot, 1.0 + 3.0 * share, 2.0 - 4.0 * share), "{i}: {knot:?}");
    }
    assert!((path.length() - 5.0).abs() < 1e-12);
}

#[test]
fn an_arc_turns_evenly_about_its_centre() {
    let (centre, from) = (Vec2::new(3.0, 1.0), Vec2::new(3.0, -1.0));
    for turns in [0.25, -0.6] {
        let path = TipPath::<f64, K>::arc(centre, from, turns);
        for (i, knot) in path.knots().iter().enumerate() {
            let angle = std::f64::consts::TAU * (turns * i as f64 / 12.0 - 0.25);
            assert!(near(*knot, 3.0 + 2.0 * cos(angle), 1.0 + 2.0 * sin(angle)), "{turns} {i}: {knot:?}");
        }
    }
}

#[test]
fn a_row_of_sides_has_its_knots_evenly_along_all_of_them_and_the_last_on_its_last_point() {
    // Sides of 3, 4 and 5 m: one metre from knot to knot.
    let points = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (0.0, 0.0)].map(|(x, z)| Vec2::new(x, z));
    let path = TipPath::<f64, K>::polyline(&points);
    for (i, knot) in path.knots().iter().enumerate() {
        let along = i as f64;
        let (x, z) = if along <= 3.0 {
            (along, 0.0)
        } else if along <= 7.0 {
            (3.0, along - 3.0)
        } else {
            (3.0 - 0.6 * (along - 7.0), 4.0 - 0.8 * (along - 7.0))
        };
        assert!(near(*knot, x, z), "{i}: {knot:?}");
    }
    let odd = [(0.1, 0.7), (0.3, 0.2), (1.1, 0.9), (2.3, 0.4)].map(|(x, z)| Vec2::new(x, z));
    assert_eq!(TipPath::<f64, K>::polyline(&odd).knots()[K - 1], odd[3]);
    assert_eq!(TipPath::<f64, K>::polyline(&odd[..1]).knots(), &[odd[0]; K]);
}
