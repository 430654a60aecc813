//! Where the fixed-point maps have no fixed point: f64, and geometries out of its range. There the plain maps answer.

use cross_tests::machines;
use cross_tests::rates::{crowding, cylinder_rates, cylinders, twist};
use cross_tests::sweep::Random;
use kinematics_core::geometry::Stroke;
use kinematics_core::{Machine, PinGeometry, Real, Rotor, Vec2};

/// Exact-mini with its boom cylinder's base 12 mm from the boom pin: its length is six times √(2ab).
fn short_crank() -> PinGeometry {
    let mut g = PinGeometry::EXACT_MINI;
    g.boom.base = Vec2::new(0.012, -0.002);
    let rod = g.boom.rod.norm();
    g.boom.stroke = Stroke { min_m: rod - 0.010, max_m: rod + 0.010 };
    g
}

/// Exact-mini on a slewing platform so wide that the boom pin stands 9 m from the axis.
fn far_boom_pin() -> PinGeometry {
    PinGeometry { boom_pin_x_m: 9.0, ..PinGeometry::EXACT_MINI }
}

fn poses(g: &PinGeometry) -> Vec<[f64; 3]> {
    let mut random = Random::new(31);
    let strokes = [g.boom.stroke, g.arm.stroke, g.bucket.stroke];
    (0..1000).map(|_| strokes.map(|stroke| crowding(stroke, &mut random))).collect()
}

/// At how many of the poses fine and plain maps differ: tip and cylinder-space Jacobian, and the four-joint Jacobians.
fn differences<T: Real>(g: &PinGeometry) -> [usize; 2] {
    differences_of(&Machine::<T>::new(g).unwrap(), g)
}

fn differences_of<T: Real>(machine: &Machine<T>, g: &PinGeometry) -> [usize; 2] {
    let swing = Rotor::from_turns(T::from_f64(0.3));
    let mut differ = [0; 2];
    for at in poses(g) {
        let at = cylinders(at);
        let plain = machine.cylinders_to_tip_with_jacobian(&at, swing).unwrap();
        differ[0] += usize::from(machine.cylinders_to_tip_with_fine_jacobian(&at, swing).unwrap() != plain);
        let (chain, joints) = (machine.chain(), plain.0.joints);
        differ[1] += usize::from(
            chain.fine_swing_jacobian(&joints, swing) != chain.swing_jacobian(&joints, swing)
                || chain.fine_swing_wrist_jacobian(&joints, swing) != chain.swing_wrist_jacobian(&joints, swing),
        );
    }
    differ
}

#[test]
fn out_of_range_the_fine_maps_are_the_plain_ones_bit_for_bit() {
    assert_eq!(differences::<f32>(&short_crank())[0], 0);
    assert_eq!(differences::<f32>(&far_boom_pin()), [0, 0]);
    // Within range nearly every pose differs in some bit.
    let [kernel, chain] = differences::<f32>(&PinGeometry::EXACT_MINI);
    assert!(kernel > 990 && chain > 500, "{kernel} {chain}");
    // The chain's range is its own.
    assert!(differences::<f32>(&short_crank())[1] > 500);
}

#[test]
fn without_fine_maps_they_are_the_plain_ones_and_every_other_map_is_the_same() {
    for (name, g) in machines::all().unwrap() {
        let [whole, without] = [Machine::<f32>::new(&g), Machine::without_fine_maps(&g)].map(Result::unwrap);
        assert_eq!(differences_of(&without, &g), [0, 0], "{name}");
        let swing = Rotor::from_turns(0.3);
        for at in poses(&g).into_iter().map(cylinders) {
            let plain = |machine: &Machine<f32>| machine.cylinders_to_tip_with_jacobian(&at, swing).unwrap();
            assert_eq!(plain(&whole), plain(&without), "{name}");
            let back = |machine: &Machine<f32>| machine.tip_to_cylinders(&plain(machine).0.plane);
            assert_eq!(back(&whole), back(&without), "{name}");
        }
    }
}

#[test]
fn in_f64_the_fine_maps_are_the_plain_ones_bit_for_bit() {
    for (name, g) in machines::all().unwrap() {
        assert_eq!(differences::<f64>(&g), [0, 0], "{name}");
    }
}

#[test]
fn out_of_range_accelerations_come_by_way_of_the_moments() {
    let rates = [0.1, -0.2, 0.3];
    for g in [short_crank(), far_boom_pin()] {
        let (single, double) = (Machine::<f32>::new(&g).unwrap(), Machine::<f64>::new(&g).unwrap());
        for at in poses(&g) {
            let exact = twist(double.cylinder_bias(&cylinders(at), &cylinder_rates(rates)).unwrap());
            let found = twist(single.cylinder_bias(&cylinders(at), &cylinder_rates(rates)).unwrap());
            let scale = exact.iter().fold(0.1f64, |l, x| l.max(x.abs()));
            for (found, exact) in found.into_iter().zip(exact) {
                assert!((found - exact).abs() < 2e-5 * scale, "{found} {exact} at {at:?}");
            }
        }
    }
}
