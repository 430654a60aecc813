//! No bit pattern, however wild, gives an answer with a NaN or an infinity in it.

use cross_tests::machines::{self, Named, equal_links};
use cross_tests::sweep::Random;
use kinematics_core::geometry::Stroke;
use kinematics_core::{Cylinders, Joints, Machine, PinGeometry, PlaneTip, Rotor};

fn strokes(g: &PinGeometry) -> [Stroke; 3] {
    [g.boom.stroke, g.arm.stroke, g.bucket.stroke]
}

fn machines() -> [Named; 4] {
    machines::all().unwrap()
}

fn is_finite(x: f32) -> bool {
    x.is_finite()
}

#[test]
fn no_bit_pattern_of_three_cylinders_gives_a_pose_with_a_nan() {
    for (name, g) in machines() {
        let machine = Machine::<f32>::new(&g).unwrap();
        let mut random = Random::new(11);
        let mut answered = 0;
        for _ in 0..300_000 {
            // Half the lengths inside the stroke, so that the others meet every branch; the rest any bits.
            let lengths = strokes(&g).map(|s| {
                if random.bits() & 1 == 0 {
                    (s.min_m + random.unit() * (s.max_m - s.min_m)) as f32
                } else {
                    f32::from_bits(random.bits() as u32)
                }
            });
            let [boom, arm, bucket] = lengths;
            let cylinders = Cylinders { boom, arm, bucket };
            if let Ok(pose) = machine.cylinders_to_tip(&cylinders, Rotor::from_turns(random.unit() as f32)) {
                let Joints { boom, arm, bucket } = pose.joints;
                let numbers = [
                    pose.x,
                    pose.y,
                    pose.z(),
                    pose.plane.reach,
                    pose.plane.pitch.cos,
                    pose.plane.pitch.sin,
                    boom.cos,
                    boom.sin,
                    arm.cos,
                    arm.sin,
                    bucket.cos,
                    bucket.sin,
                ];
                assert!(numbers.into_iter().all(is_finite), "{name}: {cylinders:?} gives {pose:?}");
                answered += 1;
            }
            if let Ok(found) = machine.cylinders_to_joints_any_stroke(&cylinders) {
                let numbers =
                    [found.boom.cos, found.boom.sin, found.arm.cos, found.arm.sin, found.bucket.cos, found.bucket.sin];
                assert!(numbers.into_iter().all(is_finite), "{name}: {cylinders:?} gives {found:?}");
            }
        }
        assert!(answered > 10_000, "{name}: {answered}");
    }
}

#[test]
fn no_bit_pattern_of_a_tip_gives_cylinders_with_a_nan() {
    for (name, g) in machines().into_iter().chain([("equal links", equal_links())]) {
        let machine = Machine::<f32>::new(&g).unwrap();
        let mut random = Random::new(12);
        let (mut answered, mut inside) = (0, 0);
        for _ in 0..300_000 {
            let (x, z) = ((2.0 * random.unit() - 1.0) * g.reach_m(), (2.0 * random.unit() - 1.0) * g.reach_m());
            let pitch = Rotor::<f32>::from_turns(random.unit() as f32);
            let choice = random.bits();
            let mut number = |mask: u64, good: f32| {
                if choice & mask == mask { f32::from_bits(random.bits() as u32) } else { good }
            };
            let pitch = Rotor { cos: number(0b11, pitch.cos), sin: number(0b1100, pitch.sin) };
            let tip = PlaneTip { reach: number(0b11_0000, x as f32), height: number(0b1100_0000, z as f32), pitch };
            if let Ok(found) = machine.tip_to_joints(&tip) {
                let numbers =
                    [found.boom.cos, found.boom.sin, found.arm.cos, found.arm.sin, found.bucket.cos, found.bucket.sin];
                assert!(numbers.into_iter().all(is_finite), "{name}: {tip:?} gives {found:?}");
                answered += 1;
            }
            if let Ok(found) = machine.tip_to_cylinders(&tip) {
                assert!(
                    [found.boom, found.arm, found.bucket].into_iter().all(is_finite),
                    "{name}: {tip:?} gives {found:?}"
                );
                inside += 1;
            }
        }
        assert!(answered > 10_000 && inside > 1000, "{name}: {answered}, {inside}");
    }
}
