//! What is compared computes the same: the papers' formulas and ours agree over the whole stroke.

use bench::seed::double::Dimensions;
use kinematics_core::distances::FrankelDistances;
use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinders, Machine, PlaneTip, Rotor};

const INCH_M: f64 = 0.0254;

fn machine() -> Machine<f64> {
    Machine::new(&bench::ours::frankel().to_pins().unwrap()).unwrap()
}

#[test]
fn the_papers_formulas_and_ours_give_the_same_tips_and_cylinders() {
    let (ours, seed) = (machine(), Dimensions::new());
    let strokes = [(29.0, 46.5434), (27.699, 41.9298), (22.0242, 38.6144)];
    let swing: f64 = 0.3;
    for i in 0..=10 {
        for j in 0..=10 {
            for k in 0..=10 {
                let part = |n: i32, (min, max): (f64, f64)| min + (0.01 + 0.098 * f64::from(n)) * (max - min);
                let inches = [part(i, strokes[0]), part(j, strokes[1]), part(k, strokes[2])];
                let [boom, arm, bucket] = inches.map(|x| x * INCH_M);
                let pose = ours.cylinders_to_tip(&Cylinders { boom, arm, bucket }, Rotor::from_angle(swing)).unwrap();
                let tip = seed.cylinders_to_tip(swing, inches).map(|x| x * INCH_M);
                for (a, b) in [pose.x, pose.y, pose.z()].into_iter().zip(tip) {
                    assert!((a - b).abs() < 1e-12, "{inches:?}: {a} and {b}");
                }
                let plane: PlaneTip<f64> = pose.plane;
                let pitch = plane.pitch.angle();
                let back = seed.tip_to_cylinders([plane.reach / INCH_M, plane.height / INCH_M, pitch]);
                for (a, b) in back.into_iter().zip(inches) {
                    assert!((a - b).abs() < 1e-9, "{inches:?}: {a} and {b}");
                }
            }
        }
    }
}

#[test]
fn the_strokes_are_the_papers() {
    let Stroke { min_m, max_m } = FrankelDistances::clone(&bench::ours::frankel()).boom;
    assert!((min_m / INCH_M - 29.0).abs() < 1e-12 && (max_m / INCH_M - 46.5434).abs() < 1e-12);
}
