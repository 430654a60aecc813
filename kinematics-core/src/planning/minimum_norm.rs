//! The usual answer to the bucket's freedom: the shortest joint rates at every instant, Hareesha 2015 (14).

use crate::chain_n::PlanarChain;
use crate::planning::tip_path::TipPath;
use crate::redundancy::pseudo_inverse;
use crate::{Machine, PlaneTip, Real, Rotor, Vec2};

/// Steps of the integration from knot to knot.
const STEPS: i32 = 8;

/// The pitches (turns) at the knots that θ̇ = J⁺v gives from `start` on, integrated by midpoints, the tip kept on the path
/// by the closed-form map; `None` where the path leaves reach or J is singular. It knows no stroke and no fence.
///
/// ```
/// use kinematics_core::planning::minimum_norm::minimum_norm_pitches;
/// use kinematics_core::planning::tip_path::TipPath;
/// use kinematics_core::{Machine, PinGeometry, Vec2};
/// let machine = Machine::<f64>::new(&PinGeometry::EXACT_MINI).unwrap();
/// let path = TipPath::<f64, 9>::line(Vec2::new(2.5, 0.0), Vec2::new(2.0, 0.0));
/// let pitches = minimum_norm_pitches(&machine, &path, -0.25).unwrap();
/// // Drawing in turns the bucket inwards.
/// assert!(pitches[0] == -0.25 && pitches[8] < -0.25);
/// let beyond = TipPath::<f64, 9>::line(Vec2::new(2.5, 0.0), Vec2::new(9.0, 0.0));
/// assert!(minimum_norm_pitches(&machine, &beyond, -0.25).is_none());
/// ```
pub fn minimum_norm_pitches<T: Real, const K: usize>(
    machine: &Machine<T>,
    path: &TipPath<T, K>,
    start: T,
) -> Option<[T; K]> {
    let chain = PlanarChain::from(machine.chain());
    let half = T::from_f64(0.5);
    // dφ in turns of a step of the tip from where it stands.
    let turned = |at: Vec2<T>, pitch: T, by: Vec2<T>| {
        let tip = PlaneTip { reach: at.x, height: at.z, pitch: Rotor::from_turns(pitch) };
        let joints = machine.tip_to_joints(&tip).ok()?;
        let inverse = pseudo_inverse(&chain.jacobian(&[joints.boom, joints.arm, joints.bucket]))?;
        let radians = inverse.iter().fold(T::ZERO, |sum, [x, z]| sum + (*x * by.x + *z * by.z));
        Some(radians * T::from_f64(1.0 / core::f64::consts::TAU))
    };
    let mut pitches = [start; K];
    let mut pitch = start;
    let segments = path.knots().iter().zip(path.knots().iter().skip(1));
    for ((from, to), planned) in segments.zip(pitches.iter_mut().skip(1)) {
        let by = (*to - *from).scale(T::ONE / T::from_i32(STEPS));
        for step in 0..STEPS {
            let at = *from + by.scale(T::from_i32(step));
            let first = turned(at, pitch, by)?;
            pitch = pitch + turned(at + by.scale(half), pitch + half * first, by)?;
        }
        *planned = pitch;
    }
    Some(pitches)
}
